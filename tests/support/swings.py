"""Frequencies of plates that swing under load, and the load at which they vanish."""

from __future__ import annotations

import numpy as np
from scipy.optimize import minimize_scalar

from elasticity import Array


def fitted(times: Array, values: Array, guess: float) -> float:
    """Angular frequency of the sine that fits a history best, within 30 % of a guess."""

    def misfit(omega: float) -> float:
        waves = np.stack([np.cos(omega * times), np.sin(omega * times)], axis=1)
        return float(np.linalg.lstsq(waves, values, rcond=None)[1][0])

    return float(minimize_scalar(misfit, bounds=(0.7 * guess, 1.3 * guess), method="bounded").x)


def zero_of_line(strains: Array, squares: Array) -> float:
    """Where the line through two points meets the axis."""
    return float(strains[1] + squares[1] * (strains[1] - strains[0]) / (squares[0] - squares[1]))
