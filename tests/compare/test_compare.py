"""The comparison of two builds finds one wrong bit, wherever it is, and takes other names."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest

import known_names
from cases import RECORDED_STEPS, all_cases, recorded_cases
from differences import compare_folders

VALUES = np.array([[0.1, -2.5], [3.75, 1.0e-300], [0.0, 7.0]])


def results(folder: Path) -> Path:
    """The results of a job: a history, fields and a restart file."""
    folder.mkdir()
    (folder / "job.energy.csv").write_text(
        "cycle [-],time [s],ripple [mJ]\n0,0,1.600250000E+02\n11,7.381366535E-07,1.600250001E+02\n"
    )
    with h5py.File(folder / "job.vtkhdf", "w") as file:
        file["VTKHDF/PointData/displacement"] = VALUES.astype("f4")
        file["VTKHDF/PointData/velocity"] = 2.0 * VALUES.astype("f4")
        file["VTKHDF/Steps"] = np.arange(3)
        file["VTKHDF"].attrs["Version"] = [2, 0]
    with h5py.File(folder / "job.dump01", "w") as file:
        file["state/sums"] = VALUES.reshape(-1)
        file["state/clock"] = VALUES[0]
        file["state"].attrs["cycle"] = 40
    return folder


def flip(path: Path, name: str) -> None:
    """Turn the last bit of the fourth number of an array."""
    with h5py.File(path, "r+") as file:
        values = file[name][()]
        bits = values.reshape(-1).view(f"u{values.itemsize}")
        bits[3] ^= 1
        file[name][...] = values


def rewrite(path: Path, old: str, new: str) -> None:
    """Replace words of a history."""
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


def move(path: Path, old: str, new: str) -> None:
    """Give an array of a file another name."""
    with h5py.File(path, "r+") as file:
        file.move(old, new)


def add_column(path: Path) -> None:
    """Add a column at the end of a history."""
    lines = path.read_text().splitlines()
    path.write_text("".join(f"{line},{i}\n" for i, line in enumerate(lines)))


WRONG: dict[str, tuple[str, str, str, Callable[[Path], None]]] = {
    "number of a history": (
        "job.energy.csv",
        "ripple [mJ]",
        "row 2 (cycle [-] 11)",
        lambda path: rewrite(path, "1.600250001E+02", "1.600250002E+02"),
    ),
    "sign of a zero": (
        "job.energy.csv",
        "time [s]",
        "row 1 (cycle [-] 0)",
        lambda path: rewrite(path, "\n0,0,", "\n0,-0,"),
    ),
    "row too many": (
        "job.energy.csv",
        "rows",
        "",
        lambda path: path.write_text(path.read_text() + "12,8E-07,0\n"),
    ),
    "unknown column": ("job.energy.csv", "columns", "", add_column),
    "bit of a field": (
        "job.vtkhdf",
        "VTKHDF/PointData/velocity",
        "(1, 1), first of 1",
        lambda path: flip(path, "VTKHDF/PointData/velocity"),
    ),
    "bit of a restart array": (
        "job.dump01",
        "state/sums",
        "(3,), first of 1",
        lambda path: flip(path, "state/sums"),
    ),
    "missing file": ("job.dump01", "", "", Path.unlink),
}


@pytest.mark.parametrize("case", WRONG)
def test_a_difference_is_found(case: str, tmp_path: Path) -> None:
    """By file, name and place; nothing else differs."""
    old, new = results(tmp_path / "old"), results(tmp_path / "new")
    file, data, place, spoil = WRONG[case]
    spoil(new / file)
    found = compare_folders(old, new).differences
    assert [(one.file, one.data, one.place) for one in found] == [(file, data, place)]
    assert found[0].old != found[0].new


def test_values_of_both_are_reported(tmp_path: Path) -> None:
    """So that the size of a difference can be seen."""
    old, new = results(tmp_path / "old"), results(tmp_path / "new")
    flip(new / "job.dump01", "state/sums")
    (one,) = compare_folders(old, new).differences
    assert "1e-300" in one.old
    assert "e-300" in one.new or "e-301" in one.new


def test_the_same_has_no_difference(tmp_path: Path) -> None:
    """All numbers are counted; listings and decks are not compared."""
    old, new = results(tmp_path / "old"), results(tmp_path / "new")
    (old / "job.out").write_text("took 1 s")
    report = compare_folders(old, new)
    assert (report.differences, report.notes) == ([], [])
    assert (report.files, report.numbers) == (3, 6 + (6 + 6 + 3 + 2) + (6 + 2 + 1))


def test_other_names_pass_and_are_reported(tmp_path: Path) -> None:
    """Headers by their place, arrays and attributes by their content."""
    old, new = results(tmp_path / "old"), results(tmp_path / "new")
    rewrite(new / "job.energy.csv", "ripple", "half-step correction")
    move(new / "job.dump01", "state/sums", "state/global_reduction")
    with h5py.File(new / "job.dump01", "r+") as file:
        file["state/cycle"] = np.array([file["state"].attrs["cycle"]])
        del file["state"].attrs["cycle"]
    report = compare_folders(old, new)
    assert report.differences == []
    assert len(report.notes) == 3
    assert "column 'ripple [mJ]' is called 'half-step correction [mJ]'" in "".join(report.notes)
    assert report.numbers == compare_folders(old, old).numbers


def test_a_bit_is_found_under_another_name(tmp_path: Path) -> None:
    """What is alone of its shape in its group is taken for what has gone there."""
    old, new = results(tmp_path / "old"), results(tmp_path / "new")
    move(new / "job.dump01", "state/sums", "state/global_reduction")
    flip(new / "job.dump01", "state/global_reduction")
    (one,) = compare_folders(old, new).differences
    assert (one.data, one.place) == ("state/sums", "(3,), first of 1")


def test_what_is_gone_or_new_must_be_known(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is a difference until it stands in the table, and is reported then too."""
    old, new = results(tmp_path / "old"), results(tmp_path / "new")
    with h5py.File(new / "job.dump01", "r+") as file:
        del file["state/clock"]
        file["state/speed"] = np.arange(9.0)
    found = compare_folders(old, new).differences
    assert [one.data for one in found] == ["state/clock", "state/speed"]
    monkeypatch.setitem(known_names.DROPPED_DATA, "state/clock", "not needed")
    monkeypatch.setitem(known_names.ADDED_DATA, "state/speed", "a new thing")
    report = compare_folders(old, new)
    assert report.differences == []
    assert [note.split(": ")[1:] for note in report.notes] == [
        ["state/clock is written no longer", "not needed"],
        ["state/speed is new", "a new thing"],
    ]


@pytest.mark.parametrize("right", [True, False])
def test_an_array_may_be_split(
    right: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its parts together must have its bits."""
    old, new = results(tmp_path / "old"), results(tmp_path / "new")
    monkeypatch.setitem(known_names.SPLIT_DATA, "state/sums", ("state/first", "state/second"))
    with h5py.File(new / "job.dump01", "r+") as file:
        values = file["state/sums"][()]
        del file["state/sums"]
        file["state/first"], file["state/second"] = values[:2], values[2:]
        if not right:
            file["state/second"][0] += 1.0
    found = compare_folders(old, new).differences
    assert [one.place for one in found] == ([] if right else ["(2,), first of 1"])


@pytest.mark.parametrize("right", [True, False])
def test_values_may_be_shared_out_anew(
    right: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All arrays of one owner together must have the same values."""
    old, new = results(tmp_path / "old"), results(tmp_path / "new")
    monkeypatch.setitem(known_names.REARRANGED_DATA, "(state/sums)(_rest)?", "another order")
    with h5py.File(new / "job.dump01", "r+") as file:
        values = file["state/sums"][()]
        del file["state/sums"]
        file["state/sums"], file["state/sums_rest"] = values[2:], values[:2]
        if not right:
            file["state/sums_rest"][0] += 1.0
    found = compare_folders(old, new).differences
    assert [one.data for one in found] == ([] if right else ["state/sums"])


def test_results_are_there(tmp_path: Path) -> None:
    """Two empty folders are no success."""
    (tmp_path / "old").mkdir()
    shutil.copytree(tmp_path / "old", tmp_path / "new")
    assert compare_folders(tmp_path / "old", tmp_path / "new").differences


@pytest.mark.parametrize(
    ("fields", "short"),
    [
        ("0.0012897543711928984,0", f"0.0012897543711928984,{RECORDED_STEPS:10d}"),
        (f"{1.0e-4:10.4e}{0:10d}", f"{1.0e-4:10.4e}{RECORDED_STEPS:10d}"),
    ],
)
def test_a_recorded_deck_is_cut_short(fields: str, short: str, tmp_path: Path) -> None:
    """Its end is a cycle, between commas and in columns."""
    deck = tmp_path / "written.k"
    deck.write_text(f"*KEYWORD\n*CONTROL_TERMINATION\n{fields}\n*END\n")
    (case,) = recorded_cases([deck])
    case.write(tmp_path)
    assert (tmp_path / "deck.k").read_text().splitlines()[2] == short


def test_every_deck_and_recipe_is_a_case() -> None:
    """Each has a name of its own, and the quick selection has every kind."""
    cases = list(all_cases())
    names = [case.name for case in cases]
    assert len(set(names)) == len(names)
    tops = Path(__file__).resolve().parents[2]
    for path in [*tops.glob("decks/*/*.toml"), *tops.glob("tests/deck/*/deck.k")]:
        if path.suffix == ".toml":
            assert f"recipe/{path.parent.name}/{path.stem}" in names
        else:
            name = f"deck/{path.parent.name}"
            assert (name in names) != (name in known_names.CHANGED_CASES)
    assert {case.name.split("/")[0] for case in cases if case.quick} == {"made", "deck", "recipe"}


@pytest.mark.parametrize(("most", "rows"), [(1.0e-7, []), (1.0e-8, ["row 2 (cycle [-] 11)"])])
def test_a_column_may_be_rounded(
    most: float, rows: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of one case, by no more than the table says: the last digit is worth 1e-7."""
    old, new = results(tmp_path / "old"), results(tmp_path / "new")
    rewrite(new / "job.energy.csv", "1.600250001E+02", "1.6002500019E+02")
    name = r"deck/one .*energy\.csv: ripple.*"
    monkeypatch.setitem(known_names.ROUNDED_COLUMNS, name, (most, "a reason"))
    assert [one.place for one in compare_folders(old, new, "deck/one").differences] == rows
    assert compare_folders(old, new, "deck/other").differences


def test_a_column_may_move(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is found by its header, and another takes its place."""
    old, new = results(tmp_path / "old"), results(tmp_path / "new")
    add_column(old / "job.energy.csv")
    rewrite(old / "job.energy.csv", "[mJ],0", "[mJ],loss")
    lines = (old / "job.energy.csv").read_text().splitlines()
    rows = [line.split(",") for line in lines]
    moved = [[row[0], row[1], row[3], row[2]] for row in rows]
    (new / "job.energy.csv").write_text("".join(",".join(row) + "\n" for row in moved))
    assert compare_folders(old, new).differences
    rewrite(new / "job.energy.csv", "ripple", "half-step correction")
    key, value = r"(.*energy\.csv: )ripple(.*)", r"\1half-step correction\2"
    monkeypatch.setitem(known_names.RENAMED_COLUMNS, key, value)
    assert compare_folders(old, new).differences == []


@pytest.mark.parametrize(("last", "failures"), [(2.5, 0), (2.6, 1)])
def test_two_columns_may_share_a_sum(
    last: float, failures: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What one column has lost the other must have got, in histories and in restart files."""
    table, why = (".*energy.csv", "contact", "damping"), "a reason"
    monkeypatch.setattr(known_names, "SHIFTED_COLUMNS", {table[0]: (*table[1:], why)})
    monkeypatch.setattr(known_names, "SHIFTED_DATA", {"state/energies": (0, 2, why)})
    for name, one, other in (("old", 1.0, 3.0), ("new", 1.5, last)):
        (tmp_path / name).mkdir()
        text = f"time,contact [J],damping [J]\n0,0,0\n1,{one},{other}\n"
        (tmp_path / name / "job.energy.csv").write_text(text)
        with h5py.File(tmp_path / name / "job.dump01", "w") as file:
            file["state/energies"] = np.array([one, 7.0, other])
    report = compare_folders(tmp_path / "old", tmp_path / "new")
    assert bool(report.differences) == bool(failures)
    assert sum("have the same sum" in note for note in report.notes) == (0 if failures else 2)


@pytest.mark.parametrize("right", [True, False])
def test_an_array_may_be_widened(
    right: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The old values must follow each other among the new ones."""
    old, new = results(tmp_path / "old"), results(tmp_path / "new")
    monkeypatch.setitem(known_names.WIDENED_DATA, "state/sums", "a new variable")
    with h5py.File(new / "job.dump01", "r+") as file:
        values = file["state/sums"][()]
        if not right:
            values[[1, 4]] = values[[4, 1]]
        del file["state/sums"]
        file["state/sums"] = np.insert(values, 2, [8.0, 9.0])
    found = compare_folders(old, new).differences
    assert [one.data for one in found] == ([] if right else ["state/sums"])


def test_two_newer_builds_are_compared(tmp_path: Path) -> None:
    """What the tables say of an older build does not hide or miss anything that both write."""
    old, new = results(tmp_path / "old"), results(tmp_path / "new")
    for folder in (old, new):
        rewrite(folder / "job.energy.csv", "ripple [mJ]", "contact friction [mJ]")
        (folder / "job.delamination.csv").write_text(
            "time [s],interface 1 area [mm2],interface 1 failed area [mm2]\n0,4,2\n"
        )
        with h5py.File(folder / "job.dump01", "r+") as file:
            file["state/time"] = np.array([0.25])
    assert compare_folders(old, new).differences == []
    rewrite(new / "job.delamination.csv", "0,4,2", "0,5,2")
    rewrite(new / "job.energy.csv", "1.600250001E+02", "1.600250002E+02")
    with h5py.File(new / "job.dump01", "r+") as file:
        file["state/time"][0] = 0.5
    found = {(one.file, one.data) for one in compare_folders(old, new).differences}
    assert found == {
        ("job.delamination.csv", "interface 1 area [mm2]"),
        ("job.energy.csv", "contact friction [mJ]"),
        ("job.dump01", "state/time"),
    }
