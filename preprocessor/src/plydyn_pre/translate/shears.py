"""Nonlinear shear of plies as plydyn's: a curve, or the law of Ramberg and Osgood."""

from __future__ import annotations

from typing import Any

from plydyn_pre.translate.block import REPLACED, Block
from plydyn_pre.translate.model import Model

#: LS-DYNA's shear strain has the term ALPH stress**3
_CUBE = 3.0
#: Shear strain at the strength from which on a coefficient is taken for one in another unit
_MOST_STRAIN = 1.0

Points = list[tuple[float, float]]


def shear_law(model: Model, block: Block, modulus: float, strength: float) -> dict[str, Any]:
    """Keys of a ply for its shear in the plane; none where it is linear."""
    for name in ("ALPH", "ALP"):
        if coefficient := float(block.raw(name, 0.0)):
            strain = strength / modulus + coefficient * strength**_CUBE
            if not 0.0 < strain < _MOST_STRAIN:
                words = (
                    f"{name} {coefficient:g} is left out, and shear is linear: it makes a strain"
                )
                block.remarks.append(
                    f"{words} of {strain:.3g} at the shear strength; its unit is 1/stress^3"
                )
                block.mark(
                    REPLACED, "linear shear, for such a coefficient is in another unit", name
                )
                return {}
            block.mark(REPLACED, "shear of Ramberg and Osgood with the exponent 3", name)
            power = {"shear_coefficient": coefficient, "shear_exponent": _CUBE}
            return {"shear": "ramberg_osgood", **power}
    if not shear_points(model, block):
        return {}
    return {"shear": "curve", "shear_curve": f"shear-{block.raw('MID')}"}


def shear_points(model: Model, block: Block) -> Points:
    """Shear stress over strain in the plane, where the law has a curve or makes one."""
    match block.name:
        case "MAT_LAMINATED_FRACTURE_DAIMLER_PINHO":
            if lcid := int(float(block.raw("LCSS", 0))):
                block.mark(REPLACED, "the curve of shear", "LCSS", "SIGY")
                return model.curve(block, lcid, block.line_of("LCSS"))
        case "MAT_LAMINATED_FRACTURE_DAIMLER_CAMANHO":
            return _hardened(block)
        case "MAT_LAMINATED_COMPOSITE_FABRIC":
            names = ("GAMMA1", "TAU1", "GMS", "SC")
            x1, y1, x2, y2 = (float(block.raw(name, 0.0)) for name in names)
            if 0.0 < x1 < x2 and 0.0 < y1 < y2:
                block.mark(REPLACED, "the curve of shear", "GAMMA1", "TAU1", "GMS")
                return [(0.0, 0.0), (x1, y1), (x2, y2)]
    return []


def _hardened(block: Block) -> Points:
    """Shear that yields at a stress and hardens up to the strength."""
    names = ("GAB", "SIGY", "ETAN", "SL")
    modulus, stress, slope, strength = (float(block.raw(name, 0.0)) for name in names)
    block.refuse_curve("ETAN")
    if not (0.0 < stress < strength and 0.0 < slope < modulus):
        if 0.0 < stress < strength:
            words = f"shear is linear up to {strength:g}: to yield at SIGY {stress:g} it needs ETAN"
            block.remarks.append(f"{words} above 0 and below GAB")
        return []
    block.mark(REPLACED, "the curve of shear", "SIGY", "ETAN")
    end = stress / modulus + (strength - stress) / slope
    return [(0.0, 0.0), (stress / modulus, stress), (end, strength)]
