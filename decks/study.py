"""Repeat the studies of the impacts, from a checkout after ``decks/quickstart.sh``.

    .venv/bin/python decks/study.py --help
    .venv/bin/python decks/study.py times --into decks/README.md

Each command is declared in a module of ``studies`` and run by ``runner``. Decks, results, tables
and figures go to ``results/study``; ``--into`` puts a table into a page, between its two marks.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module

from plydyn_post.errors import ResultsError
from plydyn_pre.errors import PreError
from runner.cases import StudyError
from runner.commands import app
from runner.jobs import console

#: Modules of studies that declare the commands, in the order of the help
DECLARED = (
    *("bricks", "timings", "stress", "elastic_meshes", "bimetal"),
    *("runs", "damage_figures", "schemes", "choices", "refinement", "edges"),
    *("validation", "blind", "cross_ply", "open_hole", "unnotched", "mechanisms", "rates"),
    *("crack_lines", "strength", "page", "quick", "glance"),
)
for _name in DECLARED:
    import_module(f"studies.{_name}")
FAILED = 3


def main(command: Callable[[], None] = app) -> None:
    """Run the command; an error is one of its words and no traceback."""
    try:
        command()
    except (StudyError, ResultsError, PreError, OSError) as error:
        console.print(f"study: {error}", markup=False, soft_wrap=True)
        raise SystemExit(FAILED) from error


if __name__ == "__main__":
    main()
