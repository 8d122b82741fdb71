"""Numbers in mm, s and t, and in the units of a recipe."""

from __future__ import annotations

from collections.abc import Mapping

_LENGTHS = {"m": 1e3, "cm": 10.0, "mm": 1.0, "um": 1e-3, "in": 25.4, "ft": 304.8}
TIMES = {"s": 1.0, "ms": 1e-3, "us": 1e-6}
_POUND = 0.45359237e-3  # by definition; a slug is what a pound of force moves by a foot/s2
_SLUG = _POUND * 9806.65 / 304.8
_MASSES = {"t": 1.0, "kg": 1e-3, "g": 1e-6, "mg": 1e-9}
_MASSES |= {"lb": _POUND, "slug": _SLUG, "slinch": 12.0 * _SLUG}


def unit_factor(powers: tuple[float, float, float], units: Mapping[str, str]) -> float:
    """What a number in mm, s and t is multiplied by; powers of length, time and mass."""
    scales = (
        _LENGTHS.get(str(units.get("length", "mm")), 1.0),
        TIMES.get(str(units.get("time", "s")), 1.0),
        _MASSES.get(str(units.get("mass", "t")), 1.0),
    )
    factor = 1.0
    for scale, power in zip(scales, powers, strict=True):
        factor *= scale**-power
    return factor
