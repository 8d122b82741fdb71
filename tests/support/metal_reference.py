"""A point of a metal that yields, step by step, as section 4 of `manual/theory.md` describes it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

from elasticity import Array

#: Yield stress over effective plastic strain and its rate
Yield = Callable[[float, float], float]


@dataclass
class MetalPoint:
    """Backward steps of von Mises' flow with a back stress in proportion to the plastic strain."""

    young: float
    poisson: float
    yields: Yield
    kinematic: float = 0.0
    plastic: Array = field(default_factory=lambda: np.zeros((3, 3)))
    path: float = 0.0
    dissipated: float = 0.0

    def step(self, strain: Array, time: float) -> Array:
        """Stress at the next strain of the path, xx, yy, zz, xy, xz, yz, after a time."""
        shear = self.young / (2.0 * (1.0 + self.poisson))
        bulk = self.young / (3.0 * (1.0 - 2.0 * self.poisson))
        total = _tensor(strain)
        volume = np.trace(total) * np.eye(3) / 3.0
        relative = 2.0 * shear * (total - volume - self.plastic)
        relative = relative - 2.0 / 3.0 * self.kinematic * self.plastic
        effective = float(np.sqrt(1.5 * (relative * relative).sum()))
        if effective > self.yields(self.path, 0.0):
            slope = 3.0 * shear + self.kinematic

            def left(more: float) -> float:
                return effective - slope * more - self.yields(self.path + more, more / time)

            more = brentq(left, 0.0, effective / slope, xtol=1.0e-20, rtol=1.0e-14)
            at = self.path
            self.dissipated += quad(lambda p: self.yields(p, more / time), at, at + more)[0]
            self.plastic = self.plastic + 1.5 * more * relative / effective
            self.path += more
        stress = 3.0 * bulk * volume + 2.0 * shear * (total - volume - self.plastic)
        return stress[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]


def _tensor(strain: Array) -> Array:
    """Strain with engineering shear as a matrix."""
    xx, yy, zz, xy, xz, yz = strain
    return np.array([[xx, xy / 2, xz / 2], [xy / 2, yy, yz / 2], [xz / 2, yz / 2, zz]])
