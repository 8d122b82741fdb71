"""A picture of a mesh with the sets and delaminations of its recipe, as SVG."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape as escaped

import numpy as np

from plydyn_pre.deck.names import Names
from plydyn_pre.mesh import Mesh
from plydyn_pre.mesh.grid import SIDES, Integers
from plydyn_pre.study import InitialDelamination, PlaceSet, Study

#: Colours of sets and delaminations in turn, which the colour-blind can tell apart
_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
_INK = "#333333"
_WIDTH = 1000.0  # of the drawing, points
#: Height of a line of the legend, and radius of a node, over the larger side of the mesh
_LINE, _DOT = 0.03, 0.004


def picture_lines(study: Study, mesh: Mesh) -> Iterator[str]:
    """The lines of an SVG file: quads, sets by place, delaminations, the impactor, a legend."""
    names = Names(study, mesh)
    shapes = [*_sets(names), *_delaminations(names)]
    colours = [_COLOURS[number % len(_COLOURS)] for number in range(len(shapes))]
    (left, low), (right, high) = mesh.nodes.min(axis=0), mesh.nodes.max(axis=0)
    line = _LINE * mesh.size
    width, height = right - left + 2.0 * line, high - low + (2.0 + len(shapes)) * line
    box = f"{left - line:.6g} {-high - line:.6g} {width:.6g} {height:.6g}"
    size = f'width="{_WIDTH:g}" height="{_WIDTH * height / width:.6g}"'
    yield f'<svg xmlns="http://www.w3.org/2000/svg" {size} viewBox="{box}">'
    yield f"<title>{_words(study.title)}</title>"
    corner = f'x="{left - line:.6g}" y="{-high - line:.6g}"'
    yield f'<rect {corner} width="{width:.6g}" height="{height:.6g}" fill="white"/>'
    yield '<g transform="scale(1,-1)">'  # y upwards
    for colour, (_, shape) in zip(colours, shapes, strict=True):
        yield shape.replace("COLOUR", colour)
    outlines = _quads_path(mesh, np.arange(len(mesh.quads)))
    yield f'<path d="{outlines}" fill="none" {_stroke(mesh, _INK, 0.5)}/>'
    yield from _impactor(names)
    yield "</g>"
    for number, (words, _) in enumerate(shapes):
        at = f'x="{left:.6g}" y="{line * (number + 1.5) - low:.6g}"'
        look = f'font-size="{0.8 * line:.6g}" font-family="sans-serif" fill="{colours[number]}"'
        yield f"<text {at} {look}>{_words(words)}</text>"
    yield "</svg>"


def _words(text: str) -> str:
    """Text as XML has it, in which there are no control characters."""
    return escaped("".join(each if each.isprintable() else " " for each in text))


def _sets(names: Names) -> Iterator[tuple[str, str]]:
    """Words and shape of each set of the recipe."""
    for name in names.study.sets:
        nodes, quads = names.members_of(name)
        if len(quads):
            yield f"set {name}: {len(quads)} quads", _filled(names.mesh, quads)
        else:
            yield f"set {name}: {len(nodes)} nodes", _dots(names.mesh, nodes)


def _delaminations(names: Names) -> Iterator[tuple[str, str]]:
    """Words and shape of each delamination before the run."""
    for number, one in enumerate(names.study.initial_delamination, start=1):
        listed = ", ".join(str(k) for k in one.numbers) or "all"
        words = f"initial delamination {number}: interfaces {listed}"
        if one.circle is None:
            yield words, _filled(names.mesh, _delaminated(names, one, number))
        else:
            x, y, radius = one.circle
            at = f'cx="{x:.6g}" cy="{y:.6g}" r="{radius:.6g}"'
            edge = _stroke(names.mesh, "COLOUR", 1.5)
            yield words, f'<circle {at} fill="COLOUR" fill-opacity="0.4" {edge}/>'


def _delaminated(names: Names, one: InitialDelamination, number: int) -> Integers:
    """Quads of a delamination that is no circle."""
    path = f"initial_delamination[{number}]"
    part = names.part(one.part, f"{path}.part")
    if one.box is None and one.ring is None:
        return names.quads_of(part if one.set == "all" else one.set, f"{path}.set")
    names.region(PlaceSet(box=one.box, ring=one.ring), part, path)
    return names.quads_of(path, path)


def _impactor(names: Names) -> Iterator[str]:
    """The outline of the impactor."""
    impactor = names.study.impactor
    if impactor is not None:
        x, y = impactor.position or names.mesh.middle
        at = f'cx="{x:.6g}" cy="{y:.6g}" r="{impactor.radius:.6g}"'
        yield f'<circle {at} fill="none" {_stroke(names.mesh, _INK, 1.5)}/>'


def _filled(mesh: Mesh, quads: Integers) -> str:
    """Some quads in a colour."""
    return f'<path d="{_quads_path(mesh, quads)}" fill="COLOUR" fill-opacity="0.4"/>'


def _dots(mesh: Mesh, nodes: Integers) -> str:
    """Some nodes in a colour."""
    radius = _DOT * mesh.size
    dots = (f'<circle cx="{x:.6g}" cy="{y:.6g}" r="{radius:.4g}"/>' for x, y in mesh.nodes[nodes])
    return f'<g fill="COLOUR">{"".join(dots)}</g>'


def _stroke(mesh: Mesh, colour: str, width: float) -> str:
    """A line some points wide."""
    return f'stroke="{colour}" stroke-width="{width * mesh.size / _WIDTH:.4g}"'


def _quads_path(mesh: Mesh, quads: Integers) -> str:
    """Outlines of some quads; sides of three nodes are parabolas."""
    return "".join(_outline(mesh, nodes) for nodes in mesh.quads[quads])


def _outline(mesh: Mesh, nodes: Integers) -> str:
    """Outline of a quad."""
    places = mesh.nodes[nodes]
    path = "M{:.7g} {:.7g}".format(*places[0])
    for side, (start, end) in enumerate(SIDES):
        if mesh.order == 1:
            path += "L{:.7g} {:.7g}".format(*places[end])
        else:
            bend = 2.0 * places[4 + side] - (places[start] + places[end]) / 2
            path += "Q{:.7g} {:.7g} {:.7g} {:.7g}".format(*bend, *places[end])
    return f"{path}Z"
