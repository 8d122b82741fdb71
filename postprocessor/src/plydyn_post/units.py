"""Units: conversion between the ones decks use, and the choice of one that reads well."""

from __future__ import annotations

from dataclasses import dataclass
from math import floor, log10

from plydyn_post.errors import ResultsError

_POUND_FORCE = 0.45359237 * 9.80665  # N

# Size in SI of every unit known here, by its kind
_SIZES = {
    "time": {"s": 1.0, "ms": 1e-3, "µs": 1e-6, "us": 1e-6},
    "length": {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "µm": 1e-6, "um": 1e-6}
    | {"in": 0.0254, "ft": 0.3048},
    "force": {"N": 1.0, "mN": 1e-3, "kN": 1e3, "MN": 1e6, "lbf": _POUND_FORCE},
    "stress": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9}
    | {"psi": _POUND_FORCE / 0.0254**2, "psf": _POUND_FORCE / 0.3048**2},
    "energy": {"mJ": 1e-3, "J": 1.0, "kJ": 1e3}
    | {"in-lbf": _POUND_FORCE * 0.0254, "ft-lbf": _POUND_FORCE * 0.3048},
    "mass": {"kg": 1.0, "g": 1e-3, "t": 1e3}
    | {"slinch": _POUND_FORCE / 0.0254, "slug": _POUND_FORCE / 0.3048},
    "share": {"-": 1.0, "%": 1e-2},
}
KNOWN = {unit: (kind, size) for kind, units in _SIZES.items() for unit, size in units.items()}

# Units of print by kind, largest first, each with the smallest number it is chosen for
PREFERRED: dict[str, list[tuple[str, float]]] = {
    "time": [("s", 0.2), ("ms", 0.02), ("µs", 0.0)],
    "length": [("mm", 0.0)],
    "force": [("kN", 1.0), ("N", 0.0)],
    "stress": [("MPa", 0.0)],
    "energy": [("J", 0.5), ("mJ", 0.0)],
    "length/time": [("m/s", 0.0)],
    "force.time": [("N.s", 0.0)],
    "share": [("%", 0.0)],
}


@dataclass(frozen=True)
class Scale:
    """A unit of print and what numbers are multiplied by to be in it."""

    factor: float
    unit: str


def size(unit: str) -> tuple[str, float] | None:
    """Kind and size in SI of a unit such as ``mm``, ``mm/s`` or ``N.s``; nothing if unknown."""
    if unit in KNOWN:
        return KNOWN[unit]
    for sign in "/.":
        left, found, right = unit.partition(sign)
        if found and left in KNOWN and right in KNOWN:
            (kind, value), (other_kind, other) = KNOWN[left], KNOWN[right]
            return f"{kind}{sign}{other_kind}", value / other if sign == "/" else value * other
    return None


def kind_of(unit: str) -> str:
    """What kind of quantity a unit is of; the unit itself if it is unknown."""
    known = size(unit)
    return unit if known is None else known[0]


def factor(unit: str, target: str) -> float:
    """What numbers in ``unit`` are multiplied by to be in ``target``."""
    if unit == target:
        return 1.0
    here, there = size(unit), size(target)
    if here is None or there is None or here[0] != there[0]:
        raise ResultsError(f"numbers in [{unit}] cannot be drawn in [{target}]")
    return here[1] / there[1]


def readable(unit: str, largest: float) -> Scale:
    """The unit of print in which numbers of this unit, up to ``largest``, read well."""
    known = size(unit)
    if known is None or known[0] not in PREFERRED:
        return Scale(1.0, unit)
    for target, smallest in PREFERRED[known[0]]:
        if abs(largest) * factor(unit, target) >= smallest:
            return Scale(factor(unit, target), target)
    return Scale(1.0, unit)


def nice(number: float) -> float:
    """The largest of 1, 2, 5, 10, 20, … that is not above a number; at least 1."""
    if number < 1.0:
        return 1.0
    power = 10.0 ** floor(log10(number))
    return max(step for step in (1, 2, 5) if step * power <= number) * power


def in_brackets(name: str, unit: str) -> str:
    """A label such as ``Force [kN]``; without a unit, the name alone."""
    if not unit or unit == "-":
        return name
    return f"{name} [{unit.replace('.', ' ')}]"
