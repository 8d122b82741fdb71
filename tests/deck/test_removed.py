"""Options that earlier decks had are refused by their names; manual/removed.md lists them all."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from runs import ROOT, SOLVER

PAGE = ROOT / "manual" / "removed.md"
#: A deck without titles of materials
DECK = re.sub(
    r"_TITLE\n.*\n", "\n", (ROOT / "tests" / "deck" / "fibre_damage" / "deck.k").read_text()
)


def rows() -> list[tuple[str, str, str]]:
    """Keyword, field or nothing, and what is right now, of the rows of the page for decks."""
    found = []
    for line in PAGE.read_text().splitlines():
        if line.startswith("| deck |"):
            _, _, option, _, now, _ = (cell.strip() for cell in line.split("|"))
            names = option.replace("`", "").split()
            found.append((names[0], names[1] if len(names) > 1 else "", now.replace("`", "")))
    return found


def with_field(text: str, keyword: str, field: str, value: str) -> str:
    """A deck with a value in a field of a keyword, by the columns of its page."""
    pages = subprocess.run(
        [SOLVER, "--keywords", keyword[1:]], check=True, capture_output=True, text=True
    ).stdout
    before = pages[: pages.index(f"| {field} |")]
    card = int(re.findall(r"^Card (\d+)", before, re.MULTILINE)[-1])
    first, last = map(int, re.search(rf"\| {field} \| (\d+)-(\d+)", pages).groups())
    lines = text.splitlines()
    start = lines.index(keyword)
    at = [i for i in range(start + 1, len(lines)) if not lines[i].startswith("$")]
    end = next(i for i in at if lines[i].startswith("*"))
    cards = [i for i in at if i < end]
    while len(cards) < card:
        lines.insert(end, "")
        cards.append(end)
        end += 1
    place = cards[card - 1]
    line = lines[place].ljust(last)
    lines[place] = f"{line[: first - 1]}{value:>{last - first + 1}}{line[last:]}"
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize(("keyword", "field", "now"), rows())
def test_a_removed_option_is_refused_with_advice(
    keyword: str, field: str, now: str, tmp_path: Path
) -> None:
    text = DECK
    if field:
        text = with_field(text, keyword, field, "1")
    else:
        text = text.replace("*END", f"{keyword}\n1\n*END")
    deck = tmp_path / "deck.k"
    deck.write_text(text)
    said = subprocess.run([SOLVER, "check", deck], capture_output=True, text=True, check=False)
    assert said.returncode == 2
    assert f"{keyword} card" in said.stderr if field else f"'{keyword}'" in said.stderr
    words = " ".join(said.stderr.split())
    assert now in words
    assert "removed" in words


def test_a_zero_asks_for_nothing(tmp_path: Path) -> None:
    deck = tmp_path / "deck.k"
    for keyword, field, _ in rows():
        if field:
            deck.write_text(with_field(DECK, keyword, field, "0"))
            checked = subprocess.run([SOLVER, "check", deck], capture_output=True, check=False)
            assert checked.returncode == 0, field
