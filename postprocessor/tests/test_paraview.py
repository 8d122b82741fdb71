"""The macro for ParaView, run with the vtk of Python: what it shows has known areas."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import pyvista as pv
import synthetic
import synthetic_damage as known
from matplotlib.image import imread
from typer.testing import CliRunner

from plydyn_post import offscreen, paraview_macro
from plydyn_post.cli import app
from plydyn_post.paraview_macro import LAYERS, job_of, layers_of, vtk_fields, vtk_layer

needs_vtk = pytest.mark.skipif(offscreen.window() is None, reason="VTK cannot draw here")


@pytest.fixture(scope="module")
def damaged(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A job with damage of plies and interfaces, and cracks."""
    folder = tmp_path_factory.mktemp("damaged")
    job = known.write_job(folder)
    known.write_interfaces(folder, "plate", quads=80, nodes=4)
    known.add_energy_share(folder, "plate")
    known.write_cracks(folder, "plate")
    return job


def grids(job: Path) -> dict[str, pv.UnstructuredGrid]:
    """What is shown, by the names of the layers."""
    return {
        layer.name: pv.wrap(vtk_layer(layer, path, field))
        for layer, path, field in layers_of(job, vtk_fields)
    }


def test_all_layers_of_a_job_are_found(damaged: Path) -> None:
    assert set(grids(damaged)) == {layer.name for layer in LAYERS}
    for ending in ("", ".vtkhdf", ".interfaces.vtkhdf", ".cracks.vtkhdf"):
        assert job_of(f"{damaged}{ending}") == damaged


def test_delaminated_cells_have_the_areas_of_the_ellipses(damaged: Path) -> None:
    """Quads whose points all have spent half of their energy: exact to a quad at the border."""
    shown = grids(damaged)["delaminated"]
    sizes = shown.compute_cell_sizes(length=False, volume=False)
    side = synthetic.SIDE / 80
    for number, (a, b) in enumerate(known.ELLIPSES, start=1):
        area = float(sizes.cell_data["Area"][shown.cell_data["interface"] == number].sum())
        wide = 1.0 + known.RIM / 2  # where the share is one half
        rim = 2.0 * np.pi * np.sqrt((a * a + b * b) / 2.0) * wide * side
        assert abs(area - np.pi * a * b * wide**2) < rim


def test_the_plate_is_deformed_and_whole(damaged: Path) -> None:
    shown = grids(damaged)["plate"]
    assert (
        shown.n_cells
        == pv.wrap(paraview_macro.vtk_reader(Path(f"{damaged}.vtkhdf")).GetOutput()).n_cells
    )
    assert shown.bounds[4] == pytest.approx(-synthetic.DEPTH * synthetic.SHAPE[-1], rel=1e-6)


def test_a_job_without_damage_shows_its_plate_alone(job: Path, tmp_path: Path) -> None:
    assert set(grids(job)) == {"plate"}
    with pytest.raises(SystemExit, match="no fields of plydyn there"):
        layers_of(tmp_path / "none", vtk_fields)


@needs_vtk
def test_the_command_writes_a_script_that_draws_alone(damaged: Path, tmp_path: Path) -> None:
    """As a file of its own, far from the package."""
    script, picture = tmp_path / "macro.py", tmp_path / "picture.png"
    done = CliRunner().invoke(app, ["paraview", "-o", str(script)])
    assert done.exit_code == 0, done.output
    environment = os.environ | {offscreen.CHOICE: offscreen.window() or ""}
    words = [sys.executable, "-I", script, f"{damaged}.vtkhdf", picture]
    subprocess.run(words, env=environment, check=True)
    image = imread(picture)[..., :3]
    assert image.shape[:2] == paraview_macro.SIZE[::-1]
    assert len(np.unique((image * 255).astype(int).reshape(-1, 3), axis=0)) > 50
