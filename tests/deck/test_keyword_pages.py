"""The keyword pages of the manual are those that the program prints."""

import subprocess

from runs import ROOT, SOLVER

PAGES = ROOT / "manual" / "keywords.md"


def test_manual_has_the_pages_of_the_program() -> None:
    printed = subprocess.run(
        [SOLVER, "--keywords"], check=True, capture_output=True, text=True
    ).stdout
    assert PAGES.read_text() == printed, "run: build/release/plydyn --keywords > manual/keywords.md"
