"""The same deck gives the same bits."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest

from comparison import Comparison
from decks import Deck, Ply, Sphere
from elasticity import CARBON, GLASS
from meshes import distorted, regular
from runs import Results, run


def deck(springs: bool) -> Deck:
    """A short impact on two plies: joined by springs, linear; or tied, total Lagrangian."""
    mesh = distorted(regular(10.0, 10.0, 5, 5, 9), 0.1)
    made = Deck("same bits", 2.0e-5)
    made.control(linear=springs)
    made.mesh(mesh)
    made.laminate([Ply(CARBON, 0.5, 30.0), Ply(GLASS, 0.5, -30.0)], 2)
    if springs:
        made.interfaces(1.0e5, 1.0e5)
    made.hold(mesh.boundary(), "xyz")
    made.intervals(impactor=0.0, glstat=0.0, spcforc=0.0, binary_d3plot=5.0e-6)
    made.histories(range(len(mesh.points)), 1.0e-6)
    made.profile(1, 5.0, 5.0, 1.0e-6)
    made.add("DATABASE_FIELD", ("displacement", "velocity", "stress", "strain"))
    made.sphere(Sphere(5.0, 1.0e-6, (5.0, 5.0, 5.5), (0.0, 0.0, -3.0e3), method=1))
    return made


def arrays(results: Results) -> dict[str, np.ndarray]:
    """Every dataset of the field file."""
    found: dict[str, np.ndarray] = {}

    def keep(name: str, item: object) -> None:
        if isinstance(item, h5py.Dataset):
            found[name] = np.array(item)

    with h5py.File(results.folder / f"{results.job}.vtkhdf") as file:
        file.visititems(keep)
    return found


@pytest.mark.parametrize("springs", [True, False], ids=["springs", "tied"])
def test_run_twice_gives_the_same_bits(springs: bool, compare: Comparison, tmp_path: Path) -> None:
    """Every history and every field, byte by byte."""
    first, second = (run(deck(springs), tmp_path / name) for name in ("first", "second"))
    tables = sorted(path.name for path in first.folder.glob("*.csv"))
    assert len(tables) >= 5
    for name in tables:
        assert (first.folder / name).read_bytes() == (second.folder / name).read_bytes(), name
    one, other = arrays(first), arrays(second)
    assert one.keys() == other.keys()
    differing = [name for name, values in one.items() if values.tobytes() != other[name].tobytes()]
    compare.number("arrays that differ from those of the other run", len(differing), 0)
