"""Halves and quarters are drawn whole: what is mirrored is the other part of the plate."""

from pathlib import Path

import h5py
import numpy as np
import pytest
import synthetic
import synthetic_damage
from typer.testing import CliRunner

from plydyn_post.cli import app
from plydyn_post.curves import read_numbers
from plydyn_post.errors import ResultsError
from plydyn_post.hexahedra import QUADRATIC, lattice
from plydyn_post.interfaces import read_areas, read_interfaces
from plydyn_post.plies import read_stack
from plydyn_post.results import open_results
from plydyn_post.scan import drawn_areas, read_scan
from plydyn_post.scene import Wish, make_scene
from plydyn_post.symmetry import Plane, part_of, planes_of, read_whole
from plydyn_post.table import SHARE, read_table
from plydyn_post.vtkhdf import cells_of

BOTH = (Plane(0, 0.0), Plane(1, 0.0))


def known_fields(points: np.ndarray, angle: np.ndarray) -> dict[str, np.ndarray]:
    """Fields of a plate that is symmetric about x = 0 and y = 0."""
    x, y, z = points.T
    even, ones = np.cos(x / 30) * np.cos(y / 30), np.ones_like(x)
    stress = np.column_stack([even, 2 * even, 3 * ones, x * y, y * z, x * z])
    xx, yy, zz, xy, yz, xz = stress.T
    # axes of plies at 90 degrees are y and -x
    turned = np.column_stack([yy, xx, zz, -xy, -xz, yz])
    return {
        "displacement": np.column_stack([0.01 * x, 0.02 * y, -even]),
        "stress": stress,
        "stress_ply": np.where(angle[:, None] == 0.0, stress, turned),
        "damage_matrix": even,
    }


def write_quarter(folder: Path) -> Path:
    """The quarter x > 0, y > 0 of a plate hit in its middle."""
    job = synthetic_damage.write_job(folder)
    with h5py.File(job.with_name("plate.vtkhdf"), "r+") as file:
        root = file["VTKHDF"]
        points = root["Points"][...]
        angle = np.repeat(synthetic.ANGLES, len(points) // len(synthetic.ANGLES))
        for name, values in known_fields(points, angle).items():
            if name in root["PointData"]:
                del root[f"PointData/{name}"]
            else:
                starts = np.arange(len(synthetic.STATES)) * len(points)
                root[f"Steps/PointDataOffsets/{name}"] = starts
            root[f"PointData/{name}"] = np.concatenate([values] * len(synthetic.STATES))
        file["plydyn/impactors"][0, 3:5] = 0.0
    for path in folder.glob("*.vtkhdf"):
        with h5py.File(path, "r+") as file:
            file.require_group("plydyn").attrs["symmetry"] = "x=0 y=0"
    for path in folder.glob("*.csv"):
        head, *rows = path.read_text().splitlines()
        lines = [f"{head},{SHARE} [-]", *(f"{row},0.25" for row in rows)]
        path.write_text("\n".join(lines) + "\n")
    return job


@pytest.fixture(scope="module")
def quarter(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A quarter, only to be read."""
    return write_quarter(tmp_path_factory.mktemp("quarter"))


def test_fields_of_the_image_are_those_of_the_other_part(quarter: Path) -> None:
    job = open_results(quarter)
    grid = read_whole(job, job.fields, 1)
    points = np.asarray(grid.points)
    assert points[:, :2].min(axis=0) == pytest.approx([-synthetic.SIDE] * 2)
    angle = np.zeros(len(points))
    offsets, connectivity = cells_of(grid)
    angle[connectivity] = np.repeat(grid.cell_data["angle"], np.diff(offsets))
    for name, wanted in known_fields(points, angle).items():
        assert np.asarray(grid.point_data[name]) == pytest.approx(wanted, abs=1e-5), name


def test_cells_of_the_image_are_not_inside_out(quarter: Path) -> None:
    job = open_results(quarter)
    grid = read_whole(job, job.fields, 0)
    corner = np.asarray(grid.points)[grid.cells_dict[QUADRATIC][:, lattice(QUADRATIC)]]
    start = corner[:, 0, 0, 0]
    sides = [corner[:, -1, 0, 0], corner[:, 0, -1, 0], corner[:, 0, 0, -1]]
    assert np.all(np.linalg.det(np.stack([side - start for side in sides], axis=1)) > 0.0)


@pytest.mark.parametrize(
    ("mirror", "planes"),
    [("auto", BOTH), ("xy", BOTH), ("x", BOTH[:1]), ("y", BOTH[1:]), ("none", ())],
)
def test_planes_are_found_or_chosen(quarter: Path, mirror: str, planes: tuple) -> None:
    job = open_results(quarter, mirror)
    assert planes_of(job) == planes
    assert part_of(job) == "whole plate, 4 x the quarter"


def test_words_that_are_no_planes_are_refused(tmp_path: Path) -> None:
    job = write_quarter(tmp_path)
    with h5py.File(job.with_name("plate.vtkhdf"), "r+") as file:
        file["plydyn"].attrs["symmetry"] = "z=0"
    with pytest.raises(ResultsError, match="'z=0' are no planes of symmetry"):
        planes_of(open_results(job))


def test_a_whole_plate_is_not_mirrored(job: Path) -> None:
    assert planes_of(open_results(job)) == ()
    with pytest.raises(ResultsError, match="--mirror cannot be 'z'"):
        open_results(job, "z")


def test_a_quarter_is_drawn_whole(quarter: Path, tmp_path: Path) -> None:
    scene = make_scene(open_results(quarter), Wish())
    assert scene.points[:, 0].min() == pytest.approx(-scene.points[:, 0].max())
    assert scene.words.endswith("mirrored about x = 0 and y = 0")
    # no face is left where the parts meet
    middle = scene.points[scene.triangles].mean(axis=1)
    assert np.abs(middle[:, 0]).min() > 1e-3
    stack = read_stack(open_results(quarter))
    assert stack.places.shape[0] == 4 * 36
    for command in ("cscan", "section", "damage"):
        words = [command, str(quarter), "-o", str(tmp_path / f"{command}.png")]
        assert CliRunner().invoke(app, words).exit_code == 0


def test_areas_are_those_of_the_whole(quarter: Path, tmp_path: Path) -> None:
    synthetic_damage.write_job(tmp_path)
    whole, part = open_results(quarter), open_results(tmp_path)
    time = synthetic.STATES[-1]
    areas = [read_areas(job, time).projected for job in (whole, part)]
    assert areas[0] == pytest.approx(4 * areas[1])
    scan, alone = read_scan(whole), read_scan(open_results(quarter, "none"))
    measured = [drawn_areas(one.state, one.sheets) for one in (scan, alone)]
    assert measured[0].projected == pytest.approx(4 * measured[1].projected, rel=1e-9)
    assert len(np.unique(read_interfaces(whole).each[0].elements)) == 4 * 24 * 24


def test_numbers_of_a_quarter_are_those_of_the_whole(quarter: Path, tmp_path: Path) -> None:
    synthetic_damage.write_job(tmp_path)
    for mirror in ("auto", "none"):
        whole, part = (
            read_numbers(open_results(quarter, mirror)),
            read_numbers(open_results(tmp_path)),
        )
        assert whole.notes[-1] == "whole plate, 4 x the quarter"
        assert not any("whole" in note for note in part.notes)
        for name in ("peak_force", "impulse", "absorbed_energy"):
            assert getattr(whole, name) == pytest.approx(4.0 * getattr(part, name)), name
        for name in ("peak_time", "largest_displacement", "impact_velocity", "energy_error"):
            assert getattr(whole, name) == getattr(part, name), name


def test_forces_energies_and_areas_alone_count_as_often_as_the_model(tmp_path: Path) -> None:
    path = tmp_path / "job.x.csv"
    names = "time [s],force [N],force x [N],friction [mJ],contact area [mm2],pressure [MPa],"
    names += f"impulse z [lbf s],slip [mm],velocity [mm/s],spin [1/s],steps [-],{SHARE} [-]"
    path.write_text(f"{names}\n{'1,' * 11}0.5\n")
    table = read_table(path)
    doubled = [name for name, value in zip(table.names, table.values[0], strict=True) if value == 2]
    assert doubled == ["force", "friction", "contact area", "impulse z"]
    assert table.copies == 2
    assert read_table(path, from_solver=False).copies == 1
    path.write_text(f"{names}\n{'1,' * 11}0.3\n")
    with pytest.raises(ResultsError, match=r"share of the whole plate must be 0\.5 or 0\.25"):
        read_table(path)
