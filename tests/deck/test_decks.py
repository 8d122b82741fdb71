"""Decks as a user writes them: each folder has a deck and what it must give.

`expected.py` computes what must hold from the constants of the deck, in `check(results)`.
"""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

import pytest

from runs import run_deck

CASES = sorted(path.parent for path in Path(__file__).parent.glob("*/expected.py"))


def expectation(folder: Path) -> ModuleType:
    """The module `expected.py` of a case."""
    spec = importlib.util.spec_from_file_location(f"expected_{folder.name}", folder / "expected.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_deck_gives_what_is_expected(case: Path, tmp_path: Path) -> None:
    """Run the deck of the case and check its results."""
    expectation(case).check(run_deck(case / "deck.k", tmp_path, "job"))
