"""Materials of plies as those of plydyn."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import atan2, degrees, isnan, sqrt
from typing import Any

from plydyn_pre.errors import RecipeError
from plydyn_pre.library import find_card
from plydyn_pre.study import Elastic, PlasticKinematic, PlyCodam2, PlyElastic
from plydyn_pre.study.materials import Material
from plydyn_pre.study.plausible import LARGEST_MAJOR
from plydyn_pre.translate.block import IDLE, REPLACED, TAKEN, Block
from plydyn_pre.translate.frames import axes_of
from plydyn_pre.translate.laws import DAMAGED, ENERGIES, ISOTROPIC, OWN, angle_name
from plydyn_pre.translate.model import Model
from plydyn_pre.translate.shears import shear_law
from plydyn_pre.translate.stack import Zone

_IN_PLANE = 1e-3  # of the length of a vector in the plate
_RATIOS = {"PRBA": "nu12", "PRCA": "nu13", "PRCB": "nu23"}


@dataclass(frozen=True)
class Like:
    """A ply of the library, in the units of the deck."""

    name: str = ""
    units: Mapping[str, str] = field(default_factory=dict)

    def energies(self) -> dict[str, Any]:
        """Its fracture energies."""
        values = find_card(self.name).table(self.units)
        if "G1T" not in values:
            raise RecipeError("--like", f"{self.name!r} has no toughnesses of a ply")
        return {
            key: float(values[key]) for key in ("G1T", "G1C", "G2T", "G2C", "G2S") if key in values
        }


def axis_angle(model: Model, block: Block, zone: Zone) -> float:
    """Angle of the material's first axis from x in a zone, degrees."""
    if block.name in ISOTROPIC or (block.name in OWN and not block.has("AOPT")):
        return 0.0
    normal = -1.0 if zone.turned else 1.0
    aopt = block.number("AOPT", 0.0)
    _check_bricks(block, zone, aopt)
    name = angle_name(block)
    beta = normal * block.number(name, 0.0) if aopt in (0.0, 3.0) else 0.0
    if aopt not in (0.0, 3.0):
        block.mark(IDLE, "only AOPT 0 and 3 have an angle of their own", name)
    block.mark(TAKEN, "the plate is flat", "A3", "V3", "D1", "D2", "D3")
    block.mark(IDLE, "of no use for this AOPT", "XP", "YP", "ZP", "A1", "A2", "V1", "V2")
    if aopt == 0.0:
        if isnan(zone.first_edge):
            words = "0: the axes of the elements, which differ from element to element"
            raise block.fail("AOPT", f"{words}; give 2 with the vector A", block.line_of("AOPT"))
        words = "0: the axes of the elements, whose first edge is at this angle from x"
        words = f"{words}: {zone.first_edge:g} degrees, added to the plies"
        block.mark(REPLACED, words, "AOPT")
        return zone.first_edge + beta
    if aopt < 0.0:
        return _system_angle(model, block, -aopt)
    names = {2.0: ("A1", "A2"), 3.0: ("V1", "V2")}.get(aopt)
    if names is None:
        words = f"{aopt:g} is not translated; 0, 2, 3 and systems below zero are"
        raise block.fail("AOPT", words, block.line_of("AOPT"))
    x, y = (block.number(name, 0.0) for name in names)
    x, y = (x, y) if aopt == 2.0 else (normal * y, -normal * x)
    if x == y == 0.0:
        raise block.fail(names[0], "the vector is zero or along z; it must lie in the plate")
    block.mark(REPLACED, "their angle is added to that of the plies", *names, "AOPT")
    return degrees(atan2(y, x)) + beta


def _system_angle(model: Model, block: Block, cid: float) -> float:
    """Angle from x of the first axis of a coordinate system."""
    line = block.line_of("AOPT")
    x, y, z = axes_of(model, block, "AOPT", round(cid), line)[0]
    if abs(z) > _IN_PLANE:
        raise block.fail("AOPT", f"the first axis of system {cid:g} is not in the plate", line)
    block.mark(REPLACED, "the angle of the system is added to that of the plies", "AOPT")
    return degrees(atan2(y, x))


def _check_bricks(block: Block, zone: Zone, aopt: float) -> None:
    """Refuse axes of bricks of which the third is not across the plate."""
    if zone.kind == "shell":
        block.mark(IDLE, "of bricks", "MACF")
        return
    if block.raw("MACF", 0) not in (0, 1):
        words = f"{block.raw('MACF')}: axes that change places are not translated"
        block.lose(words, "MACF", line=block.line_of("MACF"))
    block.mark(TAKEN, "", "MACF") if "MACF" not in block.fates else None
    if aopt in (0.0, 3.0) and not zone.flat:
        words = f"{aopt:g}: nodes 1 to 4 of a brick do not lie along the plate, nor do its axes"
        raise block.fail("AOPT", f"{words}; give 2 with the vector A", block.line_of("AOPT"))
    size = max(abs(block.number(name, 0.0)) for name in ("D1", "D2", "D3"))
    if aopt == 2.0 and abs(block.number("D3", 0.0)) > _IN_PLANE * size:
        words = "vector d of a brick must lie in the plate: axis b is beside a, and c across"
        raise block.fail("D3", words, block.line_of("D3"))


def ply_material(model: Model, block: Block, like: Like) -> Material:
    """A ply; toughnesses that LS-DYNA's card has not are those of a card of the library."""
    if block.name == "MAT_ELASTIC":
        density, young, poisson = (block.number(name, 0.0) for name in ("RO", "E", "PR"))
        return made(block, lambda: Elastic(density=density, E=young, nu=poisson))
    if block.name == "MAT_PLASTIC_KINEMATIC":
        return _metal(block)
    elastic = _own_elastic(block) if block.name in OWN else _elastic(block)
    if block.name in ("MAT_ORTHOTROPIC_ELASTIC", "MAT_PLY_ELASTIC"):
        return made(block, lambda: PlyElastic(**elastic))
    strengths = _strengths(block, elastic)
    energies = _energies(block, like)
    if strengths is None:
        return made(block, lambda: PlyElastic(**elastic))
    if energies is None:
        words = (
            "its card has no fracture energy, so that the strengths are lost and the ply elastic"
        )
        block.lose(
            f"{words}; --like NAME takes them from a ply of the library", *DAMAGED[block.name]
        )
        return made(block, lambda: PlyElastic(**elastic))
    shear = shear_law(model, block, elastic["G12"], strengths["SL"])
    return made(block, lambda: PlyCodam2(**elastic, **strengths, **energies, **shear))


def _metal(block: Block) -> Material:
    """A metal that yields."""
    names = {"density": "RO", "young": "E", "poisson": "PR", "yield_stress": "SIGY"}
    names |= {"tangent": "ETAN", "beta": "BETA", "rate": "SRC", "power": "SRP"}
    values: dict[str, Any] = {own: block.number(name, 0.0) for own, name in names.items()}
    block.lose_filled("no metal is deleted", "FS")
    block.mark(IDLE, "the rate is that of the whole strain", "VP")
    return made(block, lambda: PlasticKinematic(**values))


def _own_elastic(block: Block) -> dict[str, Any]:
    """Elastic constants of a ply by plydyn's names."""
    names = {own: own.upper() for own in ("E1", "E2", "E3", "nu12", "nu13", "nu23")}
    names |= {own: own for own in ("G12", "G13", "G23")} | {"density": "RO"}
    return {own: block.number(name) for own, name in names.items()}


def _elastic(block: Block) -> dict[str, Any]:
    """Elastic constants of a ply."""
    for name in ("EA", "EB", "EC", "GAB", "GBC", "GCA"):
        block.refuse_curve(name)
    young = {"E1": block.positive("EA"), "E2": block.positive("EB")}
    young["E3"] = block.number("EC", 0.0) or young["E2"]
    if not block.has("EC") or not block.raw("EC"):
        block.mark(REPLACED, "blank: EB", "EC")
    minor = {n: block.number(n, 0.0) for n in ("PRBA", "PRCA", "PRCB")}
    block.mark(REPLACED, "minor Poisson's ratios as major ones: PRBA EA/EB", *minor)
    major = {
        "nu12": _major(block, "PRBA", minor["PRBA"], ("EA", young["E1"]), ("EB", young["E2"])),
        "nu13": _major(block, "PRCA", minor["PRCA"], ("EA", young["E1"]), ("EC", young["E3"])),
        "nu23": _major(block, "PRCB", minor["PRCB"], ("EB", young["E2"]), ("EC", young["E3"])),
    }
    found = young | {"density": block.positive("RO")} | major | {"G12": block.positive("GAB")}
    found["G13"] = block.number("GCA", 0.0) or found["G12"]
    found["G23"] = block.number("GBC", 0.0) or found["E2"] / (2.0 * (1.0 + found["nu23"]))
    for name, own in (("GCA", "G13"), ("GBC", "G23")):
        if not block.has(name) or not block.raw(name):
            block.mark(REPLACED, f"blank: {found[own]:g}", name)
    return found


def _major(
    block: Block, name: str, minor: float, first: tuple[str, float], second: tuple[str, float]
) -> float:
    """The major ratio of a minor one, which is checked."""
    major = minor * first[1] / second[1]
    words = f"{_RATIOS[name]} = {name} {first[0]}/{second[0]}"
    doubt = f"{words} = {major:.3g}: is {name} the major ratio? LS-DYNA's is the minor one,"
    doubt = f"{doubt} {minor * second[1] / first[1]:.3g} where {minor:g} is the major"
    if abs(major) >= sqrt(first[1] / second[1]):
        raise block.fail(name, f"no material: {doubt}", block.line_of(name))
    if major > LARGEST_MAJOR and first[1] > second[1]:
        block.remarks.append(doubt)
    return major


def _strengths(block: Block, elastic: dict[str, Any]) -> dict[str, Any] | None:
    """Strengths of a ply; None where all are zero, which is LS-DYNA's word for none."""
    names = dict(zip(("XT", "XC", "YT", "YC", "SL"), DAMAGED[block.name], strict=True))
    for name in names.values() if block.name in ENERGIES else ():
        block.refuse_curve(name, " over the rate")
    found: dict[str, Any] = {own: abs(block.number(name, 0.0)) for own, name in names.items()}
    words = "a strength or a stress of shear that a curve gives over the rate is not translated"
    block.lose_filled(words, "LCXC", "LCXT", "LCYC", "LCYT", "LCSC", "LCTAU", "LCGAM")
    block.lose_filled("fibres in two directions are not translated", "TWOWAY")
    if block.name == "MAT_COMPOSITE_DAMAGE" and not block.has("XC"):
        found["XC"] = found["XT"]
    if not any(found.values()):
        return None
    for own, value in found.items():
        if value == 0.0:
            words = "0 is a strength without limit in LS-DYNA; a ply of plydyn needs all five"
            block.lose(words, names[own], line=block.line_of(names[own]))
            return None
    if block.name in OWN:
        found["ST"] = block.number("ST", 0.0)
        found["matrix_compression"] = "hashin" if block.number("MCOMP", 0.0) else "quadratic"
    return found


def _energies(block: Block, like: Like) -> dict[str, Any] | None:
    """Toughnesses of a ply."""
    names = ENERGIES.get(block.name, ())
    if any(map(block.has, names)):
        words = "fibres that soften on two lines are not translated"
        block.lose_filled(words, "GXCO", "GXTO", "XCO", "XTO")
        for name in names:
            block.refuse_curve(name, " over the size of elements")
        own = dict(zip(("G1T", "G1C", "G2T", "G2C", "G2S"), names, strict=True))
        if block.name in OWN and not block.has("G2S"):
            own.pop("G2S")
        return {key: block.positive(name) for key, name in own.items()}
    if not like.name:
        return None
    found = like.energies()
    words = f"toughnesses, which its card has not, are those of {like.name} of the library"
    shown = ", ".join(f"{key} {value:.4g}" for key, value in found.items())
    block.remarks.append(f"{words}: {shown}")
    return found


def made(block: Block, make: Callable[[], Any]) -> Any:  # noqa: ANN401
    """A material; what it refuses is told with the place of its keyword."""
    try:
        material = make()
    except RecipeError as error:
        raise block.fail("", f"as a material of plydyn: {error}") from error
    block.mark(REPLACED, "numbered anew", "MID")
    return material
