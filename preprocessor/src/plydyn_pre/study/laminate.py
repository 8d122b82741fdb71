"""Laminates: plies from the bottom up, and how fine each is through its thickness."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from itertools import groupby, pairwise
from typing import Literal

from plydyn_pre.errors import LayupError, RecipeError, require
from plydyn_pre.layup import BETWEEN_UNLIKE, parse

_HIGHEST_ORDER = 4
_MOST_LAYERS = 100  # numerical layers in a ply


@dataclass(frozen=True)
class StackPly:
    """A ply with all that the deck says of it."""

    material: str
    thickness: float
    angle: float  # degrees, from the x axis
    order: int
    layers: int


@dataclass(frozen=True)
class PlyRange:
    """Some plies with an expansion of their own."""

    plies: tuple[int, int]  # first and last, counted from the bottom, from 1
    order: int  # of the polynomials in each numerical layer, 1 to 4
    layers: int = 1  # numerical layers in each of these plies

    def __post_init__(self) -> None:
        """Refuse an expansion that there is not."""
        _check_expansion(self.order, self.layers)


@dataclass(frozen=True)
class Laminate:
    """A stacking sequence, its materials, and its expansion through the thickness."""

    layup: str  # from the bottom up, such as [0/90]2s
    thickness: float | dict[str, float]  # of a ply; or by the names of the materials
    material: str = ""  # of the plies whose material the layup does not name
    order: int = 2  # of the polynomials in each numerical layer, 1 to 4
    layers: int = 1  # numerical layers in each ply
    # points through a layer
    basis: Literal["equispaced", "gauss_lobatto"] = "equispaced"
    reference: Literal["bottom", "middle", "top"] = "middle"  # where the nodes are
    interfaces: str = "tied"  # or "apart", or a material, also "NAME between unlike plies"
    join_alike: bool = False  # neighbours of one material and direction are one ply
    strengths: Literal["given", "in-situ"] = "given"  # of plies that are damaged
    refine: tuple[PlyRange, ...] = ()
    title: str = ""
    stack: tuple[StackPly, ...] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Read the layup; refuse what cannot be a laminate."""
        _check_expansion(self.order, self.layers)
        object.__setattr__(self, "stack", _stack(self))

    @property
    def total(self) -> float:
        """Thickness of the laminate."""
        return sum(ply.thickness for ply in self.stack)

    @property
    def bottom(self) -> float:
        """Height of the bottom face above the nodes."""
        return {"bottom": 0.0, "middle": -0.5, "top": -1.0}[self.reference] * self.total

    @property
    def joint(self) -> str:
        """What joins plies: "tied", "apart", or the name of a material."""
        return self.interfaces.removesuffix(BETWEEN_UNLIKE)

    @property
    def tied(self) -> bool:
        """Whether all plies share the points of their faces."""
        return not self.opened

    @property
    def opened(self) -> tuple[int, ...]:
        """Interfaces whose faces have points of their own, counted from the bottom, from 1."""
        if self.joint == "tied":
            return ()
        pairs = enumerate(pairwise(self.stack), start=1)
        every = not self.interfaces.endswith(BETWEEN_UNLIKE)
        return tuple(number for number, (a, b) in pairs if every or not is_alike(a, b))

    @property
    def levels(self) -> int:
        """Thickness points above a node of the plane."""
        return sum(ply.layers * ply.order for ply in self.stack) + 1 + len(self.opened)


def runs(numbers: Iterable[int]) -> list[list[int]]:
    """Rising numbers in runs without a gap."""
    groups = groupby(enumerate(numbers), lambda item: item[1] - item[0])
    return [[number for _, number in group] for _, group in groups]


def is_alike(one: StackPly, other: StackPly) -> bool:
    """Whether two plies have the same material and fibres along the same direction."""
    return one.material == other.material and (one.angle - other.angle) % 180.0 == 0.0


def _check_expansion(order: int, layers: int) -> None:
    """Refuse an expansion that there is not."""
    require(1 <= order <= _HIGHEST_ORDER, "order", f"{order} must be from 1 to {_HIGHEST_ORDER}")
    rule = f"{layers} must be from 1 to {_MOST_LAYERS}"
    require(1 <= layers <= _MOST_LAYERS, "layers", rule)


def _stack(laminate: Laminate) -> tuple[StackPly, ...]:
    """The plies of a laminate."""
    try:
        plies = parse(laminate.layup)
    except LayupError as error:
        raise RecipeError("layup", str(error)) from error
    expansions = _expansions(laminate, len(plies))
    stack = []
    for ply, (order, layers) in zip(plies, expansions, strict=True):
        material = ply.material or laminate.material
        require(bool(material), "material", "missing; the layup names no material for some plies")
        stack.append(StackPly(material, _thickness(laminate, material), ply.angle, order, layers))
    if isinstance(laminate.thickness, dict):
        used = {ply.material for ply in stack}
        for name in laminate.thickness:
            require(name in used, f"thickness.{name}", "the layup has no ply of this material")
    return tuple(_joined(stack) if laminate.join_alike else stack)


def _joined(stack: Iterable[StackPly]) -> Iterator[StackPly]:
    """Plies of which neighbours that are alike are one, with the expansion of the lowest."""
    thick: list[StackPly] = []
    for ply in stack:
        if thick and is_alike(thick[-1], ply):
            thick[-1] = replace(thick[-1], thickness=thick[-1].thickness + ply.thickness)
        else:
            thick.append(ply)
    return iter(thick)


def _thickness(laminate: Laminate, material: str) -> float:
    """Thickness of the plies of a material."""
    given, place = laminate.thickness, "thickness"
    if isinstance(given, dict):
        value, place = given.get(material), f"thickness.{material}"
    else:
        value = given
    if value is None:
        raise RecipeError(place, f"missing; the layup has plies of {material!r}")
    require(value > 0.0, place, f"{value!r} must be above zero")
    return value


def _expansions(laminate: Laminate, plies: int) -> list[tuple[int, int]]:
    """Order and numerical layers of each ply."""
    expansions = [(laminate.order, laminate.layers)] * plies
    for number, finer in enumerate(laminate.refine, start=1):
        first, last = finer.plies
        rule = f"{first} to {last} must be plies from 1 to {plies}, the lower one first"
        require(1 <= first <= last <= plies, f"refine[{number}].plies", rule)
        expansions[first - 1 : last] = [(finer.order, finer.layers)] * (last - first + 1)
    return expansions
