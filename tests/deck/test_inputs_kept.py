"""No result takes the place of an input, by whatever name or link it is reached."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from runs import SOLVER

DECK = Path(__file__).parent / "heads" / "deck.k"
NORMAL, USAGE, OUTPUT = 0, 1, 5
REFUSED = "results of the job would replace its input"


def said(*words: object) -> tuple[int, str]:
    """Exit code, and all that was printed."""
    done = subprocess.run([SOLVER, *words], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


@pytest.fixture
def results(tmp_path: Path) -> Path:
    """A folder with all files of a run that writes whatever a run can write."""
    text = DECK.read_text().replace(
        "*END", "*DATABASE_BINARY_D3DUMP\n1\n*DATABASE_BINARY_RUNRSF\n1\n*END"
    )
    (tmp_path / "start.k").write_text(text)
    (tmp_path / "x.ctl").write_text("status\n")
    code, text = said("run", tmp_path / "start.k", "-j", tmp_path / "x")
    assert code == NORMAL, text
    return tmp_path


def test_no_result_takes_the_name_of_the_deck(results: Path) -> None:
    """Each file that a run makes is refused as its deck, and stays as it is."""
    made = [path.name for path in results.glob("x.*")]
    assert len(made) >= 9
    for name in [*made, "x.vtkhdf.part", "x.runrsf.part", "x.supports_2.csv", "x.impactor_2.csv"]:
        shutil.copyfile(DECK, results / name)
        code, text = said("run", results / name, "-j", results / "x")
        assert code == USAGE, name
        assert f"{REFUSED} {results / name}" in text
        assert (results / name).read_bytes() == DECK.read_bytes()


@pytest.mark.parametrize("by_link", [False, True], ids=["by name", "by link"])
def test_no_result_takes_the_name_of_an_included_file(by_link: bool, tmp_path: Path) -> None:
    """A link to such a name is no better than the name."""
    text = DECK.read_text().replace("*KEYWORD\n", "")
    kept = tmp_path / "x.energy.csv"
    kept.write_text(text)
    if by_link:
        (tmp_path / "mesh.k").symlink_to(kept)
    included = "mesh.k" if by_link else kept.name
    (tmp_path / "x.k").write_text(f"*KEYWORD\n*INCLUDE\n{included}\n*END\n")
    code, said_text = said("run", tmp_path / "x.k", "-j", tmp_path / "x")
    assert (code, kept.read_text()) == (USAGE, text)
    assert REFUSED in said_text


@pytest.mark.parametrize(
    "name", ["x.out", "x.energy.csv", "x.vtkhdf", "x.vtkhdf.part", "x.runrsf", "x.runrsf.part"]
)
@pytest.mark.parametrize("kind", ["symbolic", "hard"])
def test_results_follow_no_link(name: str, kind: str, tmp_path: Path) -> None:
    """A result in place of a link to the deck is a file of its own."""
    deck = tmp_path / "plate.k"
    deck.write_text(DECK.read_text().replace("*END", "*DATABASE_BINARY_RUNRSF\n1\n*END"))
    text = deck.read_text()
    link = tmp_path / name
    if kind == "symbolic":
        link.symlink_to(deck)
    else:
        link.hardlink_to(deck)
    code, words = said("run", deck, "-j", tmp_path / "x")
    assert code == NORMAL, words
    assert deck.read_text() == text
    assert not link.is_symlink()
    assert not link.exists() or not link.samefile(deck)


def test_restart_goes_on_through_no_link(results: Path) -> None:
    """The listing of a run that goes on is the file that was written, not what is linked there."""
    other = results / "other.txt"
    other.write_text("kept\n")
    (results / "x.out").unlink()
    (results / "x.out").symlink_to(other)
    code, text = said("restart", results / "x.dump01")
    assert (code, other.read_text()) == (OUTPUT, "kept\n")
    assert "it must be a file, and is a link" in text


def test_restart_file_is_not_replaced_by_the_first_that_is_kept(results: Path) -> None:
    """The files of a job of another name are counted on from the one it began with."""
    start = results / "y.dump01"
    shutil.copyfile(results / "x.dump01", start)
    before = start.read_bytes()
    code, text = said("restart", start, "-j", results / "y")
    assert code == NORMAL, text
    assert start.read_bytes() == before


def test_results_replace_no_device(tmp_path: Path) -> None:
    """A pipe in place of a result is refused, not waited for."""
    subprocess.run(["mkfifo", tmp_path / "x.out"], check=True)
    code, text = said("run", DECK, "-j", tmp_path / "x")
    assert code == OUTPUT
    assert "no regular file" in text
