"""Sketches of the manual are those that `decks/sketches.py` draws."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from matplotlib import image

import sketches
from runner.pages import PICTURES

#: Share of dark or coloured points of a sketch at least
INK = 0.005


def test_each_sketch_of_the_manual_is_drawn(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The same names, of the same size, and none is empty; fonts may differ between machines."""
    monkeypatch.setattr(sketches, "PICTURES", tmp_path)
    drawn = {draw().name for draw in sketches.SKETCHES}
    assert drawn == {path.name for path in PICTURES.glob("sketch_*.png")}
    for name in drawn:
        new, old = (image.imread(folder / name)[..., :3] for folder in (tmp_path, PICTURES))
        assert new.shape == old.shape, name
        for picture in (new, old):
            assert np.mean(picture.min(axis=2) < 0.9) > INK, name
