"""The field that `manual/extending.md` adds is read, used, tested and written by recipes."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from changed_build import ChangedBuild
from runs import ROOT, SOLVER

PAGE = (ROOT / "manual/extending.md").read_text().partition("\n## A field\n")[2]
SECTION = PAGE.partition("\n## ")[0]
PACKAGE, KEYWORD = "preprocessor/src/plydyn_pre", "MAT_PLY_FRACTURE_3D"
#: In words of the page
NUMBER = "nine"
RECIPE = f"""base = "{ROOT}/decks/elastic_impact/le1.toml"
[laminate]
material = "ply"
[materials.ply]
kind = "ply_fracture_3d"
like = "IM7/8552 3D"
pressure_gain = 0.5
"""


def changes() -> Iterator[tuple[str, str]]:
    """Paths and new texts of the files that the page changes; each place is there once."""
    for block in re.findall(r"^```diff\n(.*?)^```$", SECTION, re.MULTILINE | re.DOTALL):
        for name, lines in re.findall(r"^--- (\S+)\n((?:(?!--- ).*\n)+)", block, re.MULTILINE):
            text = (ROOT / name).read_text()
            for part in lines.split("@@\n"):
                old, new = (
                    "".join(f"{line[1:]}\n" for line in part.splitlines() if line[0] in signs)
                    for signs in (" -", " +")
                )
                assert text.count(old) == 1, f"{name} has not just one\n{old}"
                text = text.replace(old, new)
            yield name, text


@pytest.fixture(scope="module")
def changed() -> dict[str, str]:
    """New texts of the files by their paths."""
    return dict(changes())


@pytest.fixture(scope="module")
def solver(changed: dict[str, str], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The solver with the field."""
    sources = {name: text for name, text in changed.items() if name.startswith("src/")}
    return ChangedBuild(SOLVER.parent, tmp_path_factory.mktemp("changed"), sources).link()


def test_page_tells_how_many_files_there_are(changed: dict[str, str]) -> None:
    """Those that it changes, the test, and the generated ones."""
    tests = re.findall(r"^```python\n# (\S+)$", SECTION, re.MULTILINE)
    generated = set(re.findall(r"\S+/\w+\.(?:md|json)", SECTION))
    assert len({*changed, *tests, *generated}) == 9
    assert f"It takes\n{NUMBER} files" in SECTION


def test_its_test_fails_without_the_field_and_passes_with_it(solver: Path, tmp_path: Path) -> None:
    """The test of the page, with the program as it is and with the changed one."""
    (source,) = re.findall(r"^```python\n(.*?)^```$", SECTION, re.MULTILINE | re.DOTALL)
    path = tmp_path / "test_pressure_gain.py"
    path.write_text(source)
    support = os.pathsep.join([str(ROOT / "tests/support"), os.environ.get("PYTHONPATH", "")])
    for program, verdict in ((SOLVER, "1 failed"), (solver, "1 passed")):
        words = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(path)]
        own = {**os.environ, "PLYDYN": str(program), "PYTHONPATH": support}
        ran = subprocess.run(words, env=own, cwd=tmp_path, capture_output=True, text=True)
        assert verdict in ran.stdout, ran.stdout + ran.stderr


def test_recipe_has_its_key(solver: Path, changed: dict[str, str], tmp_path: Path) -> None:
    """The card is written with the columns that the changed program tells."""
    shutil.copytree(ROOT / PACKAGE, tmp_path / PACKAGE)
    for name, text in changed.items():
        if name.startswith(PACKAGE):
            (tmp_path / name).write_text(text)
    printed = subprocess.run(
        [solver, "--keywords", "--json"], capture_output=True, text=True, check=True
    ).stdout
    assert "ETA" in json.dumps(json.loads(printed))
    (tmp_path / PACKAGE / "keywords.json").write_text(printed)
    recipe, deck = tmp_path / "job.toml", tmp_path / "job.k"
    recipe.write_text(RECIPE)
    own = {**os.environ, "PYTHONPATH": str(tmp_path / "preprocessor/src")}
    words = [
        sys.executable,
        "-c",
        "from plydyn_pre.cli import app; app()",
        "deck",
        recipe,
        "-o",
        deck,
    ]
    subprocess.run(words, env=own, cwd=tmp_path, check=True)
    cards = deck.read_text().partition(f"*{KEYWORD}")[2].splitlines()
    place = next(k for k, line in enumerate(cards) if "DEBRIS" in line.upper())
    assert (cards[place].split()[-1].upper(), float(cards[place + 1].split()[-1])) == ("ETA", 0.5)
    subprocess.run([solver, "check", deck], check=True, capture_output=True)
