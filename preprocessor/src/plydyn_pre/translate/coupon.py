"""A translated deck as a study, where it is a standard coupon: what a recipe can say."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from plydyn_pre.errors import PreError
from plydyn_pre.mesh import Rectangle
from plydyn_pre.study import (
    Bar,
    Contact,
    Control,
    Curve,
    Fixture,
    Impactor,
    Laminate,
    Outputs,
    PlaceSet,
    Plane,
    PlyCodam2,
    Punch,
    Ring,
    Study,
    Support,
    Units,
)
from plydyn_pre.study.materials import Material
from plydyn_pre.translate.control import step_of
from plydyn_pre.translate.deck import Plate
from plydyn_pre.translate.rigid import Rigid, reach_of
from plydyn_pre.translate.shears import shear_points
from plydyn_pre.translate.stack import with_mid_sides

_EQUAL = 1e-4  # of a quad, by which corners may lie off a grid
#: Intervals of outputs by their keywords
_OUTPUTS = {
    "DATABASE_RCFORC": "impactor_interval",
    "DATABASE_BINARY_D3PLOT": "field_interval",
    "DATABASE_GLSTAT": "energy_interval",
    "DATABASE_SPCFORC": "support_interval",
}

#: Fields of a part of a study
Given = dict[str, Any]


@dataclass
class Coupon:
    """A deck as a study; causes say why it is none."""

    plate: Plate
    causes: list[str] = field(default_factory=list)
    curves: dict[str, Curve] = field(default_factory=dict)
    sets: dict[str, PlaceSet] = field(default_factory=dict)

    def study(self, title: str, units: Given) -> Study | None:
        """The study of a standard coupon; None where there are causes."""
        materials, laminate = self._laminate()
        mesh = self._mesh()
        moving = [rigid for rigid in self.plate.rigid if rigid.moves]
        still = [rigid for rigid in self.plate.rigid if not rigid.moves]
        impactor, contact = self._impactor(moving)
        supports = self._supports(mesh) if mesh else ()
        fixtures = tuple(f for f in map(self._fixture, still) if f is not None)
        self._others()
        if self.causes or mesh is None or laminate is None:
            return None
        parts: Given = {"supports": supports, "fixtures": fixtures, "impactor": impactor}
        parts |= {"contact": contact, "curves": self.curves, "sets": self.sets}
        parts |= {"units": Units(**units) if units else Units()}
        rest: Given = {"control": self._control(), "outputs": self._outputs()}
        try:
            return Study(
                title=title, materials=materials, mesh=mesh, laminate=laminate, **rest, **parts
            )
        except PreError as error:
            self.causes.append(f"{error}")
            return None

    def _laminate(self) -> tuple[dict[str, Material], Laminate | None]:
        """The materials by their names, and the laminate."""
        if len(self.plate.laminates) > 1:
            self.causes.append("its plies differ from place to place")
            return {}, None
        plies = self.plate.laminates[0]
        kinds = list(dict.fromkeys((mid, thickness) for mid, thickness, _ in plies))
        single = len(kinds) == 1
        names = {kind: "ply" if single else f"ply-{n}" for n, kind in enumerate(kinds, start=1)}
        materials: dict[str, Material] = {}
        for (mid, _), name in zip(kinds, names.values(), strict=True):
            if mid not in self.plate.made:
                self.causes.append("*MAT_CODAM2 has no recipe: ply_codam2 is another law")
                return {}, None
            materials[name] = made = self.plate.made[mid]
            if isinstance(made, PlyCodam2) and made.shear_curve:
                points = shear_points(self.plate.model, self.plate.bodies.laws[mid])
                self._curve(made.shear_curve, points)
        words = [
            f"{'' if single else names[mid, thickness] + ':'}{angle:.12g}"
            for mid, thickness, angle in plies
        ]
        half = len(words) // 2
        mirrored = len(words) > 1 and len(words) % 2 == 0 and words == words[::-1]
        layup = f"[{'/'.join(words[:half])}]s" if mirrored else f"[{'/'.join(words)}]"
        thickness = kinds[0][1] if single else {name: kind[1] for kind, name in names.items()}
        material = "ply" if single else ""
        given: Given = {"layup": layup, "thickness": thickness, "material": material}
        return materials, self._joined(materials, given)

    def _joined(self, materials: dict[str, Material], given: Given) -> Laminate | None:
        """The laminate with what joins its plies."""
        joints = self.plate.joints
        laws = list(dict.fromkeys(joint.law for joint in joints))
        if any(joint.friction for joint in joints) or len(laws) > 1:
            self.causes.append("its interfaces differ, or have a friction of their own")
            return None
        if not joints:
            return Laminate(**given)
        if laws[0] is not None:
            materials["bond"] = laws[0]
        name = "bond" if laws[0] is not None else "apart"
        for words in (name, f"{name} between unlike plies"):
            laminate = Laminate(**given, interfaces=words)
            if set(laminate.opened) == {joint.interface for joint in joints}:
                return laminate
        self.causes.append("some plies are joined by an interface, and others are tied")
        return None

    def _mesh(self) -> Rectangle | None:
        """The rectangle of the mesh."""
        stack = self.plate.stack
        corners = {n: stack.places[n] for quad in stack.quads for n in quad[:4]}
        low, high = ([f(p[i] for p in corners.values()) for i in (0, 1)] for f in (min, max))
        first = [corners[n] for n in stack.quads[0][:4]]
        step = [max(p[i] for p in first) - min(p[i] for p in first) for i in (0, 1)]
        counts = [round((high[i] - low[i]) / step[i]) if step[i] > 0.0 else 0 for i in (0, 1)]
        cells = [(high[i] - low[i]) / counts[i] if counts[i] else 0.0 for i in (0, 1)]
        equal = min(counts) > 0 and counts[0] * counts[1] == len(stack.quads)
        for quad in stack.quads if equal else ():
            for n in quad:
                halves = [2.0 * (stack.places[n][i] - low[i]) / cells[i] for i in (0, 1)]
                equal = equal and all(abs(h - round(h)) <= _EQUAL for h in halves)
        if not equal:
            words = "its mesh is no grid of equal quads over a rectangle"
            self.causes.append(f"{words}; a recipe with a mesh of kind gmsh reads its file")
            return None
        sides = (_six(high[0] - low[0]), _six(high[1] - low[1]))
        return Rectangle(sides, (counts[0], counts[1]), corner=(_six(low[0]), _six(low[1])))

    def _supports(self, mesh: Rectangle) -> tuple[Support, ...]:
        """Edges, or boxes of nodes, that are held."""
        stack, found = self.plate.stack, list[Support]()
        edges = _edges(mesh, stack.places)
        for support in self.plate.supports:
            if support.lcid >= 0:
                self.causes.append(f"{support.title} moves or is let go: no support of a coupon")
                continue
            ids = set(support.ids)
            names = [name for name, nodes in edges.items() if nodes <= ids]
            whole = set().union(*(edges[name] for name in names)) == ids
            names = ["boundary"] if len(names) == len(edges) and whole else names
            if not whole:
                names = self._boxed(ids, len(found) + 1)
            at: dict[str, Any] = {}
            if support.height is not None:
                at = {"face": "plane", "height": _six(support.height - stack.middle)}
            found += [Support(name, support.held, **at) for name in names]
            if not names:
                self.causes.append(f"{support.title} holds neither edges nor all nodes of a box")
        return tuple(found)

    def _boxed(self, ids: set[int], number: int) -> list[str]:
        """The name of a set of nodes that are all those of a box; nothing for others."""
        places = self.plate.stack.places
        spans = [[f(places[n][i] for n in ids) for f in (min, max)] for i in (0, 1)]
        (x0, x1), (y0, y1) = spans
        inside = {n for n, (x, y) in places.items() if x0 <= x <= x1 and y0 <= y <= y1}
        corners = {n for quad in self.plate.stack.quads for n in quad[:4]}
        if not inside & corners <= ids or set(with_mid_sides(self.plate.stack, ids)) != ids:
            return []
        name = f"held-{number}"
        self.sets[name] = PlaceSet(box=(x0, x1, y0, y1))
        return [name]

    def _impactor(self, moving: list[Rigid]) -> tuple[Impactor | None, Contact | None]:
        """The impactor and its contact."""
        if not moving:
            return None, None
        rigid, shape = moving[0], moving[0].shape
        if len(moving) > 1:
            self.causes.append("it has several impactors; a recipe has stages for them")
        if shape.kind == "bar":
            self.causes.append("a lying cylinder is no impactor of a coupon")
            return None, None
        if rigid.freedom == 2 or set(rigid.curves) - {"z"}:
            self.causes.append("its impactor moves aside without turning, or along a curve")
        stack, z = self.plate.stack, shape.centre[2]
        gap = z - reach_of(shape) - stack.top if rigid.above else stack.bottom - z - reach_of(shape)
        given: Given = {"radius": shape.radius, "mass": rigid.mass, "kind": shape.kind}
        given |= {"position": shape.centre[:2], "gap": max(0.0, _six(gap))}
        given |= {"guided": rigid.freedom == 1, "velocity": tuple(map(float, rigid.velocity))}
        given |= {"length": shape.length} if shape.kind != "sphere" else {}
        given |= {"angle": shape.angle, "tip": shape.tip} if shape.kind == "cone" else {}
        given |= {"edge": shape.edge} if shape.edge else {}
        if "z" in rigid.curves:
            kind = ("velocity", "acceleration", "displacement")[rigid.quantity]
            given |= {"motion_z": self._curve("motion", rigid.curves["z"]), "motion": kind}
        try:
            return Impactor(**given), Contact(method="points_on_plate", **_touch(rigid))
        except PreError as error:
            self.causes.append(f"impactor: {error}")
            return None, None

    def _curve(self, name: str, points: list[tuple[float, float]]) -> str:
        """The name of a curve."""
        times, values = zip(*points, strict=True)
        self.curves[name] = Curve(times, values)
        return name

    def _fixture(self, rigid: Rigid) -> Fixture | None:
        """A fixture."""
        shape = rigid.shape
        given = _touch(rigid) | {"gap": rigid.gap}
        for axis, points in rigid.curves.items():
            given[f"move_{axis}"] = self._curve(f"move-{axis}-{len(self.curves)}", points)
        centre = shape.centre[:2]
        window = shape.sides if min(shape.sides) > 0.0 else 0.0
        makers: dict[str, Callable[[], Fixture]] = {
            "plane": lambda: Plane(**given, window=window, centre=centre),
            "ring": lambda: Ring(**given, inner=shape.inner, outer=shape.radius, centre=centre),
            "punch": lambda: Punch(**given, size=shape.sides, centre=centre),
            "cylinder": lambda: Punch(
                **given, size=2.0 * shape.radius, centre=centre, edge=shape.edge
            ),
            "bar": lambda: Bar(**given, radius=shape.radius, **_ends(rigid)),
        }
        return makers[shape.kind]()

    def _others(self) -> None:
        """Tell what a coupon has not."""
        plate = self.plate
        for words, found in (
            ("forces at nodes", plate.forces),
            ("pressures", plate.pressures),
            ("gravity", plate.gravity),
            ("velocities of its plate at time zero", plate.velocities),
            ("histories of single nodes", plate.history),
        ):
            if found:
                self.causes.append(f"it has {words}, which no coupon has")

    def _control(self) -> Control:
        """The end, the step and the damping."""
        share, scaled = step_of(self.plate.model)
        damping = self.plate.model.first("DAMPING_GLOBAL")
        given: Given = {"end_time": self.plate.model.end, "step_factor": share}
        given |= {"mass_scaled_step": -scaled} if scaled else {}
        return Control(**given, damping=float(damping.raw("VALDMP", 0.0)) if damping else 0.0)

    def _outputs(self) -> Outputs:
        """The intervals of outputs."""
        given: Given = {}
        for name, key in _OUTPUTS.items():
            block = self.plate.model.first(name)
            if block is not None and float(block.raw("DT", 0.0)) > 0.0:
                given[key] = float(block.raw("DT"))
        return Outputs(**given)


def _touch(rigid: Rigid) -> Given:
    """The face that a body meets, and its friction."""
    friction = dict(zip(("friction", "dynamic_friction", "decay"), rigid.friction, strict=True))
    return {"face": "top" if rigid.above else "bottom", **friction}


def _six(value: float) -> float:
    """A length with nine digits; round-off of a difference is none."""
    return float(f"{value:.9g}")


def _edges(mesh: Rectangle, places: dict[int, tuple[float, float]]) -> dict[str, set[int]]:
    """The nodes of the edges of a rectangle."""
    found = {}
    for axis, names in ((0, ("left", "right")), (1, ("bottom", "top"))):
        slack = _EQUAL * mesh.sides[axis] / mesh.quads[axis]
        for name, level in zip(names, (0.0, mesh.sides[axis]), strict=True):
            at = mesh.corner[axis] + level
            found[name] = {n for n, place in places.items() if abs(place[axis] - at) <= slack}
    return found


def _ends(rigid: Rigid) -> Given:
    """Both ends of a bar."""
    x, y = rigid.shape.centre[:2]
    half = [0.5 * rigid.shape.length * a for a in rigid.shape.axis[:2]]
    return {"start": (x - half[0], y - half[1]), "end": (x + half[0], y + half[1])}
