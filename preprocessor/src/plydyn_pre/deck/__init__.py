"""Decks: keyword files of fixed columns that need nothing else to run."""

from __future__ import annotations

from collections.abc import Iterator
from hashlib import sha256
from itertools import chain
from pathlib import Path

from plydyn_pre.deck import bricks, conditions, control, grid, materials, plates
from plydyn_pre.deck.cracked import check_cracked
from plydyn_pre.deck.delaminations import delamination_keywords
from plydyn_pre.deck.fixtures import fixture_keywords
from plydyn_pre.deck.names import Names
from plydyn_pre.deck.places import check_places
from plydyn_pre.deck.stages import end_keyword, stage_text
from plydyn_pre.errors import PreError
from plydyn_pre.files import is_other, write_lines
from plydyn_pre.mesh import Mesh
from plydyn_pre.study import Study, resolved
from plydyn_pre.version import VERSION

__all__ = ["deck_text", "stage_text", "write_deck", "write_stages"]


def deck_text(study: Study, mesh: Mesh) -> Iterator[str]:
    """The deck in pieces, each of some lines without the last line's end."""
    names = Names(resolved(study), mesh)
    check_places(names)
    check_cracked(names)
    yield f"*KEYWORD\n$ written by plydyn-pre {VERSION}"
    if names.study.bricks is not None:
        yield from bricks.brick_keywords(names)
        yield "*END"
        return
    # sets, curves and materials come after all that uses them, since only those in use are written
    yield from chain(
        control.control_keywords(names),
        control.output_keywords(names),
        end_keyword(names.study),
        plates.part_keywords(names),
        delamination_keywords(names),
        materials.material_keywords(names),
        conditions.impactor_keywords(names),
        conditions.support_keywords(names),
        fixture_keywords(names),
        conditions.load_keywords(names),
        conditions.curve_keywords(names),
        conditions.set_keywords(names),
        grid.node_keyword(names),
        grid.quad_keyword(names),
    )
    yield "*END"


def write_deck(pieces: Iterator[str], path: Path) -> None:
    """Write a deck; nothing is left of one that fails on the way, and no recipe is replaced."""
    if path.suffix == ".toml":
        raise PreError(f"{path} is the name of a recipe; a deck needs another, as {path.stem}.k")
    if is_other(path):
        raise PreError(f"{path} is not a file that a deck may replace")
    write_lines(pieces, path)


def write_stages(study: Study, mesh: Mesh, deck: Path) -> list[Path]:
    """Write the decks of the stages beside the first one, whose sum they know it by."""
    paths = [deck.with_name(f"{deck.stem}_{stage.name}.k") for stage in study.stages]
    if paths:
        deck_sum = sha256(deck.read_bytes()).hexdigest()
    for number, path in enumerate(paths, start=1):
        write_deck(stage_text(study, mesh, number, deck_sum), path)
    return paths
