"""What ended a test of strength, from gaps, energies and broken fibres that are known."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
import synthetic
import synthetic_damage
from test_compression import END, FALL_TIME, PEAK_TIME, SIDE, STRENGTH, write_test

from plydyn_post.broken_plies import broken_plies, fibre_strains
from plydyn_post.compression import Compression, read_compression
from plydyn_post.compression_report import judge, report_tasks
from plydyn_post.ending import ending_words, read_ending
from plydyn_post.plan import Plan
from plydyn_post.plies import read_stack
from plydyn_post.results import open_results
from plydyn_post.section import Cut
from plydyn_post.strength import strength_lights
from plydyn_post.sublaminate_figures import draw_gap, draw_sublaminates, widened
from plydyn_post.sublaminates import states_of

#: States: the start, shortly before the peak, after the fall
TIMES = (0.0, 1.9e-3, END)
#: Largest gaps at them: a strip of the lower ply, the middle of the laminate, a closed interface
GAPS = ((0.0, 0.20, 0.25), (0.01, 0.30, 0.60), (0.0, 0.0, 0.0))
#: Energies that the interfaces take up to the peak and in the fall
TAKEN = ((30.0, 5.0), (10.0, 400.0), (0.0, 0.0))
MIDDLE = np.array([SIDE / 2, SIDE / 2])


def write_ending(
    folder: Path,
    gaps: tuple[tuple[float, ...], ...] = GAPS,
    shortened: float = 0.01,
    taken: tuple[tuple[float, float], ...] = TAKEN,
) -> Compression:
    """A test whose fibres of ply 1 break where x is above the middle."""
    test = write_test(folder)
    synthetic_damage.write_interfaces(folder, "pressed")
    _write_gaps(folder / "pressed.interfaces.vtkhdf", np.array(gaps))
    columns = [np.array([0.0, PEAK_TIME, FALL_TIME, END])]
    for before, fall in taken:
        columns.append(np.interp([0.0, 1.0, 2.0, 3.0], [0, 1, 2], [0.0, before, before + fall]))
    names = ["time [s]", *(f"interface {k + 1} energy [mJ]" for k in range(3))]
    synthetic.write_csv(folder / "pressed.delamination.csv", names, np.column_stack(columns))
    with h5py.File(test.job.fields, "r+") as file:
        grid = file["VTKHDF"]
        grid["Steps/Values"][...] = TIMES
        x = grid["Points"][:, 0]
        lower = np.arange(len(x)) < len(x) // 2
        states = [0.0 * x, 0.0 * x, np.where(lower, x / SIDE, 0.0)]
        grid["PointData/damage_fibre"] = np.concatenate(states)
        offsets = grid["Steps/PointDataOffsets/displacement"][...]
        grid["Steps/PointDataOffsets/damage_fibre"] = offsets
        grid["PointData/displacement"][:, 0] = -shortened * np.tile(x, len(TIMES))
        del file["plydyn/plies"]
        rows = [[1, k + 1, k + 11, 0.0, 0.5 * k, 0.5 * (k + 1)] for k in range(4)]
        file["plydyn/plies"] = np.array(rows)
        file["plydyn/plies"].attrs["columns"] = "part,ply,ply_id,angle,bottom,top"
    return read_compression(test.job)


def _write_gaps(path: Path, gaps: np.ndarray) -> None:
    """Gaps of the whole of each interface at each state, and damage everywhere."""
    with h5py.File(path, "r+") as file:
        grid = file["VTKHDF"]
        grid["Steps/Values"][...] = TIMES
        each = len(grid["Points"]) // len(gaps)
        grid["PointData/damage"][...] = 1.0
        opening = np.repeat(gaps.T.ravel(), each)
        grid["PointData/opening"] = np.outer(opening, [0.0, 0.0, 1.0])
        offsets = grid["Steps/PointDataOffsets/damage"][...]
        grid["Steps/PointDataOffsets/opening"] = offsets


def test_states_are_those_around_the_fall(tmp_path: Path) -> None:
    test = write_ending(tmp_path)
    states = states_of(test, test.job.fields)
    assert (states.first, states.peak, states.after) == TIMES


def test_the_interface_of_the_fall_is_not_the_strip_that_opened_early(tmp_path: Path) -> None:
    """Interface 1 opens by more of its ply, and takes no energy in the fall."""
    test = write_ending(tmp_path)
    ending = read_ending(test)
    assert ending.opened is ending.grown
    assert ending.opened is not None
    assert ending.opened.number == 2
    assert ending.opened.gaps == pytest.approx(GAPS[1])
    assert ending.opened.thickness == pytest.approx(1.0)
    assert ending.opened.energies == pytest.approx((10.0, 400.0))
    assert ending.opened.opened == pytest.approx(STRENGTH * TIMES[1] / PEAK_TIME)
    assert [one.number for one in ending.harmless] == [1]
    words = ending_words(test, ending)
    assert words[0].startswith("Sublaminate buckling with opening of interface 2, then fibre")
    assert any("Interface 1 opened" in one and "harmless" in one for one in words)


def test_what_had_opened_is_told_from_what_grows(tmp_path: Path) -> None:
    """Interface 2 is open before the peak, interface 3 takes most in the fall."""
    test = write_ending(tmp_path, taken=((30.0, 5.0), (50.0, 100.0), (0.0, 400.0)))
    ending = read_ending(test)
    assert ending.opened is not None
    assert ending.grown is not None
    assert (ending.opened.number, ending.grown.number) == (2, 3)
    words = ending_words(test, ending)
    assert "opening of interface 2, then" in words[0]
    assert any("Interface 3" in one and "400 mJ" in one for one in words)


def test_rows_enclose_a_fall_that_is_shorter_than_an_interval(tmp_path: Path) -> None:
    """Nothing of what the fall takes counts as taken before."""
    test = write_test(tmp_path)
    assert test.fall(np.array([0.0, 1.5e-3, 2.5e-3, END])) == (1, 2)
    assert test.fall(np.array([0.0, PEAK_TIME, FALL_TIME])) == (1, 2)
    assert test.fall(np.array([1.9e-3, 2.01e-3])) == (0, 1)


def test_a_plate_that_opens_nowhere_buckles_as_a_whole(tmp_path: Path) -> None:
    """The bump of the fields is deeper than half of the thickness, and fibres are pressed."""
    test = write_ending(tmp_path, ((0.0,) * 3,) * 3)
    ending = read_ending(test)
    assert ending.deflection == pytest.approx(synthetic.DEPTH, rel=1e-6)
    first = ending_words(test, ending)[0]
    assert first.startswith("Buckling of the whole plate, then fibre kinking of ply 1 (0°)")


@pytest.mark.parametrize(("gaps", "drawn"), [(GAPS, True), (((0.0,) * 3,) * 3, False)])
def test_a_gap_is_drawn_where_there_is_one(
    gaps: tuple[tuple[float, ...], ...], drawn: bool, tmp_path: Path
) -> None:
    """Without energies and gaps no interface had a part in the end."""
    test = write_ending(tmp_path, gaps, taken=((0.0, 0.0),) * 3)
    tasks = report_tasks(judge(Plan((test.job,), tmp_path), test, None))
    assert ("compression_gap" in {task.name for task in tasks}) == drawn


def test_broken_fibres_have_a_ply_an_area_and_a_place(tmp_path: Path) -> None:
    """The damage of ply 1 grows with x, and passes a half in the middle of the plate."""
    (ply,) = broken_plies(write_ending(tmp_path))
    assert ply.number == 1
    assert ply.area == pytest.approx(0.5 * SIDE**2)
    assert ply.along == pytest.approx((0.5 * SIDE, SIDE))
    assert ply.over == pytest.approx(1.0)


def test_fibres_that_break_beside_the_delaminations_are_told(tmp_path: Path) -> None:
    """Fibres break where x is above the middle; only the other half has delaminated."""
    test = write_ending(tmp_path)
    with h5py.File(test.job.interface_fields, "r+") as file:
        grid = file["VTKHDF"]
        left = grid["Points"][:, 0] < 0.5 * SIDE - 1.0e-6
        grid["PointData/damage"][...] = np.tile(1.0 * left, len(TIMES))
    ending = read_ending(test)
    # nine nodes: the quads next to the middle have nodes on both sides of it
    assert ending.plies[0].over == pytest.approx(0.0)
    assert ending.is_away
    assert "of ply 1 (0°) away from the delaminations" in ending_words(test, ending)[0]
    lights = strength_lights(test, ending, ())
    assert any(light.colour == "red" and "away from" in light.words for light in lights)


def test_stretched_fibres_tear(tmp_path: Path) -> None:
    test = write_ending(tmp_path, shortened=-0.01)
    assert "fibre tearing of ply 1" in ending_words(test, read_ending(test))[0]


@pytest.mark.parametrize("angle", [0.0, 45.0, 90.0])
def test_strains_along_fibres_are_those_of_the_gradient(angle: float, tmp_path: Path) -> None:
    """E = ((F f)^2 - 1)/2 with the gradient F of a plate that is stretched and sheared."""
    test = write_test(tmp_path)
    gradient = np.array([[-0.01, 0.02], [0.005, 0.004]])
    with h5py.File(test.job.fields, "r+") as file:
        grid = file["VTKHDF"]
        moved = grid["Points"][:, :2] @ gradient.T
        field = np.column_stack([moved, 0.0 * moved[:, 0]])
        grid["PointData/displacement"][...] = np.tile(field, (len(synthetic.STATES), 1))
        grid["CellData/angle"][...] = angle
    stack = read_stack(test.job)
    way = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    line = way + gradient @ way
    wanted = 0.5 * (line @ line - 1.0)
    assert fibre_strains(stack, stack.plies[0]) == pytest.approx(wanted, abs=1e-6)


def test_an_early_dip_is_not_the_end(tmp_path: Path) -> None:
    """A strip buckles at half of the strength; energies count from the last peak on."""
    test = write_test(tmp_path)
    path = tmp_path / "pressed.supports.csv"
    head, *rows = path.read_text().splitlines()
    values = np.loadtxt(rows, delimiter=",")
    places = [0.0, 0.8e-3, 1.0e-3, PEAK_TIME, FALL_TIME, END]
    share = np.interp(values[:, 0], places, [0.0, 0.5, 0.3, 1.0, 0.2, 0.2])
    values[:, 3] = -STRENGTH * share * SIDE
    synthetic.write_csv(path, head.split(","), values)
    dipped = read_compression(test.job)
    assert dipped.time[dipped.peak] == pytest.approx(PEAK_TIME)
    assert dipped.fallen is not None
    assert dipped.time[dipped.fallen] > PEAK_TIME


def test_gaps_are_widened_and_the_ply_in_the_middle_stays() -> None:
    along = np.zeros(2)
    heights = [np.array([[0.0, 1.0]] * 2), np.array([[1.1, 2.0]] * 2), np.array([[1.9, 3.0]] * 2)]
    cut = widened(Cut(along, np.zeros((2, 2)), [], heights, []), 5.0)
    assert cut.heights[1] == pytest.approx(heights[1])
    assert cut.heights[0][:, -1] == pytest.approx(1.1 - 5.0 * 0.1)
    # faces that pass each other are not widened
    assert cut.heights[2] == pytest.approx(heights[2])


def test_sublaminates_and_gaps_are_drawn(tmp_path: Path) -> None:
    test = write_ending(tmp_path)
    assert draw_gap(test, read_ending(test), MIDDLE, tmp_path / "gap.png").is_file()
    assert draw_sublaminates(test, MIDDLE, tmp_path / "section.png").is_file()


@pytest.mark.parametrize(("share", "colour"), [(0.01, "green"), (0.03, "amber"), (0.06, "red")])
def test_ends_out_of_balance_are_told(share: float, colour: str, tmp_path: Path) -> None:
    write_ending(tmp_path)
    path = tmp_path / "pressed.supports.csv"
    head, *rows = path.read_text().splitlines()
    values = np.loadtxt(rows, delimiter=",")
    values[:, 1] = share * values[:, 3]
    synthetic.write_csv(path, head.split(","), values)
    test = read_compression(open_results(tmp_path / "pressed"))
    assert test.unbalance() == pytest.approx(share)
    lights = strength_lights(test, read_ending(test), ())
    told = [light for light in lights if "forces of both ends" in light.words]
    assert [light.colour for light in told] == [colour]
