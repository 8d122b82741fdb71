"""Stacked parts as one laminate on a plane mesh of quads with nine nodes."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import atan2, degrees

from plydyn_pre.translate.bodies import Bodies, Body, Place

_FLAT = 1e-6  # of the size of the plate

Key = tuple[int, int]


@dataclass
class Layer:
    """A part of the stack, between two heights."""

    body: Body
    bottom: float
    top: float
    quads: list[tuple[int, ...]]  # nodes of the lower face


@dataclass
class Stack:
    """A laminate and its plane mesh."""

    layers: list[Layer]
    places: dict[int, tuple[float, float]] = field(default_factory=dict)
    quads: list[tuple[int, ...]] = field(default_factory=list)  # nine nodes each
    column_of: dict[int, int] = field(default_factory=dict)  # any node of the plate, to the plane
    edges: dict[tuple[int, int], int] = field(default_factory=dict)  # corners, to their mid-side
    first_edge: float = 0.0  # direction of the first edge of the quads, degrees

    @property
    def middle(self) -> float:
        """Height of the middle."""
        return self.layers[0].bottom + 0.5 * self.thickness

    @property
    def top(self) -> float:
        """Height of the top face."""
        return self.layers[0].bottom + self.thickness

    @property
    def thickness(self) -> float:
        """Thickness of all plies."""
        return sum(layer.body.thickness for layer in self.layers)


def read_stack(bodies: Bodies) -> Stack:
    """The parts of a plate, one over the other."""
    places = [bodies.nodes[n] for body in bodies.plates for n in body.nodes]
    size = max(max(p[i] for p in places) - min(p[i] for p in places) for i in (0, 1))
    slack = _FLAT * size
    layers = [_layer(body, bodies.nodes, slack) for body in bodies.plates]
    layers.sort(key=lambda layer: layer.bottom + layer.top)
    stack = Stack(layers)
    _mesh(stack, bodies.nodes, slack)
    return stack


def _layer(body: Body, nodes: dict[int, Place], slack: float) -> Layer:
    """A part with its heights."""
    for element in body.elements:
        if len(set(element[:4])) < 4:
            words = f"part {body.pid} has triangles: {element[:4]}; quads are needed"
            raise body.block.fail("PID", words)
    if body.kind == "tshell":
        low = _height(body, [n for e in body.elements for n in e[:4]], nodes, slack)
        high = _height(body, [n for e in body.elements for n in e[4:]], nodes, slack)
        if low > high:
            raise body.block.fail("", f"the thick shells of part {body.pid} are upside down")
        return Layer(body, low, high, [element[:4] for element in body.elements])
    level = _height(body, list(body.nodes), nodes, slack)
    bottom = level - 0.5 * (1.0 + body.reference) * body.thickness
    return Layer(body, bottom, bottom + body.thickness, list(body.elements))


def _height(body: Body, ids: list[int], nodes: dict[int, Place], slack: float) -> float:
    """The height that some nodes have in common."""
    heights = [nodes[n][2] for n in ids]
    if max(heights) - min(heights) > max(slack, 1e-3 * body.thickness):
        words = f"part {body.pid} lies between z = {min(heights):g} and {max(heights):g}"
        raise body.block.fail("PID", f"{words}; plates of plydyn are flat, at one z")
    return sum(heights) / len(heights)


def _mesh(stack: Stack, nodes: dict[int, Place], slack: float) -> None:
    """The plane mesh of the lowest part, and where the nodes of the others lie in it."""
    lowest = stack.layers[0]

    def key(nid: int) -> Key:
        x, y, _ = nodes[nid]
        return round(x / (4.0 * slack)), round(y / (4.0 * slack))

    columns: dict[Key, int] = {}
    for quad in lowest.quads:
        for nid in quad:
            columns.setdefault(key(nid), nid)
            stack.places[nid] = nodes[nid][:2]
    faces = {frozenset(map(key, quad)) for quad in lowest.quads}
    for layer in stack.layers:
        if {frozenset(map(key, quad)) for quad in layer.quads} != faces:
            first = lowest.body.pid
            words = f"the elements of part {layer.body.pid} do not lie over those of part {first}"
            raise layer.body.block.fail("PID", f"{words}; one stack of parts is translated")
        for nid in layer.body.nodes:
            if key(nid) not in columns:
                words = f"node {nid} lies over no node of part {lowest.body.pid}"
                raise layer.body.block.fail("PID", words)
            stack.column_of[nid] = columns[key(nid)]
    next_id = max(nodes) + 1
    for quad in lowest.quads:
        next_id = _add_quad(stack, _turned(quad, nodes, lowest.body), next_id)
    a, b = (nodes[n] for n in lowest.quads[0][:2])
    stack.first_edge = degrees(atan2(b[1] - a[1], b[0] - a[0]))
    for quad in lowest.quads:
        a, b = (nodes[n] for n in quad[:2])
        off = degrees(atan2(b[1] - a[1], b[0] - a[0])) - stack.first_edge
        if abs((off + 180.0) % 360.0 - 180.0) > 1.0:
            stack.first_edge = float("nan")
            return


def _turned(quad: tuple[int, ...], nodes: dict[int, Place], body: Body) -> tuple[int, ...]:
    """A quad counter-clockwise from above."""
    corners = [nodes[n] for n in quad]
    pairs = zip(corners, [*corners[1:], corners[0]], strict=True)
    area = sum(a[0] * b[1] - b[0] * a[1] for a, b in pairs)
    if area <= 0.0:
        words = f"element {quad} runs clockwise seen from above, and its plies from the top down"
        raise body.block.fail("PID", f"{words}; turn the elements and the plies")
    return quad


def _add_quad(stack: Stack, quad: tuple[int, ...], next_id: int) -> int:
    """A quad with mid-side nodes, which neighbours share, and a centre."""
    middles = []
    for a, b in zip(quad, [*quad[1:], quad[0]], strict=True):
        edge = (min(a, b), max(a, b))
        if edge not in stack.edges:
            stack.edges[edge] = next_id
            stack.places[next_id] = _mean(stack, a, b)
            next_id += 1
        middles.append(stack.edges[edge])
    stack.places[next_id] = _mean(stack, *quad)
    stack.quads.append((*quad, *middles, next_id))
    return next_id + 1


def _mean(stack: Stack, *ids: int) -> tuple[float, float]:
    """The middle between some nodes."""
    x, y = zip(*(stack.places[n] for n in ids), strict=True)
    return sum(x) / len(x), sum(y) / len(y)


def with_mid_sides(stack: Stack, ids: set[int]) -> list[int]:
    """Nodes of the plane for nodes of the plate, with the mid-sides between them."""
    found = {stack.column_of[n] for n in ids if n in stack.column_of}
    return sorted(found | {mid for (a, b), mid in stack.edges.items() if {a, b} <= found})
