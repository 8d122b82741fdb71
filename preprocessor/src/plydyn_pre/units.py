"""Numbers in mm, s and t, and in the units of a recipe."""

from __future__ import annotations

from collections.abc import Mapping

_LENGTHS = {"m": 1e3, "cm": 10.0, "mm": 1.0, "um": 1e-3}
TIMES = {"s": 1.0, "ms": 1e-3, "us": 1e-6}
_MASSES = {"t": 1.0, "kg": 1e-3, "g": 1e-6, "mg": 1e-9}


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
