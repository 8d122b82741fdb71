"""A bending crack of a 90 ply starts the delamination of the 90/0 interface below it.

Classical theory of beams gives the moment at which the crack begins, and the moment at which the
delamination grows from it, whatever its length. `study.py` has three meshes.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from comparison import Comparison
from cracked_beam import (
    BOND,
    INNER,
    PLY,
    WIDTH,
    Bent,
    Strip,
    bend,
    cracking_moment,
    deflection,
    delaminated,
    growth_moment,
)

# Quads between the inner bars, 0.96 mm long
QUADS = 25
# Share of the deflection at which the delamination grows: the crack is through, and nothing else
CRACKED = 0.95
# Over the moment of growth, without a crack
MORE = 1.6
# The highest of three Gauss points of the upper layer, half of the ply thick
HIGHEST = 2.0 * PLY - 0.25 * PLY * (1.0 - np.sqrt(0.6))


def test_crack_starts_the_delamination(compare: Comparison, tmp_path: Path) -> None:
    """Crack, delamination from its foot to both sides, and one moment as it grows.

    Between two rows of the histories the moment rises by 0.4 %, and damping takes as much: 2 % for
    the crack. Points fail one after the other and let the strip ring, and damping takes 2 % of the
    work, 1 % of the moment: 5 %, as for beams that delaminate.
    """
    found = bend(Strip(QUADS), tmp_path)
    begins = found.moment[int(np.argmax(found.crack > 0.0))]
    theory = cracking_moment(HIGHEST)
    compare.number("moment at which the crack begins", begins, theory, unit="N", rel=0.02)
    growing = found.growing
    moment = found.moment[growing].mean()
    name = "moment at which the delamination grows"
    compare.number(name, moment, growth_moment(), unit="N", rel=0.05)
    spent = found.energy("delamination")[growing] / WIDTH
    taken = np.polyfit(found.failed[growing], spent, 1)[0]
    name = "energy of the delamination per area"
    compare.number(name, taken, BOND.toughness[0], unit="N/mm", rel=0.05)
    draw(found, compare)
    check_order(found)
    assert np.abs(found.energy("error")).max() < 1e-6
    assert (found.energy("kinetic")[growing] < 0.01 * found.energy("internal")[growing]).all()


def test_nothing_delaminates_without_the_crack(compare: Comparison, tmp_path: Path) -> None:
    """The same way with a ply that can not crack: at 1.6 times the moment of growth nothing."""
    reach = deflection(1.05 * MORE * growth_moment(), 0.0)
    found = bend(Strip(13, cracks=False), tmp_path, reach)
    assert found.moment.max() > MORE * growth_moment()
    spent = float(found.energy("delamination").max())
    compare.number("energy of the delamination without a crack", spent, 0.0, unit="mJ", abs=1e-12)
    assert found.results.interface_field("damage").max() == 0.0


def test_energy_of_the_crack(compare: Comparison, tmp_path: Path) -> None:
    """The toughness times the section of the ply.

    NU23 is zero here: the stress across the thickness, which falls as the crack passes, would
    change the energy. Two of three rows of points open. In the row beside the interface, 14 % of
    the section, it may be one or three, with 0.46 or 1.38 of the energy: 5 %.
    """
    reach = CRACKED * deflection(growth_moment(), 0.0)
    found = bend(Strip(QUADS, poisson=0.0), tmp_path, reach)
    name = "energy of the crack over toughness times area, NU23 0"
    compare.number(name, found.crack[-1], 1.0, rel=0.05)
    assert found.failed[-1] == 0.0


def check_order(found: Bent) -> None:
    """The crack is there before the interface fails, in one piece that grows to both sides."""
    assert found.crack[int(np.argmax(found.failed > 0.0))] > 0.9
    assert found.crack[-1] < 1.1  # one crack
    points = np.unique(found.places)
    grown = [places for places in found.states()[1] if len(places)]
    for places in grown:
        assert places[0] < 0.0 < places[-1]
        assert len(places) == np.count_nonzero((points >= places[0]) & (points <= places[-1]))
    assert grown[-1][0] < -0.3 * INNER
    assert grown[-1][-1] > 0.3 * INNER


def draw(found: Bent, compare: Comparison) -> None:
    """Moment over deflection, and where the delamination ends at both sides."""
    grows, way = growth_moment(), found.way
    known = np.array([0.0, deflection(grows, 0.0), deflection(grows, INNER)])
    name = found.strip.name
    across = "deflection of the inner bars [mm]"
    compare.curves(
        f"four-point bending, {name}",
        (across, "moment [N]"),
        {name: (way, found.smooth)},
        {"theory": (known, np.array([0.0, grows, grows]))},
    )
    ways, states = found.states()
    ends = np.array([(one[0], one[-1]) if len(one) else (0.0, 0.0) for one in states])
    half = 0.5 * delaminated(way)
    compare.curves(
        f"ends of the delamination, {name}",
        (across, "distance from the crack [mm]"),
        {"one side": (ways, ends[:, 0]), "other side": (ways, ends[:, 1])},
        {"theory": (np.append(way[::-1], way), np.append(-half[::-1], half))},
    )
