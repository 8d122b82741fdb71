"""The commands `plydyn-pre translate` and `foreign`, which alone load what reads foreign decks."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from plydyn_pre.command_line import note, out, tell
from plydyn_pre.deck import write_deck
from plydyn_pre.errors import PreError
from plydyn_pre.files import write_lines
from plydyn_pre.recipe_text import recipe_lines


def translate(
    deck: Annotated[
        Path, typer.Argument(help="A deck of LS-DYNA, Abaqus or Nastran.", show_default=False)
    ],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="The deck. Default: DECK_plydyn.k.")
    ] = None,
    like: Annotated[
        str, typer.Option(help="A ply of the library, for fracture energies that a card lacks.")
    ] = "",
    units: Annotated[
        str, typer.Option(help="Units of the deck where it names none, as in mm,s,t.")
    ] = "",
    allow_lost: Annotated[
        bool, typer.Option("--allow-lost", help="Note what changes the result and is lost.")
    ] = False,
    recipe: Annotated[
        Path | None,
        typer.Option(help="A recipe, FILE.toml, of the same model if it is a standard coupon."),
    ] = None,
) -> None:
    """Translate a deck of LS-DYNA, Abaqus or Nastran, and report what became of every field."""
    from plydyn_pre.translate import Choices, translation

    path = output or Path(f"{deck.stem}_plydyn.k")
    if recipe is not None and (recipe.suffix != ".toml" or recipe.exists()):
        raise PreError(f"{recipe} is no name of a new recipe; a file that ends in .toml is")
    made = translation(deck, path, Choices(like, units, allow_lost))
    write_deck(iter(made.lines), path)
    write_deck(iter(made.page.splitlines()), path.with_suffix(".md"))
    for words in made.notes:
        note(words)
    tell("deck", path)
    tell("page", path.with_suffix(".md"))
    if recipe is not None:
        if made.study is None:
            raise PreError(f"{deck} has no recipe: {'; '.join(made.causes)}")
        write_lines(recipe_lines(made.study), recipe)
        tell("recipe", recipe)


def foreign() -> None:
    """List what a translation makes of each keyword of LS-DYNA, Abaqus and Nastran."""
    from plydyn_pre.translate.table_text import table_lines

    for line in table_lines():
        out.print(line, markup=False, soft_wrap=True)
