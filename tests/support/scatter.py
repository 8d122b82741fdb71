"""Factors of strengths that scatter, computed apart from the solver (manual/theory.md)."""

from __future__ import annotations

import math
from statistics import NormalDist

_BITS = 0xFFFFFFFF
_HALF_WIDTH = 3
_MOST = 4.0


def factor(
    seed: int, modulus: float, length: float, place: tuple[float, float], layer: int
) -> float:
    """Weibull quantile of the normal field of a layer at a place."""
    x, y = (value / length for value in place)
    total = squares = 0.0
    for i in _near(x):
        for j in _near(y):
            weight = math.exp(-((x - i) ** 2) - (y - j) ** 2)
            total += weight * _normal(seed, layer, i, j)
            squares += weight**2
    normal = min(max(total / math.sqrt(squares), -_MOST), _MOST)
    beyond = NormalDist().cdf(-normal)
    return (-math.log(beyond)) ** (1.0 / modulus) / math.gamma(1.0 + 1.0 / modulus)


def _near(x: float) -> range:
    """Lattice lines that count at a place."""
    first = math.floor(x)
    return range(first - _HALF_WIDTH + 1, first + _HALF_WIDTH + 1)


def _normal(*key: int) -> float:
    """A normal number of four integers."""
    state = 0
    for number in key:
        state = _hash(state ^ (number & _BITS))
    uniform = []
    for k in (1, 2):
        state = _hash(state + k)
        uniform.append((state + 0.5) / (_BITS + 1))
    return math.sqrt(-2.0 * math.log(uniform[0])) * math.cos(2.0 * math.pi * uniform[1])


def _hash(key: int) -> int:
    """The 32 bits of Wellons' hash of 2018."""
    key &= _BITS
    for multiplier, shift in ((2146121005, 16), (2221713035, 15)):
        key = ((key ^ key >> shift) * multiplier) & _BITS
    return key ^ key >> 16
