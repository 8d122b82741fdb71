"""The library: materials with the source of each of their numbers."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from math import cos, isclose, radians, sin, tan
from typing import Any

from plydyn_pre.errors import PreError, RecipeError
from plydyn_pre.layup import BETWEEN_UNLIKE
from plydyn_pre.suggest import suggestion
from plydyn_pre.tables import Table
from plydyn_pre.units import unit_factor

#: What joins plies of a material of the library has its name with this behind it
JOINT = " interface"
_STRESS, _ENERGY = (-1, -2, 1), (0, -2, 1)
#: Powers of length, time and mass of the keys that have some
_STRESSES = "E1 E2 E3 G12 G13 G23 XT XC YT YC SL ST N S E young yield shear_yield crush_stress"
DIMENSIONS = dict.fromkeys(_STRESSES.split(), _STRESS)
_TOUGHNESSES = ("G1T", "G1C", "G2T", "G2C", "G2S", "GIC", "GIIC", "GC")
DIMENSIONS |= dict.fromkeys(_TOUGHNESSES, _ENERGY)
DIMENSIONS |= {"density": (-3, 0, 1), "normal": (-2, -2, 1), "shear": (-2, -2, 1)}
DIMENSIONS |= {"cubic": (3, 6, -3), "ply_thickness": (1, 0, 0)}


#: How constants follow from others where a card says nothing else: words, what they need, and the
#: rule; fracture planes of compression across the fibres lie at 53 degrees
_ANGLE = radians(53.0)
_ON_PLANE = cos(_ANGLE) * (sin(_ANGLE) + cos(_ANGLE) / tan(2.0 * _ANGLE))
_RULES: dict[str, tuple[str, tuple[str, ...], Callable[..., float]]] = {
    "E3": ("E2", ("E2",), float),
    "nu13": ("nu12", ("nu12",), float),
    "G13": ("G12", ("G12",), float),
    "G23": ("E2/(2 (1 + nu23))", ("E2", "nu23"), lambda young, nu: young / (2.0 * (1.0 + nu))),
    "ST": (f"{_ON_PLANE:.3f} YC", ("YC",), lambda strength: _ON_PLANE * strength),
    "GIC": ("G2T", ("G2T",), float),
    "GIIC": ("G2S", ("G2S",), float),
    "G2C": ("G2S/cos 53", ("G2S",), lambda toughness: toughness / cos(_ANGLE)),
}
#: By how much numbers of a card are rounded
_ROUNDED = 1.0e-3

#: Keys of plies of kind ply_codam2 that those of kind ply_fracture_3d do not have
_PLANAR = ("ST", "G2C", "GIC", "GIIC", "cubic")


@dataclass(frozen=True)
class Entry:
    """A value of a card and where it is from."""

    value: float | str
    source: str


@dataclass(frozen=True)
class Origin:
    """What a material of a recipe has from the library."""

    card: str
    filled: Table  # constants that the recipe leaves out, by their keys
    derived: dict[str, str]  # rules by which others of the card follow those of the recipe
    whole: bool = False  # whether the recipe gives none itself

    @property
    def words(self) -> str:
        """One line: all constants of a card, or those that it filled in."""
        if self.whole:
            return f"all constants are those of {self.card} of the library"
        shown = [
            f"{key} {value if isinstance(value, str) else f'{value:.5g}'}"
            for key, value in self.filled.items()
        ]
        rules = [f"{key} = {rule}" for key, rule in self.derived.items()]
        filled = f"from {self.card} of the library: {', '.join(shown)}" if shown else ""
        return "; ".join(filter(None, [filled, ", ".join(rules)]))


@dataclass(frozen=True)
class LibraryCard:
    """A material of the library."""

    name: str
    kind: str
    title: str
    note: str
    values: dict[str, Entry]
    ply_thickness: Entry | None = None
    curves: dict[str, Table] = field(default_factory=dict)

    def table(self, units: Mapping[str, str]) -> Table:
        """The table of a recipe with these units."""
        power = self.values.get("shear_exponent", Entry(0.0, "")).value
        found: Table = {"kind": self.kind, "title": self.title}
        for key, entry in self.values.items():
            found[key] = _converted(key, entry.value, units, power)
        return found

    def curve_tables(self, units: Mapping[str, str]) -> Table:
        """The curves of stress over strain that it needs, in these units."""
        factor = unit_factor(_STRESS, units)
        return {
            name: {"time": curve["time"], "value": [factor * value for value in curve["value"]]}
            for name, curve in self.curves.items()
        }


@cache
def library() -> dict[str, LibraryCard]:
    """All cards by their names."""
    data = _data()
    cards = {}
    for name, card in data["cards"].items():
        values = {key: Entry(*pair) for key, pair in card["values"].items()}
        thick = card.get("ply_thickness")
        curve = str(values["shear_curve"].value) if "shear_curve" in values else ""
        cards[name] = LibraryCard(
            name=name,
            kind=card["kind"],
            title=card["title"],
            note=card["note"],
            values=values,
            ply_thickness=Entry(*thick) if thick else None,
            curves={curve: data["curves"][curve]} if curve else {},
        )
    return cards


def sources() -> dict[str, str]:
    """What the short names of sources stand for."""
    return dict(_data()["sources"])


def find_card(name: str) -> LibraryCard:
    """A card by its name."""
    known = {each.casefold(): card for each, card in library().items()}
    if name.casefold() not in known:
        raise PreError(f"{name!r} is not in the library; {suggestion(name, library())}")
    return known[name.casefold()]


def with_library(table: Table) -> tuple[Table, dict[str, Origin]]:
    """The table of a recipe with the materials and curves of the library that it names.

    With it comes what each material has from the library.
    """
    units = table.get("units", {})
    own = table.get("materials", {})
    if not isinstance(own, dict) or not isinstance(units, dict):
        return table, {}
    origins: dict[str, Origin] = {}
    materials: Table = {
        name: _likened(name, each, units, origins) if _is_like(each) else each
        for name, each in own.items()
    }
    used: list[LibraryCard] = []
    changed = table | {"materials": materials}
    for key, laminate in _laminates(table):
        joint = _joint(laminate, own)
        joined = laminate if joint is None else laminate | {"interfaces": joint}
        changed = _put(changed, key, joined)
        used += [library()[name] for name in _names(joined) if name in library()]
    used += filter(None, map(_base, own.values()))
    named = {name for _, laminate in _laminates(changed) for name in _names(laminate)}
    for card in used:
        if card.name not in own and card.name in named:
            materials.setdefault(card.name, _pruned(card.table(units), {}))
            origins.setdefault(card.name, Origin(card.name, {}, {}, whole=True))
    wanted = {each.get("shear_curve") for each in materials.values() if isinstance(each, dict)}
    for card in used:
        curves = {name: each for name, each in card.curve_tables(units).items() if name in wanted}
        if curves:
            changed = changed | {"curves": curves | changed.get("curves", {})}
    return changed, origins


def _joint(laminate: Table, own: Table) -> str | None:
    """What joins plies, by its full name; None where the recipe has it."""
    words = laminate.get("interfaces")
    if not isinstance(words, str):
        return None
    where = BETWEEN_UNLIKE if f" {words}".endswith(BETWEEN_UNLIKE) else ""
    name = f" {words}".removesuffix(BETWEEN_UNLIKE).strip() if where else words
    joints = [key for key, each in own.items() if _is_joint(each)]
    if not name:
        known = joints if len(joints) == 1 else [laminate.get("material")]
        name = known[0] if isinstance(known[0], str) else ""
    if name not in own and name + JOINT in library():
        return name + JOINT + where
    return name + where if where else None


def _is_joint(material: object) -> bool:
    """Whether a table is of a material between plies."""
    return isinstance(material, dict) and material.get("kind") in ("springs", "cohesive")


def _base(material: object) -> LibraryCard | None:
    """The card that a material of a recipe is like."""
    name = material.get("like") if isinstance(material, dict) else None
    return library().get(name) if isinstance(name, str) else None


def _is_like(material: object) -> bool:
    """Whether a material of a recipe is on top of one of the library."""
    return isinstance(material, dict) and "like" in material


def _likened(
    name: str, material: Table, units: Mapping[str, str], origins: dict[str, Origin]
) -> Table:
    """A material of a recipe on top of the card that it is like; its origin is kept."""
    card = _base(material)
    if card is None:
        words = f"{material['like']!r} is not in the library; "
        raise RecipeError(
            f"materials.{name}.like", words + suggestion(str(material["like"]), library())
        )
    below = card.table(units)
    if material.get("kind", card.kind) == "ply_elastic" and card.kind == "ply_codam2":
        kept = ("title", "density", "E", "nu", "G12", "G13", "G23")
        below = {key: value for key, value in below.items() if key.startswith(kept)}
    if material.get("kind", card.kind) == "ply_fracture_3d" and card.kind == "ply_codam2":
        below = {key: value for key, value in below.items() if key not in _PLANAR}
        if below.get("shear") not in ("ramberg_osgood", "curve"):
            below = {key: value for key, value in below.items() if not key.startswith("shear")}
    above = {key: value for key, value in material.items() if key != "like"}
    if "shear" in above and above["shear"] != below.get("shear"):
        below = {key: value for key, value in below.items() if not key.startswith("shear_")}
    below = _pruned(below, above)
    derived = _followed(below, above)
    filled = {
        key: value for key, value in below.items() if key not in {*above, *derived, "kind", "title"}
    }
    rules = {key: _RULES[key][0] for key in derived}
    constants = {key for key, value in below.items() if not isinstance(value, str)}
    whole = not constants & set(above)
    origins[name] = Origin(card.name, filled, rules, whole)
    if not whole:
        below["title"] = f"{name}, like {card.name}"
    return below | derived | above


def _followed(below: Table, above: Table) -> dict[str, float]:
    """Constants that a card has from others by a rule, from those that a recipe replaces."""
    found: dict[str, float] = {}
    for key, (_, needs, rule) in _RULES.items():
        inputs = [(below | found | above).get(need) for need in needs]
        if key not in below or key in above or not any(need in {*found, *above} for need in needs):
            continue
        if not all(isinstance(each, int | float) for each in inputs):
            continue
        of_card = rule(*(below.get(need, 0.0) for need in needs))
        if isclose(below[key], of_card, rel_tol=_ROUNDED):
            found[key] = rule(*inputs)
    return found


def _pruned(below: Table, above: Table) -> Table:
    """A card without the constants that have no effect by what is chosen."""
    if above.get("matrix_compression") == "hashin":
        return below
    return {key: value for key, value in below.items() if key != "ST"}


def _laminates(table: Table) -> list[tuple[tuple[str, ...], Table]]:
    """The tables of laminates with their keys."""
    found: list[tuple[tuple[str, ...], Any]] = [(("laminate",), table.get("laminate"))]
    parts = table.get("laminates")
    if isinstance(parts, dict):
        found += [(("laminates", name), each) for name, each in parts.items()]
    return [(key, each) for key, each in found if isinstance(each, dict)]


def _put(table: Table, key: tuple[str, ...], laminate: Table) -> Table:
    """The table with another laminate."""
    if len(key) == 1:
        return table | {key[0]: laminate}
    return table | {key[0]: table[key[0]] | {key[1]: laminate}}


def _names(laminate: Table) -> list[str]:
    """Names of materials that a laminate may use."""
    joint = laminate.get("interfaces")
    joint = joint.removesuffix(BETWEEN_UNLIKE) if isinstance(joint, str) else joint
    words = [laminate.get("material"), joint]
    thickness = laminate.get("thickness")
    words += list(thickness) if isinstance(thickness, dict) else []
    layup = laminate.get("layup")
    words += [name for name in library() if isinstance(layup, str) and name in layup]
    return [word for word in words if isinstance(word, str)]


def _converted(key: str, value: Any, units: Mapping[str, str], power: Any) -> Any:  # noqa: ANN401
    """A value of the library in other units."""
    if isinstance(value, str):
        return value
    if key == "shear_coefficient":
        return value * unit_factor(_STRESS, units) ** -power
    return value * unit_factor(DIMENSIONS.get(key, (0, 0, 0)), units)


@cache
def _data() -> Table:
    """The file of the library."""
    return tomllib.loads(files("plydyn_pre").joinpath("materials.toml").read_text(encoding="utf-8"))
