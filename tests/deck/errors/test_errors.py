"""Broken decks: each must be refused with the words of its `.expected` file."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path


def test_every_broken_deck_is_refused_with_the_right_words() -> None:
    """Run `run.sh`, which names the decks that are not."""
    script = Path(__file__).parent / "run.sh"
    done = subprocess.run(
        ["bash", str(script), os.environ["PLYDYN"]], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
