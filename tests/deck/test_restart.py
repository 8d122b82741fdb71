"""A run that goes on from a restart file ends as the run in one piece, to the last bit."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest

from broken import (
    CYCLES,
    KINDS,
    averaged_parts,
    impact,
    metal,
    said,
    unlike,
    yielding_by_points,
    yielding_by_power,
)
from decks import Deck
from elasticity import Array
from fixture_decks import all_bodies, all_fixtures
from lever_decks import under_ball
from runs import DIGITS, SOLVER, Results

NORMAL, USAGE, INPUT, OUTPUT = 0, 1, 2, 5

CASES: dict[str, Callable[[], Deck]] = {
    **KINDS,
    "points of plate": lambda: impact(2),
    "springs": lambda: impact(1, "springs"),
    "thick linear plies": lambda: impact(1, linear=True, order=4),
    "failing plies that close": lambda: impact(1, "springs", failing=True, closing=True),
    "averages on two parts, one of given strains": averaged_parts,
    "fixtures": all_fixtures,
    "levers under a ball": under_ball,
    "bodies of every shape": all_bodies,
    "metal by points": lambda: metal(yielding_by_points),
    "metal by a power": lambda: metal(yielding_by_power),
}


def both(deck: Deck, folder: Path, cycles: int = CYCLES) -> tuple[Path, Path]:
    """The files of a run in one piece, with restart files; and the same once more, to go on in."""
    deck.add("DATABASE_BINARY_D3DUMP", (cycles,))
    whole, broken = folder / "whole", folder / "broken"
    whole.mkdir()
    code, text = said("run", deck.write(folder / "job.k"), "-o", whole)
    assert code == NORMAL, text
    shutil.copytree(whole, broken)
    return whole, broken


def contacts(dump: Path) -> int:
    """Contact nodes that press when a restart file was written."""
    with h5py.File(dump) as file:
        return int(file["state/impactor_1"][8])


def column(folder: Path, table: str, name: str) -> Array:
    """A column of a history of the job in a folder."""
    return Results(folder, "job").table(table)[name]


@pytest.mark.parametrize("case", CASES)
def test_restart_gives_the_same_bits(case: str, tmp_path: Path) -> None:
    """Wherever the run goes on, in mid-contact too, all files are those of the run in one piece.

    So they are on another number of threads.
    """
    whole, broken = both(CASES[case](), tmp_path)
    (tmp_path / "job.k").unlink()
    dumps = [dump for dump in sorted(broken.glob("job.dump??")) if contacts(dump) > 0]
    code, text = said("restart", sorted(broken.glob("job.dump??"))[-1], "-j", "new", "-o", tmp_path)
    assert code == NORMAL
    assert "nothing is left to do: the end" in text
    lossy = {"metal", "failing", "averages", "bricks", "planes", "crack"}
    assert (case.split()[0] in lossy) == any(column(whole, "energy", "dissipated") > 0.0)
    code, text = said("restart", dumps[-1], "ncpu=2")
    assert code == NORMAL, text
    assert unlike(whole, broken) == []
    assert "continues from" in (broken / "job.out").read_text()


def test_last_restart_files_are_the_same(tmp_path: Path) -> None:
    """All of the state is the same at the end, not only what is shown of it."""
    whole, broken = both(impact(1), tmp_path)
    last = sorted(whole.glob("job.dump??"))[-1].name
    code, text = said("restart", broken / "job.dump01")
    assert code == NORMAL, text
    with h5py.File(whole / last) as one, h5py.File(broken / last) as other:
        assert one["state"].keys() == other["state"].keys()
        for name, values in one["state"].items():
            assert np.array_equal(values[()], other["state"][name][()]), name


def test_running_file_replaces_the_one_before(tmp_path: Path) -> None:
    """RUNRSF leaves as many files as it says, and each of them goes on."""
    deck = impact(1)
    deck.add("DATABASE_BINARY_RUNRSF", (CYCLES, 2))
    whole = tmp_path / "whole"
    whole.mkdir()
    code, text = said("run", deck.write(tmp_path / "job.k"), "-o", whole)
    assert code == NORMAL, text
    before = {path.name: path.read_bytes() for path in whole.glob("*.csv")}
    assert sorted(path.name for path in whole.glob("job.runrsf*")) == ["job.runrsf1", "job.runrsf2"]
    for number in (1, 2):
        code, text = said(f"r={whole / f'job.runrsf{number}'}")
        assert code == NORMAL, text
        assert before == {path.name: path.read_bytes() for path in whole.glob("*.csv")}


@pytest.mark.parametrize("words", [["-j", "job"], ["-o", "broken"], ["-o", "whole/../broken"]])
def test_name_of_the_run_goes_on_with_its_files(words: list[str], tmp_path: Path) -> None:
    """However it is written: nothing of what is before the restart is lost."""
    whole, broken = both(impact(1, end=1.0e-5), tmp_path)
    folder = broken if words[0] == "-j" else tmp_path
    dump = (broken / "job.dump01").relative_to(folder)
    command = [SOLVER, "restart", dump, *words]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == NORMAL, done.stderr
    assert unlike(whole, broken) == []


def test_parameters_and_include_files_are_in_the_restart_file(tmp_path: Path) -> None:
    """A restart needs nothing but the restart file and the results."""
    (tmp_path / "end.k").write_text("*KEYWORD\n*DATABASE_BINARY_D3DUMP\n40\n*END\n")
    text = impact(1).text().replace("-8000.0", "&speed")
    head = "*KEYWORD\n*PARAMETER\nR speed,-1.0\n*INCLUDE\nend.k\n"
    deck = tmp_path / "job.k"
    deck.write_text(text.replace("*KEYWORD\n", head, 1))
    folders = [tmp_path / "whole", tmp_path / "broken"]
    for folder in folders:
        folder.mkdir()
        code, text = said("run", deck, "-o", folder, "-p", "speed=-8e3")
        assert code == NORMAL, text
    for path in (deck, tmp_path / "end.k"):
        path.unlink()
    code, text = said("restart", folders[1] / "job.dump02")
    assert code == NORMAL, text
    assert unlike(*folders) == []


def test_deck_moves_the_end(tmp_path: Path) -> None:
    """A later end gives what the run would have given that had it from the start."""
    folders = [tmp_path / "whole", tmp_path / "broken"]
    for folder, end in zip(folders, (2.0e-5, 1.5e-5), strict=True):
        folder.mkdir()
        deck = impact(1, end=end)
        deck.add("DATABASE_BINARY_D3DUMP", (CYCLES,))
        code, text = said("run", deck.write(tmp_path / "job.k"), "-o", folder)
        assert code == NORMAL, text
    small = tmp_path / "small.k"
    small.write_text("*KEYWORD\n*CONTROL_TERMINATION\n2.0e-5,\n*END\n")
    code, text = said("restart", folders[1] / "job.dump02", small)
    assert code == NORMAL, text
    assert unlike(*folders) == []


@pytest.mark.parametrize("end", ["1.0e-9", "1.0,1", f"1.0,{CYCLES}"])
def test_end_that_has_passed_is_refused(end: str, tmp_path: Path) -> None:
    """The results of the run before are not cut back."""
    deck = impact(1, end=1.0e-5)
    deck.add("DATABASE_BINARY_D3DUMP", (CYCLES,))
    code, text = said("run", deck.write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == NORMAL, text
    table = (tmp_path / "job.energy.csv").read_bytes()
    small = tmp_path / "small.k"
    small.write_text(f"*KEYWORD\n*CONTROL_TERMINATION\n{end},\n*END\n")
    code, text = said("restart", tmp_path / "job.dump01", small)
    assert code == INPUT, text
    assert "ends the run before it goes on: the restart file is of time" in text
    assert f"cycle {CYCLES}" in text
    assert (tmp_path / "job.energy.csv").read_bytes() == table


def test_deck_of_a_restart_may_ask_for_a_check(tmp_path: Path) -> None:
    """NOSOL 1: the listing on the screen, and the results as they were."""
    deck = impact(1, end=1.0e-5)
    deck.add("DATABASE_BINARY_D3DUMP", (CYCLES,))
    code, text = said("run", deck.write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == NORMAL, text
    before = {path.name: path.read_bytes() for path in tmp_path.glob("job.*")}
    small = tmp_path / "small.k"
    small.write_text("*KEYWORD\n*CONTROL_TERMINATION\n4.0e-5,0,0.0,0.0,0.0,1\n*END\n")
    code, text = said("restart", tmp_path / "job.dump01", small)
    assert code == NORMAL, text
    assert "Stable step" in text
    assert before == {path.name: path.read_bytes() for path in tmp_path.glob("job.*")}


def test_deck_changes_supports_and_loads(tmp_path: Path) -> None:
    """From the restart on, other points are held and other loads act; the books still close.

    A node in the middle of the plate is caught in its motion and stays where it is; the edges are
    free then, and a line of them is loaded.
    """
    deck = impact(1)
    deck.add("DATABASE_BINARY_D3DUMP", (CYCLES,))
    code, text = said("run", deck.write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == NORMAL, text
    before = column(tmp_path, "energy", "total")
    middle = 13 * 6 + 7
    small = tmp_path / "small.k"
    small.write_text(
        f"*KEYWORD\n*SET_NODE_LIST\n50\n{middle},\n*BOUNDARY_SPC_SET\n50,0,1,1,1\n"
        "*SET_NODE_LIST\n51\n1,14,27\n*LOAD_FACE_LINE\n51,1,3,0,0.5\n*END\n"
    )
    code, text = said("restart", tmp_path / "job.dump02", small, "-j", "other", "-o", tmp_path)
    assert code == NORMAL, text
    results = Results(tmp_path, "other")
    energy, nodes = results.table("energy"), results.table("nodes")
    height = nodes[f"n{middle} top uz"]
    assert energy["cycle"][0] == 2 * CYCLES
    assert height[0] < -1.0e-3
    assert np.ptp(height) <= DIGITS * abs(height[0])
    assert np.abs(energy["error"]).max() < 100.0 * DIGITS
    assert np.array_equal(before, column(tmp_path, "energy", "total"))


def test_other_supports_have_a_table_of_their_own(tmp_path: Path) -> None:
    """The old one ends at the restart; a later restart finds both, and goes on to the same bits."""
    deck = impact(1)
    deck.add("DATABASE_BINARY_D3DUMP", (CYCLES,))
    code, text = said("run", deck.write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == NORMAL, text
    before = tmp_path.joinpath("job.supports.csv").read_text()
    small = tmp_path / "small.k"
    small.write_text("*KEYWORD\n*SET_NODE_LIST\n50\n1,2,3\n*BOUNDARY_SPC_SET\n50,0,1,1,1\n*END\n")
    code, text = said("restart", tmp_path / "job.dump02", small)
    assert code == NORMAL, text
    assert f"other supports act from here on: their forces are in {tmp_path}/job.supports_2" in text
    broken_off = float(re.search(r"continues from .*, time (\S+)", text)[1])
    ended = tmp_path.joinpath("job.supports.csv").read_text()
    assert before.startswith(ended)
    assert column(tmp_path, "supports", "time")[-1] <= broken_off
    second = Results(tmp_path, "job").table("supports_2")
    assert second["time"][0] > broken_off
    assert second.names[4:] == [f"spc 50 f{axis}" for axis in "xyz"]
    tables = {path.name: path.read_bytes() for path in tmp_path.glob("job.*.csv")}
    for words in ([], [same(tmp_path)]):
        code, text = said("restart", tmp_path / "job.dump03", *words)
        assert code == NORMAL, text
        assert tables == {path.name: path.read_bytes() for path in tmp_path.glob("job.*.csv")}


def same(folder: Path) -> Path:
    """A deck of a restart that brings the supports that act already."""
    path = folder / "same.k"
    path.write_text("*KEYWORD\n*BOUNDARY_SPC_SET\n50,0,1,1,1\n*END\n")
    return path


def test_restart_refuses(tmp_path: Path) -> None:
    """What a restart cannot change or find is named, and nothing is written."""
    deck = impact(1, end=1.0e-5)
    deck.add("DATABASE_BINARY_D3DUMP", (CYCLES,))
    code, text = said("run", deck.write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == NORMAL, text
    dump = tmp_path / "job.dump01"
    small = tmp_path / "small.k"
    small.write_text("*KEYWORD\n*MAT_ELASTIC\n7,1.0,1.0,0.3\n*END\n")
    for words, expected, fragment in [
        ([dump, small], INPUT, "small.k:2: *MAT_ELASTIC: a restart cannot change this"),
        ([dump, "nowhere.k"], INPUT, "the file 'nowhere.k' cannot be read"),
        ([dump, "-p", "speed=1"], USAGE, "-p belongs to run"),
        ([], USAGE, "restart needs a restart file"),
        ([tmp_path / "job.k"], INPUT, "job.k is no restart file"),
        ([dump, dump], INPUT, "job.dump01' is an HDF5 file, not a deck"),
        ([tmp_path / "job.vtkhdf"], INPUT, "but no restart file of plydyn"),
    ]:
        code, text = said("restart", *words)
        assert (code, fragment in text) == (expected, True), text
    table = (tmp_path / "job.energy.csv").read_bytes()
    (tmp_path / "job.energy.csv").write_bytes(table[: len(table) // 4])
    code, text = said("restart", dump)
    assert code == OUTPUT, text
    assert "cannot go on with" in text
    assert (tmp_path / "job.energy.csv").read_bytes() == table[: len(table) // 4]


def test_results_of_another_run_are_left_alone(tmp_path: Path) -> None:
    """Another deck has run under the same name since: its tables are not cut and gone on with."""
    whole, broken = both(impact(1, end=1.0e-5), tmp_path)
    dump = tmp_path / "job.dump01"
    shutil.copy(whole / "job.dump01", dump)
    other = tmp_path / "other" / "job.k"
    other.parent.mkdir()
    text = (tmp_path / "job.k").read_text()
    assert text.count("-8000.0") == 1
    other.write_text(text.replace("-8000.0", "-7000.0"))
    code, text = said("run", other, "-o", broken)
    assert code == NORMAL, text
    shutil.copy(dump, broken)
    before = {path.name: path.read_bytes() for path in broken.iterdir()}
    code, text = said("restart", broken / "job.dump01")
    assert code == INPUT, text
    assert "is of another run than the restart file" in text
    assert before == {path.name: path.read_bytes() for path in broken.iterdir()}
    code, text = said("restart", broken / "job.dump01", "-j", tmp_path / "new")
    assert code == NORMAL, text
