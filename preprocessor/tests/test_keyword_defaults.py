"""Empty fields of a ply's keyword mean what a recipe means by the keys that it does not have."""

from __future__ import annotations

import re
import subprocess
from dataclasses import dataclass, replace
from pathlib import Path

import pytest
from conftest import CARBON, DAMAGED
from deck_cards import cards_of, split_columns, text_of

import plydyn_pre as pre
from plydyn_pre.deck.materials import material_text

#: The constants without which there is no such ply, and nothing else
CRACKED = pre.PlyFracture3d(
    **{key: value for key, value in vars(CARBON).items() if key != "title"},
    **{"XT": 2537.0, "XC": 1580.0, "YT": 82.0, "YC": 236.0, "SL": 90.0},
    **{"G1T": 91.6, "G1C": 79.9, "G2T": 0.22, "G2S": 0.79},
)
PLIES = {"MAT_PLY_CODAM2": DAMAGED, "MAT_PLY_FRACTURE_3D": CRACKED}


@dataclass(frozen=True)
class Field:
    """What the solver says of a field."""

    name: str
    default: str  # as printed: a number, `required`, or a number and that zero stands for it, too

    def read(self, written: str) -> float:
        """Number that the solver takes for what a deck has in the field."""
        value = float(written or 0.0)
        usual = not written or (value == 0.0 and self.default.endswith(", also for 0"))
        default = self.default.split(",")[0]
        # a field that was removed may be blank or 0
        return (0.0 if default == "blank" else float(default)) if usual else value


def page_of(keyword: str, solver: str) -> list[list[Field]]:
    """The fields of each card of a keyword, as the solver prints them."""
    printed = subprocess.run(
        [solver, "--keywords", keyword], check=True, capture_output=True, text=True
    ).stdout
    cards: list[list[Field]] = []
    for line in printed.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("Card "):
            cards.append([])
        elif line.startswith("| ") and cells[0] != "field":
            cards[-1].append(Field(cells[0], cells[3]))
    return cards


def card_lines(ply: pre.PlyCodam2 | pre.PlyFracture3d) -> list[str]:
    """Cards of a ply as recipes write them."""
    return next(iter(cards_of(material_text(ply, "ply", 1, lambda name: 0)).values()))[1:]


@pytest.mark.parametrize("keyword", list(PLIES))
def test_every_empty_field_is_the_default_of_recipes(keyword: str, solver: str) -> None:
    """Field by field: what is written for keys that a recipe does not have, and an empty field."""
    cards, lines = page_of(keyword, solver), card_lines(PLIES[keyword])
    # what no key has set behind the last field that is written is empty anyway
    assert len(lines) <= len(cards)
    chosen = []
    for fields, line in zip(cards[: len(lines)], lines, strict=True):
        written = split_columns(line, 10)
        assert len(written) <= len(fields) and all(written), line
        for field, value in zip(fields[: len(written)], written, strict=True):
            if field.default != "required":
                chosen.append(field.name)
                assert field.read(value) == field.read(""), field.name
    assert {"LSTAR", "DMAX", "SHEAR", "PLATEAU", "LRULE"} <= set(chosen)


def only_required(keyword: str, lines: list[str], solver: str) -> list[str]:
    """The cards of a ply without what may be empty."""
    kept = []
    for fields, line in zip(page_of(keyword, solver)[: len(lines)], lines, strict=True):
        columns = split_columns(line, 10)
        written = zip(fields[: len(columns)], columns, strict=True)
        needed = (value if field.default == "required" else "" for field, value in written)
        kept.append("".join(f"{value:>10}" for value in needed).rstrip())
    while not kept[-1]:
        kept.pop()
    return kept


@pytest.mark.parametrize("keyword", list(PLIES))
def test_the_listing_of_damage_is_that_of_the_recipe(
    keyword: str, study: pre.Study, solver: str, tmp_path: Path
) -> None:
    """A deck with empty fields, and what a recipe writes of the same constants."""
    ply = PLIES[keyword]
    plate = pre.Laminate("[0/90]s", 0.125, "ply")
    text = text_of(replace(study, materials={"ply": ply}, laminate=plate))
    full = card_lines(ply)
    short = only_required(keyword, full, solver)
    assert len(short) == 4 < len(full)
    listings = []
    for lines in (full, short):
        block = "\n".join([f"*{keyword}", *lines, ""])
        deck, count = re.subn(r"\*MAT_PLY_\w+\n([^*].*\n)+", block, text)
        assert count == 1
        (tmp_path / "job.k").write_text(deck)
        words = [solver, "check", "job.k"]
        told = subprocess.run(words, cwd=tmp_path, check=True, capture_output=True, text=True)
        _, _, after = told.stdout.partition("Damage of material")
        listings.append(after.partition("Size and mass")[0])
    assert "\nlargest damage " in listings[0]
    assert listings[1] == listings[0]
