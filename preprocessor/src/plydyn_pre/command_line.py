"""Options and printing that commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

out = Console(highlight=False)
err = Console(stderr=True, highlight=False)

Recipe = Annotated[Path, typer.Argument(help="The recipe, a TOML file.", show_default=False)]
Overrides = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="KEY=VALUE", help="Replace a value, such as mesh.n=6."),
]


def tell(what: str, words: object) -> None:
    """Print a line of a listing."""
    out.print(f"{what:<16} {words}", markup=False, soft_wrap=True)


def note(words: str) -> None:
    """Tell what someone may have meant otherwise."""
    err.print(f"note: {words}", markup=False, soft_wrap=True)
