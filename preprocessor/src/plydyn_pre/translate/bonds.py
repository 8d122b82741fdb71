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
#: TES of MAT_186 by the law of mixed modes that follows from it
_SEPARATIONS = {
    0.0: "the power law of mixed modes",
    1.0: "the law of Benzeggagh and Kenane",
    2.0: "one separation over both of failure: the power law with the exponent 1",
}

Bond = Cohesive | Springs
#: Of opening and of sliding
Pair = tuple[float, float]


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
    block.lose_filled("an energy that varies with thickness is not translated", "LCG1C", "LCG2C")
    block.lose_filled("onset is by the squares of both stresses", "INICRT")
    if min(block.number("T0"), block.number("S0")) < 0.0:
        block.remarks.append(
            "strengths are those at rest, T0 and S0, which grow with the rate there"
        )
    if any(block.raw(name, 0.0) for name in ("FG1", "FG2")):
        block.remarks.append("no plateau of stress: a triangle of the same strength and toughness")
    thick = block.positive("THICK")
    words = "over THICK, the stiffness of the interface"
    stiffness = block.positive("EMOD") / thick, block.positive("GMOD") / thick
    block.mark(REPLACED, words, "EMOD", "GMOD", "THICK")
    energy = _positive(block, "G1C_0", "G2C_0")
    return _cohesive(block, stiffness, energy, (abs(block.number("T0")), abs(block.number("S0"))))


def _positive(block: Block, opening: str, sliding: str) -> Pair:
    """Numbers above zero of both modes."""
    return block.positive(opening), block.positive(sliding)


def _cohesive(
    block: Block, stiffness: Pair, energy: Pair, strength: Pair, exponent: float = 1.0
) -> Bond:
    """A bond; an exponent below zero is that of Benzeggagh and Kenane, a blank one is 1."""
    values = (*stiffness, *energy, *strength, abs(exponent) or 1.0)
    names = ("normal", "shear", "GIC", "GIIC", "N", "S", "exponent")
    law: dict[str, Any] = dict(zip(names, values, strict=True))
    law["mixing"] = "benzeggagh_kenane" if exponent < 0.0 else "power"
    return made(block, lambda: Cohesive(**law))


def _mixed_mode(block: Block) -> Bond:
    """A bond of MAT_138."""
    exponent = block.number("XMU", 0.0)
    stiffness, energy = _positive(block, "EN", "ET"), _positive(block, "GIC", "GIIC")
    block.refuse_curve("T", " over the size of elements")
    block.refuse_curve("S", " over the size of elements")
    opening, sliding = block.number("T", 0.0), block.number("S", 0.0)
    opening = opening or 2.0 * energy[0] / block.positive("UND")
    sliding = sliding or 2.0 * energy[1] / block.positive("UTD")
    block.mark(TAKEN, "the strengths", "UND", "UTD")
    if block.number("GAMMA", 0.0) != 1.0:
        block.lose_filled("Benzeggagh and Kenane's law has no such exponent", "GAMMA")
    return _cohesive(block, stiffness, energy, (opening, sliding), exponent)


def _tvergaard(block: Block) -> Bond:
    """A bond of MAT_185: three lines of traction over one separation, which is 1 at NLS or TLS."""
    stress, opening = block.positive("SIGMAX"), block.positive("NLS")
    sliding, last = block.positive("TLS"), block.positive("LAMDAF")
    ends = [block.number(name, 0.0) / last for name in ("LAMDA1", "LAMDA2")]
    area = 0.5 * (1.0 - ends[0] + ends[1])
    names = ("SIGMAX", "NLS", "TLS", "LAMDA1", "LAMDA2", "LAMDAF")
    block.mark(REPLACED, "a triangle of the same strength, first slope and energy", *names)
    stiff = (0.0, 0.0)
    if ends[0] > 0.0:
        slope = stress * opening / sliding / (ends[0] * sliding)
        stiff = stress / (ends[0] * opening), slope
    energy = stress * opening * area
    return _cohesive(block, stiff, (energy, energy), (stress, stress * opening / sliding))


def _general(model: Model, block: Block) -> Bond:
    """A bond of MAT_186: a normed curve of traction over separation."""
    energy, strength = _positive(block, "GIC", "GIIC"), _positive(block, "T", "S")
    names = "TSLC", "TSLC2" if block.raw("TSLC2", 0) else "TSLC"
    # the separation at complete failure is energy / (strength area), the first slope its share
    normal, shear = (
        _stiffness_of_curve(model, block, name) * s**2 / e
        for name, s, e in zip(names, strength, energy, strict=True)
    )
    words = "a triangle of the same strength, first slope and energy"
    block.mark(REPLACED, words, "TSLC", "TSLC2")
    return _cohesive(block, (normal, shear), energy, strength, _exponent(block))


def _stiffness_of_curve(model: Model, block: Block, name: str) -> float:
    """First slope of a normed curve times its area."""
    points = model.curve(block, block.whole(name), block.line_of(name))
    area = _area(points)
    rise = next(((x, y) for x, y in points if x > 0.0 and y > 0.0), (0.0, 0.0))
    if area <= 0.0 or rise[0] <= 0.0:
        words = "the curve has no area or does not rise from zero"
        raise block.fail(name, words, block.line_of(name))
    return area * rise[1] / rise[0]


def _exponent(block: Block) -> float:
    """The exponent of mixed modes of MAT_186; below zero for that of Benzeggagh and Kenane."""
    kind = block.number("TES", 0.0)
    if kind not in _SEPARATIONS:
        words = f"{kind:g} is not translated; 0, 1 and 2 are"
        raise block.fail("TES", words, block.line_of("TES"))
    block.mark(REPLACED, _SEPARATIONS[kind], "TES", "XMU")
    match kind:
        case 1.0:
            return -block.positive("XMU")
        case 2.0:
            return 1.0
    return block.number("XMU", 0.0)


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
    strength, exponent = _positive(block, "NFLS", "SFLS"), 1.0
    if option in _TO_DISTANCE:
        reach = block.positive("PARAM")
        energy = strength[0] * reach / 2.0, strength[1] * reach / 2.0
        block.mark(REPLACED, "the distance of failure, as toughness: strength PARAM/2", "PARAM")
    else:
        energy = _positive(block, "ERATEN", "ERATES")
    if option in _BY_ANGLE:
        block.lose_filled("a shear strength that grows with pressure is not translated", "PARAM")
    elif option in _BY_ENERGY:
        exponent = block.number("PARAM", 0.0)
    return _cohesive(block, stiffness, energy, strength, exponent)


def _plastic(model: Model, block: Block, stiffness: Pair) -> Bond:
    """A bond that yields at a stress of von Mises, and softens over its opening by a curve."""
    most = block.positive("NFLS")
    curve = model.curve(block, block.whole("SFLS"), block.line_of("SFLS"))
    area = _area(curve) * (most if curve[0][1] == 1.0 else 1.0)
    words = f"the area below its curve as toughness: {area:g}; in shear the {sqrt(3.0):.3f}th part"
    block.mark(REPLACED, words, "NFLS", "SFLS")
    return _cohesive(block, stiffness, (area, area / sqrt(3.0)), (most, most / sqrt(3.0)))


def _stiffness(block: Block, modulus: float, thickness: float) -> Pair:
    """The stiffness of a bond, from the plies beside it where the card has none."""
    normal = block.number("CN", 0.0)
    if normal <= 0.0:
        normal = _STIFF * modulus / thickness
        block.mark(REPLACED, f"blank: {normal:g}, 50 moduli over the plies' thickness", "CN")
    return normal, normal * (block.number("CT2CN", 0.0) or 1.0)


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
    strength, stiffness = _positive(block, "NFLS", "SFLS"), _stiffness(block, modulus, thickness)
    pairs = zip(strength, stiffness, strict=True)
    opening, sliding = (_BRITTLE * most**2 / (2.0 * stiff) for most, stiff in pairs)
    model.notes.append(
        f"{block.title}, line {block.line}: a bond that breaks at once, as a law of the least"
        f" fracture energy that its stiffness allows (GIC {opening:.3g}, GIIC"
        f" {sliding:.3g}); a tiebreak of option 9 has energies of its own"
    )
    return _cohesive(block, stiffness, (opening, sliding), strength)
