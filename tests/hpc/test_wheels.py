"""Wheels of both Python packages: what they hold, and what they need.

LOWEST=1 also installs them with the lowest versions that they allow, and draws a report with those.
"""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
import tomllib
import venv
import zipfile
from email.parser import Parser
from pathlib import Path

import pytest

from runs import ROOT, SOLVER

PACKAGES = {"plydyn_pre": ROOT / "preprocessor", "plydyn_post": ROOT / "postprocessor"}
#: Distributions whose modules have other names
MODULES = {"pillow": "PIL", "vtk": "vtkmodules"}
#: Modules that a function may ask for, and do without: of an extra, and of ParaView's own Python
OPTIONAL = {"pandas", "paraview"}


@pytest.fixture(scope="module")
def wheels(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The wheels, made as anyone would."""
    folder = tmp_path_factory.mktemp("wheels")
    for source in PACKAGES.values():
        words = ["--wheel", "--no-isolation", "--outdir", folder, source]
        done = subprocess.run(
            [sys.executable, "-m", "build", *words], capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stdout + done.stderr
    return {name: next(folder.glob(f"{name}-*.whl")) for name in PACKAGES}


def bounds_of(source: Path) -> dict[str, str]:
    """Lowest version of each distribution that a package needs."""
    project = tomllib.loads((source / "pyproject.toml").read_text())["project"]
    found = [re.fullmatch(r"([\w-]+)>=([\d.]+)", each) for each in project["dependencies"]]
    return {each[1]: each[2] for each in found if each} if all(found) else {}


def version(text: str) -> list[int]:
    """Numbers of a version, to compare."""
    return [int(number) for number in text.split(".")]


@pytest.mark.parametrize("name", PACKAGES)
def test_wheel_has_licence_types_and_data(name: str, wheels: dict[str, Path]) -> None:
    """The licence word for word, the mark of typed packages, and every file of the source."""
    with zipfile.ZipFile(wheels[name]) as wheel:
        held = set(wheel.namelist())
        licence = next(each for each in held if each.endswith("licenses/LICENSE"))
        assert wheel.read(licence) == (ROOT / "LICENSE").read_bytes()
        metadata = next(each for each in held if each.endswith("METADATA"))
        told = Parser().parsestr(wheel.read(metadata).decode())
    assert told["License-Expression"] == "Apache-2.0"
    assert told["Author"] == "The plydyn authors"
    assert f"{name}/py.typed" in held
    source = PACKAGES[name] / "src"
    listed = subprocess.run(
        ["git", "ls-files", "."], cwd=source, capture_output=True, text=True, check=True
    )
    assert held >= set(listed.stdout.split())


@pytest.mark.parametrize("name", PACKAGES)
def test_each_import_is_declared(name: str) -> None:
    """With a lowest version; what is declared is imported."""
    bounds = bounds_of(PACKAGES[name])
    declared = {MODULES.get(each, each) for each in bounds}
    needed, asked = set(), set()
    for path in (PACKAGES[name] / "src").rglob("*.py"):
        tree = ast.parse(path.read_text())
        inner = {
            node
            for outer in ast.walk(tree)
            if isinstance(outer, ast.FunctionDef) or is_for_types(outer)
            for node in ast.walk(outer)
        }
        for node in ast.walk(tree):
            (asked if node in inner else needed).update(modules_of(node))
    known = set(sys.stdlib_module_names) | set(PACKAGES)
    assert needed - known <= declared
    assert (needed | asked) - known - OPTIONAL - {"_typeshed"} == declared


def is_for_types(node: ast.AST) -> bool:
    """Whether a block is read by checkers of types alone."""
    return isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"


def modules_of(node: ast.AST) -> set[str]:
    """Modules at the top that a statement imports."""
    if isinstance(node, ast.Import):
        return {alias.name.split(".")[0] for alias in node.names}
    if isinstance(node, ast.ImportFrom) and node.level == 0:
        return {node.module.split(".")[0]}
    return set()


@pytest.mark.skipif("LOWEST" not in os.environ, reason="downloads a gigabyte; by hand")
def test_lowest_versions_work(wheels: dict[str, Path], tmp_path: Path) -> None:
    """From the wheels to a report in an environment that has nothing newer."""
    venv.create(tmp_path / "lowest", with_pip=True)
    python = tmp_path / "lowest/bin/python"
    bounds: dict[str, str] = {}
    for source in PACKAGES.values():
        for name, least in bounds_of(source).items():
            bounds[name] = max(least, bounds.get(name, "0"), key=version)
    lowest = [f"{name}=={least}" for name, least in bounds.items()]
    words = [python, "-m", "pip", "install", "-q", *wheels.values(), *lowest]
    subprocess.run(words, check=True)
    recipe = tmp_path / "impact.toml"
    command = [python, "-m", "plydyn_pre"]
    subprocess.run([*command, "new", recipe], check=True)
    path = {"PATH": f"{SOLVER.parent}:{ROOT / 'decks/hpc'}:{os.environ['PATH']}"}
    subprocess.run([*command, "run", recipe, tmp_path / "made"], env=os.environ | path, check=True)
    assert (tmp_path / "made/impact_report/report.html").is_file()
