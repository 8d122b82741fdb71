"""Analytical rigid surfaces as meshes of shells, fine enough to show their shape."""

from __future__ import annotations

from itertools import pairwise
from math import atan2, ceil, cos, hypot, pi, sin

import numpy as np

from plydyn_pre.translate.abaqus.lines import Keyword
from plydyn_pre.translate.abaqus.mesh import Element, Mesh

_AROUND = 24  # elements around an axis
_ARC = pi / 24.0  # of a circle in one element
_LINE = 6  # elements along a straight line

Point = tuple[float, float]


def put_surface(mesh: Mesh, keyword: Keyword) -> list[Element]:
    """Elements of an analytical surface; their nodes are added to the mesh."""
    start_at = [bool(words) and words[0].upper() == "START" for _, words in keyword.data]
    front = start_at.index(True) if True in start_at else len(start_at)
    rest = keyword.data[front:]
    given = [keyword.numbers("", words, line) for line, words in keyword.data[:front]]
    points = np.array([number for row in given for number in row])
    revolved = keyword.options["TYPE"].upper() == "REVOLUTION"
    if len(points) < (6 if revolved else 9):
        raise keyword.fail("", "the points of its axes are missing")
    profile = _profile(keyword, rest)
    start = points[:3]
    if revolved:
        rows = _revolved(start, _unit(keyword, points[3:6] - start), profile)
    else:
        x = _unit(keyword, points[3:6] - start)
        y = _unit(keyword, points[6:9] - start)
        rows = _extruded(mesh, start, (x, y, np.cross(x, y)), profile)
    return _elements(mesh, keyword, rows, revolved)


def _unit(keyword: Keyword, vector: np.ndarray) -> np.ndarray:
    """A direction."""
    size = float(np.linalg.norm(vector))
    if not size:
        raise keyword.fail("", "two points of its axes are one")
    return vector / size


def _profile(keyword: Keyword, data: list[tuple[int, list[str]]]) -> list[Point]:
    """Points along the lines and arcs of a profile."""
    found: list[Point] = []
    for line, words in data:
        kind = words[0].upper()
        values = keyword.numbers("", words[1:], line)
        if len(values) < (4 if kind == "CIRCL" else 2) or (kind != "START" and not found):
            raise keyword.fail(kind, "a START and then points are needed", line)
        end = (values[0], values[1])
        match kind:
            case "START":
                found.append(end)
            case "LINE":
                found += _between(found[-1], end)
            case "CIRCL":
                found += _arc(found[-1], end, (values[2], values[3]))
            case _:
                raise keyword.fail(kind, "is not translated; START, LINE, CIRCL are", line)
    if len(found) < 2:
        raise keyword.fail("", "the profile has no lines")
    return found


def _between(a: Point, b: Point) -> list[Point]:
    """Points of a line, without its first."""
    shares = [n / _LINE for n in range(1, _LINE + 1)]
    return [(a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])) for s in shares]


def _arc(a: Point, b: Point, centre: Point) -> list[Point]:
    """Points of an arc below half a circle, without its first."""
    radius = hypot(a[0] - centre[0], a[1] - centre[1])
    first = atan2(a[1] - centre[1], a[0] - centre[0])
    sweep = (atan2(b[1] - centre[1], b[0] - centre[0]) - first + pi) % (2.0 * pi) - pi
    count = max(1, ceil(abs(sweep) / _ARC))
    angles = [first + sweep * n / count for n in range(1, count)]
    return [(centre[0] + radius * cos(t), centre[1] + radius * sin(t)) for t in angles] + [b]


def _revolved(start: np.ndarray, axis: np.ndarray, profile: list[Point]) -> list[np.ndarray]:
    """Rings of points about an axis."""
    x = np.cross(axis, [1.0, 0.0, 0.0] if abs(axis[0]) < 0.9 else [0.0, 1.0, 0.0])
    x /= np.linalg.norm(x)
    y = np.cross(axis, x)
    turns = 2.0 * pi * np.arange(_AROUND) / _AROUND
    ring = np.outer(np.cos(turns), x) + np.outer(np.sin(turns), y)
    return [start + max(r, 0.0) * ring + z * axis for r, z in profile]


def _extruded(
    mesh: Mesh, start: np.ndarray, axes: tuple[np.ndarray, ...], profile: list[Point]
) -> list[np.ndarray]:
    """Lines of points along a third axis, as long as the whole model is wide."""
    places = np.array(list(mesh.nodes.values()))
    reach = float(np.linalg.norm(np.ptp(places, axis=0))) if len(places) else 1.0
    shifts = np.linspace(-reach, reach, 3)[:, None] * axes[2]
    return [start + u * axes[0] + v * axes[1] + shifts for u, v in profile]


def _elements(mesh: Mesh, keyword: Keyword, rows: list[np.ndarray], closed: bool) -> list[Element]:
    """Quads between rows of points."""
    number = max(mesh.last, max(mesh.nodes, default=0), max(mesh.elements, default=0)) + 1
    line = keyword.block.line
    ids, found = [], []
    for row in rows:
        ids.append(list(range(number, number + len(row))))
        mesh.nodes |= {
            nid: mesh.placed(keyword.space, place) for nid, place in zip(ids[-1], row, strict=True)
        }
        number += len(row)
    for low, high in pairwise(ids):
        count = len(low)
        for i in range(count if closed else count - 1):
            j = (i + 1) % count
            nodes = (low[i], low[j], high[j], high[i])
            found.append(Element(number, "shell", nodes, (), keyword, line))
            number += 1
    mesh.last = number - 1
    return found
