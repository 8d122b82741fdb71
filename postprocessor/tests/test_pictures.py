"""Pictures and figures are made without a display, and show something."""

from pathlib import Path

import h5py
import numpy as np
import pytest
import pyvista as pv
import synthetic
import synthetic_damage
from matplotlib.image import imread

from plydyn_post import offscreen
from plydyn_post.camera import camera_for
from plydyn_post.errors import ResultsError
from plydyn_post.figures import curves_of, draw_energy, draw_history
from plydyn_post.picture import draw_picture
from plydyn_post.profile import IN_PLANE, draw_profiles, read_profiles
from plydyn_post.results import open_results
from plydyn_post.scene import Wish, make_scene
from plydyn_post.shown import shown
from plydyn_post.units import nice


def colours(path: Path) -> int:
    """Number of different colours, coarsely."""
    image = (15 * imread(path)[..., :3]).astype(int)
    return len(np.unique(image.reshape(-1, 3), axis=0))


def is_drawn(path: Path) -> bool:
    return path.is_file() and float(imread(path)[..., :3].std()) > 0.02


needs_vtk = pytest.mark.skipif(offscreen.window() is None, reason="VTK cannot draw here")


@needs_vtk
@pytest.mark.parametrize("cut", [False, True])
def test_vtk_draws_the_plate(job: Path, tmp_path: Path, cut: bool) -> None:
    wish = Wish("sxx" if cut else "uz", cut=cut)
    path = tmp_path / "new" / "a.png"
    draw_picture(open_results(job), path, wish)
    assert is_drawn(path)
    assert colours(path) > 100


@pytest.mark.parametrize("cut", [False, True])
def test_matplotlib_draws_the_plate_where_vtk_cannot(
    job: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cut: bool
) -> None:
    monkeypatch.setattr(offscreen, "window", lambda: None)
    path = tmp_path / "a.png"
    draw_picture(open_results(job), path, Wish("u", cut=cut))
    assert is_drawn(path)
    assert colours(path) > 50


@needs_vtk
def test_both_ways_show_the_same(job: Path, tmp_path: Path) -> None:
    wish = Wish("sxx", mesh=False)
    paths = {plain: tmp_path / f"{plain}.png" for plain in (False, True)}
    for plain, path in paths.items():
        draw_picture(open_results(job), path, wish, plain=plain)
    one, other = map(imread, paths.values())
    # edges of lines and the sphere differ, faces do not
    assert np.abs(one - other)[..., :3].mean() < 0.02


def test_without_libraries_no_process_is_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(offscreen, "has_library", lambda names: False)
    monkeypatch.setattr(offscreen, "draws", lambda window: pytest.fail("a process was started"))
    assert offscreen.window.__wrapped__() is None


def test_a_process_that_crashes_is_survived(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(offscreen, "has_library", lambda names: True)
    monkeypatch.setattr(offscreen.sys, "executable", "/bin/false")
    assert offscreen.window.__wrapped__() is None


def test_libraries_are_looked_for_by_name() -> None:
    assert offscreen.has_library(("libnothing.so.0", "libc.so.6"))
    assert not offscreen.has_library(("libnothing.so.0",))


def test_the_scene_says_what_was_magnified(job: Path) -> None:
    scene = make_scene(open_results(job), Wish("sxx", cut=True))
    assert scene.words == "t = 1 ms   displacement × 2   thickness × 5"
    assert scene.label == r"$\sigma_{xx}$ [MPa]"
    assert scene.limits[0] == -scene.limits[1]
    plain = make_scene(open_results(job), Wish(time=0.0))
    assert plain.words == "t = 0 µs"


def test_the_impactor_touches_the_drawn_plate(job: Path) -> None:
    scene = make_scene(open_results(job), Wish(factor=5.0))
    (sphere,) = scene.bodies
    top = 2 * synthetic.PLY
    assert sphere.radius == synthetic.RADIUS
    assert sphere.centre[2] - sphere.radius == pytest.approx(top - 5.0 * synthetic.DEPTH)


def test_an_impactor_of_unknown_size_is_left_out(own_job: Path) -> None:
    with h5py.File(own_job.with_name("plate.vtkhdf"), "r+") as file:
        del file["plydyn/impactors"]
    assert make_scene(open_results(own_job), Wish()).bodies == ()


def test_the_view_holds_the_scene_and_zooms_into_it(job: Path) -> None:
    scene = make_scene(open_results(job), Wish())
    camera = camera_for(scene)
    left, right, low, high = camera.window
    seen = camera.seen(scene.points)
    assert left < seen[:, 0].min() and seen[:, 0].max() < right
    assert low < seen[:, 1].min() and seen[:, 1].max() < high
    near = camera_for(make_scene(open_results(job), Wish(zoom=2.0))).window
    assert near[1] - near[0] == pytest.approx((right - left) / 2)


@pytest.mark.parametrize(
    ("number", "shown"), [(0.3, 1.0), (1.9, 1.0), (2.0, 2.0), (7.0, 5.0), (34.0, 20.0)]
)
def test_factors_are_round(number: float, shown: float) -> None:
    assert nice(number) == shown


def test_an_unknown_quantity_and_a_missing_field_are_told(job: Path, tmp_path: Path) -> None:
    with pytest.raises(ResultsError, match="'heat' is no quantity"):
        draw_picture(open_results(job), tmp_path / "a.png", Wish("heat"))
    with pytest.raises(ResultsError, match=r"plate\.vtkhdf has no field 'stress_ply'"):
        draw_picture(open_results(job), tmp_path / "a.png", Wish("s11"))


def test_a_field_of_one_number_is_shown_as_it_is() -> None:
    grid = pv.ImageData(dimensions=(2, 1, 1)).cast_to_unstructured_grid()
    grid.point_data["plastic_strain"] = np.array([0.0, 0.02])
    wanted = shown("plastic_strain")
    assert not wanted.signed
    assert wanted.values(grid, "a file").tolist() == [0.0, 0.02]


def test_damage_between_points_stays_within_theirs(tmp_path: Path) -> None:
    """A cell of 27 nodes with a step in it, through which its polynomial swings."""
    job = synthetic_damage.write_job(tmp_path)
    scene = make_scene(open_results(job), Wish("damage_matrix", time=synthetic.STATES[-1]))
    assert scene.limits == (0.0, 1.0)
    assert scene.values.min() == 0.0
    assert scene.values.max() == 1.0


def test_figures_of_curves_are_drawn(job: Path, own_job: Path, tmp_path: Path) -> None:
    measured = tmp_path / "test 17.csv"
    measured.write_text("Time (ms);Force (kN)\n0;0\n1;1.4\n2;0")
    jobs = [open_results(job), open_results(own_job)]
    curves = curves_of(jobs, [measured])
    assert [curve.measured for curve in curves] == [False, False, True]
    draw_history(curves, "time", "force", tmp_path / "a.png")
    draw_history(curves[:2], "displacement", "force", tmp_path / "b.png")
    draw_energy(jobs[0], tmp_path / "c.png")
    draw_energy(jobs[0], tmp_path / "d.png", stacked=True)
    draw_profiles(read_profiles(jobs), IN_PLANE, tmp_path / "e.png")
    assert all(is_drawn(tmp_path / f"{name}.png") for name in "abcde")


def test_a_test_without_what_is_drawn_is_told(job: Path, tmp_path: Path) -> None:
    measured = tmp_path / "test.csv"
    measured.write_text("time [ms],temperature [K]\n0,1\n")
    with pytest.raises(ResultsError, match=r"test\.csv names time, temperature"):
        curves_of([open_results(job)], [measured])
    measured.write_text("time [ms],force [kgf]\n0,1\n")
    with pytest.raises(ResultsError, match=r"\[kgf\]"):
        curves = curves_of([open_results(job)], [measured])
        draw_history(curves, "time", "force", tmp_path / "a.png")
