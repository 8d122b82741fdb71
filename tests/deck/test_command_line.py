"""What the program answers to the words of its command line, and its exit codes."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from runs import ROOT, SOLVER

DECK = Path(__file__).parent / "heads" / "deck.k"
RECIPE = ROOT / "decks" / "elastic_impact" / "le2.toml"
NORMAL, USAGE, INPUT, OUTPUT = 0, 1, 2, 5


def said(*words: object) -> tuple[int, str]:
    """Exit code, and all that was printed."""
    done = subprocess.run([SOLVER, *words], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


@pytest.mark.parametrize(
    ("words", "code", "fragment"),
    [
        (["--version"], NORMAL, "flags"),
        (["--help"], NORMAL, "plydyn run DECK"),
        (["check", "--help"], NORMAL, "plydyn run DECK"),
        (["--keywords", "node"], NORMAL, "## *NODE"),
        (["--keywords", "*MAT_001"], NORMAL, "## *MAT_ELASTIC"),
        (
            ["--keywords", "NODES"],
            USAGE,
            "no keyword *NODES: right would be perhaps *NODE",
        ),
        (
            ["--keywords", "impactor"],
            USAGE,
            "no keyword *IMPACTOR: right would be one of *IMPACTOR_SPHERE, *IMPACTOR_TUP,",
        ),
        (["--keywords", "NODE", "PART"], USAGE, "'PART' is not understood"),
        (["--version", "deck.k"], USAGE, "'deck.k' is not understood"),
        ([], USAGE, "plydyn run DECK"),
        (["strike", DECK], USAGE, "'strike' is not understood"),
        (["strike"], USAGE, "'strike' is not understood"),
        (["run"], USAGE, "run needs a deck"),
        (["run", "one.k", "two.k"], USAGE, "'two.k' is not understood"),
        (["run", DECK, "-j"], USAGE, "-j needs a name after it"),
        (["run", DECK, "-o", "-j", "job"], USAGE, "-o needs a name after it"),
        (["check", DECK, "--help"], NORMAL, "plydyn run DECK"),
        (["check", DECK, f"i={DECK}"], USAGE, "the deck is given twice, as '"),
        ([f"i={DECK}", "i=two.k"], USAGE, "and as 'two.k'"),
        (["run", DECK, "-j", "a", "jobid=b"], USAGE, "the job is given twice, as 'a' and as 'b'"),
        (["run", DECK, "-o", "a", "-o", "b"], USAGE, "the folder of the results is given twice"),
        (["run", DECK, "jobid="], USAGE, "the job needs a name behind its ="),
        (["run", DECK, "-j", "out/"], USAGE, "'out/' is no name of a job"),
        (["run", DECK, "-j", ".."], USAGE, "'..' is no name of a job"),
        (["run", DECK, "ncpu=1", "NCPU=2"], USAGE, "ncpu= is given twice"),
        (["run", DECK, "--wall-time", "5", "--wall-time", "6"], USAGE, "is given twice"),
        (["run", DECK, "-p", "v=1", "-p", "V=2"], USAGE, "-p gives 'V' twice"),
        (["check", DECK, "r=job.dump01"], USAGE, "r= belongs to restart"),
        (["--version", "-o", "out"], USAGE, "takes none of the words that belong to a run"),
        (["--keywords", "NODE", "ncpu=2"], USAGE, "takes none of the words that belong to a run"),
        (["run", DECK, "ncpu=0"], USAGE, "a number of threads from 1 to"),
        (["check", DECK, "ncpu=4096"], INPUT, "4096 threads are too many for this machine"),
        (["run", DECK, "ncpu=two"], USAGE, "a number of threads from 1 to"),
        (["run", DECK, "-x"], USAGE, "'-x' is not understood"),
        (["run", DECK, "--wall-time", "soon"], USAGE, "hours, minutes and seconds"),
        (["run", DECK, "-p", "speed"], USAGE, "a name and a number"),
        (["run", DECK, "-p", "sped=1"], INPUT, "does not define this parameter"),
        (["check", DECK, "-p", "speed=fast"], INPUT, "as in -p velocity=3.0"),
        (["run", "check", DECK], USAGE, "cannot go together"),
        (["run", DECK, "--wall-time", "1:2:3:4"], USAGE, "hours, minutes and seconds"),
        (["check", DECK, "ncpu=99999999999"], USAGE, "a number of threads from 1 to"),
        (["check", "missing.k"], INPUT, "the file 'missing.k' cannot be read"),
        (["check", Path(__file__).parent], INPUT, "cannot be read"),
        (["check", RECIPE], INPUT, "le2.toml' is a recipe, not a deck"),
        (["check", RECIPE], INPUT, "right would be: the deck that 'plydyn-pre deck"),
        (["run", DECK, "-o", DECK / "folder"], OUTPUT, "cannot make the folder"),
        (["run", DECK, "-o", "/proc"], OUTPUT, "cannot create /proc/deck.lock"),
    ],
    ids=lambda value: " ".join(str(v) for v in value) if isinstance(value, list) else "",
)
def test_command_line(words: list[object], code: int, fragment: str) -> None:
    """The exit code says what kind of end it was."""
    found, text = said(*words)
    assert found == code, text
    assert fragment in text


def test_words_of_other_codes(tmp_path: Path) -> None:
    """i=, jobid= and ncpu= run a deck; the files have the name of the job."""
    code, text = said(f"i={DECK}", f"jobid={tmp_path / 'other'}", "ncpu=2")
    assert code == NORMAL, text
    assert (tmp_path / "other.vtkhdf").exists()
    assert f"normal end, results in {tmp_path / 'other'}.*" in text


def test_folder_of_results_is_made(tmp_path: Path) -> None:
    """With those above it; a check makes none."""
    assert said("check", DECK, "-o", tmp_path / "none")[0] == NORMAL
    assert not (tmp_path / "none").exists()
    code, text = said("run", DECK, "-o", tmp_path / "one" / "two")
    assert code == NORMAL, text
    assert (tmp_path / "one" / "two" / "deck.vtkhdf").exists()


def test_deck_comes_through_a_pipe(tmp_path: Path) -> None:
    """It is read as from its file, a long line and one without an end too."""
    text = DECK.read_text().replace("*NODE\n", f"$ {'-' * 10000}\n*NODE\n").rstrip()
    tables = []
    for words, sent in [([DECK], ""), (["/dev/stdin"], text), (["/dev/stdin"], text + "\n\n")]:
        command = [SOLVER, "run", *words, "-j", "job", "-o", tmp_path]
        done = subprocess.run(command, input=sent, capture_output=True, text=True, check=False)
        assert done.returncode == NORMAL, done.stderr
        tables.append((tmp_path / "job.energy.csv").read_bytes())
    assert tables[1:] == tables[:1] * 2
    done = subprocess.run(
        [SOLVER, "check", "/dev/stdin"], input="", capture_output=True, text=True, check=False
    )
    assert done.returncode == INPUT
    assert "/dev/stdin:1: the deck does not end with *END" in done.stderr


def test_values_of_parameters_are_used(tmp_path: Path) -> None:
    """A study by a name that stands nowhere would give the same result each time."""
    deck = tmp_path / "deck.k"
    for name, text in (
        ("speed", "*PARAMETER\nR speed, 1.0, R speed2, 1.0\n*TITLE\n&speed2\n"),
        ("base", "*PARAMETER_EXPRESSION\nR base, 1.0\nR other, 2*base2\n"),
    ):
        deck.write_text(DECK.read_text().replace("*NODE\n", f"{text}*NODE\n", 1))
        code, words = said("check", deck, "-p", f"{name}=2.0")
        assert code == INPUT, words
        assert f"'-p {name}' on the command line: the deck defines this parameter and" in words
    used = "*PARAMETER\nR base, 1.0\n*PARAMETER_EXPRESSION\nR other, 2*BASE\n"
    deck.write_text(DECK.read_text().replace("*NODE\n", f"{used}*NODE\n", 1))
    assert said("check", deck, "-p", "base=2.0")[0] == NORMAL


def test_a_run_goes_on_without_a_reader(tmp_path: Path) -> None:
    """As in `plydyn run DECK | head`: its results are in files."""
    reader, writer = os.pipe()
    os.close(reader)
    command = [SOLVER, "run", DECK, "-o", tmp_path]
    done = subprocess.run(command, stdout=writer, stderr=subprocess.PIPE, check=False)
    os.close(writer)
    assert done.returncode == NORMAL, done.stderr
    assert "normal end" in (tmp_path / "deck.out").read_text()
