"""Meshes of the built-in shapes."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from plydyn_pre import (
    Coupon,
    Mesh,
    OgridDisc,
    OgridSquare,
    RecipeError,
    Rectangle,
    make_mesh,
    quality,
)
from plydyn_pre.mesh import Shape
from plydyn_pre.mesh.quality import jacobians, quad_areas

ROUND_OFF = 1e-12

SHAPES = [
    Rectangle((3.0, 2.0), (3, 2)),
    Rectangle((100.0, 60.0), (8, 6), grading=4.0, corner=(-7.0, 1.0)),
    OgridSquare(100.0, 20.0, 4, 2),
    OgridSquare(100.0, 40.0, 5, 3, grading=2.0, corner=(-50.0, 3.0)),
    OgridDisc(75.0, 15.0, 8, 4),
    OgridDisc(2.0, 0.9, 3, 1, centre=(5.0, -4.0)),
    OgridDisc(2.0, 0.9, 4, 2, grading=3.0, centre=(5.0, -4.0), quarter=True),
]
BOTH_ORDERS = [
    type(shape)(**{**vars(shape), "order": order}) for shape in SHAPES for order in (1, 2)
]


def ogrid_counts(n: int, rings: int) -> tuple[int, int]:
    """Quads of nine nodes, and nodes, by counting rings."""
    return n**2 + 4 * n * rings, (2 * n + 1) ** 2 + 16 * n * rings


@pytest.mark.parametrize(
    ("n", "rings", "quads", "nodes"), [(4, 2, 48, 209), (6, 4, 132, 553), (8, 4, 192, 801)]
)
def test_ogrids_have_the_counts_of_the_paper(n: int, rings: int, quads: int, nodes: int) -> None:
    square = make_mesh(OgridSquare(100.0, 20.0, n, rings))
    disc = make_mesh(OgridDisc(75.0, 15.0, n, rings))
    assert (quads, nodes) == ogrid_counts(n, rings)
    assert (len(square.quads), len(square.nodes)) == (quads, nodes)
    assert (len(disc.quads), len(disc.nodes)) == (quads, nodes)


@pytest.mark.parametrize("shape", BOTH_ORDERS, ids=str)
def test_quads_run_counter_clockwise_with_positive_jacobians(shape: object) -> None:
    mesh = make_mesh(shape)
    grid = np.linspace(-1.0, 1.0, 5)
    places = np.stack(np.meshgrid(grid, grid), axis=-1).reshape(-1, 2)
    assert jacobians(mesh, places).min() > 0.0
    assert quality(mesh).smallest_jacobian > 0.0


@pytest.mark.parametrize("shape", BOTH_ORDERS, ids=str)
def test_mid_sides_and_centres_lie_between_their_corners(shape: object) -> None:
    mesh = make_mesh(shape)
    if mesh.order == 1:
        assert mesh.quads.shape[1] == 4
        return
    corners = mesh.nodes[mesh.quads[:, :4]]
    sides = mesh.nodes[mesh.quads[:, 4:8]]
    chords = np.roll(corners, -1, axis=1) - corners
    off = np.linalg.norm(sides - (corners + chords / 2), axis=2) / np.linalg.norm(chords, axis=2)
    # only the sides on a bent ring leave their chord, by the sagitta of their part of the circle
    n = getattr(shape, "n", None)
    sagitta = np.tan(np.pi / (8 * n)) / 2 if isinstance(shape, OgridDisc) else 0.0
    assert off.max() <= sagitta + ROUND_OFF


@pytest.mark.parametrize("shape", BOTH_ORDERS, ids=str)
def test_every_node_is_used_once_and_numbered_from_one(shape: object) -> None:
    mesh = make_mesh(shape)
    assert np.array_equal(np.unique(mesh.quads), np.arange(len(mesh.nodes)))
    assert len(np.unique(mesh.nodes.round(9), axis=0)) == len(mesh.nodes)
    assert mesh.node_ids.tolist() == list(range(1, len(mesh.nodes) + 1))
    assert mesh.quad_ids.tolist() == list(range(1, len(mesh.quads) + 1))
    assert np.array_equal(np.sort(np.concatenate(list(mesh.parts.values()))), mesh.quad_ids - 1)


@pytest.mark.parametrize(
    "shape", [*SHAPES, Coupon((15.0, 10.0), (12.0, 7.0), 3.0, quad=0.5)], ids=str
)
def test_built_in_shapes_need_no_mesher(shape: Shape, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "gmsh", None)  # any import of it fails
    assert len(make_mesh(shape).quads) > 0


@pytest.mark.parametrize("order", [1, 2])
def test_areas_of_squares_are_exact(order: int) -> None:
    square = make_mesh(OgridSquare(100.0, 20.0, 4, 2, order=order))
    assert quality(square).area == pytest.approx(1.0e4, rel=ROUND_OFF)
    core = quad_areas(square)[square.quad_sets["core"]]
    assert core == pytest.approx(np.full(16, 25.0), rel=ROUND_OFF)
    plate = make_mesh(Rectangle((100.0, 60.0), (8, 6), grading=4.0, order=order))
    assert quality(plate).area == pytest.approx(6.0e3, rel=ROUND_OFF)


def test_area_of_a_disc_is_that_of_its_polygon_and_parabolas() -> None:
    n, radius = 4, 37.5
    half = np.pi / (4 * n)  # of the angle of a quad on the circle
    polygon = 4 * n * radius**2 * np.sin(half) * np.cos(half)
    caps = 4 * n * 2 / 3 * 2 * radius * np.sin(half) * radius * (1 - np.cos(half))
    flat = make_mesh(OgridDisc(75.0, 15.0, n, 2, order=1))
    bent = make_mesh(OgridDisc(75.0, 15.0, n, 2))
    assert quality(flat).area == pytest.approx(polygon, rel=ROUND_OFF)
    assert quality(bent).area == pytest.approx(polygon + caps, rel=ROUND_OFF)


@pytest.mark.parametrize("order", [1, 2])
def test_nodes_of_a_disc_are_on_the_circle_at_equal_angles(order: int) -> None:
    mesh = make_mesh(OgridDisc(75.0, 15.0, 8, 4, order=order, centre=(3.0, -2.0)))
    x, y = (mesh.nodes[mesh.node_sets["boundary"]] - (3.0, -2.0)).T
    assert np.hypot(x, y) == pytest.approx(np.full(32 * order, 37.5), rel=ROUND_OFF)
    steps = np.diff(np.sort(np.arctan2(y, x)))
    assert steps == pytest.approx(np.full(32 * order - 1, 2 * np.pi / (32 * order)), rel=1e-9)


def test_nodes_of_rings_lie_on_lines_from_the_core_to_the_edge() -> None:
    mesh = make_mesh(OgridSquare(100.0, 20.0, 4, 2))
    places = mesh.nodes - 50.0
    reach = np.abs(places).max(axis=1)
    assert np.unique(reach[reach > 10.1].round(9)).tolist() == [20.0, 30.0, 40.0, 50.0]
    along = np.abs(places).min(axis=1)[reach > 10.1] / reach[reach > 10.1]
    assert np.unique(along.round(9)).tolist() == [0.0, 0.25, 0.5, 0.75, 1.0]


def test_nodes_of_rings_of_a_disc_lie_on_lines_from_the_core_to_the_circle() -> None:
    n, rings, core, radius = 3, 2, 10.0, 20.0
    mesh = make_mesh(OgridDisc(2 * radius, core, n, rings))
    step = np.arange(-n, n + 1) / n
    bottom = np.stack([step * core / 2, np.full(2 * n + 1, -core / 2)], axis=1)
    angle = step * np.pi / 4
    arc = radius * np.stack([np.sin(angle), -np.cos(angle)], axis=1)
    for share in np.arange(2 * rings + 1) / (2 * rings):
        expected = (1 - share) * bottom + share * arc
        distance = np.linalg.norm(mesh.nodes[:, None] - expected, axis=2).min(axis=0)
        assert distance.max() < ROUND_OFF * radius


def test_the_mesh_of_the_paper_has_the_points_of_its_figures() -> None:
    mesh = make_mesh(OgridSquare(100.0, 20.0, 4, 2))
    places = {(x, y) for x, y in mesh.nodes.tolist()}
    assert {(40.0, 40.0), (60.0, 40.0), (50.0, 50.0), (0.0, 0.0), (100.0, 100.0)} <= places


def on_edges(mesh: Mesh, low: tuple[float, float], high: tuple[float, float]) -> dict[str, set]:
    """Nodes on the edges of a rectangle."""
    x, y = mesh.nodes.T
    edges = {"left": x == low[0], "right": x == high[0], "bottom": y == low[1], "top": y == high[1]}
    sets = {name: set(np.flatnonzero(on)) for name, on in edges.items()}
    return sets | {"boundary": set().union(*sets.values())}


@pytest.mark.parametrize("order", [1, 2])
def test_edges_have_their_sets(order: int) -> None:
    plate = make_mesh(Rectangle((3.0, 2.0), (6, 4), order=order, corner=(1.0, -1.0)))
    for name, nodes in on_edges(plate, (1.0, -1.0), (4.0, 1.0)).items():
        assert set(plate.node_sets[name]) == nodes
    square = make_mesh(OgridSquare(100.0, 20.0, 4, 2, order=order))
    for name, nodes in on_edges(square, (0.0, 0.0), (100.0, 100.0)).items():
        assert set(square.node_sets[name]) == nodes


@pytest.mark.parametrize("order", [1, 2])
def test_centre_and_core_have_their_sets(order: int) -> None:
    for shape in (OgridSquare(100.0, 20.0, 4, 2, order=order), OgridDisc(75.0, 20.0, 4, 2)):
        mesh = make_mesh(shape)
        (centre,) = mesh.node_sets["centre"]
        assert mesh.nodes[centre].tolist() == list(mesh.middle)
        inside = np.abs(mesh.nodes - mesh.middle).max(axis=1) <= 10.0 + 1e-9
        assert mesh.node_sets["core"].tolist() == np.flatnonzero(inside).tolist()
        assert len(mesh.quad_sets["core"]) == 16


def test_there_is_no_centre_where_no_node_is() -> None:
    assert "centre" not in make_mesh(Rectangle((1.0, 1.0), (3, 3), order=1)).node_sets
    assert "centre" in make_mesh(Rectangle((1.0, 1.0), (3, 3))).node_sets


def test_grading_is_the_ratio_of_the_outermost_to_the_innermost_quad() -> None:
    mesh = make_mesh(Rectangle((100.0, 60.0), (8, 6), grading=4.0, order=1))
    for axis in (0, 1):
        steps = np.diff(np.unique(mesh.nodes[:, axis].round(9)))
        half = steps[len(steps) // 2 :]
        assert half[-1] / half[0] == pytest.approx(4.0)
        assert half[1:] / half[:-1] == pytest.approx(np.full(len(half) - 1, half[1] / half[0]))
        assert steps == pytest.approx(steps[::-1])
    ring = make_mesh(OgridSquare(100.0, 20.0, 2, 3, grading=3.0, order=1))
    widths = np.diff(np.unique(np.abs(ring.nodes - 50.0).max(axis=1).round(9)))[1:]
    assert widths[-1] / widths[0] == pytest.approx(3.0)


@pytest.mark.parametrize(
    ("shape", "values", "key"),
    [
        (Rectangle, {"sides": (0.0, 1.0), "quads": (1, 1)}, "sides"),
        (Rectangle, {"sides": (1.0, 1.0), "quads": (0, 1)}, "quads"),
        (Rectangle, {"sides": (1.0, 1.0), "quads": (3, 4), "grading": 2.0}, "quads"),
        (OgridSquare, {"side": 10.0, "core": 10.0, "n": 2, "rings": 1}, "core"),
        (OgridSquare, {"side": 10.0, "core": 5.0, "n": 2, "rings": 0}, "rings"),
        (OgridDisc, {"diameter": 10.0, "core": 7.1, "n": 2, "rings": 1}, "core"),
        (OgridDisc, {"diameter": 10.0, "core": 5.0, "n": 0, "rings": 1}, "n"),
        (OgridDisc, {"diameter": 75.0, "core": 15.0, "n": 2, "rings": 4}, "n"),
    ],
)
def test_shapes_that_cannot_be_meshed_are_refused(shape: type, values: dict, key: str) -> None:
    with pytest.raises(RecipeError) as caught:
        shape(**values)
    assert caught.value.path == key
