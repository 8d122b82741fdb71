"""The page manual/gallery.md: every template and case with one sentence, command, size and time.

    .venv/bin/python manual/site/gallery.py           # list them, with the numbers it has
    .venv/bin/python manual/site/gallery.py --times   # ask `plydyn check` for all numbers

The site adds a picture of each mesh, which is drawn when the site is built.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

from plydyn_pre import Study, deck_text, load_recipe, make_mesh, write_deck
from plydyn_pre.recipe import example_recipe, templates

TOP = Path(__file__).resolve().parents[2]
PAGE = TOP / "manual/gallery.md"
LISTED = "<!-- list -->"
#: Folders of the cases, those of measured tests first
CASES = (
    "validation",
    "small_coupon",
    "damage_impact",
    "elastic_impact",
    "elastic_impact_ladder",
    "bimetal_impact",
)
_TEMPLATES = TOP / "preprocessor/src/plydyn_pre/templates"
#: A stop that ends a sentence, not an abbreviation
_STOP = re.compile(r"(?<=[a-z]{3}|\d\d\)|DOF| mJ)\.(?=\s+[A-Z`]|$)")
_HEADS = ("| recipe | test and command | DOF | time |", "| --- | --- | ---: | ---: |")
_STEPS = (1, 2, 3, 5, 7, 10, 15, 20, 30, 45, 60)


@dataclass(frozen=True)
class Entry:
    """A recipe of the gallery."""

    group: str  # templates, or a folder of decks
    name: str
    sentence: str
    command: str

    def study(self) -> Study:
        """What the recipe describes."""
        if self.group != "templates":
            return load_recipe(TOP / "decks" / self.group / f"{self.name}.toml")
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / f"{self.name}.toml"
            path.write_text(example_recipe(self.name), encoding="utf-8")
            return load_recipe(path)


def entries() -> list[Entry]:
    """All templates, then all recipes of the cases."""
    found = [
        Entry(
            "templates",
            name,
            _sentence(_TEMPLATES / f"{name}.toml"),
            f"`plydyn-pre new mine.toml --template {name}`, `plydyn-pre run mine.toml made`",
        )
        for name in templates()
    ]
    for case in CASES:
        for path in sorted((TOP / "decks" / case).glob("*.toml")):
            command = f"`plydyn-pre run {path.relative_to(TOP)} made`"
            found.append(Entry(case, path.stem, _sentence(path), command))
    return found


def _sentence(recipe: Path) -> str:
    """The first sentence of the comment with which a recipe begins."""
    words = []
    for line in recipe.read_text(encoding="utf-8").splitlines():
        if line.startswith("# after "):
            continue
        if not line.startswith("# "):
            break
        words.append(line.removeprefix("# ").strip())
    return _STOP.split(" ".join(words))[0].rstrip(".").replace("|", "/")


def kept(page: str) -> dict[str, tuple[str, str]]:
    """Size and time of the recipes that a page has, by group and name."""
    found, group = {}, ""
    for line in page.partition(LISTED)[2].splitlines():
        if line.startswith("## "):
            group = line.split("`")[1] if "`" in line else "templates"
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) == 4 and cells[0].startswith("`"):
            found[f"{group}/{cells[0].strip('`')}"] = (cells[2], cells[3])
    return found


def listed(numbers: dict[str, tuple[str, str]]) -> str:
    """All groups with their tables."""
    lines = [LISTED]
    for group, members in groupby(entries(), key=lambda entry: entry.group):
        lines += ["", *_heading(group), "", *_HEADS]
        for entry in members:
            size, time = numbers.get(f"{group}/{entry.name}", ("", ""))
            words = f"{entry.sentence}<br>{entry.command}"
            cells = (f"`{entry.name}`", words, size, time)
            lines.append(f"| {' | '.join(cells)} |")
    return "\n".join([*lines, ""])


def _heading(group: str) -> Iterator[str]:
    """Heading of a group, with a result of its page where that shows one."""
    if group == "templates":
        yield "## Templates"
        return
    readme = TOP / "decks" / group / "README.md"
    yield f"## Cases in `{group}`"
    yield ""
    yield f"[About these cases](../decks/{group}/README.md)"
    text = readme.read_text(encoding="utf-8")
    picture = re.search(r"!\[([^\]]*)\]\(\.\./\.\./manual/(pictures/[^)]+)\)", text)
    if picture:
        yield ""
        yield f"![{picture[1]}]({picture[2]})"


def measure(entry: Entry, solver: Path) -> tuple[str, str]:
    """Degrees of freedom and time of a recipe, as the solver predicts them on one thread."""
    study = entry.study()
    with tempfile.TemporaryDirectory() as folder:
        deck = Path(folder) / "one.k"
        write_deck(deck_text(study, make_mesh(study.mesh)), deck)
        words = [solver, "check", deck]
        environment = os.environ | {"OMP_NUM_THREADS": "1"}
        done = subprocess.run(words, check=False, env=environment, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{entry.group}/{entry.name}: {done.stderr.strip() or done.stdout}")
    size = re.search(r"^degrees of freedom +(\d+)$", done.stdout, re.MULTILINE)
    time = re.search(r"^time to come, predicted.*\(([\d.]+) s\)$", done.stdout, re.MULTILINE)
    if size is None or time is None:
        raise SystemExit(f"{entry.group}/{entry.name}: the listing has no size or no time")
    ends = (study.control.end_time, *(stage.end_time for stage in study.stages))
    seconds = float(time[1]) * sum(ends) / ends[0]
    words_of_time = in_words(seconds)
    return f"{int(size[1]):,}", f"up to {words_of_time}" if study.stages else words_of_time


def in_words(seconds: float) -> str:
    """A time, rounded as coarsely as a prediction for another machine is worth."""
    for unit, name in ((1.0, "s"), (60.0, "min"), (3600.0, "h")):
        if seconds < 52.0 * unit or name == "h":
            nearest = min(_STEPS, key=lambda step: abs(step - seconds / unit))
            return f"{nearest} {name}"
    raise AssertionError


def main() -> int:
    """Write the page."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--times", action="store_true", help="ask the solver for all numbers")
    parser.add_argument("--plydyn", type=Path, default=TOP / "build/release/plydyn")
    options = parser.parse_args()
    page = PAGE.read_text(encoding="utf-8")
    numbers = kept(page)
    for entry in entries():
        key = f"{entry.group}/{entry.name}"
        if options.times or not all(numbers.get(key, ("",))):
            numbers[key] = measure(entry, options.plydyn)
            sys.stdout.write(f"{key} {' '.join(numbers[key])}\n")
            sys.stdout.flush()
    PAGE.write_text(page.partition(LISTED)[0] + listed(numbers), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
