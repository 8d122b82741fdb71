"""Decks of LS-DYNA as decks of plydyn, with a page that tells what became of every field."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from plydyn_pre.errors import PreError
from plydyn_pre.translate.bodies import materials, read_bodies
from plydyn_pre.translate.conditions import read_contacts, read_control, read_supports
from plydyn_pre.translate.deck import Plate, deck_lines
from plydyn_pre.translate.impactor import read_impactor
from plydyn_pre.translate.joints import read_joints
from plydyn_pre.translate.page import page_text
from plydyn_pre.translate.reader import TranslateError, read_deck
from plydyn_pre.translate.stack import read_stack

__all__ = ["TranslateError", "translate"]


def translate(source: Path, deck: Path, like: str = "") -> tuple[Iterator[str], str, list[str]]:
    """The lines of a deck, the page in Markdown, and what to look at first.

    `like` names a ply of the library whose toughnesses stand in for those that a card has not.
    """
    blocks = read_deck(source)
    inputs = {block.file.resolve() for block in blocks} | {source.resolve()}
    for path in (deck, deck.with_suffix(".md")):
        if path.resolve() in inputs:
            raise PreError(f"{path} is a file of the deck that is read; give another name")
    bodies = read_bodies(blocks)
    known = materials(blocks)
    notes: list[str] = []
    stack = read_stack(bodies)
    sphere = read_impactor(bodies, blocks, known, stack, notes)
    joints = read_joints(bodies, blocks, known, stack, notes)
    plate = Plate(blocks, known, stack, joints, sphere, like, notes)
    read_control(plate)
    read_supports(plate)
    read_contacts(plate)
    lines = list(deck_lines(plate))
    notes += _first_things(plate)
    return iter(lines), page_text(source, deck, blocks, notes), notes


def _first_things(plate: Plate) -> Iterator[str]:
    """What stands in for constants of plies, and whether the laminate can delaminate."""
    for block in plate.blocks:
        for remark in block.remarks:
            yield f"*{block.written}, line {block.line}: {remark}"
    plies = sum(len(layer.body.plies) for layer in plate.stack.layers)
    if plies > 1 and not plate.joints:
        yield (
            "no delamination, as in the deck of LS-DYNA: all plies are tied; *INTERFACE_COHESIVE"
            " and *MAT_COHESIVE_MIXED_MODE let them fail"
        )
