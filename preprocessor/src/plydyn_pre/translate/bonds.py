"""Cohesive laws and tiebreak contacts as bonds between plies."""

from __future__ import annotations

from itertools import pairwise
from math import sqrt
from typing import Any

from plydyn_pre.study import Cohesive, Springs
from plydyn_pre.translate.block import REPLACED, TAKEN, Block
from plydyn_pre.translate.model import Model
from plydyn_pre.translate.plies import made

#: Multiples of the modulus over the thickness beside it that an interface should have
_STIFF = 50.0
#: Options of a tiebreak contact whose bond softens to a distance or with an energy
_TO_DISTANCE, _BY_ENERGY, _BY_ANGLE = (6, 8), (7, 9, 10, 11), (7, 10)
#: Toughness of a bond that breaks at once: this many times the energy at its strength
_BRITTLE = 1.05

Bond = Cohesive | Springs


def cohesive_material(model: Model, block: Block) -> Bond:
    """A bond between plies."""
    if block.name == "MAT_COHESIVE_ELASTIC":
        block.lose_filled("springs do not fail; *MAT_COHESIVE_MIXED_MODE does", "FN_FAIL")
        normal, shear = block.positive("EN"), block.positive("ET")
        return made(block, lambda: Springs(normal=normal, shear=shear))
    if block.name == "MAT_COHESIVE_TH":
        return _tvergaard(block)
    if block.name == "MAT_COHESIVE_GENERAL":
        return _general(model, block)
    if block.name == "MAT_COHESIVE_MIXED_MODE":
        return _mixed_mode(block)
    thick = block.positive("THICK")
    words = "over THICK, the stiffness of the interface"
    normal, shear = block.positive("EMOD") / thick, block.positive("GMOD") / thick
    block.mark(REPLACED, words, "EMOD", "GMOD", "THICK")
    energy: dict[str, Any] = {"GIC": block.positive("G1C_0"), "GIIC": block.positive("G2C_0")}
    strength: dict[str, Any] = {"N": abs(block.number("T0")), "S": abs(block.number("S0"))}
    law: dict[str, Any] = {"mixing": "power", "exponent": 1.0}
    return made(block, lambda: Cohesive(normal=normal, shear=shear, **energy, **strength, **law))


def _mixed_mode(block: Block) -> Bond:
    """A bond of MAT_138."""
    exponent = block.number("XMU", 0.0)
    stiffness: dict[str, Any] = {"normal": block.positive("EN"), "shear": block.positive("ET")}
    energy: dict[str, Any] = {"GIC": block.positive("GIC"), "GIIC": block.positive("GIIC")}
    opening, sliding = block.number("T", 0.0), block.number("S", 0.0)
    strength: dict[str, Any] = {
        "N": opening or 2.0 * energy["GIC"] / block.positive("UND"),
        "S": sliding or 2.0 * energy["GIIC"] / block.positive("UTD"),
    }
    block.mark(TAKEN, "the strengths", "UND", "UTD")
    block.lose_filled("Benzeggagh and Kenane's law has no such exponent", "GAMMA")
    mixing = "benzeggagh_kenane" if exponent < 0.0 else "power"
    law: dict[str, Any] = {"mixing": mixing, "exponent": abs(exponent) or 1.0}
    return made(block, lambda: Cohesive(**stiffness, **energy, **strength, **law))


def _tvergaard(block: Block) -> Bond:
    """A bond of MAT_185: three lines of traction over one separation."""
    stress, opening = block.positive("SIGMAX"), block.positive("NLS")
    sliding = block.positive("TLS")
    ends = [block.number(name, 0.0) for name in ("LAMDA1", "LAMDA2", "LAMDAF")]
    area = 0.5 * (ends[2] - ends[0] + ends[1])
    names = ("SIGMAX", "NLS", "TLS", "LAMDA1", "LAMDA2", "LAMDAF")
    block.mark(REPLACED, "a triangle of the same strength, first slope and energy", *names)
    return made(
        block,
        lambda: Cohesive(
            normal=stress / (ends[0] * opening) if ends[0] > 0.0 else 0.0,
            shear=stress * opening / sliding / (ends[0] * sliding) if ends[0] > 0.0 else 0.0,
            N=stress,
            S=stress * opening / sliding,
            GIC=stress * opening * area,
            GIIC=stress * opening * area,
            mixing="power",
            exponent=1.0,
        ),
    )


def _general(model: Model, block: Block) -> Bond:
    """A bond of MAT_186: a normed curve of traction over separation."""
    energy: dict[str, Any] = {"GIC": block.positive("GIC"), "GIIC": block.positive("GIIC")}
    strength: dict[str, Any] = {"N": block.positive("T"), "S": block.positive("S")}
    points = model.curve(block, block.whole("TSLC"), block.line_of("TSLC"))
    area = _area(points)
    rise = next(((x, y) for x, y in points if x > 0.0 and y > 0.0), (0.0, 0.0))
    if area <= 0.0 or rise[0] <= 0.0:
        raise block.fail("TSLC", "the curve has no area or does not rise from zero")
    # the separation at complete failure is energy / (strength area), the first slope its share
    slope = rise[1] / rise[0]
    stiffness: dict[str, Any] = {
        "normal": slope * strength["N"] ** 2 * area / energy["GIC"],
        "shear": slope * strength["S"] ** 2 * area / energy["GIIC"],
    }
    block.mark(REPLACED, "a triangle of the same strength, first slope and energy", "TSLC", "TES")
    exponent = block.number("XMU", 0.0)
    mixing = "benzeggagh_kenane" if exponent < 0.0 else "power"
    law: dict[str, Any] = {"mixing": mixing, "exponent": abs(exponent) or 1.0}
    return made(block, lambda: Cohesive(**stiffness, **energy, **strength, **law))


def _area(points: list[tuple[float, float]]) -> float:
    """The area below a curve."""
    return sum(0.5 * (b[0] - a[0]) * (a[1] + b[1]) for a, b in pairwise(points))


def tiebreak_material(model: Model, block: Block, modulus: float, thickness: float) -> Bond:
    """A tiebreak contact as a bond; zeros of strengths keep a side from failing."""
    if block.name == "CONTACT_TIEBREAK_CLASSIC":
        return _brittle(model, block, modulus, thickness)
    option = block.whole("OPTION")
    if abs(option) in (2, 3):
        return _brittle(model, block, modulus, thickness)
    if option not in (5, *_TO_DISTANCE, *_BY_ENERGY):
        words = f"{option} is not translated; 1, 2, 3 and 5 to 11 are"
        raise block.fail("OPTION", words, block.line_of("OPTION"))
    stiffness = _stiffness(block, modulus, thickness)
    if option == 5:
        return _plastic(model, block, stiffness)
    strength: dict[str, Any] = {"N": block.positive("NFLS"), "S": block.positive("SFLS")}
    law: dict[str, Any] = {"mixing": "power", "exponent": 1.0}
    if option in _TO_DISTANCE:
        reach = block.positive("PARAM")
        energy: dict[str, Any] = {
            "GIC": strength["N"] * reach / 2.0,
            "GIIC": strength["S"] * reach / 2.0,
        }
        block.mark(REPLACED, "the distance of failure, as toughness: strength PARAM/2", "PARAM")
    else:
        energy = {"GIC": block.positive("ERATEN"), "GIIC": block.positive("ERATES")}
    if option in _BY_ANGLE:
        block.lose_filled("a shear strength that grows with pressure is not translated", "PARAM")
    elif option in _BY_ENERGY:
        law["exponent"] = abs(block.number("PARAM", 0.0)) or 1.0
        law["mixing"] = "benzeggagh_kenane" if block.number("PARAM", 0.0) < 0.0 else "power"
    return made(block, lambda: Cohesive(**stiffness, **energy, **strength, **law))


def _plastic(model: Model, block: Block, stiffness: dict[str, Any]) -> Bond:
    """A bond that yields at a stress of von Mises, and softens over its opening by a curve."""
    most = block.positive("NFLS")
    curve = model.curve(block, block.whole("SFLS"), block.line_of("SFLS"))
    area = _area(curve) * (most if curve[0][1] == 1.0 else 1.0)
    words = f"the area below its curve as toughness: {area:g}; in shear the {sqrt(3.0):.3f}th part"
    block.mark(REPLACED, words, "NFLS", "SFLS")
    strength: dict[str, Any] = {"N": most, "S": most / sqrt(3.0)}
    energy: dict[str, Any] = {"GIC": area, "GIIC": area / sqrt(3.0)}
    law: dict[str, Any] = {"mixing": "power", "exponent": 1.0}
    return made(block, lambda: Cohesive(**stiffness, **energy, **strength, **law))


def _stiffness(block: Block, modulus: float, thickness: float) -> dict[str, Any]:
    """The stiffness of a bond, from the plies beside it where the card has none."""
    normal = block.number("CN", 0.0)
    if normal <= 0.0:
        normal = _STIFF * modulus / thickness
        block.mark(REPLACED, f"blank: {normal:g}, 50 moduli over the plies' thickness", "CN")
    return {"normal": normal, "shear": normal * (block.number("CT2CN", 0.0) or 1.0)}


def _brittle(model: Model, block: Block, modulus: float, thickness: float) -> Bond:
    """A bond that breaks at once where (N/NFLS)^2 + (S/SFLS)^2 = 1."""
    if curve := block.raw("TBLCID", 0):
        words = f"curve {curve} of what the bond still carries is not translated"
        raise block.fail("TBLCID", words, block.line_of("TBLCID"))
    for name in ("NEN", "MES"):
        if float(block.raw(name, 2.0)) not in (0.0, 2.0):
            raise block.fail(
                name, f"{block.raw(name):g} is not translated; 2 is", block.line_of(name)
            )
    block.mark(TAKEN, "squares of both stresses", "NEN", "MES", "PARAM", "ERATEN", "ERATES")
    strength: dict[str, Any] = {"N": block.positive("NFLS"), "S": block.positive("SFLS")}
    stiffness = _stiffness(block, modulus, thickness)
    energy: dict[str, Any] = {
        "GIC": _BRITTLE * strength["N"] ** 2 / (2.0 * stiffness["normal"]),
        "GIIC": _BRITTLE * strength["S"] ** 2 / (2.0 * stiffness["shear"]),
    }
    model.notes.append(
        f"{block.title}, line {block.line}: a bond that breaks at once, as a law of the least"
        f" fracture energy that its stiffness allows (GIC {energy['GIC']:.3g}, GIIC"
        f" {energy['GIIC']:.3g}); a tiebreak of option 9 has energies of its own"
    )
    law: dict[str, Any] = {"mixing": "power", "exponent": 1.0}
    return made(block, lambda: Cohesive(**stiffness, **energy, **strength, **law))
