"""Mutants of decks of LS-DYNA: each is refused with a line, or every field is on the page."""

from __future__ import annotations

import random
import re
import sys
from collections.abc import Iterator
from pathlib import Path

from test_foreign_forms import LAYUPS, tiebreak, tied
from user_decks import cohesive, composite, thick

from plydyn_pre.errors import PreError
from plydyn_pre.translate import Choices, translate

_WORDS = ("", "0", "-1", "1e30", "1.5", "abc", "&x", "99999999", "-0.0", "1-", "<1/0>", "*", "7,7")
#: Share of changes that are not of nodes and elements
_BESIDE = 0.85
_KEYWORDS = (
    "*LOAD_BLAST\n1,2,3",
    "*ELEMENT_BEAM\n1,1,1,2,3",
    "*MAT_999\n1,2.0",
    "*CONTACT_TIED_NODES_TO_SURFACE\n1,2,4,3\n,\n,",
    "*RIGIDWALL_PLANAR\n0\n0,0,-5,0,0,-4,0.1",
    "*SET_NODE_GENERAL\n77\nBOX,3",
    "*DEFINE_CURVE\n5\n0,0\n1,1",
    "*BOUNDARY_PRESCRIBED_MOTION_SET\n7,3,2,5,-1.0",
    "*INITIAL_VELOCITY\n\n1,2,3",
    "*PARAMETER_EXPRESSION\nR y,1/0",
    "*SECTION_SHELL\n77,2,1,4,,,1\n1,1,1,1",
    "*INCLUDE\nnone.k",
)


def originals() -> list[str]:
    """The decks that are changed."""
    own = [composite("comma"), cohesive("comma"), thick("comma"), composite(), thick()]
    return [*own, *LAYUPS.values(), tiebreak("segments"), tied("nodes")]


def mutant(text: str, dice: random.Random) -> str:
    """A deck with a few changes."""
    lines = text.splitlines()
    for _ in range(dice.randint(1, 3)):
        at = dice.choice(_beside_the_mesh(lines) if dice.random() < _BESIDE else range(len(lines)))
        match dice.randrange(6):
            case 0:
                del lines[at]
            case 1:
                lines.insert(at, lines[dice.randrange(len(lines))])
            case 2:
                lines[at] = _changed(lines[at], dice)
            case 3:
                lines.insert(at, dice.choice(_KEYWORDS))
            case 4:
                lines[at] = lines[at][: dice.randrange(len(lines[at]) + 1)]
            case _:
                lines[at] = _changed(lines[at], dice)
    return "\n".join(lines) + "\n"


def _beside_the_mesh(lines: list[str]) -> list[int]:
    """Lines of other keywords than nodes and elements."""
    name, found = "", [0]
    for at, line in enumerate(lines):
        name = line if line.startswith("*") else name
        if not name.startswith(("*NODE", "*ELEMENT", "*SET_SEGMENT")):
            found.append(at)
    return found


def _changed(line: str, dice: random.Random) -> str:
    """A line with another field."""
    word = dice.choice(_WORDS)
    if line.startswith("*"):
        return line + dice.choice(("_MPP", "_TITLE", "X", "_SET", " LONG=Y"))
    if "," in line:
        words = line.split(",")
        words[dice.randrange(len(words))] = word
        return ",".join(words)
    at = 10 * dice.randrange(max(1, len(line) // 10))
    return f"{line[:at]}{word[:10]:>10}{line[at + 10 :]}"


def look_at(text: str, folder: Path, allow_lost: bool) -> str:
    """What is wrong with the translation of a deck; empty if nothing is."""
    (folder / "user.k").write_text(text, encoding="utf-8")
    try:
        choices = Choices("HTS40/977-2", "mm,s,t", allow_lost)
        lines, page, _ = translate(folder / "user.k", folder / "job.k", choices)
        deck = "\n".join(lines)
    except PreError as error:
        said = str(error)
        placed = re.search(r"user\.k:\d+: \*|none\.k: there is no such file", said)
        known = placed or "no plate" in said or "is missing" in said or "no keyword" in said
        return "" if known else f"refused without a line: {said[:300]}"
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    if "nan" in deck or "inf" in deck.replace("interface", "").replace("INTERFACE", ""):
        return "a number of the deck is not finite"
    return "; ".join(_unsaid(text, page))


def _unsaid(text: str, page: str) -> Iterator[str]:
    """Keywords that are not on the page."""
    told = page.count("### *")
    for name in re.findall(r"(?m)^\*([A-Za-z_0-9]+)", text.split("\n*END")[0])[1:]:
        silent = name.upper().startswith(("PARAMETER", "INCLUDE", "KEYWORD", "END"))
        if not silent and f"### *{name.upper()}," not in page:
            yield f"*{name} is not on the page ({told} are)"
    if rows := re.findall(r"(?m)^\| (?!field|---).*\|$", page):
        for row in rows:
            if not re.search(r"\| (taken|replaced|no effect here|lost)[^|]*\|$", row):
                yield f"no fate: {row}"


def main(count: int, seed: int, folder: Path) -> int:
    """Look at so many mutants; the number of those that are not as they should be."""
    wrong = 0
    decks = originals()
    for number in range(count):
        dice = random.Random(f"{seed}-{number}")
        text = mutant(dice.choice(decks), dice)
        said = look_at(text, folder, dice.random() < 0.3)
        if said:
            wrong += 1
            (folder / f"mutant_{number}.k").write_text(text, encoding="utf-8")
            sys.stdout.write(f"{number} {said}\n")
    return wrong


if __name__ == "__main__":
    import tempfile

    sys.exit(min(1, main(int(sys.argv[1]), int(sys.argv[2]), Path(tempfile.mkdtemp()))))
