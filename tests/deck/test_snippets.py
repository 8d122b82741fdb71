"""Snippets of the pages: recipes are read, commands and names of Python exist.

The deck of `decks.md`, the commands of the tutorial, the notebook and the examples of keywords are
run as they stand there by tests of their own.
"""

from __future__ import annotations

import ast
import os
import re
import shlex
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
import typer

import plydyn_post
import plydyn_pre
from plydyn_post.cli import app as post_app
from plydyn_pre.cli import app as pre_app
from plydyn_pre.series.plan import read_series
from runs import ROOT, SOLVER
from tutorial import blocks

PAGES = sorted(
    {
        ROOT / "README.md",
        *(ROOT / "manual").glob("*.md"),
        *ROOT.glob("p*processor/README.md"),
        *ROOT.glob("decks/**/README.md"),
    }
    - {ROOT / "manual/keywords.md"}
)
#: Templates that the recipes of a page stand on, in their order, where it is not `astm-d7136`
BASES = {
    "chains.md": ["preload-impact", "astm-d7136", "astm-d7137", "indentation", "indentation"],
    "recipes.md": [
        "aitm-1-0010",
        "indentation",
        "astm-d7136",
        "impact",
        "astm-d7136",
        "astm-d7136",
    ],
}
#: Recipes that commands of a page have made before
MADE = {
    "first.toml": "impact",
    "coupon.toml": "astm-d7136",
    "indentation.toml": "indentation",
}
#: What a recipe of the page on materials reads
SHEAR = "shear strain [%],shear stress [MPa]\n0,0\n0.2,9.8\n0.5,23.5\n1.0,42.0\n5.0,86.5\n"
PROGRAMS = {
    "plydyn-pre": typer.main.get_command(pre_app),
    "plydyn-post": typer.main.get_command(post_app),
}
#: Ranks and threads that wait give way; the solver of the test
CALM = {**os.environ, "OMP_WAIT_POLICY": "passive", "PLYDYN": str(SOLVER)}
ACTIONS = {"run", "restart", "check"}
#: What may stand before a program
STARTERS = {"mpirun", "if", "time", "source"}


def name_of(page: Path) -> str:
    """A page in the words of a test."""
    return str(page.relative_to(ROOT))


def recipes() -> Iterator[tuple[Path, int, str]]:
    """Pages, numbers and texts of the recipes that they show."""
    for page in PAGES:
        texts = [block.text for block in blocks(page) if block.kind == "toml"]
        for number, text in enumerate(texts):
            yield page, number, text


RECIPES = list(recipes())


@pytest.mark.parametrize(
    ("page", "number"), [(p, n) for p, n, _ in RECIPES], ids=lambda of: getattr(of, "name", str(of))
)
def test_recipes_are_read(page: Path, number: int, tmp_path: Path) -> None:
    """On top of the recipe that the text is about, with those before it on the page."""
    texts = [text for other, _, text in RECIPES if other == page]
    for name, template in MADE.items():
        (tmp_path / name).write_text(plydyn_pre.example_recipe(template))
    (tmp_path / "shear.csv").write_text(SHEAR)
    for text in texts[: number + 1]:
        if saved := re.match(r"# ([\w-]+\.toml)\n", text):
            (tmp_path / saved[1]).write_text(text)
    text = texts[number]
    if re.search(r"^show = ", text, re.MULTILINE):
        path = tmp_path / "study.toml"
        path.write_text(text)
        assert read_series(path)
        return
    if not re.search(r"^base = ", text, re.MULTILINE):
        template = BASES.get(page.name, ["astm-d7136"] * len(texts))[number]
        (tmp_path / "below.toml").write_text(plydyn_pre.example_recipe(template))
        text = f'base = "below.toml"\n{text}'
    path = tmp_path / "snippet.toml"
    path.write_text(text)
    assert plydyn_pre.load_recipe(path).title


def commands(page: Path) -> Iterator[list[str]]:
    """Words of the commands of our programs that a page shows."""
    for block in blocks(page):
        if block.kind not in ("", "sh", "console") or block.file:
            continue
        for line in block.text.replace("\\\n", " ").splitlines():
            words = shlex.split(line.removeprefix("$ "), comments=True) if "plydyn" in line else []
            while words and (words[0] in STARTERS or words[0].startswith("-n") or "=" in words[0]):
                words = words[2:] if words[0] == "-n" else words[1:]
            if words and Path(words[0]).name in (*PROGRAMS, "plydyn") and words[1:]:
                yield [Path(words[0]).name, *words[1:]]


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_commands_exist(page: Path) -> None:
    """Each subcommand and each of its options."""
    for program, *words in commands(page):
        if program == "plydyn":
            # the listing begins with the version
            assert words[0] in ACTIONS or re.match(r"-|\w+=|\d", words[0]), words
            continue
        if words[0].startswith("--"):
            continue
        own = PROGRAMS[program].commands
        assert words[0] in own, (program, words[0])
        known = {option for each in own[words[0]].params for option in each.opts}
        asked = {re.sub(r"=.*", "", word) for word in words[1:] if re.match(r"--?[a-z]", word)}
        assert asked <= known | {"--help"}, (program, words)


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_names_of_python_exist(page: Path) -> None:
    """What a snippet takes from both packages, and of a job."""
    for block in blocks(page):
        if block.kind != "python":
            continue
        tree = ast.parse(block.text)
        packages = {"pre": plydyn_pre, "post": plydyn_post}
        for node in ast.walk(tree):
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
                package = packages.get(node.value.id)
                assert package is None or hasattr(package, node.attr), ast.unparse(node)


def test_commands_of_the_first_page_run(tmp_path: Path) -> None:
    """A deck of one's own, from the recipe to the report; the recipe only ends earlier."""
    (tmp_path / ".venv").symlink_to(ROOT / ".venv")
    (tmp_path / "build/release").mkdir(parents=True)
    (tmp_path / "build/release/plydyn").symlink_to(SOLVER.resolve())
    texts = [block.text for block in blocks(ROOT / "README.md") if "my_impact" in block.text]
    assert len(texts) == 2
    for line in "".join(texts).splitlines():
        subprocess.run(["bash", "-c", line], cwd=tmp_path, env=CALM, check=True)
        if " new " in line:
            recipe = tmp_path / "my_impact.toml"
            text = recipe.read_text()
            assert "end_time = 1.0e-3" in text
            recipe.write_text(text.replace("end_time = 1.0e-3", "end_time = 1.0e-5"))
    assert list((tmp_path / "results").rglob("report.html"))
    assert list((tmp_path / "made").rglob("report.html"))
