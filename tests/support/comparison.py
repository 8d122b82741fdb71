"""Numbers and curves beside their references: a test asserts them, the report prints them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass

import numpy as np
import pytest

from elasticity import Array

#: Property of a report of pytest under which comparisons and curves travel
NUMBER, CURVES = "compared number", "compared curves"
#: Points of a curve in the report; longer ones are thinned out
MOST_POINTS = 400


@dataclass(frozen=True)
class Number:
    """A computed number beside its reference."""

    name: str
    unit: str
    computed: float
    reference: float
    scale: float  # what the error is a share of
    least: float  # bounds of the error that the test allows, as shares of the scale
    most: float

    @property
    def error(self) -> float:
        """Computed less reference, as a share of the scale."""
        return (self.computed - self.reference) / self.scale if self.scale else 0.0


@dataclass(frozen=True)
class Curves:
    """Curves over one axis: name, abscissa and ordinate of each; the first are computed."""

    title: str
    across: str  # label of the abscissa
    up: str  # label of the ordinate
    computed: Mapping[str, tuple[list[float], list[float]]]
    reference: Mapping[str, tuple[list[float], list[float]]]


class Comparison:
    """Asserts numbers against their references, and keeps both for the report."""

    def __init__(self, keep: Callable[[str, object], None]) -> None:
        """Take what keeps a property of the test."""
        self._keep = keep

    def number(
        self,
        name: str,
        computed: float,
        reference: float,
        *,
        unit: str = "",
        rel: float = 0.0,
        abs: float = 0.0,
        bounds: tuple[float, float] | None = None,
    ) -> None:
        """A number within a tolerance, or with an error within bounds as shares of the reference.

        Where the reference is zero, the number has to be a share by itself.
        """
        scale = float(np.abs(reference)) or 1.0
        close = max(rel, abs / scale)
        least, most = bounds or (-close, close)
        number = Number(name, unit, *map(float, (computed, reference, scale, least, most)))
        self._keep(NUMBER, asdict(number))
        if bounds is None:
            assert computed == pytest.approx(reference, rel=rel or None, abs=abs or None), name
        else:
            assert least <= number.error <= most, f"{name}: {computed} beside {reference}"

    def values(
        self,
        name: str,
        computed: Array,
        reference: Array | float,
        *,
        unit: str = "",
        rel: float = 0.0,
        abs: float = 0.0,
    ) -> None:
        """Values within a tolerance each; the report has the one that is off most.

        Its error, and the tolerance, are shares of the largest reference.
        """
        computed = np.asarray(computed, float)
        reference = np.broadcast_to(np.asarray(reference, float), computed.shape)
        worst = int(np.argmax(np.abs(computed - reference)))
        scale = float(np.abs(reference).max()) or 1.0
        close = max(rel, abs / scale)
        found, exact = computed.flat[worst], reference.flat[worst]
        number = Number(name, unit, *map(float, (found, exact, scale, -close, close)))
        self._keep(NUMBER, asdict(number))
        assert computed == pytest.approx(reference, rel=rel or None, abs=abs or None), name

    def curves(
        self,
        title: str,
        axes: tuple[str, str],
        computed: Mapping[str, tuple[Array, Array]],
        reference: Mapping[str, tuple[Array, Array]],
    ) -> None:
        """Curves for a figure of the report; labels of abscissa and ordinate."""
        drawn = [
            {name: _thinned(*curve) for name, curve in kind.items()}
            for kind in (computed, reference)
        ]
        self._keep(CURVES, asdict(Curves(title, *axes, *drawn)))


def _thinned(x: Array, y: Array) -> tuple[list[float], list[float]]:
    """A curve with no more points than the report draws."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    chosen = np.unique(np.linspace(0, len(x) - 1, min(len(x), MOST_POINTS)).round().astype(int))
    return x[chosen].tolist(), y[chosen].tolist()
