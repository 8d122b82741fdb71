"""The order of a deck is no physics: nodes and elements renumbered, shuffled and turned."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import broken
from broken import averaged, impact
from decks import Deck
from meshes import Mesh, regular
from runs import Results, run

END, STEP = 1.0e-5, 3.0e-8
HISTORIES = ("impactor_1", "energy")
# Sums in another order differ by round-off, which grows with the steps: a few hundred steps of
# sums of some ten terms leave 1e-12 of what is summed, damage that just begins or not a part of it
ROUND_OFF = 1.0e-8


def shuffled(mesh: Mesh, chance: np.random.Generator) -> Mesh:
    """The same mesh: nodes and quads in another order, each quad from another corner."""
    order = chance.permutation(len(mesh.points))
    new = np.argsort(order)
    quads = [_turned(new[quad], int(chance.integers(4))) for quad in mesh.quads]
    return Mesh(mesh.points[order], np.array(quads)[chance.permutation(len(quads))])


def _turned(quad: np.ndarray, turns: int) -> np.ndarray:
    """A quad that begins with another corner."""
    rings = [np.roll(quad[first : first + 4], turns) for first in range(0, len(quad) - 3, 4)]
    return np.concatenate([*rings, quad[8:]])


@pytest.mark.parametrize(
    "make",
    [
        lambda: impact(1, "cohesive", end=END),
        lambda: impact(2, "tied", end=END, failing=True),
        lambda: impact(1, "springs", end=END, order=2, implicit=1),
        averaged,
    ],
    ids=["cohesive", "damage", "implicit", "averages"],
)
def test_order_of_nodes_and_quads(
    make: Callable[[], Deck], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Forces, energies and what is dissipated are those of the deck in its own order."""
    own = run(in_equal_steps(make()), tmp_path / "own")
    for seed in (1, 2):
        chance = np.random.default_rng(seed)
        monkeypatch.setattr(broken, "regular", lambda *words: shuffled(regular(*words), chance))  # noqa: B023
        check_histories(own, run(in_equal_steps(make()), tmp_path / f"shuffled_{seed}"))


def in_equal_steps(deck: Deck) -> Deck:
    """The stable step is found by iteration from a start that has an order: bound it."""
    curve = deck.curve([(0.0, STEP), (1.0, STEP)])
    deck.add("CONTROL_TIMESTEP", (0.0, 0.9, 0, 0.0, 0.0, curve))
    return deck


def check_histories(one: Results, other: Results) -> None:
    """All columns agree to round-off of the largest number in them."""
    for name in HISTORIES:
        a, b = one.table(name), other.table(name)
        assert a.names == b.names
        assert a.values.shape == b.values.shape
        scale = np.abs(a.values).max(axis=0)
        if name == "energy":
            energies = slice(a.names.index("kinetic"), a.names.index("error"))
            scale[energies] = scale[energies].max()
            scale[[a.names.index("error"), a.names.index("stored error")]] = 1.0
            scale[-4:-1] = scale[-4:-1].max()
        else:
            # components that are zero by symmetry are round-off of the others
            for vector in ("force", "displacement", "velocity", "impulse"):
                parts = [i for i, word in enumerate(a.names) if word.startswith(vector)]
                scale[parts] = scale[parts].max()
            scale[a.names.index("penetration")] = scale[a.names.index("displacement")]
        difference = np.abs(a.values - b.values).max(axis=0)
        shares = dict(zip(a.names, difference / np.maximum(scale, 1e-300), strict=True))
        worst = {name: share for name, share in shares.items() if share > ROUND_OFF}
        assert not worst
