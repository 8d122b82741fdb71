"""Beams that delaminate, as strips one quad wide: double cantilever, end notch, both modes.

The specimens of AS4/PEEK of Camanho, Davila and de Moura (2003). Forces are those of their width.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from decks import BOTTOM, TOP, Bond, Deck, Ply
from elasticity import Array, Material
from meshes import Mesh, rectangle
from runs import Results, run

PEEK = Material(1.57e-9, (122.7e3, 10.1e3, 10.1e3), (0.25, 0.25, 0.45), (5.5e3, 5.5e3, 3.7e3))
# Stiffness, strength and toughness of opening and sliding, exponent of Benzeggagh and Kenane
PEEK_BOND = Bond((1.0e6, 1.0e6), (80.0, 100.0), (0.969, 1.719), -2.284)
WIDTH, ARM, HALF_SPAN = 25.4, 1.56, 51.0
# How far fine quads reach behind and before the tip of the crack
BEHIND, BEFORE = 3.0, 9.0


@dataclass(frozen=True)
class Specimen:
    """One test: share of mode II, initial crack, lever; and how it is computed."""

    share: float  # 0 double cantilever, 1 end notch, between: both modes on a lever
    crack: float
    lever: float = 0.0
    size: float = 1.0  # of the quads along the crack
    coarse: float = 3.0  # of those elsewhere
    order: int = 2
    nodes: int = 9  # of a quad
    arm: float = ARM
    nodal: bool = False
    implicit: bool = False
    bond: Bond = field(default=PEEK_BOND)
    duration: float = 3.0e-3
    growth: float = 6.0

    @property
    def stiff_length(self) -> float:
        """Share chi of the arm's thickness that the crack is longer by in a beam (Williams)."""
        (e1, e2, _), g13 = PEEK.young, PEEK.shear[1]
        gamma = 1.18 * np.sqrt(e1 * e2) / g13
        return float(np.sqrt(e1 / (11.0 * g13) * (3.0 - 2.0 * (gamma / (1.0 + gamma)) ** 2)))

    @property
    def parts(self) -> tuple[float, float]:
        """Forces that open the ends and bend the middle, for a force of one (Reeder and Crews)."""
        if self.share in (0.0, 1.0):
            return 1.0 - self.share, self.share
        opening = (3.0 * self.lever - HALF_SPAN) / (4.0 * HALF_SPAN)
        return opening, (self.lever + HALF_SPAN) / HALF_SPAN

    def release(self, force: Array | float, crack: Array | float) -> tuple[Array, Array]:
        """Energy release rates of both modes at a force and a length of the crack."""
        e1, chi = PEEK.young[0], self.stiff_length
        opening, sliding = self.parts
        unit = WIDTH**2 * self.arm**3 * e1
        first = 12.0 * (crack + chi * self.arm) ** 2 * np.square(opening * force) / unit
        second = (
            9.0 * (crack + 0.42 * chi * self.arm) ** 2 * np.square(sliding * force) / (16.0 * unit)
        )
        return first, second

    def force(self, crack: float | Array) -> Array:
        """Force at which the crack grows, by corrected beam theory."""
        first, second = self.release(1.0, crack)
        toughness = self.bond.toughness_of(second / (first + second))
        return np.sqrt(toughness / (first + second))

    def compliance(self, crack: float | Array) -> Array:
        """Opening of the ends, deflection of the middle or way of the lever's end, by force."""
        chi = self.stiff_length
        opening, sliding = self.parts
        apart = 8.0 * (crack + chi * self.arm) ** 3
        bent = (2.0 * HALF_SPAN**3 + 3.0 * (crack + 0.42 * chi * self.arm) ** 3) / 8.0
        return (opening**2 * apart + sliding**2 * bent) / (PEEK.young[0] * WIDTH * self.arm**3)

    def resistance(self, force: Array, deflection: Array) -> Array:
        """Energy release rate over the toughness, with the crack that the compliance tells."""
        cracks = np.linspace(0.0, 2.0 * HALF_SPAN, 4001)
        crack = np.interp(deflection / force, self.compliance(cracks), cracks)
        first, second = self.release(force, crack)
        return (first + second) / self.bond.toughness_of(second / (first + second))

    def deflection(self, crack: float | Array) -> Array:
        """Opening, deflection or way of the lever's end at which the crack has that length."""
        return self.force(crack) * self.compliance(crack)


@dataclass(frozen=True)
class Outcome:
    """Histories of a test."""

    force: Array  # of the width of the specimen
    deflection: Array
    crack: Array
    failed: Array  # share of the energy that went into the interface
    kinetic: Array  # share of the plate's energy that is kinetic
    results: Results

    @property
    def peak(self) -> float:
        """Largest force."""
        return float(self.force.max())

    def growing(self, least: float, most: float, crack: float) -> slice:
        """States at which the crack has grown by between two lengths."""
        grown = self.crack - crack
        return slice(int(np.argmax(grown >= least)), int(np.argmax(grown >= most)) or len(grown))


def beam(specimen: Specimen) -> Mesh:
    """Quads: fine around the tip, coarse elsewhere, a line at mid-span."""
    tip, end = specimen.crack, 2.0 * HALF_SPAN
    stops = [0.0, tip - BEHIND, tip, min(tip + BEFORE, HALF_SPAN), HALF_SPAN, end]
    coarse, fine = specimen.coarse, specimen.size
    sizes = [coarse, fine, fine, coarse, coarse]
    lines = [0.0]
    for first, last, size in zip(stops, stops[1:], sizes, strict=False):
        count = round((last - first) / size + 0.45)
        lines += list(first + (last - first) * np.arange(1, count + 1) / count) if count else []
    return rectangle(np.array(lines), np.array([0.0, specimen.size]), specimen.nodes)


def simulate(specimen: Specimen, folder: Path) -> Outcome:
    """Run a test and take its histories apart."""
    mesh, time = beam(specimen), specimen.duration
    deck = Deck("delamination of a beam", time)
    deck.control(linear=True, damping=1.0e3, scheme=int(specimen.implicit))
    deck.mesh(mesh)
    deck.laminate([Ply(PEEK, specimen.arm)] * 2, specimen.order)
    deck.cohesive(specimen.bond, nodal=specimen.nodal)
    centres = mesh.points[mesh.quads].mean(axis=1)[:, 0]
    cracked = [int(quad) + 1 for quad in np.flatnonzero(centres < specimen.crack)]
    deck.add("SET_SHELL_LIST", (900,), *[cracked[i : i + 8] for i in range(0, len(cracked), 8)])
    deck.add("INITIAL_DELAMINATION", (1, 1, 1, 900))
    load(specimen, mesh, deck)
    deck.intervals(
        spcforc=time / 400.0, glstat=time / 400.0, delam=time / 400.0, binary_d3plot=time
    )
    return outcome(specimen, mesh, run(deck, folder))


def load(specimen: Specimen, mesh: Mesh, deck: Deck) -> None:
    """Supports and what moves or pulls the beam."""
    end, span = mesh.where(x=0.0), 2.0 * HALF_SPAN
    deck.hold(mesh.where(y=0.0), "y")
    if specimen.share == 0.0:
        deck.hold(mesh.where(x=span), "xz")
        speed = 0.5 * mean_speed(specimen)
        pull(deck, end, TOP, speed, specimen.duration)
        pull(deck, end, BOTTOM, -speed, specimen.duration)
        return
    deck.hold_face(mesh.where(x=span), BOTTOM, "xz")
    deck.hold_face(end, BOTTOM, "z")
    middle = mesh.where(x=HALF_SPAN)
    if specimen.share == 1.0:
        pull(deck, middle, TOP, -mean_speed(specimen), specimen.duration)
        return
    curve, turn = slow_start(deck, specimen.duration), specimen.lever / HALF_SPAN
    for number, pair in enumerate(zip(end, middle, strict=True), start=1):
        rows = [(node + 1, TOP, 3, k) for node, k in zip(pair, (-turn, 1.0 + turn), strict=True)]
        deck.add("CONSTRAINED_FACE_LINEAR", (number, 0, curve, -mean_speed(specimen)), *rows)


def mean_speed(specimen: Specimen) -> float:
    """Rate of opening or deflection after its ramp."""
    return float(specimen.deflection(specimen.crack + specimen.growth) / (0.9 * specimen.duration))


def slow_start(deck: Deck, duration: float) -> int:
    """A curve that rises along half a cosine over a fifth of the time, and stays at one."""
    times = 0.2 * duration * np.arange(17) / 16.0
    return deck.curve(zip(times, 0.5 - 0.5 * np.cos(np.pi * np.arange(17) / 16.0), strict=True))


def pull(deck: Deck, nodes: list[int], face: int, speed: float, duration: float) -> None:
    """Move nodes at a speed that rises along half a cosine over a fifth of the time."""
    curve = slow_start(deck, duration)
    deck.add("BOUNDARY_FACE_MOTION", (deck.node_set(nodes), face, 3, 0, curve, speed))


def outcome(specimen: Specimen, mesh: Mesh, results: Results) -> Outcome:
    """Force from the work, length of the crack from the area that has failed."""
    energy, area = results.table("energy"), results.table("delamination")
    strip = mesh.points[:, 1].max()
    time, work = energy["time"], energy["external"]
    crack = np.interp(time, area["time"], area["failed sum"]) / strip
    ramp = 0.2 * specimen.duration
    way = np.where(
        time < ramp,
        0.5 * (time - ramp / np.pi * np.sin(np.pi * time / ramp)),
        time - 0.5 * ramp,
    )
    deflection = mean_speed(specimen) * way
    force = slope(work, deflection) * WIDTH / strip
    plate = energy["kinetic"] + energy["internal"]
    return Outcome(
        force,
        deflection,
        crack,
        energy["delamination"] / np.maximum(work, 1e-30),
        energy["kinetic"] / np.maximum(plate, 1e-30),
        results,
    )


def slope(work: Array, way: Array, reach: int = 5) -> Array:
    """Work over way from some states before to as many after; a point that fails rings shorter."""
    first = np.maximum(np.arange(len(way)) - reach, 0)
    last = np.minimum(np.arange(len(way)) + reach, len(way) - 1)
    return (work[last] - work[first]) / (way[last] - way[first])


# A lever goes slowly, and on behind the first millimetres, where the zone before the crack grows
LEVER_TIME, LEVER_GROWTH = 12.0e-3, 9.0
# Initial cracks, levers, and the largest forces that were measured (N)
TESTS = {
    "DCB": (Specimen(0.0, 32.9), 147.1),
    "MMB 20 %": (Specimen(0.2, 33.7, 109.4, duration=LEVER_TIME, growth=LEVER_GROWTH), 108.1),
    "MMB 50 %": (Specimen(0.5, 34.1, 44.4, duration=LEVER_TIME, growth=LEVER_GROWTH), 275.3),
    "MMB 80 %": (Specimen(0.8, 31.4, 28.4, duration=LEVER_TIME, growth=LEVER_GROWTH), 518.7),
    "ENF": (Specimen(1.0, 39.3, duration=4.0e-3), 748.0),
}
