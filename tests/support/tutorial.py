"""The commands of manual/tutorial.md: extracted, run, and its pictures drawn.

    .venv/bin/python tests/support/tutorial.py [FOLDER]

runs them as they stand there, in some minutes, and puts the pictures into manual/pictures.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from runs import ROOT, SOLVER

PAGE = ROOT / "manual/tutorial.md"
#: Pictures of the page by the files of the folder that they are
PICTURES = {
    "first_report/force.png": "tutorial_force.png",
    "small_cscan.png": "tutorial_cscan.png",
}


@dataclass(frozen=True)
class Block:
    """A block of code: what it is, and its lines."""

    kind: str  # "sh" to be run, "toml" or "" with a name in its first line to be saved
    text: str

    @property
    def file(self) -> str:
        """Name of the file to be saved; empty for none."""
        found = re.match(r"[#$] (\w+\.(?:toml|k))\n", self.text)
        return found[1] if found else ""


def blocks(page: Path = PAGE) -> Iterator[Block]:
    """Blocks of code of a page in their order."""
    for kind, text in re.findall(r"^```(\w*)\n(.*?)^```$", page.read_text(), re.M | re.S):
        yield Block(kind, text)


def follow(
    folder: Path, environment: Mapping[str, str], replaced: Mapping[str, str] | None = None
) -> list[str]:
    """Save the files and run the commands of the page in a folder; gives the commands.

    In the files some words may be replaced by others.
    """
    done = []
    for block in blocks():
        if block.file:
            text = block.text
            for word, other in (replaced or {}).items():
                text = text.replace(word, other)
            (folder / block.file).write_text(text)
        if block.kind != "sh":
            continue
        ended = subprocess.run(
            ["bash", "-euo", "pipefail", "-c", block.text],
            cwd=folder,
            env=dict(environment),
            capture_output=True,
            text=True,
            check=False,
        )
        if ended.returncode != 0:
            said = (ended.stdout + ended.stderr)[-3000:]
            raise AssertionError(f"code {ended.returncode} from\n{block.text}\n{said}")
        done += block.text.splitlines()
    return done


def environment(*first: Path) -> dict[str, str]:
    """The environment with the programs of this checkout on PATH, some folders before them."""
    own = (*first, SOLVER.parent, ROOT / "decks/hpc", Path(sys.executable).parent)
    return {**os.environ, "PATH": os.pathsep.join([*map(str, own), os.environ["PATH"]])}


def main(folder: Path) -> None:
    """Run the page and copy its pictures."""
    folder.mkdir(parents=True, exist_ok=True)
    follow(folder, environment())
    for made, name in PICTURES.items():
        shutil.copy(folder / made, ROOT / "manual/pictures" / name)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "results/tutorial")
