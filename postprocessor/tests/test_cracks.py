"""Cracks along lines: their pieces at a state, and maps with them."""

from __future__ import annotations

import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest
import synthetic
import synthetic_damage as known
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from synthetic import STATES
from test_damage import damaged  # noqa: F401 - a fixture

from plydyn_post.cracks import PlyCracks, cracks_of, read_cracks
from plydyn_post.cscan import draw_cscan
from plydyn_post.delamination import ABOVE, BELOW, draw_delamination
from plydyn_post.errors import ResultsError
from plydyn_post.maps import half_window
from plydyn_post.ply_maps import draw_ply_maps
from plydyn_post.results import Results, open_results
from plydyn_post.section import draw_section
from plydyn_post.sheets import Sheet
from plydyn_post.style import INK


@pytest.fixture
def cracked(damaged: Path, tmp_path: Path) -> Results:  # noqa: F811 - the fixture
    """Results of a job with delaminations and a line of cracks in two plies."""
    for path in damaged.parent.glob(f"{open_results(damaged).job}.*"):
        shutil.copy(path, tmp_path)
    job = open_results(damaged).job
    known.write_cracks(tmp_path, job)
    return open_results(tmp_path / f"{job}.vtkhdf")


def lines_of(figure: object, colour: str) -> list[np.ndarray]:
    """Pieces of a colour in all axes of a figure."""
    found = []
    for axes in figure.axes:
        for each in axes.collections:
            if isinstance(each, LineCollection) and np.allclose(
                each.get_colors()[0][:3], [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
            ):
                found += each.get_segments()
    return found


def thin_lines(axes: Axes) -> int:
    """Number of pieces with the width of cracks."""
    found = [each for each in axes.collections if isinstance(each, LineCollection)]
    return sum(len(each.get_segments()) for each in found if each.get_linewidth()[0] == 0.7)


def test_pieces_with_both_ends_cracked_are_cracks(cracked: Results) -> None:
    bottom, second = read_cracks(cracked)
    assert (bottom.ply, bottom.angle, second.ply, second.angle) == (1, 0.0, 2, 90.0)
    assert bottom.length == pytest.approx(16.0)
    assert second.length == pytest.approx(12.0)
    assert np.allclose(bottom.opening, 0.05)
    assert np.all(bottom.damage == 1.0)
    half = cracks_of(cracked, STATES[1])
    assert half[1].length == pytest.approx(8.0)
    assert half[2].length == pytest.approx(6.0)
    assert sum(each.length for each in read_cracks(cracked, STATES[0])) == 0.0


def test_maps_have_the_cracks_of_the_plies_beside_an_interface(cracked: Results) -> None:
    made = draw_delamination(cracked)
    # ply 1 is below the first interface; ply 2 is above it, and below the second one
    assert len(lines_of(made, BELOW)) == 16 + 6
    assert len(lines_of(made, ABOVE)) == 6
    text = " ".join(words.get_text() for words in made.texts)
    assert "cracks of the ply below green, above blue" in (made.get_suptitle() + text)
    straight = [
        piece
        for piece in lines_of(draw_cscan(cracked), INK)
        if np.allclose(piece[:, 1], 10.0) and piece[:, 0].min() >= 2.0 and len(piece) == 2
    ]
    assert len(straight) >= 16


def test_maps_of_plies_have_their_own_cracks_as_lines_of_the_matrix(cracked: Results) -> None:
    made = draw_ply_maps(cracked)
    rows, columns = made.axes[0].get_subplotspec().get_gridspec().get_geometry()
    drawn = [thin_lines(axes) for axes in made.axes[: rows * columns]]
    assert sorted(drawn, reverse=True)[:3] == [16, 6, 0]
    assert "lines: cracks of the matrix" in made.get_suptitle()
    assert "lines" not in draw_ply_maps(cracked, mechanisms=("damage_fibre",)).get_suptitle()


def test_cracks_cross_a_line_where_they_meet_it() -> None:
    pieces = np.array(
        [[[2.0, -1.0], [2.0, 3.0]], [[1.0, 4.0], [5.0, 4.0]], [[3.0, 0.0], [4.0, 0.0]]]
    )
    cracks = PlyCracks(1, 90.0, pieces, np.ones(3), np.zeros(3))
    # along x at y = 0, along the diagonal x = y, and a line that ends before it meets any
    assert cracks.crossings(np.zeros(2), np.array([9.0, 0.0])) == pytest.approx([2.0])
    diagonal = cracks.crossings(np.zeros(2), np.array([9.0, 9.0]))
    assert diagonal == pytest.approx(np.sqrt(2.0) * np.array([2.0, 4.0]))
    assert not len(cracks.crossings(np.zeros(2), np.array([1.5, 0.0])))


def test_a_section_shows_cracks_from_face_to_face_of_their_ply(cracked: Results) -> None:
    # along the diagonal both lines are met at (10, 10), along x and y through the middle neither
    made = draw_section(cracked, angles=(45.0, 0.0))
    pieces = np.array(lines_of(made, INK))
    away = (known.CRACKS[2][0][0] - 0.5 * synthetic.SIDE) * np.sqrt(2.0)
    assert pieces.shape == (2, 2, 2)
    # at the nearest of 1201 places, moved by a bending of less than a hundredth
    assert pieces[..., 0] == pytest.approx(np.full((2, 2), away), rel=0.01)
    assert np.ptp(pieces[..., 1], axis=1) == pytest.approx([synthetic.PLY] * 2, rel=0.01)
    assert abs(away) < made.axes[0].get_xlim()[1]
    assert "lines: cracks" in made.axes[0].get_title("right")


def test_the_window_of_a_map_holds_the_cracks() -> None:
    places = np.array([[0.0, 0.0], [20.0, 20.0], [-20.0, -20.0]])
    sheet = Sheet(places, np.zeros((0, 3), dtype=int), np.array([1.0, 0.0, 0.0]))
    line = np.array([[[3.0, 10.0], [4.0, 10.0]]])
    assert half_window([sheet], np.zeros(2), whole=False) < 10.0
    assert 10.0 < half_window([sheet], np.zeros(2), whole=False, lines=[line]) < 20.0


def test_jobs_without_lines_have_maps_without_them(damaged: Path) -> None:  # noqa: F811
    results = open_results(damaged)
    assert cracks_of(results) == {}
    assert lines_of(draw_delamination(results), BELOW) == []


def test_a_file_of_cracks_is_a_result_that_nothing_writes_over(cracked: Results) -> None:
    for name in ("cracks.vtkhdf", "cracks.csv"):
        path = cracked.folder / f"{cracked.job}.{name}"
        path.touch()
        with pytest.raises(ResultsError, match="is a result of job"):
            cracked.spare(path)


def test_a_file_that_is_no_file_of_cracks_is_refused(cracked: Results) -> None:
    with h5py.File(cracked.crack_fields, "r+") as file:
        del file["VTKHDF/PointData/start"]
    with pytest.raises(ResultsError, match="has no field 'start'"):
        read_cracks(cracked)
    cracked.crack_fields.unlink()
    with pytest.raises(ResultsError, match="a run writes it where plies crack along lines"):
        read_cracks(cracked)
