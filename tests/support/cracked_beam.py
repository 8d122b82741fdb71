"""A cross-ply strip in four-point bending whose 90 ply cracks, and then peels off the 0 ply below.

The 90 ply lies on top, and the inner bars press upwards: the top is in tension. The moment between
the inner bars is constant, and the strip is in plane strain. One quad in the middle has half of
the strength. All numbers are per width.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import h5py
import numpy as np
from numpy.typing import NDArray

from damage import HTS40
from decks import BOTTOM, TOP, Bond, Deck, Ply
from delamination import slope, slow_start
from elasticity import Array, Material
from meshes import Mesh, rectangle
from runs import Results, run

# Thickness of each ply; between the inner bars, from there to the outer ones; width of the strip
PLY, INNER, ARM, WIDTH = 1.5, 24.0, 10.0, 2.0
ELASTIC = Material(HTS40.density, HTS40.young, HTS40.poisson, HTS40.shear)
POISSON = HTS40.poisson[0]
# The middle quad has a share of the strength; both modes of the interface are alike, so that their
# ratio does not matter, and weak enough that quads of 1 mm resolve the zone in which it softens
WEAK = 0.5
BOND = Bond((1.0e6, 1.0e6), (30.0, 30.0), (0.2, 0.2), -1.6)
# Of the inner bars; time to it, and damping
DEFLECTION, TIME, DAMPING = 0.68, 2.7e-3, 3.0e3
STATES = 40
# Lengths between which the delamination grows steadily
STEADY = (6.0, 18.0)


@dataclass(frozen=True)
class Section:
    """A 0 ply with a 90 ply upon it, in plane strain: classical theory of a beam."""

    whole: float  # bending stiffness per width
    lower: float  # of the 0 ply alone
    neutral: float  # height of the neutral axis
    modulus: float  # of the 90 ply along the beam
    shear: float  # angle of shear per transverse force per width


def section(poisson: float = POISSON) -> Section:
    """Stiffness with and without the 90 ply, for Poisson's ratio NU12; 0 is plane stress, too."""
    along, across, _ = HTS40.young
    stiffer = 1.0 / (1.0 - poisson**2 * across / along)
    moduli, middles = stiffer * np.array([along, across]), PLY * np.array([0.5, 1.5])
    neutral = float(moduli @ middles / moduli.sum())
    own = moduli * PLY**3 / 12.0
    whole = float(own.sum() + PLY * moduli @ (middles - neutral) ** 2)
    # shear stress per force: that of the plies above, which vanishes on the faces
    z = 2.0 * PLY * (np.arange(2000) + 0.5) / 2000.0
    upper = z > PLY
    slope_of_stress = np.where(upper, moduli[1], moduli[0]) * (z - neutral) / whole
    stress = -np.cumsum(slope_of_stress) * PLY / 1000.0
    compliance = stress**2 / np.where(upper, HTS40.shear[2], HTS40.shear[1])
    return Section(
        whole, float(own[0]), neutral, float(moduli[1]), float(compliance.sum() * PLY / 1000.0)
    )


def cracking_moment(
    height: float, strength: float = WEAK * HTS40.matrix_strength[0], poisson: float = POISSON
) -> float:
    """Moment at which the stress at a height reaches the strength, by default of the weak quad."""
    beam = section(poisson)
    return strength * beam.whole / (beam.modulus * (height - beam.neutral))


def growth_moment(poisson: float = POISSON) -> float:
    """Moment at which the delamination grows: behind its tip the 0 ply bends alone.

    Per length the energy rises by half of the moment times the change of curvature, and the work
    by twice that (Hutchinson and Suo 1992).
    """
    beam = section(poisson)
    return float(np.sqrt(2.0 * BOND.toughness[0] / (1.0 / beam.lower - 1.0 / beam.whole)))


def deflection(moment: float, length: float) -> float:
    """Deflection of the inner bars at a moment and a length of the delamination."""
    beam = section()
    bent = (INNER + 2.0 * ARM / 3.0) / beam.whole + length * (1.0 / beam.lower - 1.0 / beam.whole)
    return moment * (0.5 * ARM * bent + beam.shear)


def delaminated(way: Array) -> Array:
    """Length of a delamination that grows, at deflections of the inner bars."""
    moment = growth_moment()
    first, last = deflection(moment, 0.0), deflection(moment, INNER)
    return INNER * np.clip((way - first) / (last - first), 0.0, 1.0)


@dataclass(frozen=True)
class Strip:
    """How the strip is computed, and what the card of the 90 ply says."""

    quads: int  # between the inner bars, odd
    cracks: bool = True
    poisson: float = HTS40.poisson[2]  # NU23
    largest: float = HTS40.largest  # DMAX
    shear: int = 0  # GZ
    width: float = WIDTH

    @property
    def name(self) -> str:
        """Length of these quads, in words."""
        return f"quads of {INNER / self.quads:.2f} mm"


@dataclass(frozen=True)
class Bent:
    """What came out, over the time."""

    strip: Strip
    results: Results

    @cached_property
    def way(self) -> Array:
        """Deflection of the inner bars."""
        time, ramp = self.energy("time"), 0.2 * TIME
        rising = 0.5 * (time - ramp / np.pi * np.sin(np.pi * time / ramp))
        return speed() * np.where(time < ramp, rising, time - 0.5 * ramp)

    @cached_property
    def moment(self) -> Array:
        """Moment between the inner bars, the mean of what all bars give."""
        forces = self.results.table("supports")
        inner = forces[next(name for name in forces.names if "motion" in name and "fz" in name)]
        outer = forces[next(name for name in forces.names if "top fz" in name)]
        return 0.25 * (np.abs(inner) + np.abs(outer)) * ARM / self.strip.width

    @cached_property
    def smooth(self) -> Array:
        """Moment from the work over some states; the strip rings when it cracks."""
        force = slope(self.energy("external"), np.maximum.accumulate(self.way), 12)
        return 0.5 * force * ARM / self.strip.width

    @cached_property
    def failed(self) -> Array:
        """Length of the delamination."""
        area = self.results.table("delamination")
        return np.interp(self.energy("time"), area["time"], area["failed sum"]) / self.strip.width

    def energy(self, name: str) -> Array:
        """A column of the energies."""
        return self.results.table("energy")[name]

    @cached_property
    def crack(self) -> Array:
        """Energy of matrix damage over the toughness times the section of the ply."""
        return self.energy("matrix damage") / (HTS40.matrix_toughness[0] * PLY * self.strip.width)

    @property
    def growing(self) -> NDArray[np.bool_]:
        """Rows in which the delamination grows steadily, far from the crack and from the bars."""
        return (self.failed > STEADY[0]) & (self.failed < STEADY[1])

    @cached_property
    def places(self) -> Array:
        """Distances of the points of the interface from the middle."""
        return self.results.interface_points()[:, 0].round(6) - ARM - 0.5 * INNER

    def states(self) -> tuple[Array, list[Array]]:
        """Deflections at the states, and where the interface has failed in each."""
        with h5py.File(self.results.folder / f"{self.results.job}.interfaces.vtkhdf") as file:
            times = np.array(file["VTKHDF/Steps/Values"])
            damage = np.array(file["VTKHDF/PointData/damage"]).reshape(len(times), -1)
        ways = np.interp(times, self.energy("time"), self.way)
        return ways, [np.unique(self.places[one >= 1.0]) for one in damage]


def speed() -> float:
    """Of the inner bars after their slow start."""
    return DEFLECTION / (0.9 * TIME)


def plane(strip: Strip) -> Mesh:
    """Quads along the strip, those outside of the inner bars 1 mm long, and one across."""
    outside = np.arange(ARM)
    inside = ARM + INNER * np.arange(strip.quads + 1) / strip.quads
    lines = np.concatenate([outside, inside, 2.0 * ARM + INNER - outside[::-1]])
    return rectangle(lines, np.array([0.0, strip.width]), 9)


def stack(strip: Strip, share: float) -> list[Ply]:
    """The plies, of which the 90 ply has two layers and a share of its strength."""
    upper = ELASTIC
    if strip.cracks:
        poisson = (*HTS40.poisson[:2], strip.poisson)
        tension, compression = HTS40.matrix_strength
        strengths = (share * tension, compression)
        upper = replace(HTS40, cross_strength=0.0, poisson=poisson, matrix_strength=strengths)
        upper = replace(upper, largest=strip.largest, switches=(0,) * 7 + (strip.shear,))
    return [Ply(ELASTIC, PLY)] + [Ply(upper, 0.5 * PLY, 90.0)] * 2


def bend(strip: Strip, folder: Path, reach: float = DEFLECTION) -> Bent:
    """Bend a strip of quads of nine nodes to a deflection; linear strain, interface implicit."""
    mesh, middle = plane(strip), ARM + 0.5 * INNER
    centres = mesh.points[mesh.quads].mean(axis=1)[:, 0]
    end = 0.1 * TIME + reach / speed()
    deck = Deck("a crack that starts a delamination", end)
    deck.control(linear=True, damping=DAMPING, scheme=1)
    deck.mesh(mesh, [2 if abs(x - middle) < 1e-6 else 1 for x in centres])
    for part, share in ((1, 1.0), (2, WEAK)):
        deck.laminate(stack(strip, share), order=2, part=part)
    deck.cohesive(BOND, interface=1, parts=(1, 2))
    deck.hold(range(len(mesh.points)), "y")
    deck.hold_face(mesh.where(x=middle), BOTTOM, "x")
    deck.hold_face(mesh.where(x=0.0) + mesh.where(x=2.0 * middle), TOP, "z")
    bars = deck.node_set(mesh.where(x=ARM) + mesh.where(x=ARM + INNER))
    deck.add("BOUNDARY_FACE_MOTION", (bars, BOTTOM, 3, 0, slow_start(deck, TIME), speed()))
    often = TIME / 600.0
    deck.intervals(spcforc=often, glstat=often, delam=often, binary_d3plot=end / STATES)
    return Bent(strip, run(deck, folder))
