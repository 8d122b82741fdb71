"""Plates that swing, their frequencies, and the load at which these vanish."""

from __future__ import annotations

import numpy as np
from scipy.optimize import minimize_scalar

from decks import Deck, Ply
from elasticity import Array
from meshes import Mesh
from runs import Results


def add_first_mode(deck: Deck, mesh: Mesh, plies: list[Ply], order: int, interval: float) -> None:
    """A quarter of a plate, simply supported, with the velocity of its first mode.

    The far corner of the mesh is the middle of the plate; it has a history.
    """
    half = mesh.points.max(axis=0)
    deck.mesh(mesh)
    deck.laminate(plies, order)
    deck.hold(mesh.where(x=0.0), "yz")
    deck.hold(mesh.where(y=0.0), "xz")
    deck.hold(mesh.where(x=half[0]), "x")
    deck.hold(mesh.where(y=half[1]), "y")
    shape = np.prod(np.sin(0.5 * np.pi * mesh.points / half), axis=1)
    deck.velocities(np.stack([0.0 * shape, 0.0 * shape, shape], axis=1))
    deck.histories([mesh.at(*half)], interval)


def deflection(results: Results) -> tuple[Array, Array]:
    """Time, and the mean deflection of both faces at the node with a history."""
    table = results.table("nodes")
    bottom, top = (
        next(table[name] for name in table.names if name.endswith(f"{face} uz"))
        for face in ("bottom", "top")
    )
    return table["time"], 0.5 * (bottom + top)


def fitted(times: Array, values: Array, guess: float, within: float = 0.3) -> float:
    """Angular frequency of the sine that fits a history best, within a share of a guess."""

    def misfit(omega: float) -> float:
        waves = np.stack([np.cos(omega * times), np.sin(omega * times)], axis=1)
        return float(np.linalg.lstsq(waves, values, rcond=None)[1][0])

    bounds, options = ((1.0 - within) * guess, (1.0 + within) * guess), {"xatol": 1.0e-9 * guess}
    return float(minimize_scalar(misfit, bounds=bounds, method="bounded", options=options).x)


def zero_of_line(strains: Array, squares: Array) -> float:
    """Where the line through two points meets the axis."""
    return float(strains[1] + squares[1] * (strains[1] - strains[0]) / (squares[0] - squares[1]))
