"""Modules import one way: no two of a package need each other, and below no study."""

from __future__ import annotations

import ast
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

from runner.cases import ROOT

PACKAGES = ("preprocessor/src/plydyn_pre", "postprocessor/src/plydyn_post", "decks/runner")
PACKAGES += ("decks/readings", "decks/studies")


def _imports(folder: Path) -> dict[str, set[str]]:
    """What each module imports of its package, for types only or not."""
    modules = {_name(path, folder): path for path in folder.rglob("*.py")}
    found: dict[str, set[str]] = {name: set() for name in modules}
    for name, path in modules.items():
        for line in ast.walk(ast.parse(path.read_text())):
            if isinstance(line, ast.ImportFrom):
                for one in line.names:
                    whole = f"{line.module}.{one.name}"
                    found[name].add(whole if whole in modules else str(line.module))
    return {name: (needed & set(modules)) - {name} for name, needed in found.items()}


def _name(path: Path, folder: Path) -> str:
    parts = path.relative_to(folder.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


@pytest.mark.parametrize("package", PACKAGES)
def test_no_modules_import_each_other(package: str) -> None:
    imports = _imports(ROOT / package)
    assert any(imports.values())
    list(TopologicalSorter(imports).static_order())


def test_a_circle_of_imports_is_found(tmp_path: Path) -> None:
    (tmp_path / "one.py").write_text(f"from {tmp_path.name} import two\n")
    (tmp_path / "two.py").write_text(f"from {tmp_path.name}.one import three\n")
    with pytest.raises(CycleError):
        TopologicalSorter(_imports(tmp_path)).prepare()


def test_runner_and_readings_know_no_study() -> None:
    upwards = {"runner": ("readings", "studies"), "readings": ("studies",)}
    for folder, above in upwards.items():
        for path in (ROOT / "decks" / folder).glob("*.py"):
            lines = ast.walk(ast.parse(path.read_text()))
            named = {str(getattr(one, "module", "")).split(".")[0] for one in lines}
            assert not named & set(above)
