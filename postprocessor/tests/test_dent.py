"""Dents of known depth in plates that are also bent and tilted."""

from pathlib import Path

import h5py
import numpy as np
import pytest
import synthetic
from typer.testing import CliRunner

from plydyn_post.cli import app
from plydyn_post.curves import read_numbers
from plydyn_post.dent import read_dent
from plydyn_post.errors import ResultsError
from plydyn_post.results import open_results

TOP, BOTTOM = 0.30, 0.12  # depth of the dent in either face at the last state
HIGH = synthetic.PLY * len(synthetic.ANGLES)
SINKS = 0.2  # of the whole plate at the last state


def write_dent(
    folder: Path, centre: tuple[float, float], above: float = 1.0, quads: int = 6
) -> Path:
    """A plate that sinks, tilts and has a dent at a place; the last state is the end of a run."""
    job = synthetic.write_job(folder)
    synthetic.write_fields(folder, "plate", quads)
    with h5py.File(job.with_name("plate.vtkhdf"), "r+") as file:
        points = file["VTKHDF/Points"][...]
        x, y = points[:, 0] - centre[0], points[:, 1] - centre[1]
        struck = points[:, 2] == (HIGH if above > 0 else 0.0)
        dent = np.where(struck, TOP, BOTTOM) * np.exp(-((x**2 + y**2) / 4.0))
        tilt = 0.01 * x - 0.02 * y if centre[0] > 0.0 else 0.0
        states = [
            np.outer(-above * (SINKS * share + share * dent + tilt), [0, 0, 1])
            for share in (0.0, 0.5, 1.0)
        ]
        file["VTKHDF/PointData/displacement"][...] = np.concatenate(states)
        high = HIGH + synthetic.RADIUS if above > 0 else -synthetic.RADIUS
        file["plydyn/impactors"][0, 3:6] = (*centre, high)
    return job


MIDDLE = (synthetic.SIDE / 2, synthetic.SIDE / 2)


@pytest.mark.parametrize("centre", [MIDDLE, (0.0, 0.0)])
def test_depths_are_those_below_the_plate_around(
    tmp_path: Path, centre: tuple[float, float]
) -> None:
    dent = read_dent(open_results(write_dent(tmp_path, centre)))
    assert dent is not None
    assert dent.struck == pytest.approx(np.array([0.0, 0.5, 1.0]) * TOP, abs=1e-6)
    assert dent.opposite == pytest.approx(np.array([0.0, 0.5, 1.0]) * BOTTOM, abs=1e-6)


def test_a_dent_between_nodes_is_interpolated(tmp_path: Path) -> None:
    quads = 24
    dent = read_dent(open_results(write_dent(tmp_path, (19.0, 17.0), quads=quads)))
    assert dent is not None
    # parabolas through nodes h apart miss exp(-t^2/4) by up to 0.488 h^3 / (9 sqrt 3) in x and y
    step = synthetic.SIDE / (2 * quads)
    close = 2 * TOP * 0.488 * step**3 / (9 * np.sqrt(3))
    assert dent.struck[-1] == pytest.approx(TOP, abs=close)


def test_the_impactor_sinks_towards_the_opposite_face(tmp_path: Path) -> None:
    dent = read_dent(open_results(write_dent(tmp_path, MIDDLE)))
    assert dent is not None
    # at 1 ms the impactor is at its deepest; the first and the last state are off contact
    wanted = synthetic.DEPTH - 0.5 * (SINKS + BOTTOM)
    assert dent.indentation == pytest.approx([np.nan, wanted, np.nan], nan_ok=True, abs=1e-6)


def test_a_dent_from_below_is_as_deep(tmp_path: Path) -> None:
    dent = read_dent(open_results(write_dent(tmp_path, MIDDLE, above=-1.0)))
    assert dent is not None
    assert dent.struck[-1] == pytest.approx(TOP, abs=1e-6)
    assert dent.opposite[-1] == pytest.approx(BOTTOM, abs=1e-6)


def test_numbers_tell_the_dent_after_the_contact(tmp_path: Path) -> None:
    job = write_dent(tmp_path, MIDDLE)
    numbers = read_numbers(open_results(job))
    assert numbers.largest_indentation == pytest.approx(
        synthetic.DEPTH - 0.5 * (SINKS + BOTTOM), abs=1e-6
    )
    assert numbers.dent_depth == pytest.approx(TOP, abs=1e-6)
    path = job.with_name("plate.impactor_1.csv")
    path.write_text("\n".join(path.read_text().splitlines()[:300]) + "\n")
    assert read_numbers(open_results(job)).dent_depth is None


def test_numbers_do_without_fields_and_say_why(own_job: Path) -> None:
    own_job.with_name("plate.vtkhdf").write_bytes(b"no HDF5")
    numbers = read_numbers(open_results(own_job))
    assert numbers.dent_depth is None
    assert "plate.vtkhdf cannot be read" in numbers.notes[-1]
    own_job.with_name("plate.vtkhdf").unlink()
    assert read_numbers(open_results(own_job)).notes == ()


def test_an_impactor_beside_the_plate_is_told(tmp_path: Path) -> None:
    job = write_dent(tmp_path, (100.0, 0.0))
    with pytest.raises(ResultsError, match=r"plate\.vtkhdf: the impactor is beside the plate"):
        read_dent(open_results(job))


def test_a_dent_is_drawn(tmp_path: Path) -> None:
    job = write_dent(tmp_path, MIDDLE)
    result = CliRunner().invoke(app, ["dent", str(job)])
    assert result.exit_code == 0, result.output
    assert (tmp_path / "plate_dent.png").is_file()
