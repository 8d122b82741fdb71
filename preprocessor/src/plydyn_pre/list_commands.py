"""The commands that list: layup, strengths, materials, models and keys."""

from __future__ import annotations

import json
import sys
from typing import Annotated

import typer
from rich.table import Table
from rich.text import Text

from plydyn_pre.command_line import Overrides, Recipe, note, out
from plydyn_pre.errors import RecipeError
from plydyn_pre.keys import find_tables, key_lines, schema, tables
from plydyn_pre.layup import Ply, is_balanced, is_symmetric, parse
from plydyn_pre.library import find_card, library
from plydyn_pre.library_text import as_deck, as_lsdyna, source_lines
from plydyn_pre.models import model_lines
from plydyn_pre.recipe import load_recipe
from plydyn_pre.study import strengths_of
from plydyn_pre.study_text import is_linear, strength_lines


def layup(
    notation: Annotated[str, typer.Argument(help="Such as '[0/90]2s'.", show_default=False)],
    thickness: Annotated[
        float | None, typer.Option(help="Thickness of a ply; adds a column of heights.")
    ] = None,
) -> None:
    """List the plies of a stacking sequence; the first one in the notation is at the bottom."""
    plies = parse(notation)
    out.print(_ply_table(plies, thickness))
    words = [f"{len(plies)} plies", "ply 1, the first of the notation, is the bottom one"]
    words.append("symmetric" if is_symmetric(plies) else "not symmetric")
    words.append("balanced" if is_balanced(plies) else "not balanced")
    out.print("; ".join(words), soft_wrap=True)


def strengths(recipe: Recipe, overrides: Overrides = None) -> None:
    """List the in-situ strengths of the plies of a recipe, beside those of a single ply."""
    study = load_recipe(recipe, overrides or [])
    rows = list(strengths_of(study))
    if not rows:
        raise RecipeError("laminate", "no ply is of kind ply_codam2 or ply_fracture_3d")
    for line in strength_lines(rows):
        out.print(line, markup=False, soft_wrap=True)
    for name in sorted({cluster.material for _, cluster, ply, _ in rows if is_linear(ply)}):
        words = "its shear is taken as linear, which overstates SL and YC; give its curve"
        note(f"{recipe}: materials.{name}: {words}")


def materials(
    name: Annotated[
        str | None, typer.Argument(help="Name of a material; without it, all.", show_default=False)
    ] = None,
    lsdyna: Annotated[
        bool, typer.Option("--lsdyna", help="Cards of LS-DYNA, with what they do not hold.")
    ] = False,
) -> None:
    """List the library with the source of each number, or one material as cards of a deck."""
    if name is not None:
        for line in as_lsdyna(find_card(name)) if lsdyna else as_deck(find_card(name)):
            out.print(line, markup=False, soft_wrap=True)
        return
    for card in library().values():
        out.print(f"{card.name} ({card.kind}): {card.note}", markup=False, soft_wrap=True)
        for key, value, source in source_lines(card):
            out.print(f"  {key:<20} {value:<18} {source}", markup=False, soft_wrap=True)


def models() -> None:
    """List the sets of modelling choices for plies with damage, for `model` of a recipe."""
    for line in model_lines():
        out.print(line, markup=False, soft_wrap=True)


def keys(
    table: Annotated[
        str | None,
        typer.Argument(help="Such as control or ply_codam2; without it, all.", show_default=False),
    ] = None,
    as_schema: Annotated[
        bool, typer.Option("--schema", help="A JSON Schema of recipes, for editors.")
    ] = False,
) -> None:
    """List the tables and keys of recipes with type, default and meaning."""
    if as_schema:
        sys.stdout.write(json.dumps(schema(), indent=1) + "\n")
        return
    found = find_tables(table) if table else tables()
    sys.stdout.write("\n".join(key_lines(found)))


def _ply_table(plies: tuple[Ply, ...], thickness: float | None) -> Table:
    """The plies as a table, the top one first, as they lie."""
    table = Table()
    for heading in ("ply", "angle", "material", *(("from z", "to z") if thickness else ())):
        table.add_column(heading, justify="right")
    for number, ply in reversed(list(enumerate(plies, start=1))):
        faces = (number - 1, number) if thickness else ()
        heights = [f"{face * (thickness or 0.0):.6g}" for face in faces]
        table.add_row(str(number), f"{ply.angle:g}", Text(ply.material or "-"), *heights)
    return table
