"""Make decks of recipes by plydyn-pre, in this process, which has its modules already."""

from __future__ import annotations

from pathlib import Path

from typer.testing import CliRunner

from plydyn_pre.cli import app


def make_deck(recipe: Path, deck: Path, *changes: str) -> Path:
    """The deck of a recipe, some of its values replaced."""
    replaced = [word for change in changes for word in ("--set", change)]
    done = CliRunner().invoke(app, ["deck", str(recipe), *replaced, "-o", str(deck)])
    if done.exit_code:
        raise AssertionError(f"{recipe}: {done.output}{done.exception or ''}")
    return deck
