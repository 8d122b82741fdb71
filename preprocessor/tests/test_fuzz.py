"""Recipes with faults end in a deck, or in one sentence and exit code 2."""

from __future__ import annotations

from pathlib import Path

import deck_fuzzer
import pytest
from recipe_fuzzer import mutants, run

SEED, EACH = 20, 20


@pytest.mark.parametrize("part", range(5))
def test_no_recipe_ends_in_a_traceback_or_takes_the_machine(
    part: int, tmp_path: Path, decks: Path
) -> None:
    codes = []
    for mutant in mutants(SEED + part, EACH, decks):
        outcome = run(mutant, tmp_path)
        assert not outcome.faults, f"{mutant.options}\n{mutant.text}\n{outcome.output}"
        codes.append(outcome.code)
    # some of the faults leave a recipe that can be made, most do not
    assert {0, 2} == set(codes)


@pytest.mark.parametrize("part", range(5))
def test_no_deck_of_others_ends_in_a_traceback_or_is_lost_in_silence(
    part: int, tmp_path: Path
) -> None:
    assert deck_fuzzer.main(20, SEED + part, tmp_path) == 0
