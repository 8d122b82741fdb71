"""What VTK reads from the file of fields, and profiles, for a strain that is known everywhere.

All nodes move with u = (F - 1) X in the plane and not along z. Strain, stress and their ply
components follow from F by Hooke's law, in plies of several materials, angles and orders.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import pyvista
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOHDF import vtkHDFReader

from comparison import Comparison
from decks import Deck, Ply
from elasticity import CARBON, GLASS, Array, stiffness
from meshes import distorted, regular
from runs import Results, run

PLIES = [Ply(CARBON, 0.5, 30.0), Ply(GLASS, 0.3, -75.0), Ply(CARBON, 0.2, 0.0)]
# components of symmetric tensors: VTK's order, and that of the profiles
VTK = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)]
VOIGT = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]
STRETCH = np.array([[0.01, 0.004, 0.0], [0.002, -0.006, 0.0], [0.0, 0.0, 0.0]])
TURN = np.radians(40.0)
END = 2.0e-6
# cells above quads of so many nodes
CELLS = {4: pyvista.CellType.HEXAHEDRON, 9: pyvista.CellType.TRIQUADRATIC_HEXAHEDRON}


def gradient(linear: bool) -> Array:
    """F: a small strain, or five times as much and a turn."""
    if linear:
        return np.eye(3) + STRETCH
    c, s = np.cos(TURN), np.sin(TURN)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]) @ (np.eye(3) + 5.0 * STRETCH)


def expected(linear: bool, ply: Ply) -> dict[str, Array]:
    """Tensors (3, 3) by the names of the fields."""
    f = gradient(linear)
    strain = 0.5 * (f + f.T) - np.eye(3) if linear else 0.5 * (f.T @ f - np.eye(3))
    engineering = np.array([strain[a] if a[0] == a[1] else 2.0 * strain[a] for a in VOIGT])
    second = np.zeros((3, 3))
    for value, (i, j) in zip(stiffness(ply.material, ply.angle) @ engineering, VOIGT, strict=True):
        second[i, j] = second[j, i] = value
    c, s = np.cos(np.radians(ply.angle)), np.sin(np.radians(ply.angle))
    axes = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    return {
        "strain": strain,
        "stress": second if linear else f @ second @ f.T / np.linalg.det(f),
        "strain_ply": axes @ strain @ axes.T,
        "stress_ply": axes @ second @ axes.T,
    }


def moved(nodes: int, linear: bool, folder: Path) -> Results:
    """Run a plate whose nodes all move as prescribed."""
    mesh = distorted(regular(8.0, 6.0, 3, 2, nodes), 0.4)
    motion = (gradient(linear) - np.eye(3))[:2, :2]
    deck = Deck("known strain", END)
    deck.control(linear=linear)
    deck.mesh(mesh)
    deck.laminate(PLIES, order=2, sublayers=2)
    curve = deck.curve([(0.0, 0.0), (0.5 * END, 1.0), (END, 1.0)])
    for node, displacement in enumerate(mesh.points @ motion.T):
        for direction in (0, 1):
            deck.move([node], direction + 1, curve, displacement[direction])
    deck.hold(range(len(mesh.points)), "z")
    deck.profile(1, 3.1, 2.3, END)
    deck.add("DATABASE_FIELD", "displacement stress strain stress_ply strain_ply")
    return run(deck, folder)


def last_state(path: Path) -> pyvista.UnstructuredGrid:
    """The last state, by VTK's own reader."""
    reader = vtkHDFReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    about = reader.GetOutputInformation(0)
    key = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    reader.UpdateTimeStep(about.Get(key, about.Length(key) - 1))
    return pyvista.wrap(reader.GetOutput())


@pytest.mark.parametrize("linear", [True, False], ids=["linear", "large"])
@pytest.mark.parametrize("nodes", [4, 9])
def test_fields_are_exact(nodes: int, linear: bool, compare: Comparison, tmp_path: Path) -> None:
    """Single precision in the file of fields, ten digits in profiles."""
    results = moved(nodes, linear, tmp_path)
    grid, profile = last_state(tmp_path / "job.vtkhdf"), results.profile(1)
    assert set(grid.celltypes) == {CELLS[nodes]}
    shift = (grid.points @ (gradient(linear) - np.eye(3)).T)[:, :2]
    assert grid["displacement"][:, :2] == pytest.approx(shift, abs=1e-6)
    for number, ply in enumerate(PLIES, start=1):
        cells = np.flatnonzero(grid["ply"] == number)
        points = np.unique(np.concatenate([grid.get_cell(cell).point_ids for cell in cells]))
        level = profile["ply"] == number
        for name, tensor in expected(linear, ply).items():
            scale = np.abs(tensor).max()
            wanted = np.array([tensor[a] for a in VTK])
            compare.values(
                f"{name} in the file of fields", grid[name][points], wanted, abs=1e-6 * scale
            )
            if name == "strain_ply":
                continue
            for i, j in VOIGT:
                column, factor = head(name, i, j)
                error = np.abs(profile[column][level] - factor * tensor[i, j]).max() / scale
                compare.number(f"{name} in profiles, error", error, 0.0, abs=1e-9)


def head(field: str, i: int, j: int) -> tuple[str, float]:
    """Column of a profile, and what it is in terms of the tensor."""
    if field == "stress":
        return f"s{'xyz'[i]}{'xyz'[j]}", 1.0
    if field == "stress_ply":
        return f"s{i + 1}{j + 1}", 1.0
    return f"{'e' if i == j else 'g'}{'xyz'[i]}{'xyz'[j]}", 1.0 if i == j else 2.0
