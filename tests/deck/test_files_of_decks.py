"""Files that are no decks, and decks that include files without end, are refused by name."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from runs import SOLVER

INPUT = 2


def refused(deck: Path | str, seconds: float = 20.0) -> str:
    """What is said of a deck that must be refused, and soon."""
    done = subprocess.run(
        [SOLVER, "check", deck], capture_output=True, text=True, timeout=seconds, check=False
    )
    assert done.returncode == INPUT, done.stdout + done.stderr
    assert len(done.stderr) < 10000
    return done.stderr


@pytest.mark.parametrize("device", ["/dev/zero", "/dev/null", "/dev/full", "/"])
@pytest.mark.parametrize("included", [False, True], ids=["deck", "included"])
def test_device_is_no_deck(device: str, included: bool, tmp_path: Path) -> None:
    """Neither as the deck nor as a file that it includes."""
    deck = tmp_path / "deck.k"
    deck.write_text(f"*KEYWORD\n*INCLUDE\n{device}\n*END\n")
    said = refused(deck if included else device)
    assert f"the file '{device}' cannot be read: it is no regular file" in said
    assert ("deck.k:3: *INCLUDE" in said) == included


def test_deck_that_no_integer_counts(tmp_path: Path) -> None:
    """A deck of more than 2 GB; the file has holes, and needs no room on the disk."""
    deck = tmp_path / "deck.k"
    with deck.open("wb") as file:
        file.truncate(2_200_000_000)
    assert f"the file '{deck}' is larger than 2 GB" in refused(deck)


def test_deck_with_lines_of_old_machines(tmp_path: Path) -> None:
    """Carriage returns alone end no line; with line feeds behind them they do."""
    deck = tmp_path / "deck.k"
    deck.write_bytes(b"*KEYWORD\r*TITLE\ra plate\r*END\r")
    assert f"the file '{deck}' has no line feeds: its lines end with carriage" in refused(deck)
    deck.write_bytes(b"*KEYWORD\r\n*TITLE\r\na plate\r\n*END\r\n")
    assert "no line feeds" not in refused(deck)


@pytest.mark.parametrize("name", ["./self.k", "../{folder}/self.k", "other.k", "hard.k"])
def test_deck_that_includes_itself(name: str, tmp_path: Path) -> None:
    """By other words for its path, or by a link."""
    deck = tmp_path / "self.k"
    name = name.format(folder=tmp_path.name)
    deck.write_text(f"*KEYWORD\n*INCLUDE\n{name}\n*INCLUDE\n{name}\n*END\n")
    (tmp_path / "other.k").symlink_to("self.k")
    (tmp_path / "hard.k").hardlink_to(deck)
    said = refused(deck)
    assert "self.k:3: *INCLUDE: the file" in said
    assert said.count("includes itself") == 2


def test_files_that_are_nested_too_deeply(tmp_path: Path) -> None:
    """20,000 files in a chain: refused after a hundred."""
    for i in range(1, 120):
        (tmp_path / f"{i}.k").write_text(f"*INCLUDE\n{i + 1}.k\n")
    (tmp_path / "0.k").write_text("*KEYWORD\n*INCLUDE\n1.k\n*END\n")
    said = refused(tmp_path / "0.k")
    assert "100.k:2: *INCLUDE: the file" in said
    assert "is the last of more than 100 that include each other" in said


def test_files_that_double(tmp_path: Path) -> None:
    """Forty files that include the next one twice would be a million million."""
    for i in range(40):
        (tmp_path / f"{i}.k").write_text(f"*INCLUDE\n{i + 1}.k\n*INCLUDE\n{i + 1}.k\n")
    (tmp_path / "40.k").write_text("*NODE\n")
    said = refused(tmp_path / "0.k")
    assert "is one of more than 10000" in said


def test_pipe_is_a_deck(tmp_path: Path) -> None:
    """It is read to its end."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with subprocess.Popen(["bash", "-c", f"echo '*KEYWORD' > '{pipe}'"]) as writer:
        said = refused(pipe)
        assert writer.wait(10) == 0
    assert "does not end with *END" in said


def test_a_keyword_without_end_is_shown_shortened(tmp_path: Path) -> None:
    """The message repeats its first letters, however many there are."""
    deck = tmp_path / "long.k"
    deck.write_text(f"*KEYWORD\n*PART{'1' * 100_000}\n*END\n")
    text = refused(deck)
    assert f"{deck}:2: *PART{'1' * 76}...: '*PART{'1' * 76}...' is not a keyword" in text
    assert len(text) < 1000
