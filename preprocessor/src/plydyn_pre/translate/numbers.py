"""Numbers as Fortran writes them."""

from __future__ import annotations

import re
from math import isfinite

_NUMBER = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+))(?:[eEdD]?([-+]\d+)|[eEdD](\d+))?")


def number_of(word: str) -> float | None:
    """A number, or None."""
    match = _NUMBER.fullmatch(word.strip())
    if match is None:
        return None
    value = float(f"{match[1]}e{match[2] or match[3] or 0}")
    return value if isfinite(value) else None
