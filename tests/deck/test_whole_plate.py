"""Models of a half or a quarter tell numbers of the whole plate; their files say what they hold."""

from __future__ import annotations

import re
from pathlib import Path

import h5py
import numpy as np
import pytest

from broken import said
from decks import Deck, Ply, Sphere
from elasticity import CARBON
from meshes import regular
from plydyn_post.curves import read_numbers
from plydyn_post.results import open_results
from runs import Results, run, run_stage

SIDE, THICKNESS, RADIUS, MASS = 20.0, 1.0, 5.0, 1.0e-5
SHARE = "share of the whole plate"


def impact(planes: str, *, edge: str = "plane", shift: float = 0.0, corner: float = 0.0) -> Deck:
    """A clamped plate hit in its middle, cut at planes across some of "xy".

    The cut is a plane of symmetry, a free edge or a clamped one; the impactor may be beside it.
    """
    sizes = [0.5 * SIDE if axis in planes else SIDE for axis in "xy"]
    quads = [3 if axis in planes else 6 for axis in "xy"]
    mesh = regular(*sizes, *quads, 4)
    deck = Deck("part", 4.0e-5)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, 0.5 * THICKNESS, angle) for angle in (0.0, 90.0)], 1)
    cut = {axis: set(mesh.where(**{axis: 0.0})) for axis in planes}
    held = {*mesh.where(x=sizes[0]), *mesh.where(y=sizes[1])}
    held |= {node for axis in "xy" if axis not in planes for node in mesh.where(**{axis: 0.0})}
    deck.hold(sorted(held), "xyz")
    for axis, nodes in cut.items():
        if edge != "free":
            deck.hold(sorted(nodes - held), axis if edge == "plane" else "xyz")
    middle = [shift if axis in planes else 0.5 * SIDE for axis in "xy"]
    centre = (*(place + corner for place in middle), RADIUS + 0.5 * THICKNESS)
    mass = MASS * 0.5 ** len(planes)
    deck.sphere(Sphere(RADIUS, mass, centre, (0.0, 0.0, -5.0e3), guided=True))
    deck.intervals(impactor=0.0, glstat=0.0, spcforc=0.0, binary_d3plot=1.0e-5)
    deck.add("DATABASE_BINARY_D3DUMP", (1000,))
    return deck


def symmetry(results: Results) -> str:
    """What the fields say of planes of symmetry."""
    with h5py.File(results.folder / f"{results.job}.vtkhdf") as file:
        return bytes(file["plydyn"].attrs["symmetry"]).decode()


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Results:
    """The whole plate."""
    return run(impact(""), tmp_path_factory.mktemp("whole"))


def test_a_whole_plate_is_not_marked(whole: Results) -> None:
    assert symmetry(whole) == ""
    assert "whole plate" not in whole.listing()
    assert not whole.table("impactor_1").has(SHARE)


@pytest.mark.parametrize(
    ("planes", "words"), [("x", "2 x the half"), ("y", "2 x the half"), ("xy", "4 x the quarter")]
)
def test_a_part_tells_the_numbers_of_the_whole(
    planes: str, words: str, whole: Results, tmp_path: Path
) -> None:
    part = run(impact(planes), tmp_path)
    assert symmetry(part) == " ".join(f"{axis}=0" for axis in planes)
    listing, of_whole = part.listing(), whole.listing()
    assert listing.count(f"whole plate, {words}") == 2
    for pattern in (
        r"mass of the plate +(\S+)",
        r"impactor 1 +([\d.E+-]+) t",
        r"energy +(\S+) mJ",
        r"impactors +(\S+) mJ",
        r"internal +(\S+) mJ",
        r"at start +(\S+) mJ",
    ):
        here, there = (float(re.search(pattern, each)[1]) for each in (listing, of_whole))
        assert here == pytest.approx(there, rel=1e-6), pattern
    # files hold the model, and say so in their last column
    share = 0.5 ** len(planes)
    for name in ("impactor_1", "energy", "supports", "contact"):
        assert np.all(part.table(name)[SHARE] == share), name
    force = part.table("impactor_1")["force"]
    assert force == pytest.approx(share * whole.table("impactor_1")["force"], abs=1e-5)
    # what people read
    numbers, all_of_it = (
        read_numbers(open_results(each.folder / each.job)) for each in (part, whole)
    )
    assert numbers.notes[-1] == f"whole plate, {words}"
    for name in ("peak_force", "impulse", "largest_absorbed_energy", "largest_displacement"):
        assert getattr(numbers, name) == pytest.approx(getattr(all_of_it, name), rel=1e-6), name
    _, said_at_end = said("run", tmp_path / "job.k", "-o", tmp_path / "again")
    last = float(re.search(r" 100\.0% .*% +(\S+) +[\d:]+ +[\d:]+$", said_at_end, re.M)[1])
    assert last == pytest.approx(force[-1] / share, rel=1e-3)


@pytest.mark.parametrize(
    "other", [{"edge": "free"}, {"edge": "held"}, {"shift": 0.5}, {"shift": -0.5}]
)
def test_other_impacts_near_a_side_are_of_the_whole(other: dict, tmp_path: Path) -> None:
    part = run(impact("x", **other), tmp_path)
    assert symmetry(part) == ""
    assert not part.table("impactor_1").has(SHARE)


def test_a_stage_without_the_impactor_is_still_a_part(tmp_path: Path) -> None:
    part = run(impact("xy"), tmp_path)
    after = run_stage(part, "*DELETE_IMPACTOR\n1\n*CONTROL_TERMINATION\n1.0e-5,\n", "after")
    assert symmetry(after) == "x=0 y=0"
    assert np.all(after.table("energy")[SHARE] == 0.25)
    assert "whole plate, 4 x the quarter" in after.listing()
