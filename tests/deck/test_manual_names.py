"""Names in the manual: files, options, keywords and identifiers exist in the source tree."""

from __future__ import annotations

import re
from fnmatch import fnmatch
from functools import cache
from pathlib import Path

import pytest

from runs import ROOT

# keywords.md is generated from the declarations, which another test compares
PAGES = sorted(
    {ROOT / "README.md", *(ROOT / "manual").glob("*.md")} - {ROOT / "manual/keywords.md"}
)
FOLDERS = ("src", "tests", "decks", "manual/site", "preprocessor", "postprocessor")
SUFFIXES = {".f90", ".in", ".cmake", ".txt", ".py", ".sh", ".toml", ".k", ".slurm", ".yml", ".json"}
SKIPPED = {"build", ".venv", "__pycache__", "results"}
MANUAL = ("manual", "manual/site")
#: Folders in which a page may leave out the first part of a path
ROOTS = (
    "",
    "src",
    "src/element",
    "tests",
    "tests/unit",
    "tests/support",
    "manual",
    "manual/site",
    "decks",
)
FILE = re.compile(r"[\w.*…/-]+\.(?:f90\.in|f90|py|md|sh|toml|cmake|txt|slurm|def|eb)")
WORD = re.compile(r"[A-Za-z_]\w*")
#: Commands, options and variables of other programs, and placeholders
FOREIGN = {
    "BSUB",
    "CONTACT_AUTOMATIC",
    "HDF5_ROOT",
    "OMP_PLACES",
    "OMP_PROC_BIND",
    "SLURM_CPUS_PER_TASK",
    "SLURM_RESTART_COUNT",
    "USR2",
    "apptainer",
    "completion",
    "dependency",
    "first.toml",
    "forge",
    "kill_delay",
    "log.txt",
    "mine.toml",
    "n17",
    "night",
    "non_overridable",
    "objdump",
    "omp",
    "own.toml",
    "plydyn_macro.py",
    "qsub",
    "repo",
    "run_count",
    "sif",
    "singleton",
    "study.slurm",
    "small.toml",
    "tar",
    "user.toml",
    "user_plydyn.md",
    "vfmadd",
}


@cache
def source_files() -> tuple[Path, ...]:
    """All text files of the tree that may define a name."""
    found = [ROOT / "CMakeLists.txt", ROOT / "CMakePresets.json"]
    for folder in FOLDERS:
        for path in (ROOT / folder).rglob("*"):
            inside = path.relative_to(ROOT).parts
            is_source = path.suffix in SUFFIXES or (not path.suffix and path.is_file())
            if is_source and not SKIPPED & set(inside) and path != Path(__file__):
                found.append(path)
    return tuple(found)


@cache
def known_words() -> frozenset[str]:
    """Every word of the sources, without the lines of comment of Fortran; in lower case too."""
    words: set[str] = set()
    for path in source_files():
        lines = path.read_text(errors="replace").splitlines()
        if path.suffix in {".f90", ".in"}:
            lines = [line for line in lines if not line.lstrip().startswith("!")]
        words.update(WORD.findall("\n".join(lines)))
        words.update(WORD.findall(path.name))
    return frozenset(words | {word.lower() for word in words})


@cache
def file_names() -> frozenset[str]:
    """Names of all files of the tree, without folders."""
    paths = (path for folder in ("manual", *FOLDERS) for path in (ROOT / folder).rglob("*.*"))
    return frozenset(path.name for path in paths if not SKIPPED & set(path.relative_to(ROOT).parts))


def spans(page: str) -> list[str]:
    """Inline code of a page, without its blocks of code."""
    text = re.sub(r"^ *```.*?^ *```", "", page, flags=re.MULTILINE | re.DOTALL)
    return re.findall(r"`([^`\n]+)`", text)


def is_file(name: str) -> bool:
    """Whether a path, with ``*`` or ``…`` for any part of a name, is one of the tree."""
    pattern = re.sub("…|[.]{3}", "*", name)
    if "/" not in pattern:
        return any(fnmatch(known, pattern) for known in file_names())
    return any(any((ROOT / root).glob(pattern)) for root in ROOTS)


def missing(page: str) -> list[str]:
    """What the inline code of a page names and the tree does not have."""
    wrong = []
    for span in spans(page):
        files = FILE.findall(span)
        wrong += [name for name in files if name not in FOREIGN and not is_file(name)]
        words = WORD.findall(FILE.sub(" ", span))
        wrong += [f"{word} (in {span})" for word in words if not is_known(word)]
    return wrong


def is_known(word: str) -> bool:
    """Whether a word is in the sources, or is none that they could have."""
    name = word.strip("_")
    known = known_words()
    if len(name) < 3 or name in FOREIGN or {word, name, name.lower()} & known:
        return True
    return word != name and any(other.endswith(word) or other.startswith(word) for other in known)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_names_exist(page: Path) -> None:
    """Every file, option, keyword and identifier in backticks is in the source tree."""
    assert not missing(page.read_text())


def test_a_stale_name_is_found() -> None:
    """A file, an identifier or an option that does not exist is reported."""
    page = "See `src/run/loop.f90`, `src/solver/crew_of_threads.f90`, `contact_pear%near_by`."
    assert missing(page) == [
        "src/solver/crew_of_threads.f90",
        "contact_pear (in contact_pear%near_by)",
        "near_by (in contact_pear%near_by)",
    ]
