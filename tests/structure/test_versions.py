"""One version and date in all places; recipes of packages ask for what the code needs."""

from __future__ import annotations

import ast
import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PROJECT = re.search(
    r"^project\(plydyn VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE
)
VERSION = PROJECT[1] if PROJECT else ""
HPC = ROOT / "decks" / "hpc"
#: Files, and what they say where the version is
PLACES = {
    "CITATION.cff": "\nversion: {}",
    "preprocessor/pyproject.toml": 'version = "{}"',
    "postprocessor/pyproject.toml": 'version = "{}"',
    "decks/hpc/plydyn.def": "Version {}",
    "decks/hpc/Containerfile": "image.version={}",
    "decks/hpc/conda/meta.yaml": 'version = "{}"',
    "decks/hpc/spack/packages/plydyn/package.py": 'version("{}")',
    "decks/hpc/spack/packages/py-plydyn-pre/package.py": 'version("{}")',
    "decks/hpc/spack/packages/py-plydyn-post/package.py": 'version("{}")',
    "manual/hpc.md": "/apps/plydyn/{}",
}


@pytest.mark.parametrize(("place", "words"), PLACES.items())
def test_version_is_that_of_the_project(place: str, words: str) -> None:
    """Wherever the words are, the version of CMakeLists.txt follows."""
    pattern = re.escape(words).replace(r"\{\}", r"(\d+\.\d+\.\d+)")
    found = set(re.findall(pattern, (ROOT / place).read_text()))
    assert found == {VERSION}


def test_easybuild_has_the_version_in_its_name() -> None:
    """EasyBuild finds its recipes by their names."""
    (recipe,) = HPC.glob("plydyn-*.eb")
    assert recipe.name == f"plydyn-{VERSION}-foss-2023b.eb"
    assert f"version = '{VERSION}'" in recipe.read_text()


def test_citation_and_changes_have_the_date() -> None:
    """The newest heading of the changes is the version with its day."""
    date = re.search(r"^date-released: (\d{4}-\d\d-\d\d)$", text("CITATION.cff"), re.MULTILINE)
    assert date
    newest = re.search(r"^## (.*)$", text("manual/changes.md"), re.MULTILINE)
    assert newest
    assert newest[1] == f"{VERSION} ({date[1]})"


def test_changes_are_short() -> None:
    """One line for each thing that is new; what led to a release has a page of its own."""
    newest = text("manual/changes.md").split("\n## ")[1]
    assert len(newest.split()) < 1000


def text(place: str) -> str:
    """A file of the repository."""
    return (ROOT / place).read_text()


def asked(folder: str) -> dict[str, str]:
    """What a Python package needs, with the lower bounds."""
    needs = tomllib.loads(text(f"{folder}/pyproject.toml"))["project"]["dependencies"]
    return dict(need.split(">=") for need in needs)


@pytest.mark.parametrize("folder", ["preprocessor", "postprocessor"])
def test_recipes_of_packages_ask_for_what_the_wheels_need(folder: str) -> None:
    """Spack's lower bounds are those of pyproject.toml; conda, with both, has the higher ones."""
    name = "py-plydyn-pre" if folder == "preprocessor" else "py-plydyn-post"
    tree = ast.parse((HPC / "spack/packages" / name / "package.py").read_text())
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
    specs = [
        call.args[0].value
        for call in calls
        if isinstance(call.func, ast.Name)
        and call.func.id == "depends_on"
        and isinstance(call.args[0], ast.Constant)
    ]
    spack = dict(re.findall(r"(?:py-)?(\w+)@([\d.]+):", " ".join(map(str, specs))))
    conda = dict(
        re.findall(r"- (?:python-)?(\w+)(?:-base)? >=([\d.]+)", text("decks/hpc/conda/meta.yaml"))
    )
    for need, least in asked(folder).items():
        assert spack[need] == least
        assert numbers(conda[need]) >= numbers(least)


def numbers(version: str) -> tuple[int, ...]:
    """A version as numbers."""
    return tuple(map(int, version.split(".")))


def test_wheels_name_the_authors_and_carry_the_licence() -> None:
    """Copyright has a holder, in every place that tells of it."""
    assert "Copyright 2026 The plydyn authors" in text("README.md")
    for folder in ("preprocessor", "postprocessor"):
        project = tomllib.loads(text(f"{folder}/pyproject.toml"))["project"]
        assert project["authors"] == [{"name": "The plydyn authors"}]
        assert project["license"] == "Apache-2.0"
        assert text(f"{folder}/LICENSE") == text("LICENSE")
