"""Quantities in recipes as text: a number and its unit, as in ``energy = "30 J"``."""

from __future__ import annotations

import re
from typing import Any

from plydyn_pre.errors import RecipeError
from plydyn_pre.library import DIMENSIONS
from plydyn_pre.tables import Table
from plydyn_pre.units import unit_factor

Powers = tuple[int, int, int]  # of length, time and mass
_POUND_FORCE = 0.45359237 * 9.80665  # N
_KINDS: dict[str, Powers] = {
    "a length": (1, 0, 0),
    "a time": (0, 1, 0),
    "a mass": (0, 0, 1),
    "a velocity": (1, -1, 0),
    "an acceleration": (1, -2, 0),
    "a force": (1, -2, 1),
    "a stress": (-1, -2, 1),
    "an energy": (2, -2, 1),
    "an energy per area": (0, -2, 1),
    "a density": (-3, 0, 1),
    "a stress per length": (-2, -2, 1),
}
#: Units by their kind, in mm, s and t (N, MPa, mJ)
_UNITS: dict[str, dict[str, float]] = {
    "a length": {"m": 1e3, "cm": 10.0, "mm": 1.0, "um": 1e-3, "µm": 1e-3, "in": 25.4, "ft": 304.8},
    "a time": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6},
    "a mass": {"t": 1.0, "kg": 1e-3, "g": 1e-6, "mg": 1e-9, "lb": 0.45359237e-3},
    "a velocity": {"m/s": 1e3, "mm/s": 1.0, "mm/ms": 1e3, "in/s": 25.4, "ft/s": 304.8},
    "an acceleration": {"m/s2": 1e3, "mm/s2": 1.0},
    "a force": {"N": 1.0, "kN": 1e3, "lbf": _POUND_FORCE},
    "a stress": {"Pa": 1e-6, "kPa": 1e-3, "MPa": 1.0, "N/mm2": 1.0, "GPa": 1e3},
    "an energy": {"mJ": 1.0, "J": 1e3, "kJ": 1e6, "N.m": 1e3, "Nm": 1e3},
    "an energy per area": {"J/m2": 1e-3, "kJ/m2": 1.0, "N/mm": 1.0, "mJ/mm2": 1.0, "N/m": 1e-3},
    "a density": {"kg/m3": 1e-12, "g/cm3": 1e-9, "t/mm3": 1.0, "lb/in3": 0.45359237e-3 / 25.4**3},
    "a stress per length": {"N/mm3": 1.0, "MPa/mm": 1.0, "GPa/m": 1.0},
}
_UNITS["a stress"] |= {f"{p}si": f * _POUND_FORCE / 25.4**2 for p, f in (("p", 1.0), ("k", 1e3))}
_UNITS["a stress"] |= {"Msi": 1e6 * _POUND_FORCE / 25.4**2, "msi": 1e6 * _POUND_FORCE / 25.4**2}
_UNITS["an energy"] |= {"in-lbf": _POUND_FORCE * 25.4, "ft-lbf": _POUND_FORCE * 304.8}
_UNITS["an energy"] |= {"ft-lb": _POUND_FORCE * 304.8, "in-lb": _POUND_FORCE * 25.4}
_KIND_OF = {unit: kind for kind, units in _UNITS.items() for unit in units}
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_QUANTITY = re.compile(rf"\s*({_NUMBER})\s*([A-Za-zµ][A-Za-zµ0-9./-]*)\s*")
_LENGTHS = "radius gap length edge tip side sides core thickness position corner inner outer size"
_OTHERS = {"energy": "an energy", "mass": "a mass", "velocity": "a velocity", "force": "a force"}
_OTHERS |= dict.fromkeys(_LENGTHS.split(), "a length") | {"gravity": "an acceleration"}
_TIMES = ("_time", "_interval", "_step")
#: Keys whose text is text
_TEXTS = ("title", "layup", "kind", "file", "base", "material", "like", "name", "set", "part")


def with_quantities(table: Table) -> Table:
    """A recipe with numbers in its units in place of quantities."""
    units = table.get("units", {})
    units = units if isinstance(units, dict) else {}
    return {
        key: value if key == "units" else _converted(value, key, key, units)
        for key, value in table.items()
    }


def _converted(value: Any, key: str, path: str, units: Table) -> Any:  # noqa: ANN401
    """A value, or the members of a table or list."""
    if isinstance(value, dict):
        return {
            name: _converted(each, name, f"{path}.{name}", units) for name, each in value.items()
        }
    if isinstance(value, list):
        places = enumerate(value, start=1)
        return [_converted(each, key, f"{path}[{number}]", units) for number, each in places]
    if isinstance(value, str) and key not in _TEXTS and (match := _QUANTITY.fullmatch(value)):
        return _number(match, key, path, units)
    return value


def _number(match: re.Match[str], key: str, path: str, units: Table) -> float | str:
    """The number of a quantity, whose kind is that of its key."""
    kind = _KIND_OF.get(match[2])
    if kind is None:
        return match[0]
    needed = _kind_of(key)
    if needed and needed != kind:
        raise RecipeError(path, f"{match[0]!r} is {kind}, {needed} is needed")
    return float(match[1]) * _UNITS[kind][match[2]] * unit_factor(_KINDS[kind], units)


def _kind_of(key: str) -> str:
    """The kind of quantity that a key holds; empty where it is not known here."""
    if key.endswith(_TIMES):
        return "a time"
    if key in DIMENSIONS:
        return next((kind for kind, powers in _KINDS.items() if powers == DIMENSIONS[key]), "")
    return _OTHERS.get(key, "")
