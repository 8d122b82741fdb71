"""Contact that gives energy stops the run: a plate that slides over a sharp edge and back."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest

from broken import CYCLES, said
from decks import BOTTOM, TOP, Deck, Ply
from elasticity import Material
from fixture_decks import all_bodies, all_fixtures
from meshes import regular

METAL = Material(2.7e-9, (70.0e3,) * 3, (0.3,) * 3, (26923.0,) * 3)
#: Place of the energy of contact among all energies of a restart file
CONTACT = 7
LONG, WIDE, SWING, PERIOD = 20.0, 10.0, 0.5, 4.0e-4


def sliding(edge: float) -> Deck:
    """A strip pressed down, half of it on a punch; it slides along x by half a millimetre."""
    mesh = regular(LONG, WIDE, 8, 4, 9)
    deck = Deck("a strip that slides over an edge", 2.0 * PERIOD)
    deck.intervals(glstat=PERIOD)
    deck.control()
    deck.mesh(mesh)
    deck.laminate([Ply(METAL, 1.0, 0.0)], 1)
    times = np.linspace(0.0, 2.0 * PERIOD, 161)
    swing = 0.5 * SWING * (1.0 - np.cos(2.0 * np.pi * times / PERIOD))
    motion = deck.curve(zip(map(float, times), map(float, swing), strict=True))
    deck.move(range(len(mesh.points)), 1, motion, 1.0)
    deck.add("LOAD_FACE_PRESSURE", (0, TOP, 0, 2.0))
    # the edge lies just beyond a line of nodes, which slides off it
    size = (LONG / 2.0 + 0.3, 3.0 * WIDE)
    deck.add("FIXTURE_PUNCH", (1, BOTTOM, 0.0, edge), (1, LONG / 4.0, WIDE / 2.0, *size, 0.0))
    return deck


@pytest.mark.parametrize(("edge", "ends"), [(0.0, 3), (0.5, 0)])
def test_contact_that_gives_energy_stops_the_run(edge: float, ends: int, tmp_path: Path) -> None:
    """A point that was off a sharp edge is lifted in one step; a round edge lets it climb."""
    code, text = said("run", sliding(edge).write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == ends, text
    assert ("contact has given" in text) == (ends == 3)
    told = "warning: the energy of contact (fixture 1 with the plate has given the most) has fallen"
    assert text.count(told) == (ends == 3)
    assert (tmp_path / "job.out").read_text().count(told) == (ends == 3)
    if ends == 3:
        # in one step it may pass the bound of the warning and that of the stop
        assert text.index(told) < text.index("contact has given")
        assert "most of it that of fixture 1 with the plate" in text
        assert "an edge radius of fixture 1 helps" in text


def test_the_fixture_that_gives_energy_is_named(tmp_path: Path) -> None:
    """Another one on which the strip lies, with a round edge, is not."""
    deck = sliding(0.0)
    size = (LONG / 4.0, 3.0 * WIDE)
    punch = (1, LONG / 8.0, WIDE / 2.0, *size, 0.0)
    deck.add("FIXTURE_PUNCH", (9, BOTTOM, 0.0, 0.5), punch)
    code, text = said("run", deck.write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == 3, text
    assert "most of it that of fixture 1 with the plate" in text


@pytest.mark.parametrize("make", [all_fixtures, all_bodies])
def test_contact_of_all_bodies_is_the_column(make: Callable[[], Deck], tmp_path: Path) -> None:
    """Each impactor and each fixture has its own energy of contact in the restart file."""
    deck = make()
    deck.add("DATABASE_BINARY_D3DUMP", (CYCLES,))
    code, text = said("run", deck.write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == 0, text
    with h5py.File(sorted(tmp_path.glob("job.dump??"))[-1]) as file:
        state = file["state"]
        total = state["energies"][CONTACT]
        bodies = r"(impactor|fixture)_\d+"
        own = [value[7] for name, value in state.items() if re.fullmatch(bodies, name)]
        assert len(own) > 4
        assert min(map(abs, own)) < max(map(abs, own))
        assert sum(own) == pytest.approx(total, rel=1e-9)
        assert total > 0.0
