"""The page about static runs: its deck comes to rest, and its frequency is that of the plate."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from runs import ROOT, run_deck

PLATE = (ROOT / "manual/decks.md").read_text().split("```\n")[1]
PAGE = (ROOT / "manual/static.md").read_text()
REPLACED = ("CONTROL_TERMINATION", "IMPACTOR_SPHERE", "CONTACT_IMPACTOR")
#: Free vibration after a blow at the middle
BLOW = """*CONTROL_TERMINATION
1.0e-3
*CONTROL_LAYERWISE
0
*INITIAL_VELOCITY_NODE
13, 0, 0, 1000.0
*DATABASE_HISTORY_NODE
13
*DATABASE_NODOUT
1.0e-6
"""


def deck_with(cards: str, path: Path) -> Path:
    """The plate without its ball, and some cards."""
    text = PLATE
    for name in REPLACED:
        text = re.sub(rf"^\*{name}\n(?:[^*].*\n)*", "", text, flags=re.MULTILINE)
    path.write_text(text.replace("*END\n", cards + "*END\n"))
    return path


def test_its_deck_comes_to_rest(tmp_path: Path) -> None:
    """What the page says of a plate at rest: energies, displacement and force of the supports."""
    path = deck_with(PAGE.split("```\n")[1], tmp_path / "static.k")
    results = run_deck(path, tmp_path, "static")
    energy, nodes = results.table("energy"), results.table("nodes")
    assert energy["kinetic"][-1] < 1.0e-3 * energy["internal"][-1]
    deflection = np.interp([3.8e-4, 4.2e-4], nodes["time"], nodes["n13 bottom uz"])
    assert deflection[0] == pytest.approx(deflection[1], rel=1.0e-3)
    assert results.table("supports")["fz"][-1] == pytest.approx(160.0, rel=1.0e-3)


def test_its_frequency_is_that_of_the_plate(tmp_path: Path) -> None:
    """The strongest frequency of a free vibration is the one printed."""
    results = run_deck(deck_with(BLOW, tmp_path / "free.k"), tmp_path, "free")
    nodes = results.table("nodes")
    time = np.linspace(0.0, 1.0e-3, 2001)
    motion = np.interp(time, nodes["time"], nodes["n13 bottom uz"])
    spectrum = np.abs(np.fft.rfft((motion - motion.mean()) * np.hanning(len(time)), 40000))
    found = 1.0e-3 * np.fft.rfftfreq(40000, time[1])[spectrum.argmax()]
    printed = float(re.search(r"first\s+frequency\s+is\s+([\d.]+) kHz", PAGE)[1])
    assert found == pytest.approx(printed, abs=0.1)


def test_its_loading_rate_is_that_of_waves() -> None:
    """Passages and stress of a wave in the coupon, and passages for 5 % of kinetic energy."""
    speed = np.sqrt(50.0e3 / 1.58e-9)
    transit, stress = 150.0 / speed, 1.58e-9 * speed * 62.5
    page = " ".join(PAGE.split())
    assert f"A wave takes {1.0e6 * transit:.0f} µs along the plate" in page
    assert stress == pytest.approx(float(re.search(r"it has ([\d.]+) MPa", page)[1]), rel=0.02)
    least, most = map(float, re.search(r"This is (\d+) to (\d+) passages", page).groups())
    found = [way / 62.5 / transit for way in (0.65, 1.1)]
    assert found == pytest.approx([least, most], rel=0.02)
    steady = 10.0 / np.sqrt(3.0 * 0.05)
    smooth = 30.0 * 0.1**2 * 0.9**2 / (0.1**3 * (10.0 - 1.5 + 0.06)) / np.sqrt(3.0 * 0.05)
    assert f"needs {steady:.0f} passages of a wave" in page
    assert f"over the whole time needs {smooth:.0f}" in page
