"""Metals of LS-DYNA as plies: as they stand, or refused by name."""

from __future__ import annotations

from pathlib import Path

import pytest
from foreign_decks import standard
from foreign_forms import refused, translated
from programs import solve

TEXT = standard()[0].text()
LAW = TEXT[TEXT.index("*MAT_ENHANCED") : TEXT.index("*NODE", TEXT.index("*MAT_ENHANCED"))]
PIECEWISE = "*MAT_024\n1,2.7e-9,70000.,0.33,{}\n{}\n{}\n"
JOHNSON = "*MAT_SIMPLIFIED_JOHNSON_COOK\n1,2.7e-9,70000.,0.33,{}\n{}\n"
CURVE = "*DEFINE_CURVE\n8,,2.0\n0,150.\n.1,200.\n.5,250."


def with_law(law: str) -> str:
    """The plain deck with a metal."""
    return TEXT.replace(LAW, law)


def rows(deck: str, name: str) -> list[list[float]]:
    """The numbers of a keyword."""
    lines = deck.split(f"*{name}\n")[1].split("*")[0].splitlines()
    return [[float(word) for word in line.split()] for line in lines if not line.startswith("$")]


@pytest.mark.parametrize(
    ("law", "cards"),
    [
        (PIECEWISE.format("300.,500.,1e21", "", ""), [[300.0, 500.0, 0.0, 0.0]]),
        (PIECEWISE.format("300.,500.", "40.,5.,,,1", ""), [[300.0, 500.0, 0.0, 0.0], [40.0, 5.0]]),
        (
            PIECEWISE.format("", "", "0,.1,.5\n300.,400.,500."),
            [[0.0] * 4, [0.0] * 6, [0.0, 0.1, 0.5, 0.0], [300.0, 400.0, 500.0, 0.0]],
        ),
        (PIECEWISE.format("", "0,0,8", CURVE), [[0.0] * 4, [0.0, 0.0, 8.0, 0.0]]),
        (JOHNSON.format("", "300.,1000.,.4"), [[0.0], [300.0, 1000.0, 0.4, 0.0]]),
        (JOHNSON.format("1", "300.,1000.,.4,.01,1e17"), [[1.0], [300.0, 1000.0, 0.4, 0.01, 0.0]]),
    ],
)
def test_metals_arrive_as_they_stand(
    law: str, cards: list[list[float]], solver: str, tmp_path: Path
) -> None:
    deck, _ = translated(tmp_path, with_law(law))
    name = "MAT_PIECEWISE_LINEAR_PLASTICITY" if "024" in law else "MAT_SIMPLIFIED_JOHNSON_COOK"
    found = rows(deck, name)
    assert found[0][:4] == [1.0, 2.7e-9, 70000.0, 0.33]
    own = [found[0][4:], *found[1:]]
    assert [row[: len(card)] for row, card in zip(own, cards, strict=True)] == cards
    if "LCSS" in deck and "DEFINE_CURVE" in law:
        assert rows(deck.replace("_TITLE\ncurve 8", ""), "DEFINE_CURVE")[-1] == [1.0, 250.0]
    (tmp_path / "job.k").write_text(deck)
    solve(solver, tmp_path, "check", "job.k")


@pytest.mark.parametrize(
    ("law", "words"),
    [
        (PIECEWISE.format("300.,,.3", "", ""), "FAIL: no metal is deleted"),
        (PIECEWISE.format("", "0,0,9", ""), "LCID: there is no *DEFINE_CURVE 9"),
        (PIECEWISE.format("", "0,0,9", "*DEFINE_TABLE\n9\n0\n"), "is of *DEFINE_TABLE (line"),
        (PIECEWISE.format("300.", "40.,5.", ""), "VP: 0 with an effect of the rate"),
        (JOHNSON.format("", "300.,0,0,.01"), "VP: 0 with an effect of the rate"),
        (JOHNSON.format("", "300.,9.,.1,0,0,400."), "SIGMAX: 400.0 is not translated"),
    ],
)
def test_what_the_solver_has_not_of_a_metal_is_refused(
    law: str, words: str, tmp_path: Path
) -> None:
    refused(tmp_path, with_law(law), words)
