"""Units: conversion between the ones decks use, and the choice of one that reads well."""

from __future__ import annotations

from dataclasses import dataclass

from plydyn_post.errors import ResultsError

_POUND_FORCE = 0.45359237 * 9.80665  # N

# Kind and size in SI of every unit known here
KNOWN: dict[str, tuple[str, float]] = {
    "s": ("time", 1.0),
    "ms": ("time", 1e-3),
    "µs": ("time", 1e-6),
    "us": ("time", 1e-6),
    "m": ("length", 1.0),
    "cm": ("length", 1e-2),
    "mm": ("length", 1e-3),
    "µm": ("length", 1e-6),
    "um": ("length", 1e-6),
    "N": ("force", 1.0),
    "mN": ("force", 1e-3),
    "kN": ("force", 1e3),
    "MN": ("force", 1e6),
    "Pa": ("stress", 1.0),
    "kPa": ("stress", 1e3),
    "MPa": ("stress", 1e6),
    "GPa": ("stress", 1e9),
    "mJ": ("energy", 1e-3),
    "J": ("energy", 1.0),
    "kJ": ("energy", 1e3),
    "kg": ("mass", 1.0),
    "g": ("mass", 1e-3),
    "t": ("mass", 1e3),
    "in": ("length", 0.0254),
    "ft": ("length", 0.3048),
    "lbf": ("force", _POUND_FORCE),
    "psi": ("stress", _POUND_FORCE / 0.0254**2),
    "psf": ("stress", _POUND_FORCE / 0.3048**2),
    "in-lbf": ("energy", _POUND_FORCE * 0.0254),
    "ft-lbf": ("energy", _POUND_FORCE * 0.3048),
    "slinch": ("mass", _POUND_FORCE / 0.0254),
    "slug": ("mass", _POUND_FORCE / 0.3048),
    "-": ("share", 1.0),
    "%": ("share", 1e-2),
}

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


def in_brackets(name: str, unit: str) -> str:
    """A label such as ``Force [kN]``; without a unit, the name alone."""
    if not unit or unit == "-":
        return name
    return f"{name} [{unit.replace('.', ' ')}]"
