"""Stress jumps where two parts meet: each part shows its own there."""

import h5py
import numpy as np
import pytest

from runs import Results

STRAIN = 1.0e-3
MATERIALS = {1: (70000.0, 0.3), 2: (140000.0, 0.2)}
CORNERS = 8


def check(results: Results) -> None:
    """Hooke's stress of uniaxial strain at every point of every cell of a part."""
    with h5py.File(results.folder / f"{results.job}.vtkhdf") as file:
        grid = file["VTKHDF"]
        stress = np.array(grid["PointData/stress"])[-grid["Points"].shape[0] :]
        cells = np.array(grid["Connectivity"]).reshape(-1, CORNERS)
        parts = np.array(grid["CellData/part"])
    for part, (young, poisson) in MATERIALS.items():
        along = young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson)) * STRAIN
        across = along * poisson / (1.0 - poisson)
        of_part = stress[np.unique(cells[parts == part])]
        expected = np.tile([along, across, across, 0.0, 0.0, 0.0], (len(of_part), 1))
        # fields are stored in single precision
        assert of_part == pytest.approx(expected, abs=1.0e-6 * along)
