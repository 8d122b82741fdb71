"""A writer of small decks: comma-separated cards with all digits of every number."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from damage import DamagedPly
from elasticity import Array, Material
from meshes import Mesh

TOP, BOTTOM, PLANE = 1, -1, 0


@dataclass(frozen=True)
class Ply:
    """A ply of a stack, from the bottom up."""

    material: Material
    thickness: float
    angle: float = 0.0


@dataclass(frozen=True)
class Sphere:
    """A rigid impactor and how it touches the plate."""

    radius: float
    mass: float
    centre: tuple[float, float, float]
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    guided: bool = False
    gravity: float = 0.0
    method: int = 2  # 1: nodes on the sphere, 2: points of the plate
    spacing: float = 0.0
    face: int = TOP
    friction: tuple[float, ...] = ()  # FS, FD, DC
    rotates: bool = True
    inertia: float = 0.0
    weight: tuple[float, float] = (0.0, 0.0)  # acceleration along x and y
    curves: tuple[int, int, int] = (0, 0, 0)  # of a prescribed motion along x, y, z
    quantity: int = 0  # that these give: 0 velocity, 2 displacement
    shape: str = "SPHERE"  # or TUP, CYLINDER, CONE
    form: tuple[float, ...] = ()  # second card of these
    part: int = 1  # that it meets; 0 for all


@dataclass(frozen=True)
class Bond:
    """A softening interface; pairs are opening, sliding."""

    stiffness: tuple[float, float]
    strength: tuple[float, float]
    toughness: tuple[float, float]
    exponent: float  # above 0: power law; below 0: Benzeggagh-Kenane
    whole_penalty: bool = False
    friction: float = 0.0
    fit: int = 0
    by_work: bool = False  # mix of modes of the work so far
    pressure_gain: float = 0.0  # of the shear strength
    scatter: tuple[int, float, float] | None = None  # seed, modulus, length

    def toughness_of(self, mix: float) -> float:
        """Energy per crack area where shear has a share of the energy."""
        first, second = self.toughness
        if self.exponent < 0.0:
            return first + (second - first) * mix**-self.exponent
        powers = ((1.0 - mix) / first) ** self.exponent + (mix / second) ** self.exponent
        return powers ** (-1.0 / self.exponent)


class Deck:
    """Cards in the order in which they were asked for; nodes and quads are numbered from 0."""

    def __init__(self, title: str, end_time: float, end_cycle: int = 0) -> None:
        """Start a deck that runs up to a time, or to a cycle if that comes first."""
        self._cards: list[str] = []
        self._sets = 0
        self._curves = 0
        self._bonds = 0
        self._materials: list[Material] = []
        self.add("TITLE", title)
        self.add("CONTROL_TERMINATION", (end_time, end_cycle))

    def add(self, keyword: str, *cards: str | Sequence[object]) -> None:
        """Add a keyword with its cards, as text or as fields."""
        self._cards.append(f"*{keyword}")
        for card in cards:
            self._cards.append(card if isinstance(card, str) else _fields(card))

    def text(self) -> str:
        """The whole deck."""
        return "\n".join(["*KEYWORD", *self._cards, "*END", ""])

    def write(self, path: Path) -> Path:
        """Write the deck, and give its path back."""
        path.write_text(self.text())
        return path

    def control(
        self,
        *,
        linear: bool = False,
        damping: float = 0.0,
        share: float = 0.9,
        scheme: int = 0,
        largest: float = 0.0,
        scaled: float = 0.0,
    ) -> None:
        """Strain measure, damping per mass, share of the stable step, what is implicit, DTMAX.

        Mass is added where the stable step of an element is below `scaled`.
        """
        self.add("CONTROL_LAYERWISE", (0 if linear else 1, 0.05, scheme, largest))
        self.add("CONTROL_TIMESTEP", (0.0, share, 0, 0.0, -scaled) if scaled else (0.0, share))
        if damping > 0.0:
            self.add("DAMPING_GLOBAL", (0, damping))

    def mesh(self, mesh: Mesh, parts: Sequence[int] = (1,)) -> None:
        """Nodes and quads, all in one part or each in its own."""
        self.add("NODE", *[(i + 1, x, y, 0.0) for i, (x, y) in enumerate(mesh.points)])
        quads = [(i + 1, parts[i % len(parts)], *(quad + 1)) for i, quad in enumerate(mesh.quads)]
        if mesh.quads.shape[1] == 4:
            self.add("ELEMENT_SHELL", *quads)
        else:
            cards = [card for quad in quads for card in (quad[:2], quad[2:])]
            self.add("ELEMENT_PLATE_Q9", *cards)

    def laminate(
        self,
        plies: Sequence[Ply],
        order: int = 2,
        sublayers: int = 1,
        lobatto: bool = False,
        orders: Sequence[int] = (),
        part: int = 1,
    ) -> None:
        """A part: its stack and its expansion, of one order or one for each ply."""
        cards = [
            (self._material(ply.material), ply.thickness, ply.angle, 0, k + 1)
            for k, ply in enumerate(plies)
        ]
        self.add("PART_COMPOSITE_LONG", "laminate", (part, 0), *cards)
        choice = [(1, len(plies), order, sublayers)] if sublayers > 1 else []
        choice += [(k + 1, k + 1, own, sublayers) for k, own in enumerate(orders)]
        self.add("SECTION_LAYERWISE", (part, 0, order, int(lobatto)), *choice)

    def interfaces(self, normal: float = 0.0, shear: float = 0.0) -> None:
        """Springs between all plies of part 1; without stiffness, nothing between them."""
        if normal == 0.0:
            self.add("INTERFACE_COHESIVE", (1, 0, 0, -1))
            return
        self.add("MAT_COHESIVE_ELASTIC", (100, 0.0, 0, 0, shear, normal))
        self.add("INTERFACE_COHESIVE", (1, 0, 0, 100))

    def cohesive(
        self, bond: Bond, *, interface: int = 0, nodal: bool = False, parts: Sequence[int] = (1,)
    ) -> None:
        """A bond that fails between all plies of some parts, or at one interface only."""
        self._bonds += 1
        stiffness, toughness = bond.stiffness, bond.toughness
        head = (200 + self._bonds, 0.0, 0, 0, *stiffness, *toughness)
        self.add("MAT_COHESIVE_MIXED_MODE", head, (bond.exponent, *bond.strength))
        if bond.by_work or bond.pressure_gain:
            self.add("INTERFACE_LAW", (head[0], int(bond.by_work), bond.pressure_gain))
        if bond.scatter:
            self.add("INTERFACE_SCATTER", (head[0], *bond.scatter))
        options = (int(nodal), int(bond.whole_penalty), bond.friction, bond.fit)
        cards = [(part, interface, interface, head[0], *options) for part in parts]
        self.add("INTERFACE_COHESIVE", *cards)

    def node_set(self, nodes: Iterable[int]) -> int:
        """A new set of nodes, and its number."""
        self._sets += 1
        ids = [int(node) + 1 for node in nodes]
        lines = [ids[i : i + 8] for i in range(0, len(ids), 8)]
        self.add("SET_NODE_LIST", (self._sets,), *lines)
        return self._sets

    def curve(self, points: Iterable[tuple[float, float]]) -> int:
        """A new curve over time, and its number."""
        self._curves += 1
        self.add("DEFINE_CURVE", (self._curves,), *points)
        return self._curves

    def hold(self, nodes: Iterable[int], directions: str) -> None:
        """Hold nodes in some of "xyz", all planes."""
        flags = [int(direction in directions) for direction in "xyz"]
        self.add("BOUNDARY_SPC_SET", (self.node_set(nodes), 0, *flags))

    def hold_face(self, nodes: Iterable[int], face: int, directions: str, z: float = 0.0) -> None:
        """Hold nodes in some of "xyz" on a face, or on the plane at a height."""
        flags = [int(direction in directions) for direction in "xyz"]
        self.add("BOUNDARY_FACE", (self.node_set(nodes), face, z, *flags))

    def move(self, nodes: Iterable[int], direction: int, curve: int, scale: float) -> None:
        """Prescribe the displacement of nodes along 1, 2 or 3, all planes."""
        fields = (self.node_set(nodes), direction, 2, curve, scale)
        self.add("BOUNDARY_PRESCRIBED_MOTION_SET", fields)

    def move_face(
        self, nodes: Iterable[int], face: int, direction: int, curve: int, scale: float
    ) -> None:
        """Prescribe the displacement of nodes along 1, 2 or 3, on a face."""
        fields = (self.node_set(nodes), face, direction, 2, curve, scale)
        self.add("BOUNDARY_FACE_MOTION", fields)

    def velocity(self, nodes: Iterable[int], velocity: Sequence[float]) -> None:
        """Give nodes a velocity at the start."""
        self.add("INITIAL_VELOCITY", (self.node_set(nodes),), velocity)

    def velocities(self, velocities: Array) -> None:
        """Give every node its own velocity at the start, (nodes, 3)."""
        cards = [(i + 1, *velocity) for i, velocity in enumerate(velocities)]
        self.add("INITIAL_VELOCITY_NODE", *cards)

    def face_forces(self, forces: Array, direction: int, curve: int, face: int = TOP) -> None:
        """A force at every node of a face, (nodes,), times a curve."""
        cards = [
            (i + 1, face, direction, curve, force) for i, force in enumerate(forces) if force != 0.0
        ]
        self.add("LOAD_FACE_POINT", *cards)

    def sphere(self, sphere: Sphere, number: int = 1) -> None:
        """An impactor and its contact."""
        s = sphere
        freedom = 1 if s.guided else 0 if s.rotates else 2
        cards: list[tuple[object, ...]] = [(number, s.radius, s.mass, *s.centre)]
        if s.shape == "SPHERE":
            cards.append((*s.velocity, freedom, s.gravity, 0))
        else:
            cards += [s.form, (*s.velocity, freedom, s.gravity)]
        if s.inertia or any(s.weight) or any(s.curves):
            inertia = (s.inertia,) if s.shape == "SPHERE" else ()
            cards.append((*inertia, *s.weight, *s.curves, s.quantity))
        self.add(f"IMPACTOR_{s.shape}", *cards)
        contact = [(number, number, s.part, s.face, s.method, s.spacing)]
        self.add("CONTACT_IMPACTOR", *contact, *([s.friction] if s.friction else []))

    def profile(self, number: int, x: float, y: float, interval: float, points: int = 5) -> None:
        """Stress through the thickness at a place."""
        self.add("DATABASE_PROFILE", (number, x, y, points, interval))

    def histories(self, nodes: Iterable[int], interval: float) -> None:
        """Histories of some nodes."""
        self.add("DATABASE_HISTORY_NODE_SET", (self.node_set(nodes),))
        self.add("DATABASE_NODOUT", (interval,))

    def intervals(self, **seconds: float) -> None:
        """Intervals of glstat, spcforc, impactor or binary_d3plot."""
        for name, interval in seconds.items():
            self.add(f"DATABASE_{name.upper()}", (interval,))

    def _material(self, material: Material) -> int:
        """Number of a material, written when it is new."""
        if material not in self._materials:
            self._materials.append(material)
            m, number = material, len(self._materials)
            first = (number, m.density, *m.young, *m.poisson)
            if isinstance(m, DamagedPly):
                self.add("MAT_PLY_CODAM2", *m.cards(number))
            else:
                self.add("MAT_PLY_ELASTIC", first, m.shear)
        return self._materials.index(material) + 1


def _fields(values: Sequence[object]) -> str:
    """One card in free format; a comma at the end marks a single field as free format too."""
    return ",".join(_field(value) for value in values) + ("," if len(values) == 1 else "")


def _field(value: object) -> str:
    """All digits of a number."""
    return repr(float(value)) if isinstance(value, float | np.floating) else str(value)


def ramp(until: float, steps: int = 20) -> list[tuple[float, float]]:
    """A curve that rises from 0 to 1 along half a cosine and stays there."""
    return [
        (until * k / steps, 0.5 * (1.0 - float(np.cos(np.pi * k / steps))))
        for k in range(steps + 1)
    ]
