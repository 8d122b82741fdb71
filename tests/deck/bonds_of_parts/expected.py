"""Damage of a bond jumps where two parts meet: each part shows its own there."""

import h5py
import numpy as np

from runs import Results

#: Damage of the bond of each quad
DAMAGE = {1: 1.0, 2: 0.0}
CORNERS = 4


def check(results: Results) -> None:
    """All points of a part's cells are as its bond is, in every state."""
    with h5py.File(results.folder / f"{results.job}.interfaces.vtkhdf") as file:
        grid = file["VTKHDF"]
        points = len(grid["Points"])
        damage = np.array(grid["PointData/damage"]).reshape(-1, points)
        cells = np.array(grid["Connectivity"]).reshape(-1, CORNERS)
        element = np.array(grid["CellData/element"])
    assert points == 2 * CORNERS
    for cell, number in zip(cells, element, strict=True):
        assert np.all(damage[:, cell] == DAMAGE[number])
