"""Numbers of the listing as a reader wants them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from broken import KINDS, said
from decks import Deck, Ply
from elasticity import CARBON
from meshes import regular


def listing(angles: tuple[float, ...], folder: Path, held: int = 0) -> str:
    """The listing of a laminate of sixteenths of a millimetre that binary numbers do not have."""
    deck = Deck("listed", 1.0e-6)
    deck.control(linear=True)
    deck.mesh(regular(10.0, 10.0, 2, 2, 9))
    deck.laminate([Ply(CARBON, 0.14, angle) for angle in angles], order=1)
    if held:
        deck.hold_face(range(held), -1, "z")
    code, text = said("check", deck.write(folder / "job.k"))
    assert code == 0, text
    return text


def matrices(text: str) -> list[list[float]]:
    """The rows of A, B and D."""
    rows = text.split("(xx, yy, xy)\n")[1].splitlines()[:3]
    return [[float(word) for word in row.split()] for row in rows]


def test_heights_and_coupling_of_a_symmetric_laminate_are_zero(tmp_path: Path) -> None:
    """The middle is at 0, B is 0, and A of a balanced laminate has no term of shear."""
    text = listing((45.0, -45.0, 0.0, 90.0, 90.0, 0.0, -45.0, 45.0) * 2, tmp_path)
    heights = re.findall(r"^ +\d+ +[\d.-]+ +(\S+) +(\S+) +1 ", text, re.M)
    assert len(heights) == 16
    middle = heights[7][1], heights[8][0]
    assert [float(height) for height in middle] == [0.0, 0.0]
    assert "E-1" not in "".join(word for pair in heights for word in pair)
    rows = matrices(text)
    assert all(number == 0.0 for row in rows for number in row[3:6])
    assert rows[0][2] == rows[1][2] == rows[2][0] == rows[2][1] == 0.0
    assert rows[0][0] > 0.0
    assert rows[0][8] != 0.0


def test_coupling_of_another_laminate_is_shown(tmp_path: Path) -> None:
    """B of [0/90] couples stretching along x with bending along x."""
    rows = matrices(listing((0.0, 90.0), tmp_path))
    assert rows[0][3] < 0.0 < rows[1][4]
    assert rows[0][5] == 0.0


@pytest.mark.parametrize(
    ("angles", "is_noted"),
    [
        ((45.0, 0.0, -45.0, 90.0), True),
        ((45.0, 0.0, -45.0, 90.0, 90.0, -45.0, 0.0, 45.0), False),
        ((0.0, 90.0, 0.0), False),
        # the same directions
        ((90.0, 0.0, -90.0), False),
        ((30.0,), False),
    ],
)
def test_a_laminate_without_symmetry_is_noted(
    angles: tuple[float, ...], is_noted: bool, tmp_path: Path
) -> None:
    """With the line of its part, as an s may be missing behind its notation."""
    text = listing(angles, tmp_path)
    words = r"^note: \S*job.k:\d+: the laminate of part 1 is not symmetric about its middle, so"
    assert bool(re.search(words, text, re.MULTILINE)) == is_noted
    # 25 nodes: a plate that is held along z everywhere, and one that is not in a corner
    assert not re.search(words, listing(angles, tmp_path, held=25), re.MULTILINE)
    assert bool(re.search(words, listing(angles, tmp_path, held=24), re.MULTILINE)) == is_noted


@pytest.mark.parametrize("kind", ["failing interfaces", "crack lines", "bricks of one point"])
def test_no_line_of_a_run_ends_in_blanks(kind: str, tmp_path: Path) -> None:
    """From its head to the energies at its end."""
    code, text = said("run", KINDS[kind]().write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == 0, text
    lines = (tmp_path / "job.out").read_text().splitlines()
    assert "normal end" in lines
    assert [line for line in lines if line.endswith(" ")] == []
