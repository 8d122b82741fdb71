"""Stacked parts as one laminate on a plane mesh of quads with nine nodes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from itertools import pairwise
from math import atan2, degrees, isclose, nan
from typing import Any

from plydyn_pre.translate.bodies import Bodies
from plydyn_pre.translate.elements import Body, Element
from plydyn_pre.translate.layups import Ply
from plydyn_pre.translate.model import Model, Place
from plydyn_pre.translate.sets import faces_of

_FLAT = 1e-6  # of the size of the plate
_TOUCHING = 0.02  # of the thickness of a layer by which it may lie above or inside another one
_UNIFORM = 1.0  # degrees between the first edges of elements of one direction

Key = tuple[int, int]
Quad = tuple[int, ...]


@dataclass(frozen=True)
class Zone:
    """Elements of a layer with the same plies."""

    elements: frozenset[int]
    plies: list[Ply]  # from the bottom up
    turned: bool  # whether their normal is down, and their angles run clockwise
    first_edge: float  # direction of their first edges, degrees; nan if it varies
    kind: str = "shell"  # shell, tshell or solid
    flat: bool = True  # whether nodes 1 to 4 lie along the plate

    def angle(self, base: float, ply: Ply) -> float:
        """Angle of a ply from x, whose material has its axis at an angle."""
        return base - ply.angle if self.turned else base + ply.angle


@dataclass
class Layer:
    """Parts of the stack side by side, between two heights."""

    body: Body
    bottom: float
    top: float
    quads: dict[int, Quad]  # nodes of the lower face, counter-clockwise, by element
    upper: dict[int, Quad]  # nodes of the upper face; those of the lower one for shells
    zones: list[Zone]  # whose plies have the same thicknesses
    pids: set[int] = field(default_factory=set)
    middles: dict[frozenset[int], int] = field(default_factory=dict)  # between two corners

    @property
    def plies(self) -> list[Ply]:
        """Plies of the first zone."""
        return self.zones[0].plies

    @property
    def nodes(self) -> set[int]:
        """Nodes of both faces."""
        faces = (*self.quads.values(), *self.upper.values())
        return {node for quad in faces for node in quad}


@dataclass
class Stack:
    """A laminate and its plane mesh."""

    layers: list[Layer]
    places: dict[int, tuple[float, float]] = field(default_factory=dict)
    quads: list[Quad] = field(default_factory=list)  # nine nodes each
    zones: list[tuple[int, ...]] = field(default_factory=list)  # of each quad, in every layer
    column_of: dict[int, int] = field(default_factory=dict)  # any node of the plate, to the plane
    edges: dict[tuple[int, int], int] = field(default_factory=dict)  # corners, to their mid-side
    number_of: dict[frozenset[int], int] = field(default_factory=dict)  # corners, to their quad

    @property
    def middle(self) -> float:
        """Height of the middle."""
        return self.bottom + 0.5 * self.thickness

    @property
    def bottom(self) -> float:
        """Height of the bottom face."""
        return self.layers[0].bottom

    @property
    def top(self) -> float:
        """Height of the top face."""
        return self.bottom + self.thickness

    @property
    def thickness(self) -> float:
        """Thickness of all plies."""
        return sum(ply.thickness for layer in self.layers for ply in layer.plies)

    def quad_of(self, nodes: Iterable[int]) -> int:
        """The number of the quad below or above some nodes; 0 for none."""
        corners = frozenset(self.column_of.get(n, 0) for n in nodes)
        return self.number_of.get(corners, 0)


def read_stack(model: Model, bodies: Bodies) -> Stack:
    """The parts of a plate, one over the other."""
    places = [bodies.nodes[n] for body in bodies.plates for n in body.nodes]
    size = max(max(p[i] for p in places) - min(p[i] for p in places) for i in (0, 1))
    slack = _FLAT * size
    layers: list[Layer] = []
    before = len(model.problems)
    for body in bodies.plates:
        with model.gathered():
            layers += _layers(body, bodies.nodes, slack)
    if len(model.problems) > before:
        return Stack([])
    layers = _joined(sorted(layers, key=lambda layer: layer.bottom + layer.top), slack)
    stack = Stack(layers)
    _mesh(stack, bodies.nodes, slack)
    _tell_gaps(model, layers)
    return stack


def _tell_gaps(model: Model, layers: list[Layer]) -> None:
    """Tell of layers that do not lie on each other, as those of the new deck do."""
    for lower, upper in pairwise(layers):
        gap = upper.bottom - lower.top
        thin = min(layer.top - layer.bottom for layer in (lower, upper))
        if abs(gap) <= _TOUCHING * thin:
            continue
        where = f"{abs(gap):.3g} {'above' if gap > 0.0 else 'inside'} part {lower.body.pid}"
        words = f"part {upper.body.pid} begins {where}"
        if gap > thin:
            words = f"{words}, further than it is thick: plies of a plate lie on each other"
            upper.body.block.lose(words, "PID")
            continue
        change = "thinner" if gap > 0.0 else "thicker"
        model.notes.append(f"{words}; it is put onto it, so that the plate is {change} by that")


def _layers(body: Body, nodes: dict[int, Place], slack: float) -> list[Layer]:
    """The layers of a part: one, or one for each height of its bricks."""
    if body.kind == "shell":
        return [_shells(each, nodes, slack) for each in _by_side(body, nodes)]
    levels: dict[tuple[int, ...], list[tuple[Element, Quad, Quad]]] = {}
    for element in body.elements:
        low, high = _ends(body, element, nodes)
        heights = [sum(nodes[n][2] for n in face) / 4.0 for face in (low, high)]
        key = (round(heights[0] / (4.0 * slack)), round(heights[1] / (4.0 * slack)))
        first = set(element.nodes[:4])
        side = 0 if first == set(low) else 1 if first == set(high) else 2
        levels.setdefault((*key, side), []).append((element, low, high))
    found = [_bricks(body, rows, nodes, slack) for _, rows in sorted(levels.items())]
    return [_with_plies(each, body) for each in found]


def _with_plies(layer: Layer, body: Body) -> Layer:
    """A layer with the plies of its part, which are as thick as it together."""
    (zone,) = layer.zones
    plies = body.plies[::-1] if zone.turned else body.plies
    share = (layer.top - layer.bottom) / sum(ply.thickness for ply in plies)
    return replace(layer, zones=[replace(zone, plies=[ply.turned(0.0, share) for ply in plies])])


def _by_side(body: Body, nodes: dict[int, Place]) -> list[Body]:
    """A part of shells, or one of those whose normal is up and one of the others."""
    found: dict[bool, list[Element]] = {}
    for element in body.elements:
        if element.triangle:
            words = (
                f"element {element.number} is a triangle: part {body.pid} of a plate needs quads"
            )
            raise element.block.fail("N4", words, element.row.line)
        area = twice_area(element.nodes, nodes)
        if area == 0.0:
            words = f"element {element.number} has no area seen along z, across which plates lie"
            raise element.block.fail("N1", words, element.row.line)
        found.setdefault(area > 0.0, []).append(element)
    return [replace(body, elements=elements) for elements in found.values()]


def _shells(body: Body, nodes: dict[int, Place], slack: float) -> Layer:
    """The layer of shells whose normals look the same way."""
    level = _height(body, list(body.nodes), nodes, slack)
    turned = twice_area(body.elements[0].nodes, nodes) < 0.0
    side = -1.0 if turned else 1.0
    middle = level + side * (body.offset - 0.5 * body.reference * body.thickness)
    half = 0.5 * body.thickness
    quads = {e.number: (e.nodes[0], *e.nodes[:0:-1]) if turned else e.nodes for e in body.elements}
    plies = body.plies[::-1] if turned else body.plies
    edge = _direction([element.nodes[:2] for element in body.elements], nodes)
    zones = [Zone(frozenset(quads), plies, turned, edge)]
    found = Layer(body, middle - half, middle + half, quads, quads, zones, {body.pid})
    for element in body.elements:
        found.middles |= element.middles(nodes)
    return found


def _bricks(
    body: Body, rows: list[tuple[Element, Quad, Quad]], nodes: dict[int, Place], slack: float
) -> Layer:
    """A layer of bricks or thick shells."""
    low = _height(body, [n for _, face, _ in rows for n in face], nodes, slack)
    high = _height(body, [n for _, _, face in rows for n in face], nodes, slack)
    lower = {e.number: face for e, face, _ in rows}
    upper = {e.number: face for e, _, face in rows}
    first = set(rows[0][0].nodes[:4])
    turned, flat = first == set(rows[0][2]), first in (set(rows[0][1]), set(rows[0][2]))
    edge = _direction([element.nodes[:2] for element, _, _ in rows], nodes)
    zones = [Zone(frozenset(lower), body.plies, turned, edge, body.kind, flat)]
    return Layer(body, low, high, lower, upper, zones, {body.pid})


def _ends(body: Body, element: Element, nodes: dict[int, Place]) -> tuple[Quad, Quad]:
    """The lower and the upper face of a brick, counter-clockwise from above."""
    faces = faces_of(element.nodes)
    if body.kind == "tshell":
        faces = faces[:2]
    if len(set(element.nodes)) < 8:
        words = f"element {element.number} has fewer than eight corners: plies need bricks"
        raise element.block.fail("N5", words, element.row.line)
    mean = [sum(nodes[n][2] for n in face) / 4.0 for face in faces]
    ends = []
    for choose in (min, max):
        face = faces[mean.index(choose(mean))]
        ends.append(face if twice_area(face, nodes) > 0.0 else (face[0], *face[:0:-1]))
    return ends[0], ends[1]


def _height(body: Body, ids: list[int], nodes: dict[int, Place], slack: float) -> float:
    """The height that some nodes have in common."""
    heights = [nodes[n][2] for n in ids]
    if max(heights) - min(heights) > max(slack, 1e-3 * body.thickness * (body.kind == "shell")):
        words = f"part {body.pid} lies between z = {min(heights):g} and {max(heights):g}"
        raise body.block.fail("PID", f"{words}; plates of plydyn are flat, at one z")
    return sum(heights) / len(heights)


def twice_area(quad: Quad, nodes: dict[int, Place]) -> float:
    """Twice the area of a quad from above, negative if it runs clockwise."""
    corners = [nodes[n] for n in quad]
    pairs = zip(corners, [*corners[1:], corners[0]], strict=True)
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in pairs)


def _direction(edges: list[tuple[int, ...]], nodes: dict[int, Place]) -> float:
    """The direction of edges from x, degrees; nan if it varies."""
    angles = []
    for first, second in edges:
        a, b = nodes[first], nodes[second]
        angles.append(degrees(atan2(b[1] - a[1], b[0] - a[0])))
    off = [abs((angle - angles[0] + 180.0) % 360.0 - 180.0) for angle in angles]
    return angles[0] if max(off) <= _UNIFORM else nan


def _joined(layers: list[Layer], slack: float) -> list[Layer]:
    """Layers of one height as one."""
    found: list[Layer] = []
    for layer in layers:
        last = found[-1] if found else None
        near = 4.0 * slack + 1e-6 * (layer.top - layer.bottom)
        if (
            last
            and isclose(last.bottom, layer.bottom, abs_tol=near)
            and isclose(last.top, layer.top, abs_tol=near)
        ):
            joined: dict[str, Any] = {
                "quads": last.quads | layer.quads,
                "upper": last.upper | layer.upper,
                "pids": last.pids | layer.pids,
                "middles": last.middles | layer.middles,
                "zones": _with_zone(last, layer),
            }
            found[-1] = replace(last, **joined)
        else:
            found.append(layer)
    return found


def _with_zone(last: Layer, layer: Layer) -> list[Zone]:
    """The zones of a layer, and that of another one beside it."""
    (zone,) = layer.zones
    sizes = [[ply.thickness for ply in plies] for plies in (last.plies, zone.plies)]
    if len(sizes[0]) != len(sizes[1]) or not all(map(isclose, *sizes)):
        words = f"part {layer.body.pid} lies beside part {last.body.pid} and has plies of other"
        words = f"{words} thicknesses; of plydyn's plates angles and materials may differ"
        raise layer.body.block.fail("PID", words)
    found = []
    for each in last.zones:
        if (each.plies, each.turned, each.flat) == (zone.plies, zone.turned, zone.flat):
            edge = each.first_edge if abs(each.first_edge - zone.first_edge) <= _UNIFORM else nan
            zone = replace(each, elements=each.elements | zone.elements, first_edge=edge)
            continue
        found.append(each)
    return [*found, zone]


def _mesh(stack: Stack, nodes: dict[int, Place], slack: float) -> None:
    """The plane mesh of the lowest part, and where the nodes of the others lie in it."""
    lowest = stack.layers[0]

    def key(nid: int) -> Key:
        x, y, _ = nodes[nid]
        return round(x / (4.0 * slack)), round(y / (4.0 * slack))

    columns: dict[Key, int] = {}
    for quad in lowest.quads.values():
        for nid in quad:
            columns.setdefault(key(nid), nid)
            stack.places[nid] = nodes[nid][:2]
    faces = {frozenset(map(key, quad)) for quad in lowest.quads.values()}
    for layer in stack.layers:
        if {frozenset(map(key, quad)) for quad in layer.quads.values()} != faces:
            first = lowest.body.pid
            words = f"the elements of part {layer.body.pid} do not lie over those of part {first}"
            words = f"{words}; one stack of parts, of one thickness, is translated"
            raise layer.body.block.fail("PID", words)
        for nid in layer.nodes:
            if key(nid) not in columns:
                words = f"node {nid} lies over no node of part {lowest.body.pid}"
                raise layer.body.block.fail("PID", words)
            stack.column_of[nid] = columns[key(nid)]
    next_id = max(nodes) + 1
    given = {
        frozenset(stack.column_of[n] for n in ends): nid for ends, nid in lowest.middles.items()
    }
    zones = [_zones(stack, layer) for layer in stack.layers]
    for quad in lowest.quads.values():
        corners = tuple(stack.column_of[n] for n in quad)
        next_id = _add_quad(stack, corners, next_id, given, nodes)
        stack.zones.append(tuple(each[frozenset(corners)] for each in zones))


def _zones(stack: Stack, layer: Layer) -> dict[frozenset[int], int]:
    """The zone of each element of a layer, by its corners in the plane."""
    return {
        frozenset(stack.column_of[n] for n in layer.quads[element]): number
        for number, zone in enumerate(layer.zones)
        for element in zone.elements
    }


def _add_quad(
    stack: Stack,
    quad: Quad,
    next_id: int,
    given: dict[frozenset[int], int],
    nodes: dict[int, Place],
) -> int:
    """A quad with mid-side nodes, given ones or made ones, which neighbours share, and a centre."""
    middles = []
    for a, b in zip(quad, [*quad[1:], quad[0]], strict=True):
        edge = (min(a, b), max(a, b))
        if edge not in stack.edges:
            stack.edges[edge] = next_id
            stack.places[next_id] = _mean(stack, a, b)
            if nid := given.get(frozenset(edge), 0):
                stack.places[next_id] = nodes[nid][:2]
                stack.column_of[nid] = next_id
            next_id += 1
        middles.append(stack.edges[edge])
    stack.places[next_id] = _mean(stack, *quad)
    if given:  # where a quad of eight nodes has its centre
        x, y = (
            2.0 * m - c for m, c in zip(_mean(stack, *middles), _mean(stack, *quad), strict=True)
        )
        stack.places[next_id] = (x, y)
    stack.quads.append((*quad, *middles, next_id))
    stack.number_of[frozenset(quad)] = len(stack.quads)
    return next_id + 1


def _mean(stack: Stack, *ids: int) -> tuple[float, float]:
    """The middle between some nodes."""
    x, y = zip(*(stack.places[n] for n in ids), strict=True)
    return sum(x) / len(x), sum(y) / len(y)


def with_mid_sides(stack: Stack, ids: Iterable[int]) -> list[int]:
    """Nodes of the plane for nodes of the plate, with the mid-sides between them."""
    found = {stack.column_of[n] for n in ids if n in stack.column_of}
    return sorted(found | {mid for (a, b), mid in stack.edges.items() if {a, b} <= found})
