"""The inextensible cantilever under a dead force at its tip (Bisshopp and Drucker 1945)."""

from __future__ import annotations

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq


def tip(load: float) -> tuple[float, float]:
    """Place of the tip along and across, in lengths, for load = P L^2 / E I.

    With theta the slope and a that of the tip, theta'^2 = 2 load (sin a - sin theta); the
    substitution theta = a - s^2 takes the root out of the integrands.
    """

    def integral(slope: float, power: int) -> float:
        def integrand(s: float) -> float:
            # sin a - sin theta = 2 cos((a + theta) / 2) sin((a - theta) / 2)
            rest = np.cos(slope - 0.5 * s * s) * np.sinc(0.5 * s * s / np.pi)
            return float(2.0 * np.sin(slope - s * s) ** power / np.sqrt(2.0 * load * rest))

        return quad(integrand, 0.0, np.sqrt(slope), epsabs=1e-12)[0]

    slope = brentq(lambda a: integral(a, 0) - 1.0, 1e-3, 0.5 * np.pi - 1e-9, xtol=1e-13)
    return float(np.sqrt(2.0 * np.sin(slope) / load)), integral(slope, 1)
