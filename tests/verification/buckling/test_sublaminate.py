"""A thin layer that buckles over a round delamination, when the solid below is compressed.

The layer, thickness t, is clamped along a circle of radius R and compressed alike in all
directions. It buckles at the strain 1.2235 (t/R)^2 / (1 + nu) (14.68 D / R^2), and then opens in
the middle by

    (w / t)^2 = (strain / critical - 1) / (0.2473 (1 + nu) + 0.2231 (1 - nu^2)),

an expansion about the onset (Hutchinson, Thouless and Liniger, Acta Metall. Mater. 40 (1992)
295-308). A pressure gives the sense; it bends the uncompressed layer by P t. The equation of one
mode, (strain / critical - 1) w - a w^3 / t^2 + P t = 0, takes it out of the strains. Both numbers
are those of an expansion of the first order whose next term is a few percent at these openings;
the root of the layer turns in the solid, which makes R longer by less than t, t/R = 2.5 %.

A strip that has buckled over a delamination of length 2 b releases, with s the strain and c =
pi^2/12 (t/b)^2 that of buckling, E t s^2 / 2 (1 - nu^2) (1 - c/s) (1 + 3 c/s) per area of growth
(Hutchinson and Suo, Adv. Appl. Mech. 29 (1992) 63-191).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from comparison import Comparison
from decks import BOTTOM, Bond, Deck, Ply, ramp
from elasticity import Array, isotropic
from meshes import Mesh, disc, regular, without
from runs import run

# One linear layer in bending cannot become thinner and is stiffer by (1 - nu)^2/(1 - 2 nu), 1 %
SHEET = isotropic(2.7e-9, 70.0e3, 0.1)
RADIUS, OUTER, FILM, SOLID = 20.0, 26.0, 0.5, 0.5
POISSON = SHEET.poisson[0]
ONSET = 1.2235 * (FILM / RADIUS) ** 2 / (1.0 + POISSON)
RIGIDITY = SHEET.young[0] * FILM**3 / 12.0 / (1.0 - POISSON**2)
FREQUENCY = 10.216 * np.sqrt(RIGIDITY / (SHEET.density * FILM)) / RADIUS**2
#: Strain over that of onset: first quickly, then slowly
FIRST, LAST, SHARE = 0.9, 2.0, 0.15
#: Deflection over the thickness by the pressure alone
PUSHED = 1.0e-2
#: A joint that does not fail
BOND = Bond((3.0e5, 3.0e5), (1.0e4, 1.0e4), (1.0e3, 1.0e3), 1.0)


def quarter() -> Mesh:
    """Quads of the delamination and of a ring around it, for x and y above 0."""
    whole = disc(4, 3, RADIUS, 16.0, outer=(22.0, OUTER))
    return without(whole, (whole.points[whole.quads[:, 8]] < 0.0).any(axis=1))


def opening(folder: Path) -> tuple[Array, Array]:
    """Strain over the onset, and deflection in the middle over the thickness."""
    mesh = quarter()
    time = 7.0 * 2.0 * np.pi / FREQUENCY
    deck = Deck("layer over a round delamination", time)
    deck.intervals(glstat=time)
    deck.control(damping=0.5 * FREQUENCY)
    deck.mesh(mesh)
    deck.laminate([Ply(SHEET, SOLID), Ply(SHEET, FILM)], order=1)
    deck.cohesive(BOND)
    inside = np.hypot(*mesh.points[mesh.quads[:, 8]].T) < RADIUS
    quads = [int(quad) + 1 for quad in np.flatnonzero(inside)]
    deck.add("SET_SHELL_LIST", (900,), *[quads[i : i + 8] for i in range(0, len(quads), 8)])
    deck.add("INITIAL_DELAMINATION", (1, 1, 1, 900))
    rise = [(SHARE * time * t, FIRST * share) for t, share in ramp(1.0, 100)]
    curve = deck.curve([*rise, (time, LAST)])
    deck.hold_face(range(len(mesh.points)), BOTTOM, "z")
    rim = np.hypot(*mesh.points.T) > OUTER - 1.0e-6
    for direction in range(2):
        for place in sorted({*mesh.points[:, direction]}):
            line = np.flatnonzero(mesh.points[:, direction] == place)
            if place == 0.0:
                deck.hold(line, "xy"[direction])
                continue
            outer, below = line[rim[line]], line[~rim[line]]
            if len(outer):
                deck.move(outer, direction + 1, curve, -ONSET * place)
            if len(below):
                deck.move_face(below, BOTTOM, direction + 1, curve, -ONSET * place)
    push = 64.0 * RIGIDITY * PUSHED * FILM / RADIUS**4
    deck.add("LOAD_FACE_PRESSURE", (0, 1, deck.curve(ramp(SHARE * time)), -push))
    middle = mesh.at(0.0, 0.0)
    deck.histories([middle], time / 300.0)
    table = run(deck, folder).table("nodes")
    later = (table["time"] / time - SHARE) / (1.0 - SHARE)
    slow = later >= 0.0
    opened = table[f"n{middle + 1} top uz"] / FILM
    return FIRST + (LAST - FIRST) * later[slow], opened[slow]


def test_onset(compare: Comparison, tmp_path: Path) -> None:
    """Opening squared over strain is a line from the onset on."""
    strain, deflection = opening(tmp_path)
    after = (strain > 1.4) & (strain < 1.9)
    squares, without_push = deflection[after] ** 2, strain[after] + PUSHED / deflection[after]
    slope, onset = np.polyfit(squares, without_push, 1)
    compare.number("strain of onset", onset * ONSET, ONSET, rel=0.05)
    exact = 0.2473 * (1.0 + POISSON) + 0.2231 * (1.0 - POISSON**2)
    compare.number("strain beyond it over opening squared", slope, exact, rel=0.05)
    compare.curves(
        "layer over a round delamination",
        ("strain / strain of onset", "opening in the middle / thickness"),
        {"run": (strain, deflection)},
        {"expansion": (strain, np.sqrt(np.maximum(strain - 1.0, 0.0) / exact))},
    )


# A delamination across a strip, half of it: its length, and what tears the joint in any mode
HALF, END, QUAD, TOUGHNESS = 15.0, 30.0, 1.0, 0.31
GROWING = Bond((1.0e5, 1.0e5), (30.0, 30.0), (TOUGHNESS, TOUGHNESS), 1.0)


def euler(half: Array | float) -> Array:
    """Strain at which a strip of length 2 half buckles, clamped, in plane strain."""
    return np.pi**2 / 12.0 * (FILM / np.asarray(half)) ** 2


def release(strain: Array, half: Array | float) -> Array:
    """Energy release rate of a strip that has buckled."""
    whole = SHEET.young[0] * FILM * strain**2 / (2.0 * (1.0 - POISSON**2))
    share = euler(half) / strain
    return whole * (1.0 - share) * (1.0 + 3.0 * share)


def strip(folder: Path) -> tuple[Array, Array]:
    """Strain and half of the length that has failed."""
    mesh = regular(END, QUAD, round(END / QUAD), 1, 9)
    onset = float(euler(HALF))
    rate = 22.37 / (4.0 * HALF**2) * np.sqrt(RIGIDITY / (SHEET.density * FILM))
    period = 2.0 * np.pi / rate
    time, first, least, most = 16.0 * period, 5.0 * period, 3.8 * onset, 4.4 * onset
    deck = Deck("strip that delaminates as it buckles", time)
    deck.control(damping=0.5 * rate)
    deck.mesh(mesh)
    deck.laminate([Ply(SHEET, SOLID), Ply(SHEET, FILM)], order=1)
    deck.cohesive(GROWING)
    quads = range(1, round(HALF / QUAD) + 1)
    deck.add("SET_SHELL_LIST", (900,), *[quads[i : i + 8] for i in range(0, len(quads), 8)])
    deck.add("INITIAL_DELAMINATION", (1, 1, 1, 900))
    curve = deck.curve([*[(first * t, least * share) for t, share in ramp(1.0, 100)], (time, most)])
    deck.hold(range(len(mesh.points)), "y")
    deck.hold_face(range(len(mesh.points)), BOTTOM, "z")
    deck.hold(mesh.where(x=0.0), "x")
    deck.move(mesh.where(x=END), 1, curve, -END)
    for place in sorted({*mesh.points[:, 0]} - {0.0, END}):
        deck.move_face(mesh.where(x=place), BOTTOM, 1, curve, -place)
    push = 384.0 * RIGIDITY * PUSHED * FILM / (2.0 * HALF) ** 4
    deck.add("LOAD_FACE_PRESSURE", (0, 1, deck.curve(ramp(first)), -push))
    deck.intervals(delam=time / 400.0, glstat=time)
    table = run(deck, folder).table("delamination")
    strain = least + (most - least) * (table["time"] - first) / (time - first)
    slow = strain >= least
    return strain[slow], table["failed sum"][slow] / QUAD


def test_growth(compare: Comparison, tmp_path: Path) -> None:
    """The delamination grows at the strain at which the released energy is the toughness.

    Where it ends is known to the process zone, (E G / S^2)^(1/4) t^(3/4) = 1.6 mm; that is 1 % of
    the strain, to which mass and rate add no more. The pressure adds work of the order of `PUSHED`.
    """
    strain, half = strip(tmp_path)
    lengths = np.array([HALF + 1.5, HALF + 3.0, HALF + 6.0, HALF + 9.0])
    exact = [
        float(brentq(lambda e, b=b: release(e, b) - TOUGHNESS, 1.2 * euler(b), 1.0))
        for b in lengths
    ]
    found = [float(strain[np.argmax(half >= length)]) for length in lengths]
    for length, own, theory in zip(lengths, found, exact, strict=True):
        compare.number(f"strain at which {length:g} mm have failed", own, theory, rel=0.03)
    compare.curves(
        "strip that delaminates as it buckles",
        ("strain [1e-3]", "half of the length [mm]"),
        {"run": (1e3 * strain, half)},
        {"energy release rate": (1e3 * np.array(exact), lengths)},
    )
