"""One impact as an input file of Abaqus in many forms: parts that a test puts together."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from foreign_decks import MASS, PER_SIDE, QUADS, RADIUS, SIDE, rim, sphere_profile

GAP, SPEED, END = 0.02, 4000.0, 1.2e-4
ANGLES = (0.0, 90.0, 90.0, 0.0)
CONSTANTS = (153000.0, 10300.0, 10300.0, 0.300058252427184, 0.300058252427184, 0.4, 6000.0, 6000.0)
ENGINEERING = ", ".join(map(str, CONSTANTS)) + "\n3700.0"
LAMINA = "153000., 10300., 0.300058252427184, 6000., 6000., 3700."
HASHIN = (
    "*Damage Initiation, criterion=HASHIN\n1500., 1200., 50., 200., 75., 65.\n"
    "*Damage Evolution, type=ENERGY\n91.6, 79.9, 0.22, 1.1"
)
COHESIVE = (
    "*Elastic, type=TRACTION",
    "1e5, 4e4, 4e4",
    "*Damage Initiation, criterion=QUADS",
    "60., 90., 90.",
    "*Damage Evolution, type=ENERGY, mixed mode behavior=BK, power=1.5",
    "0.3, 0.8, 0.8",
)
BY_SEPARATION = "*Damage Evolution, type=DISPLACEMENT\n0.01,"


@dataclass
class Abaqus:
    """Lines of an input file."""

    lines: list[str] = field(default_factory=lambda: ["*Heading", "the same impact"])
    node: int = 0
    element: int = 0

    def put(self, name: str, *data: str) -> None:
        """A keyword with its lines of data."""
        self.lines += [f"*{name}", *data]

    def nodes(self, places: Iterable[tuple[float, float, float]], more: str = "") -> list[int]:
        """Nodes."""
        first = self.node + 1
        rows = []
        for x, y, z in places:
            self.node += 1
            rows.append(f"{self.node}, {x:.8f}, {y:.8f}, {z:.8f}")
        self.put(f"Node{more}", *rows)
        return list(range(first, self.node + 1))

    def layer(self, z: float = 0.0) -> list[int]:
        """Nodes of the plate at a height, row by row."""
        step = SIDE / QUADS
        return self.nodes((i * step, j * step, z) for j in range(PER_SIDE) for i in range(PER_SIDE))

    def elements(self, kind: str, name: str, rows: Iterable[Sequence[int]]) -> None:
        """Elements of a type, as a set."""
        lines = []
        for ids in rows:
            self.element += 1
            lines.append(f"{self.element}, " + ", ".join(map(str, ids)))
        self.put(f"Element, type={kind}, elset={name}", *lines)

    def quads(self, kind: str, name: str, *layers: list[int]) -> None:
        """Quads of a layer, or bricks between two."""
        rows = []
        for j in range(QUADS):
            for i in range(QUADS):
                at = [PER_SIDE * j + i, PER_SIDE * j + i + 1]
                at += [at[1] + PER_SIDE, at[0] + PER_SIDE]
                rows.append([layer[k] for layer in layers for k in at])
        self.elements(kind, name, rows)

    def set_of(self, kind: str, name: str, ids: Sequence[int]) -> None:
        """A set."""
        rows = [", ".join(map(str, ids[k : k + 16])) for k in range(0, len(ids), 16)]
        self.put(f"{kind}set, {kind.lower()}set={name}", *rows)

    def plate(
        self, angles: Sequence[float] = ANGLES, kind: str = "S4R", z: float = 0.0
    ) -> list[int]:
        """A plate of shells."""
        ids = self.layer(z)
        self.quads(kind, "Plate", ids)
        rows = [f"0.125, 3, CFRP, {angle}, Ply-{n}" for n, angle in enumerate(angles, start=1)]
        self.put("Shell Section, elset=Plate, composite", *rows)
        self.put("Surface, type=ELEMENT, name=Top", "Plate, SPOS")
        return ids

    def material(self, elastic: str = ENGINEERING, more: str = "", kind: str = "") -> None:
        """The ply."""
        kind = kind or ("LAMINA" if elastic == LAMINA else "ENGINEERING CONSTANTS")
        lines = (f"Elastic, type={kind}", elastic, *([more] if more else []))
        self.put("Material, name=CFRP", "*Density", "1.6e-9,", f"*{lines[0]}", *lines[1:])

    def ball(self, top: float = 0.25, meshed: bool = False) -> None:
        """A guided ball above the plate: an analytical one, or a mesh."""
        z = top + GAP + RADIUS
        (reference,) = self.nodes([(SIDE / 2, SIDE / 2, z)], ", nset=RP")
        if meshed:
            ids = self.revolved(top)
            self.elements("R3D4", "Ball", ids)
            self.put("Rigid Body, ref node=RP, elset=Ball")
            self.put("Surface, type=ELEMENT, name=Ball", "Ball, SPOS")
        else:
            axis = f"{SIDE / 2}, {SIDE / 2}, {z}, {SIDE / 2}, {SIDE / 2}, {z + 1.0}"
            arcs = ("START, 0., -8.", "CIRCL, 8., 0., 0., 0.", "CIRCL, 0., 8., 0., 0.")
            self.put("Surface, type=REVOLUTION, name=Ball", axis, *arcs)
            self.put("Rigid Body, ref node=RP, analytical surface=Ball")
        self.elements("MASS", "Mass", [[reference]])
        self.put("Mass, elset=Mass", f"{MASS},")
        self.put("Boundary", "RP, 1, 2", "RP, 4, 6")

    def revolved(self, top: float) -> list[list[int]]:
        """Quads of the lower half of a ball."""
        from math import cos, pi, sin

        profile, around = sphere_profile(top, GAP), 12
        ids = self.nodes(
            (SIDE / 2 + r * cos(2 * pi * i / around), SIDE / 2 + r * sin(2 * pi * i / around), z)
            for r, z in profile
            for i in range(around)
        )
        pairs = [(j, i) for j in range(len(profile) - 1) for i in range(around)]
        found = []
        for j, i in pairs:
            a, b = around * j + i, around * j + (i + 1) % around
            found.append([ids[a], ids[b], ids[b + around], ids[a + around]])
        return found

    def held(self, *layers: list[int]) -> None:
        """Hold the edges."""
        self.set_of("N", "Edge", [n for layer in layers for n in rim(layer)])
        self.put("Boundary", "Edge, ENCASTRE")

    def moved(self) -> None:
        """The velocity of the ball."""
        self.put("Initial Conditions, type=VELOCITY", f"RP, 3, {-SPEED}")

    def step(self, contact: str = "*Contact Pair, interaction=Int\nTop, Ball") -> str:
        """The step, and the text of the file."""
        self.put("Surface Interaction, name=Int", "*Friction", "0.2,")
        self.put("Step, name=Impact, nlgeom=YES", "*Dynamic, Explicit", f", {END}")
        self.put("Output, history, time interval=1e-6", "*Contact Output", "CFN,")
        self.lines += [*contact.splitlines(), "*End Step"]
        return "\n".join(self.lines) + "\n"


def standard(meshed: bool = False) -> str:
    """Shells of four plies below a ball."""
    deck = Abaqus()
    plate = deck.plate()
    deck.material()
    deck.ball(meshed=meshed)
    deck.held(plate)
    deck.moved()
    return deck.step()


def stacked(joint: str) -> str:
    """Two plies with a bond between them: elements, a contact, or a tie."""
    deck = Abaqus()
    lower, upper = deck.layer(0.125), deck.layer(0.375)
    for k, layer in enumerate((lower, upper)):
        deck.quads("S4R", f"Half-{k}", layer)
        deck.put(f"Shell Section, elset=Half-{k}, composite", f"0.25, 3, CFRP, {90.0 * k}")
        deck.put(f"Surface, type=ELEMENT, name=Up-{k}", f"Half-{k}, SPOS")
        deck.put(f"Surface, type=ELEMENT, name=Down-{k}", f"Half-{k}, SNEG")
    contact = "*Contact Pair, interaction=Int\nUp-1, Ball\n"
    if joint == "elements":
        deck.quads("COH3D8", "Bond", lower, upper)
        deck.put(
            "Cohesive Section, elset=Bond, material=Glue, response=TRACTION SEPARATION", "1.0,"
        )
        deck.put("Material, name=Glue", *COHESIVE)
    elif joint == "contact":
        lines = ("*Cohesive Behavior", *COHESIVE[1:])
        deck.put("Surface Interaction, name=Glue", *lines)
        contact += "*Contact Pair, interaction=Glue\nUp-0, Down-1\n"
    elif joint == "general":
        deck.put("Surface Interaction, name=Glue", "*Cohesive Behavior", *COHESIVE[1:])
        contact = (
            "*Contact\n*Contact Inclusions, ALL EXTERIOR\n*Contact Property Assignment\n"
            ", , Int\nUp-0, Down-1, Glue\n"
        )
    else:
        deck.put("Tie, name=Glue, adjust=no", "Up-0, Down-1")
    deck.material()
    deck.ball(0.5)
    deck.held(lower, upper)
    deck.moved()
    return deck.step(contact)
