"""The structure of the sources: layers, sizes, and how much a reader of the time loop must know."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

SOURCES = Path(__file__).parents[2] / "src"
FORTRAN = sorted([*SOURCES.rglob("*.f90"), *SOURCES.rglob("*.f90.in")])
MODULE = re.compile(r"^ *module (plydyn_\w+)", re.MULTILINE)
USE = re.compile(r"^ *use (?:, *intrinsic *:: *)?(\w+)", re.MULTILINE)

#: Modules that the time loop reaches, itself among them
LOOP_MODULES = 80


def modules() -> dict[str, tuple[Path, set[str]]]:
    """Each module with its file and the modules that it uses; templates stand for their kernels."""
    found = {}
    for path in FORTRAN:
        text = path.read_text()
        match = MODULE.search(text)
        if match:
            found[match[1]] = (path, set(USE.findall(text)))
    return found


def reached_from(start: str) -> set[str]:
    """All modules that `start` uses, directly or through others, with itself."""
    graph, reached, waiting = modules(), set(), [start]
    while waiting:
        module = waiting.pop()
        if module in reached or module not in graph:
            continue
        reached.add(module)
        waiting.extend(graph[module][1])
    return reached


def components(file: str, name: str) -> int:
    """Components of a derived type, each name of a declaration counted."""
    text = (SOURCES / file).read_text()
    body = re.search(rf"type,[^\n]*:: {name}\n(.*?)(?:\n *contains|\n *end type)", text, re.DOTALL)
    assert body, f"{name} is not in {file}"
    lines = [line.split("!")[0] for line in body[1].splitlines() if "::" in line.split("!")[0]]
    names = [
        re.sub(r"\([^()]*\)|=.*?(?=,\s*\w+\s*(?:\(|=|,|$)|$)", "", line.split("::")[1])
        for line in lines
    ]
    return sum(line.count(",") + 1 for line in names)


def test_the_time_loop_is_read_with_few_modules() -> None:
    reached = reached_from("plydyn_run_loop")
    assert len(reached) > 10
    assert len(reached) <= LOOP_MODULES, sorted(reached)


def test_the_method_writes_nothing() -> None:
    for module, (_, uses) in modules().items():
        if module.startswith("plydyn_method_"):
            assert not [used for used in uses if used.startswith(("plydyn_io_", "plydyn_run_"))]


@pytest.mark.parametrize(
    ("library", "folders"), [("mpi_f08", {"parallel", "io"}), ("hdf5", {"io"})]
)
def test_a_library_stays_in_its_folders(library: str, folders: set[str]) -> None:
    users = {
        path.relative_to(SOURCES).parts[0] for path, uses in modules().values() if library in uses
    }
    assert users <= folders
    assert users


@pytest.mark.parametrize(
    ("file", "name", "most"),
    [("domain/domain.f90", "domain_type", 20), ("state/state.f90", "state_type", 18)],
)
def test_the_large_types_stay_small(file: str, name: str, most: int) -> None:
    assert 5 < components(file, name) <= most


def test_the_path_of_a_file_is_the_name_of_its_module() -> None:
    for module, (path, _) in modules().items():
        if path.suffix == ".f90":
            parts = path.relative_to(SOURCES).with_suffix("").parts
            assert module == "plydyn_" + "_".join(parts)


def test_a_file_holds_one_idea() -> None:
    long = {str(path): n for path in FORTRAN if (n := len(path.read_text().splitlines())) > 400}
    assert not long
