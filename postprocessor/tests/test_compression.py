"""A compression test whose strength, strains and event are known."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
import synthetic
from typer.testing import CliRunner

from plydyn_post.broken_plies import place_words
from plydyn_post.cli import app
from plydyn_post.compression import Compression, Places, read_compression
from plydyn_post.ending import ending_words, read_ending
from plydyn_post.errors import ResultsError
from plydyn_post.results import open_results
from plydyn_post.strength import notes_of, ratio, strength_table, strength_words

# 40 x 40 x 1 mm: stress rises to 300 MPa at 0.4 mm, and falls to 60 over a tenth of the time
SIDE, THICKNESS, STRENGTH, SHORTENING = 40.0, 1.0, 300.0, 0.4
PEAK_TIME, FALL_TIME, END = 2.0e-3, 2.2e-3, 3.0e-3
FIBRES, MATRIX = 800.0, 200.0


def write_test(
    folder: Path, job: str = "pressed", share: float = 1.0, kinetic: float = 0.0
) -> Compression:
    """A stage that presses the end at the largest x: forces along -x are negative."""
    synthetic.write_fields(folder, job)
    time = np.linspace(0.0, END, 301)
    stress = share * STRENGTH * np.interp(time, [0.0, PEAK_TIME, FALL_TIME], [0.0, 1.0, 0.2])
    moved = -SHORTENING * time / PEAK_TIME
    nothing = np.zeros_like(time)
    force = -stress * SIDE * THICKNESS
    supports = ["time [s]", "fx [N]", "spc 3 fx [N]", "motion 7 fx [N]", "motion 7 fy [N]"]
    rows = np.column_stack([time, nothing, -force, force, nothing])
    synthetic.write_csv(folder / f"{job}.supports.csv", supports, rows)
    names = ["time [s]", "z [mm]", "ply [-]", "ux [mm]", "uz [mm]", "exx [-]"]
    # gauges bend: 20 % more on the bottom; the middle opens by 0.1 mm; 0.05 mm are there before
    for number in (1, 2, 4):
        blocks = []
        for place, t in enumerate(time):
            for row, face in enumerate((-1.0, 1.0)):
                strain = moved[place] / SIDE * (1.0 - 0.2 * face) + 1.0e-4
                opening = 0.05 * face * t / END
                blocks.append((t, 0.5 * face, row + 1, 0.05 + moved[place], opening, strain))
        synthetic.write_csv(folder / f"{job}.profile_{number}.csv", names, np.array(blocks))
    broken = np.interp(time, [PEAK_TIME, FALL_TIME], [0.0, 1.0])
    internal = 1.0e3 * time / END
    energy = {
        "time [s]": time,
        "kinetic [mJ]": kinetic * internal,
        "internal [mJ]": internal,
        "dissipated [mJ]": 1.0e3 * broken,
        "error [-]": nothing,
        "total [mJ]": internal,
        "external [mJ]": internal,
        "contact [mJ]": nothing,
        "fibre damage [mJ]": FIBRES * broken,
        "matrix damage [mJ]": MATRIX * broken,
    }
    columns = np.column_stack(list(energy.values()))
    synthetic.write_csv(folder / f"{job}.energy.csv", list(energy), columns)
    return read_compression(open_results(folder / job), Places())


def told(test: Compression) -> tuple[str, ...]:
    """What the page says of the end of a test."""
    return ending_words(test, read_ending(test))


def test_strength_is_peak_force_over_width_and_thickness(tmp_path: Path) -> None:
    test = write_test(tmp_path)
    assert test.strength == pytest.approx(STRENGTH)
    assert test.shortening[test.peak] == pytest.approx(SHORTENING)
    assert test.time[test.peak] == pytest.approx(PEAK_TIME)
    # 0.7 of the peak on a line from 1 to 0.2
    fallen = PEAK_TIME + (FALL_TIME - PEAK_TIME) * 0.3 / 0.8
    assert test.time[test.fallen] == pytest.approx(fallen, abs=END / 300.0)


def test_gauges_count_from_the_start_of_the_stage(tmp_path: Path) -> None:
    """Both faces average the strain of the plate, and bend by a fifth of it."""
    test = write_test(tmp_path)
    assert test.strain == pytest.approx(SHORTENING / SIDE)
    assert test.bending == pytest.approx(20.0)
    assert test.faces[-1] == pytest.approx([-0.05, 0.05])


def test_event_is_what_took_most_energy_in_the_fall(tmp_path: Path) -> None:
    test = write_test(tmp_path)
    taken = test.broken()
    assert taken["fibre damage"] / taken["matrix damage"] == pytest.approx(FIBRES / MATRIX)
    assert any("fibres 80%, matrix 20%" in words for words in told(test))


@pytest.mark.parametrize(("middle", "words"), [(20.0, "between its ends"), (1.0, "were crushed")])
def test_crushed_ends_are_told_from_a_plate_that_fails(
    middle: float, words: str, tmp_path: Path
) -> None:
    """Fibres break within 3 mm of a line across, from the second state on."""
    test = write_test(tmp_path)
    with h5py.File(test.job.fields, "a") as file:
        grid = file["VTKHDF"]
        near = np.abs(grid["Points"][:, 0] - middle) < 3.0
        states = [0.0 * near, *[1.0 * near] * (len(synthetic.STATES) - 1)]
        field = np.concatenate(states)
        grid["PointData"].create_dataset("damage_fibre", data=field)
        offsets = grid["Steps/PointDataOffsets/displacement"][()]
        grid["Steps/PointDataOffsets"].create_dataset("damage_fibre", data=offsets)
    assert words in place_words(test)
    assert any(words in one for one in told(test))


def test_ratio_to_a_pristine_plate(tmp_path: Path) -> None:
    struck, sound = write_test(tmp_path, "struck", 0.6), write_test(tmp_path, "sound")
    assert ratio(struck, sound) == pytest.approx(0.6)
    rows = {row[0]: row[1:] for row in strength_table(struck, sound).rows}
    assert rows["strength, peak force / (w h) [MPa]"] == ("180", "300")
    assert rows["peak force [kN]"] == ("7.2", "12")


def test_the_page_says_how_to_get_the_pristine_strength(tmp_path: Path) -> None:
    struck, sound = write_test(tmp_path, "struck", 0.6), write_test(tmp_path, "sound")
    assert "60% of the 300 MPa" in strength_words(struck, sound)[0]
    assert "give --with-pristine to plydyn-pre run" in strength_words(struck, None)[1]


def test_the_kinetic_share_is_told_at_the_peak(tmp_path: Path) -> None:
    assert write_test(tmp_path, kinetic=0.03).kinetic_at_peak() == pytest.approx(0.03)


def test_fast_and_bent_tests_are_noted(tmp_path: Path) -> None:
    assert "not quasi-static" in notes_of(write_test(tmp_path, kinetic=0.06))[0]
    notes = notes_of(write_test(tmp_path, kinetic=0.04))
    assert len(notes) == 1
    assert "gauges bend by 20 %" in notes[0]


def test_page_of_a_chain(own_job: Path, tmp_path: Path) -> None:
    write_test(tmp_path)
    write_test(tmp_path, "sound")
    words = ["compression", own_job, tmp_path / "pressed", "--pristine", tmp_path / "sound"]
    words += ["-o", tmp_path / "page", "--plain", "--gauge", 2]
    result = CliRunner().invoke(app, [str(word) for word in words])
    assert result.exit_code == 0, result.output
    assert "strength / that of the pristine plate" in result.output
    page = (tmp_path / "page/report.html").read_text()
    for name in ("compression_stress", "compression_gauges", "compression_event", "force"):
        assert f'src="{name}.png"' in page
    heads = ("Strength", "What ended the test", "Can the strength be trusted?")
    heads += ("What the strength assumes", "Stages")
    places = [page.index(f"<h2>{head}</h2>") for head in heads]
    assert places == sorted(places)
    assert page.index("compression_stress.png") < places[1] < page.index("compression_event.png")
    assert page.count("compression_event.png") == 1
    assert (tmp_path / "page/strength.csv").read_text().startswith("quantity,pressed,sound")


def test_a_job_that_nothing_presses_is_refused(own_job: Path, tmp_path: Path) -> None:
    with pytest.raises(ResultsError, match=r"no history of support forces.*support_interval"):
        read_compression(open_results(own_job))
    test = write_test(tmp_path)
    with pytest.raises(ResultsError, match="no profile 9"):
        read_compression(test.job, Places(end=9))
    with pytest.raises(ResultsError, match="no profile 3"):
        read_compression(test.job, Places(gauges=(2, 3)))
    assert len(read_compression(test.job).gauges) == 1
    for path in tmp_path.glob("pressed.profile_*.csv"):
        path.unlink()
    with pytest.raises(ResultsError, match=r"no profile, .*outputs\.profiles"):
        read_compression(test.job)


def test_a_missing_history_is_told_by_its_key(own_job: Path, tmp_path: Path) -> None:
    write_test(tmp_path)
    (tmp_path / "pressed.supports.csv").unlink()
    result = CliRunner().invoke(app, ["compression", str(own_job), str(tmp_path / "pressed")])
    assert result.exit_code == 2
    assert "give outputs.support_interval in the stage of the recipe" in result.output
