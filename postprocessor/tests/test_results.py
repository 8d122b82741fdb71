"""A job is found from any of its files, and what is wrong with one is told by its name."""

from pathlib import Path

import pytest
import synthetic

from plydyn_post.errors import ResultsError
from plydyn_post.results import labelled, open_results
from plydyn_post.table import read_table, split_header


@pytest.mark.parametrize("ending", ["", ".vtkhdf", ".out", ".energy.csv", ".impactor_1.csv"])
def test_a_job_is_found_from_any_of_its_names(job: Path, ending: str) -> None:
    results = open_results(f"{job}{ending}")
    assert (results.job, results.folder) == (job.name, job.parent)
    assert (results.impactors, results.profiles) == ((1,), (1,))


def test_a_job_is_found_from_its_folder(job: Path) -> None:
    assert open_results(job.parent).job == "plate"


def test_a_dot_in_the_name_is_kept(tmp_path: Path) -> None:
    synthetic.write_impactor(tmp_path, "v1.5_plate")
    assert open_results(tmp_path / "v1.5_plate").impactors == (1,)


def test_a_folder_with_two_jobs_names_them(own_job: Path) -> None:
    synthetic.write_impactor(own_job.parent, "other")
    with pytest.raises(ResultsError, match="other, plate"):
        open_results(own_job.parent)


def test_a_missing_job_and_a_missing_file_are_named(own_job: Path) -> None:
    with pytest.raises(ResultsError, match=r"nothing\.vtkhdf"):
        open_results(own_job.parent / "nothing")
    own_job.with_name("plate.energy.csv").unlink()
    with pytest.raises(ResultsError, match=r"plate\.energy\.csv"):
        open_results(own_job).energy()
    with pytest.raises(ResultsError, match="no impactor 7; it has 1"):
        open_results(own_job).impactor(7)


def test_histories_that_were_asked_for_are_read(own_job: Path) -> None:
    own_job.with_name("plate.nodes.csv").write_text("time [s],n5 top uz [mm]\n0,0\n1,-2\n")
    heads = "time [s],fz [N],spc 3 fz [N]"
    own_job.with_name("plate.supports.csv").write_text(f"{heads}\n0,0,0\n1,30,20\n")
    other = own_job.with_name("plate.supports_2.csv")
    other.write_text("time [s],fz [N],motion 4 fz [N]\n2,10,10\n")
    results = open_results(other)
    assert results == open_results(own_job)
    assert results.nodes()["n5 top uz"].tolist() == [0.0, -2.0]
    assert (results.supports().unit("fz"), results.supports()["fz"][-1]) == ("N", 30.0)
    assert results.supports()["spc 3 fz"].tolist() == [0.0, 20.0]
    assert results.supports(2)["motion 4 fz"].tolist() == [10.0]


def test_jobs_of_one_name_are_told_apart_by_their_folder(tmp_path: Path) -> None:
    for folder in ("coarse", "fine"):
        (tmp_path / folder).mkdir()
        synthetic.write_impactor(tmp_path / folder, "plate")
    jobs = [open_results(tmp_path / folder) for folder in ("coarse", "fine")]
    assert [name for name, _ in labelled(jobs)] == ["coarse/plate", "fine/plate"]


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("time [s]", ("time", "s")),
        ("Force (kN)", ("force", "kN")),
        ("cycle", ("cycle", "")),
        ("error [-]", ("error", "")),
        ("n12 top ux [mm]", ("n12 top ux", "mm")),
    ],
)
def test_headers_hold_a_name_and_a_unit(text: str, parts: tuple[str, str]) -> None:
    assert split_header(text) == parts


def test_a_line_cut_short_is_left_out_with_a_note(own_job: Path) -> None:
    path = own_job.with_name("plate.impactor_1.csv")
    rows = len(read_table(path).values)
    path.write_text(path.read_text()[:-30])
    table = read_table(path)
    assert len(table.values) == rows - 1
    assert "cut short" in table.notes[0]
    assert any("plate.impactor_1.csv" in note for note in open_results(own_job).notes())


def test_a_last_number_cut_short_is_not_taken_for_a_whole_one(tmp_path: Path) -> None:
    path = tmp_path / "a.energy.csv"
    path.write_text("time [s],total [mJ]\n0,1\n1,12")
    assert read_table(path).values.tolist() == [[0.0, 1.0]]
    assert read_table(path, from_solver=False).values.tolist() == [[0.0, 1.0], [1.0, 12.0]]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is empty"),
        ("time [s],force [N]\n", "no rows yet"),
        ("time [s],force [N]\n0,0\n1,***\n", r"line 3: '\*\*\*' is not a number"),
        ("time [s],force [N]\n0,0,4\n1,2\n", "line 2: 3 numbers where the header names 2"),
        ("time [s],force [N]\n0\n1\n", "line 2: 1 numbers"),
    ],
)
def test_what_is_wrong_with_a_table_is_told(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "job.impactor_1.csv"
    path.write_text(text)
    with pytest.raises(ResultsError, match=message) as caught:
        read_table(path)
    assert str(path) in str(caught.value)


def test_an_unknown_column_is_told_with_the_known_ones(job: Path) -> None:
    with pytest.raises(ResultsError, match=r"energy\.csv has no column 'heat'; it has cycle, time"):
        _ = open_results(job).energy()["heat"]
