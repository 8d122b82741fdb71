"""A strip of which one arm is pulled, in plane strain: both modes in one ratio, 3/7 of it sliding.

Every point that fails takes the toughness of its own mix of modes, and the crack moves at a ratio
that the beam knows. Two things hide that, and neither is of the law: the energy of all points over
the failed area counts what points before the tip have taken so far; and arms that are moved fast,
or damped, are loaded by their own inertia, which slides the interface more than the pull does. Both
made 105 to 107 % of the toughness out of what is 101 % here.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from comparison import Comparison
from decks import TOP, Deck, Ply
from delamination import ARM, PEEK, PEEK_BOND, Specimen, pull
from meshes import rectangle
from runs import Results, run

CRACK, LENGTH, FINE = 40.0, 80.0, 16.0
TIME, OPENING, DAMPING = 1.0e-2, 10.0, 3.0e2
# Failed points behind the tip and beyond where the zone has formed, one and a half arms long
BEHIND, FORMED = 1.0, 2.5
BOND = replace(PEEK_BOND, by_work=True)


def test_points_take_the_toughness_of_the_ratio(compare: Comparison, tmp_path: Path) -> None:
    """Benzeggagh and Kenane at the ratio of corrected beams with the crack at the point.

    The beam knows the share of sliding to some 0.03, the corrections of its length being those of
    a sharp crack; the toughness moves by 0.55 N/mm times that, 1.6 %. Points fail one after the
    other, and each by steps of the others: 4 % for one, 2 % for their mean.
    """
    results = strip(tmp_path)
    places, took = results.interface_points(), results.interface_field("dissipated").ravel()
    failed = results.interface_field("damage").ravel() >= 1.0
    tip = places[failed, 0].max()
    inside = failed & (places[:, 0] > CRACK + FORMED) & (places[:, 0] < tip - BEHIND)
    toughness = np.array([BOND.toughness_of(share_of_sliding(x)) for x in places[inside, 0]])
    assert np.count_nonzero(inside) > 20
    name = "one arm, energy of a point"
    compare.values(name, took[inside], toughness, unit="N/mm", rel=0.04)
    name = "one arm, energy of all points over toughness"
    compare.number(name, float(np.mean(took[inside] / toughness)), 1.0, rel=0.02)
    energy = results.table("energy")
    assert np.abs(energy["error"]).max() < 1e-6


def share_of_sliding(crack: float) -> float:
    """Share of mode II where one arm is pulled, half of its moment to each mode."""
    longer = Specimen(0.5, crack).stiff_length * ARM
    opening, sliding = 12.0 * (crack + longer) ** 2, 9.0 * (crack + 0.42 * longer) ** 2
    return sliding / (opening + sliding)


def strip(folder: Path) -> Results:
    """Pull the upper arm of a strip one quad wide that is clamped at its other end."""
    fine = np.arange(CRACK - 3.0, CRACK + FINE, 1.0)
    coarse = np.linspace(0.0, CRACK - 3.0, 9)[:-1], np.linspace(CRACK + FINE, LENGTH, 9)
    mesh = rectangle(np.concatenate([coarse[0], fine, coarse[1]]), np.array([0.0, 1.0]), 9)
    deck = Deck("one arm is pulled", TIME)
    deck.control(linear=True, damping=DAMPING, scheme=1)
    deck.mesh(mesh)
    deck.laminate([Ply(PEEK, ARM)] * 2, 1)
    deck.cohesive(BOND)
    centres = mesh.points[mesh.quads].mean(axis=1)[:, 0]
    cracked = [int(quad) + 1 for quad in np.flatnonzero(centres < CRACK)]
    deck.add("SET_SHELL_LIST", (900,), *[cracked[i : i + 8] for i in range(0, len(cracked), 8)])
    deck.add("INITIAL_DELAMINATION", (1, 1, 1, 900))
    deck.hold(range(len(mesh.points)), "y")
    deck.hold(mesh.where(x=LENGTH), "xz")
    pull(deck, mesh.where(x=0.0), TOP, OPENING / (0.9 * TIME), TIME)
    deck.intervals(glstat=TIME / 400.0, delam=TIME / 400.0, binary_d3plot=TIME)
    return run(deck, folder)
