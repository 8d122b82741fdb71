"""Programs that runs need: on PATH, beside this Python, or in the checkout of this package."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

from plydyn_pre.errors import PreError

#: Top of the checkout, where this package has not been installed from a wheel
_TOP = Path(__file__).resolve().parents[4]
#: Folders of a checkout, behind those of PATH
_OF_CHECKOUT = (_TOP / "build/release", _TOP / "decks/hpc", _TOP / ".venv/bin")


def find_program(name: str, first: Path | None = None) -> Path:
    """The program of a name; `first` is the solver to use, or a folder to look in before all."""
    folders = [first.parent if first.is_file() else first] if first else []
    folders += [Path(sys.executable).parent]
    folders += [Path(each) for each in os.environ.get("PATH", "").split(os.pathsep) if each]
    folders += _OF_CHECKOUT
    found = shutil.which(name, path=os.pathsep.join(map(str, folders)))
    if found is None:
        raise PreError(f"there is no program {name} on PATH; {_remedy(name)}")
    return Path(found)


def chain_of(solver: Path | None, threads: int) -> tuple[Path, dict[str, str]]:
    """The program that runs a deck and its stages by a solver, and the environment for it."""
    plydyn = find_program("plydyn", solver)
    environment = os.environ | {"OMP_NUM_THREADS": str(threads)}
    environment["PATH"] = f"{plydyn.parent}{os.pathsep}{environment['PATH']}"
    return find_program("plydyn-chain", plydyn), environment


def _remedy(name: str) -> str:
    """What brings a program."""
    if name == "plydyn-post":
        return "pip install plydyn-pre[report] brings it"
    return "install the solver, and put its folder bin on PATH"
