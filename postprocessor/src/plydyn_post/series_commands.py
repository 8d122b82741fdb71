"""The command of plydyn-post about the cases of a parameter study."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from plydyn_post.commands import app, console, tell, tells_errors


@app.command()
@tells_errors
def study(
    folder: Annotated[Path, typer.Argument(help="Folder that plydyn-pre study wrote.")],
    show: Annotated[
        str, typer.Option("--show", help="Number to draw, such as 'absorbed energy'.")
    ] = "peak force",
) -> None:
    """One table and one figure of the cases of a parameter study that have ended."""
    from plydyn_post.series import draw_series, read_series, write_series

    table = read_series(folder)
    path = folder / f"{show.replace(' ', '_').replace('/', '_')}.png"
    draw_series(table, show, path)
    tell(write_series(table, folder / "table.csv"))
    tell(path)
    for note in table.notes:
        console.print(f"note: {note}", markup=False)
