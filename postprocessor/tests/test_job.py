"""A job from Python: tables, arrays, grids, stresses, areas and figures with known numbers."""

from __future__ import annotations

import fcntl
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
import pyvista as pv
import synthetic
import synthetic_damage as known
from matplotlib.figure import Figure

import plydyn_post as post
from plydyn_post.job_figures import FIGURES
from plydyn_post.plies import turned

PNG = b"\x89PNG"


@dataclass(frozen=True)
class Ran:
    """What plydyn_pre.run gives."""

    results: tuple[Path, ...]


@pytest.fixture(scope="module")
def damaged(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A job with damage, only to be read."""
    return known.write_job(tmp_path_factory.mktemp("damaged"))


def test_a_job_is_opened_by_name_file_folder_or_run(job: Path, damaged: Path) -> None:
    for name in (job, str(job), f"{job}.out", f"{job}.vtkhdf", f"{job}.energy.csv", job.parent):
        assert post.open(name).results.fields == Path(f"{job}.vtkhdf")
    ran = Ran((job, damaged))
    assert post.open(ran).results.fields == Path(f"{job}.vtkhdf")
    assert post.open(ran, -1).results.fields == Path(f"{damaged}.vtkhdf")
    with pytest.raises(post.ResultsError, match="no results there"):
        post.open(job.with_name("none"))


def test_a_history_is_a_table_and_a_frame(job: Path) -> None:
    opened = post.open(job)
    assert opened.histories == ("energy", "impactor_1", "profile_1")
    table = opened.history("impactor_1")
    np.testing.assert_allclose(table["force"], synthetic.force(table["time"]), atol=1e-6)
    frame = table.frame()
    assert frame["force"].max() == pytest.approx(synthetic.PEAK, rel=1e-5)
    assert frame.attrs["units"]["force"] == "N"
    assert list(frame.columns) == list(table.names)
    with pytest.raises(post.ResultsError, match="no table 'nodes'; it has energy, impactor_1"):
        opened.history("nodes")


def test_a_frame_without_pandas_says_what_brings_it(
    job: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(post.ResultsError, match=r"pip install plydyn-post\[frame\]"):
        post.open(job).history("energy").frame()


def test_fields_are_arrays_and_grids(damaged: Path) -> None:
    opened = post.open(damaged)
    assert opened.times.tolist() == list(synthetic.STATES)
    assert "stress" in opened.fields
    moved = opened.field("displacement", synthetic.STATES[1])
    assert moved.shape[1] == 3
    assert moved[:, 2].min() == pytest.approx(-synthetic.DEPTH)
    grid = opened.grid(synthetic.STATES[1])
    assert isinstance(grid, pv.UnstructuredGrid)
    np.testing.assert_array_equal(grid.point_data["displacement"], moved)
    last = opened.field("displacement")
    assert last[:, 2].min() == pytest.approx(-synthetic.DEPTH * synthetic.SHAPE[-1])
    assert opened.units["length"] == "mm"
    assert [ply["angle"] for ply in opened.plies] == list(synthetic.ANGLES)


def test_interfaces_are_arrays_and_a_grid(damaged: Path) -> None:
    opened = post.open(damaged)
    each = opened.interfaces()
    assert [one.number for one in each] == [1, 2, 3]
    assert all(one.fields["damage"].shape == one.places.shape[:3] for one in each)
    assert max(one.damage.max() for one in opened.interfaces(0.0)) == 0.0
    grid = opened.interface_grid()
    assert sorted(set(grid.cell_data["interface"])) == [1, 2, 3]


def test_cracks_along_lines_are_pieces_of_their_plies(tmp_path: Path) -> None:
    opened = post.open(known.write_job(tmp_path))
    assert opened.cracks() == ()
    known.write_cracks(tmp_path, "plate")
    for one, (start, end, pieces) in zip(opened.cracks(), known.CRACKS.values(), strict=True):
        assert one.pieces.shape == (pieces, 2, 2)
        assert one.length == pytest.approx(np.linalg.norm(np.subtract(end, start)))
    assert sum(one.length for one in opened.cracks(0.0)) == 0.0


def test_the_stress_of_a_ply_at_a_point_is_that_of_the_fields(job: Path) -> None:
    middle, time = synthetic.SIDE / 2, synthetic.STATES[1]
    for ply, angle in enumerate(synthetic.ANGLES, start=1):
        found = post.open(job).ply_stress(ply, middle, middle, time)
        low = (ply - 1) * synthetic.PLY
        np.testing.assert_allclose(found.z, low + synthetic.PLY * np.array([0.0, 0.5, 1.0]))
        wanted = synthetic.stress_at(found.z, np.full_like(found.z, ply), synthetic.SHAPE[1])
        for name, values in wanted.items():
            np.testing.assert_allclose(found.stress[name], values, rtol=1e-5, atol=1e-4)
        along, across = ("sxx", "syy") if angle == 0.0 else ("syy", "sxx")
        np.testing.assert_allclose(found.stress["s11"], wanted[along], rtol=1e-5, atol=1e-4)
        np.testing.assert_allclose(found.stress["s22"], wanted[across], rtol=1e-5, atol=1e-4)
    with pytest.raises(post.ResultsError, match="no ply 3; it has 2"):
        post.open(job).ply_stress(3, middle, middle)
    with pytest.raises(post.ResultsError, match="no point at x -1, y 0"):
        post.open(job).ply_stress(1, -1.0, 0.0)


def test_turned_stresses_have_their_closed_forms() -> None:
    """Along x at 45 degrees; shear yz seen from axes at 90 degrees; and there and back."""
    tension = turned(np.array([[2.0, 0.0, 0.0, 0.0, 0.0, 0.0]]), 45.0)
    np.testing.assert_allclose(tension, [[1.0, 1.0, 0.0, -1.0, 0.0, 0.0]], atol=1e-12)
    shear = turned(np.array([[0.0, 0.0, 0.0, 0.0, 3.0, 0.0]]), 90.0)
    np.testing.assert_allclose(shear, [[0.0, 0.0, 0.0, 0.0, 0.0, 3.0]], atol=1e-12)
    some = np.arange(12.0).reshape(2, 6)
    np.testing.assert_allclose(turned(turned(some, 30.0), -30.0), some, atol=1e-12)


def test_areas_over_time_by_both_measures(tmp_path: Path) -> None:
    job = known.write_job(tmp_path)
    known.write_interfaces(tmp_path, "plate", quads=60)
    opened = post.open(job)
    energy = opened.areas()
    assert energy["interface 1 area"][-1] == pytest.approx(known.areas()[0])
    damage = opened.areas("damage")
    assert damage["time"].tolist() == list(synthetic.STATES)
    assert damage.unit("sum") == "mm2"
    for state, share in enumerate(known.SHARES):
        wanted = known.areas(share)
        for place, area in enumerate(wanted, start=1):
            # the border of complete damage is found to half of the distance of nodes
            found = damage[f"interface {place} area"][state]
            assert found == pytest.approx(area, rel=0.1)
        assert damage["sum"][state] == pytest.approx(sum(wanted), rel=0.1)
    projected = damage["projected area"][-1]
    assert max(known.areas()) < projected < sum(known.areas())
    with pytest.raises(post.ResultsError, match="'force' is no measure"):
        opened.areas("force")


def test_numbers_have_values_and_units(job: Path) -> None:
    value, unit = post.open(job).numbers()["peak force"]
    assert (value, unit) == (pytest.approx(synthetic.PEAK / 1000.0, rel=1e-5), "kN")
    with pytest.raises(post.ResultsError, match="no impactor 2; it has 1"):
        post.open(job).numbers(2)


def test_every_figure_is_given_back_and_written_where_asked(damaged: Path, tmp_path: Path) -> None:
    opened = post.open(damaged)
    known_options = {"picture": {"plain": True}}
    for name in FIGURES.keys() - {"fixtures"}:
        options = known_options.get(name, {})
        made = opened.figure(name, tmp_path / f"{name}.png", **options)
        assert isinstance(made, Figure)
        assert (tmp_path / f"{name}.png").read_bytes().startswith(PNG)
    before = set(tmp_path.iterdir())
    shown = opened.figure("force", over="displacement")
    assert set(tmp_path.iterdir()) == before
    assert shown.axes[0].get_xlabel() == "Impactor displacement [mm]"
    assert shown._repr_png_().startswith(PNG)
    with pytest.raises(post.ResultsError, match="'heat' is no figure; right would be force"):
        opened.figure("heat")
    with pytest.raises(post.ResultsError, match="is a result of job"):
        opened.figure("force", f"{damaged}.energy.csv")


def test_results_are_read_while_the_solver_has_them_open(own_job: Path) -> None:
    """The solver's HDF5 locks the file that it writes."""
    with own_job.with_name("plate.vtkhdf").open("rb") as written:
        fcntl.flock(written, fcntl.LOCK_EX)
        assert len(post.open(own_job).times) == len(synthetic.STATES)


def test_importing_changes_nothing_of_the_process() -> None:
    """Neither variables of the environment, nor settings of matplotlib, nor a backend."""
    code = """
import os, matplotlib
before, settings = dict(os.environ), dict(dict.items(matplotlib.rcParams))
import plydyn_post.cli, plydyn_post.job, plydyn_post.report
assert dict(os.environ) == before, set(os.environ.items()) ^ set(before.items())
assert dict(dict.items(matplotlib.rcParams)) == settings
import sys
assert "matplotlib.pyplot" not in sys.modules
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
