"""Run the commands of a page on a chain of stages, and put what they print and draw into it.

    .venv/bin/python decks/chain_page.py decks/compression/README.md [FOLDER]

The commands are the lines of the first block of the page that is marked `sh`. They run in FOLDER,
without it results/chain, where $DECKS is the folder of this file; stages that have run there are
not run again. What `plydyn-post
compression` prints goes between the marks of the page, its figures into manual/pictures.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from runner.pages import PICTURES, insert

ROOT = Path(__file__).resolve().parents[1]
#: Figures of the report, and their words
FIGURES = {
    "stress": "Stress over end shortening",
    "sublaminates": "The plies next to the peak, with gaps between them drawn wider",
    "gap": "Gap of the interface that had opened, next to the peak",
    "event": "What breaks",
}
#: First line of a report below its heading, and the endings of files that it names
FIRST, FILES = "strength, peak force", (".png", ".csv", ".html", ".gif")


def commands(page: Path) -> str:
    """The lines to type."""
    found = re.search(r"^```sh\n(.*?)^```$", page.read_text(), re.M | re.S)
    if found is None:
        raise SystemExit(f"{page} has no block of commands")
    return found[1]


def run(text: str, folder: Path) -> str:
    """Run commands with the programs of this checkout; what they print."""
    folder.mkdir(parents=True, exist_ok=True)
    for recipe in folder.glob("*.toml"):  # `plydyn-pre new` does not replace it
        recipe.unlink()
    programs = (ROOT / "build/release", Path(sys.executable).parent, ROOT / "decks/hpc")
    path = os.pathsep.join([*map(str, programs), os.environ["PATH"]])
    done = subprocess.run(
        ["bash", "-ec", text],
        cwd=folder,
        env=os.environ | {"PATH": path, "DECKS": str(ROOT / "decks"), "COLUMNS": "120"},
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    return done.stdout


def tables(printed: str) -> str:
    """Numbers and notes of all reports, without the files that they name."""
    lines = [line.rstrip() for line in printed.splitlines()]
    first = next(k for k, line in enumerate(lines) if line.startswith(FIRST)) - 1
    return "\n".join(line for line in lines[first:] if not line.endswith(FILES)).strip("\n")


def main() -> None:
    """Run, and write the page."""
    page = Path(sys.argv[1])
    folder = Path(sys.argv[2]) if len(sys.argv) > 2 else ROOT / "results/chain"
    text = f"```\n{tables(run(commands(page), folder))}\n```\n"
    for name, words in FIGURES.items():
        picture = PICTURES / f"{page.parent.name}_{name}.png"
        shutil.copy(folder / f"page/compression_{name}.png", picture)
        text += f"\n![{words}](../../manual/pictures/{picture.name})\n"
    insert(page, "printed", text)


if __name__ == "__main__":
    main()
