"""Materials of LS-DYNA as those of plydyn."""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, degrees
from typing import Any

from plydyn_pre.errors import RecipeError
from plydyn_pre.library import find_card
from plydyn_pre.study import Cohesive, Elastic, PlyCodam2, PlyElastic
from plydyn_pre.study.materials import Material
from plydyn_pre.study.plausible import LARGEST_MAJOR
from plydyn_pre.translate.reader import LOST, REPLACED, TAKEN, Block

#: Plies that have strengths, and their name for that of shear
DAMAGED = {
    "MAT_COMPOSITE_DAMAGE": ("SC",),
    "MAT_ENHANCED_COMPOSITE_DAMAGE": ("SC",),
    "MAT_LAMINATED_COMPOSITE_FABRIC": ("SC",),
    "MAT_LAMINATED_FRACTURE_DAIMLER_CAMANHO": ("SL",),
}
#: Multiples of the modulus over the thickness beside it that an interface should have
_STIFF = 50.0


def axis_angle(block: Block, first_edge: float) -> float:
    """Angle of the material's first axis from x, degrees."""
    if block.name in ("MAT_ELASTIC", "MAT_CODAM2"):
        return 0.0
    aopt = block.number("AOPT", 0.0)
    beta = block.number("BETA", 0.0)
    if aopt == 0.0:
        words = "0: the axes of the elements, whose first edge is at this angle from x"
        block.mark(REPLACED, f"{words}: {first_edge:g} degrees, added to the plies", "AOPT")
        return first_edge + beta
    names = {2.0: ("A1", "A2"), 3.0: ("V1", "V2")}.get(aopt)
    if names is None:
        raise block.fail("AOPT", f"{aopt:g} is not translated; 0, 2 and 3 are")
    x, y = (block.number(name, 0.0) for name in names)
    x, y = (x, y) if aopt == 2.0 else (y, -x)
    if x == y == 0.0:
        raise block.fail(names[0], "the vector is zero or along z; it must lie in the plate")
    block.mark(REPLACED, "their angle is added to that of the plies", *names, "AOPT", "BETA")
    block.mark(TAKEN, "the plate is flat", "A3", "V3", "D1", "D2", "D3")
    return degrees(atan2(y, x)) + beta


def ply_material(block: Block, like: str) -> Material:
    """A ply; toughnesses that LS-DYNA's card has not are those of a card of the library."""
    if block.name == "MAT_ELASTIC":
        names = ("RO", "E", "PR")
        density, young, poisson = (block.number(name, 0.0) for name in names)
        return _made(block, lambda: Elastic(density=density, E=young, nu=poisson))
    if block.name not in DAMAGED:
        raise block.fail("", f"is no ply that is translated; {', '.join(DAMAGED)} are")
    elastic = _elastic(block)
    strengths = _strengths(block, *DAMAGED[block.name])
    energies = _energies(block, like)
    if energies is None or strengths is None:
        words = "no toughness is known, so the ply is elastic; --like takes them from the library"
        block.mark(LOST, words, "XC", "XT", "YC", "YT", *DAMAGED[block.name])
        block.remarks.append(
            "elastic in the new deck, for its card has no toughness; --like gives one"
        )
        return _made(block, lambda: PlyElastic(**elastic))
    return _made(block, lambda: PlyCodam2(**elastic, **strengths, **energies))


def _elastic(block: Block) -> dict[str, float]:
    """Elastic constants of a ply."""
    young = {f"E{i}": block.number(name, 0.0) for i, name in ((1, "EA"), (2, "EB"))}
    young["E3"] = block.number("EC", 0.0) or young["E2"]
    if not block.has("EC") or not block.raw("EC"):
        block.mark(REPLACED, "blank: EB", "EC")
    for name, value in zip(("EA", "EB"), young.values(), strict=False):
        if value <= 0.0:
            raise block.fail(name, f"{value:g} must be above zero")
    minor = {n: block.number(n, 0.0) for n in ("PRBA", "PRCA", "PRCB")}
    block.mark(REPLACED, "minor Poisson's ratios as major ones: PRBA EA/EB", *minor)
    found = young | {
        "density": block.positive("RO"),
        "nu12": minor["PRBA"] * young["E1"] / young["E2"],
        "nu13": minor["PRCA"] * young["E1"] / young["E3"],
        "nu23": minor["PRCB"] * young["E2"] / young["E3"],
        "G12": block.positive("GAB"),
    }
    for name, minor_name, under in (("nu12", "PRBA", "EB"), ("nu13", "PRCA", "EC")):
        _doubt_major(block, name, found[name], minor_name, f"EA/{under}")
    found["G13"] = block.number("GCA", 0.0) or found["G12"]
    found["G23"] = block.number("GBC", 0.0) or found["E2"] / (2.0 * (1.0 + found["nu23"]))
    return found


def _doubt_major(block: Block, name: str, value: float, minor: str, ratio: str) -> None:
    """Doubt a major Poisson's ratio that no ply has: that of the card may be the major one."""
    if value > LARGEST_MAJOR:
        words = f"{name} = {minor} {ratio} = {value:.3g}: is {minor} the major ratio?"
        block.remarks.append(f"{words} Then divide it by {ratio}, for LS-DYNA wants the minor one")


def _strengths(block: Block, shear: str) -> dict[str, float] | None:
    """Strengths of a ply; None where some are zero, which is LS-DYNA's word for none."""
    names = {"XT": "XT", "XC": "XC", "YT": "YT", "YC": "YC", "SL": shear}
    found = {own: abs(block.number(name, 0.0)) for own, name in names.items()}
    if block.name == "MAT_COMPOSITE_DAMAGE" and not block.has("XC"):
        found["XC"] = found["XT"]
    return found if min(found.values()) > 0.0 else None


def _energies(block: Block, like: str) -> dict[str, float] | None:
    """Toughnesses of a ply."""
    own = {"G1T": "GXT", "G1C": "GXC", "G2T": "GYT", "G2C": "GYC", "G2S": "GSL"}
    if block.name == "MAT_LAMINATED_FRACTURE_DAIMLER_CAMANHO":
        return {key: block.positive(name) for key, name in own.items()}
    if not like:
        return None
    values = find_card(like).values
    if "G1T" not in values:
        raise RecipeError("--like", f"{like!r} has no toughnesses of a ply")
    block.remarks.append(f"toughnesses, which its card has not, are those of {like} of the library")
    return {key: float(values[key].value) for key in own if key in values}


def cohesive_material(block: Block) -> Cohesive:
    """A bond between plies."""
    if block.name == "MAT_COHESIVE_MIXED_MODE":
        exponent = block.number("XMU", 0.0)
        stiffness = {"normal": block.positive("EN"), "shear": block.positive("ET")}
        energy = {"GIC": block.positive("GIC"), "GIIC": block.positive("GIIC")}
        opening, sliding = block.number("T", 0.0), block.number("S", 0.0)
        strength = {
            "N": opening or 2.0 * energy["GIC"] / block.positive("UND"),
            "S": sliding or 2.0 * energy["GIIC"] / block.positive("UTD"),
        }
        mixing = "benzeggagh_kenane" if exponent < 0.0 else "power"
        law: dict[str, Any] = {"mixing": mixing, "exponent": abs(exponent) or 1.0}
    else:
        thick = block.positive("THICK")
        words = "over THICK, the stiffness of the interface"
        stiffness = {
            "normal": block.positive("EMOD") / thick,
            "shear": block.positive("GMOD") / thick,
        }
        block.mark(REPLACED, words, "EMOD", "GMOD", "THICK")
        energy = {"GIC": block.positive("G1C_0"), "GIIC": block.positive("G2C_0")}
        strength = {"N": abs(block.number("T0")), "S": abs(block.number("S0"))}
        words = "no rates, and no plateau of stress: a bilinear law of the same toughness"
        lost = ("G1C_INF", "EDOT_G1", "T1", "EDOT_T", "G2C_INF", "EDOT_G2", "S1", "EDOT_S")
        block.mark(LOST, words, *lost, "FG1", "FG2", "LCG1C", "LCG2C")
        law = {"mixing": "power", "exponent": 1.0}
    block.mark(LOST, "an interface has no mass, and nothing is deleted", "RO", "ROFLG", "INTFAIL")
    return _made(block, lambda: Cohesive(**stiffness, **energy, **strength, **law))


def tiebreak_material(block: Block, modulus: float, thickness: float) -> Cohesive:
    """A tiebreak contact as a bond."""
    option = block.whole("OPTION")
    if abs(option) not in (7, 8, 9, 10, 11):
        raise block.fail("OPTION", f"{option} is not translated; 7 to 11 are")
    strength = {"N": block.positive("NFLS"), "S": block.positive("SFLS")}
    if abs(option) in (8, 10):
        reach = block.positive("PARAM")
        energy = {"GIC": strength["N"] * reach / 2.0, "GIIC": strength["S"] * reach / 2.0}
        block.mark(REPLACED, "the distance of failure, as toughness: strength PARAM/2", "PARAM")
        exponent = 1.0
    else:
        energy = {"GIC": block.positive("ERATEN"), "GIIC": block.positive("ERATES")}
        exponent = abs(block.number("PARAM", 0.0)) or 1.0
    normal = block.number("CN", 0.0)
    if normal <= 0.0:
        normal = _STIFF * modulus / thickness
        block.mark(REPLACED, f"blank: {normal:g}, 50 moduli over the plies' thickness", "CN")
    shear = normal * (block.number("CT2CN", 0.0) or 1.0)
    block.mark(TAKEN, "", "OPTION")
    stiffness = {"normal": normal, "shear": shear, "exponent": exponent}
    mixing = "benzeggagh_kenane" if block.number("PARAM", 0.0) < 0.0 else "power"
    return _made(block, lambda: Cohesive(**stiffness, **energy, **strength, mixing=mixing))


def _made(block: Block, make: Callable[[], Any]) -> Any:  # noqa: ANN401
    """A material; what it refuses is told with the place of its keyword."""
    try:
        material = make()
    except RecipeError as error:
        doubt = next((words for words in block.remarks if "the major ratio?" in words), "")
        words = f"as a material of plydyn: {error}{'; ' if doubt else ''}{doubt}"
        raise block.fail("", words) from error
    block.mark(REPLACED, "numbered anew", "MID")
    return material
