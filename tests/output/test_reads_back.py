"""Field files read back: by VTK's own reader, by h5py, whole and after a kill.

The environment variable ``WRITE_SAMPLE`` names the program built from ``write_sample.f90``.
"""

from __future__ import annotations

import os
import resource
import signal
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest
import pyvista
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOHDF import vtkHDFReader

from ranks import LAUNCHER, PATIENT

SAMPLE = os.environ.get("WRITE_SAMPLE", "")
STATES = 5
POINTS = 2 * 27
EXIT_OUTPUT = 5
SECONDS = 60.0

pytestmark = pytest.mark.skipif(not SAMPLE, reason="WRITE_SAMPLE names no program")


def write(
    path: Path, states: int = STATES, largest: int | None = None, ranks: int = 1
) -> tuple[int, str]:
    """Run the program, with a largest size of its files if given: its exit code and its words."""

    def limit() -> None:
        if largest is not None:
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (largest, largest))

    done = subprocess.run(
        [*launcher(ranks), SAMPLE, str(path), str(states)],
        preexec_fn=limit,
        env={**os.environ, **PATIENT},
        capture_output=True,
        text=True,
        timeout=SECONDS,
    )
    return done.returncode, done.stdout


def launcher(ranks: int) -> list[str]:
    """What starts several ranks."""
    return [] if ranks == 1 else [*LAUNCHER, str(ranks)]


def write_held(path: Path, state: int, ranks: int = 1) -> subprocess.Popen[str]:
    """Run the program until it is in the midst of a state."""
    process = subprocess.Popen(
        [*launcher(ranks), SAMPLE, str(path), str(STATES), str(state)],
        env={**os.environ, **PATIENT},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "pause\n"
    return process


def read(path: Path) -> dict[float, pyvista.UnstructuredGrid]:
    """All states of a file by their times."""
    reader = vtkHDFReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    about = reader.GetOutputInformation(0)
    key = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    states = {}
    for time in [about.Get(key, k) for k in range(about.Length(key))]:
        reader.UpdateTimeStep(time)
        states[time] = pyvista.wrap(reader.GetOutput()).copy()
    return states


def expected(state: int, components: int) -> np.ndarray:
    """Values that the program gives a field of a state, (points, components)."""
    point = np.arange(1, POINTS + 1)[:, None]
    return 1000.0 * state + point + 0.1 * np.arange(1, components + 1)


def check_states(path: Path, states: int) -> None:
    """A file has so many states, each with its time, its grid and its fields."""
    found = read(path)
    assert list(found) == pytest.approx([0.1 * k for k in range(1, states + 1)], abs=1e-15)
    for k, grid in enumerate(found.values(), start=1):
        assert grid.celltypes.tolist() == [29, 29]
        assert grid.n_points == POINTS
        assert grid.bounds[:2] == pytest.approx((0.0, 3.0))
        assert grid.compute_cell_sizes()["Volume"] == pytest.approx([1.0, 1.0], rel=1e-6)
        assert grid.cell_data["ply"].tolist() == [1, 2]
        assert grid.cell_data["angle"].tolist() == [45.0, -45.0]
        assert grid.cell_data["fibre"].tolist() == [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
        assert grid["pressure"] == pytest.approx(expected(k, 1)[:, 0], rel=1e-6)
        assert grid["displacement"] == pytest.approx(expected(k, 3), rel=1e-6)
        assert grid["stress"] == pytest.approx(expected(k, 6), rel=1e-6)


def test_all_states_read_back(tmp_path: Path) -> None:
    assert write(tmp_path / "a.vtkhdf") == (0, "")
    check_states(tmp_path / "a.vtkhdf", STATES)


def test_more_states_than_times_in_a_chunk_read_back(tmp_path: Path) -> None:
    assert write(tmp_path / "a.vtkhdf", states=600)[0] == 0
    check_states(tmp_path / "a.vtkhdf", 600)


def test_what_never_changes_is_stored_once(tmp_path: Path) -> None:
    write(tmp_path / "a.vtkhdf")
    with h5py.File(tmp_path / "a.vtkhdf") as file:
        assert file["VTKHDF/Points"].shape == (POINTS, 3)
        assert file["VTKHDF/Points"].dtype == np.float64
        assert file["VTKHDF/CellData/ply"].shape == (2,)
        assert not np.any(file["VTKHDF/Steps/PointOffsets"][:])
        assert not np.any(file["VTKHDF/Steps/CellDataOffsets/ply"][:])
        assert file["VTKHDF/PointData/stress"].shape == (STATES * POINTS, 6)
        assert file["VTKHDF/PointData/stress"].dtype == np.float32


def test_our_own_group_tells_about_the_run(tmp_path: Path) -> None:
    write(tmp_path / "a.vtkhdf")
    with h5py.File(tmp_path / "a.vtkhdf") as file:
        group = file["plydyn"]
        assert group.attrs["title"] == b"Sample of two cells"
        assert group.attrs["length"] == b""
        assert group["plies"].attrs["columns"] == b"ply,angle,thickness"
        assert group["plies"][:].tolist() == [[1.0, 45.0, 0.1], [2.0, -45.0, 0.2]]


def test_the_same_run_writes_the_same_bytes(tmp_path: Path) -> None:
    write(tmp_path / "a.vtkhdf")
    write(tmp_path / "b.vtkhdf")
    assert (tmp_path / "a.vtkhdf").read_bytes() == (tmp_path / "b.vtkhdf").read_bytes()


@pytest.mark.parametrize("ranks", [2, 3, 5])
def test_several_ranks_write_the_bytes_of_one(ranks: int, tmp_path: Path) -> None:
    """Also ranks that have points and no cell; more states than an index has room for at first."""
    assert write(tmp_path / "a.vtkhdf", states=600)[0] == 0
    assert write(tmp_path / "b.vtkhdf", states=600, ranks=ranks)[0] == 0
    assert (tmp_path / "a.vtkhdf").read_bytes() == (tmp_path / "b.vtkhdf").read_bytes()


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_killed_run_leaves_the_states_before(ranks: int, tmp_path: Path) -> None:
    process = write_held(tmp_path / "a.vtkhdf", 4, ranks)
    process.kill()
    process.wait()
    check_states(tmp_path / "a.vtkhdf", 3)


def test_a_running_job_can_be_looked_at(tmp_path: Path) -> None:
    process = write_held(tmp_path / "a.vtkhdf", state=3)
    check_states(tmp_path / "a.vtkhdf", 2)
    process.communicate("\n")
    assert process.returncode == 0
    check_states(tmp_path / "a.vtkhdf", STATES)


def test_a_full_disk_is_an_error_and_keeps_the_states_before(tmp_path: Path) -> None:
    path = tmp_path / "a.vtkhdf"
    code, words = write(path, states=400, largest=500_000)
    assert code == EXIT_OUTPUT
    assert words.count(str(path)) == 1
    assert "room" in words
    with h5py.File(path) as file:
        states = int(file["VTKHDF/Steps"].attrs["NSteps"])
    assert states > 10
    check_states(path, states)


@pytest.mark.parametrize(
    ("place", "reason"),
    [("none/a.vtkhdf", "No such file"), ("folder", "no regular file")],
    ids=["no folder", "a folder"],
)
def test_a_path_that_is_no_good_is_named_with_its_reason(
    tmp_path: Path, place: str, reason: str
) -> None:
    (tmp_path / "folder").mkdir()
    code, words = write(tmp_path / place)
    assert code == EXIT_OUTPUT
    assert str(tmp_path / place) in words
    assert reason in words
