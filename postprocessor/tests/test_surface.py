"""The surface that is drawn is the plate's: closed, looking outwards, and cut where asked."""

from pathlib import Path

import numpy as np
import pytest
import synthetic

from plydyn_post.cut import cut_surface, lines_beyond, triangles_beyond
from plydyn_post.grid import read_state
from plydyn_post.hexahedra import LINEAR, QUADRATIC, faces, finer, lattice
from plydyn_post.surface import Block, Surface, blocks_of, surface_of

HIGH = synthetic.PLY * len(synthetic.ANGLES)


def read_blocks(folder: Path, quads: int, quadratic: bool) -> tuple[list[Block], np.ndarray]:
    """Cells and points of seven numbers at the second state."""
    synthetic.write_fields(folder, "plate", quads, quadratic)
    grid = read_state(folder / "plate.vtkhdf", 1)
    stress = np.asarray(grid.point_data["stress"])[:, 0]
    return blocks_of(grid), np.column_stack([grid.points, grid.point_data["displacement"], stress])


def volume(surface: Surface) -> float:
    """Volume inside a closed surface at time zero, positive if it looks outwards."""
    a, b, c = np.moveaxis(surface.points[surface.triangles, :3], 1, 0)
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)


def area(points: np.ndarray, triangles: np.ndarray) -> float:
    a, b, c = np.moveaxis(points[triangles, :3], 1, 0)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2.0)


@pytest.mark.parametrize("kind", [LINEAR, QUADRATIC])
def test_a_lattice_holds_every_node_once(kind: int) -> None:
    nodes = lattice(kind)
    assert sorted(nodes.ravel()) == list(range(8 if kind == LINEAR else 27))
    assert len(np.unique(faces(kind))) == (8 if kind == LINEAR else 26)


def test_finer_points_follow_a_parabola() -> None:
    at = np.linspace(0.0, 1.0, 8)
    assert finer(3, 7) @ np.array([0.0, 0.25, 1.0]) == pytest.approx(at**2)


@pytest.mark.parametrize("quadratic", [True, False])
def test_the_surface_encloses_the_plate(tmp_path: Path, quadratic: bool) -> None:
    blocks, points = read_blocks(tmp_path, 4, quadratic)
    surface = surface_of(blocks, points)
    assert volume(surface) == pytest.approx(synthetic.SIDE**2 * HIGH)
    whole = 2 * synthetic.SIDE**2 + 4 * synthetic.SIDE * HIGH
    assert area(surface.points, surface.triangles) == pytest.approx(whole)
    heights = np.unique(surface.ply_lines[..., 2].round(9))
    assert heights.tolist() == [0.0, synthetic.PLY, HIGH]


def test_plies_that_come_apart_show_their_faces(tmp_path: Path) -> None:
    blocks, points = read_blocks(tmp_path, 4, True)
    points[points[:, 2] > synthetic.PLY + 1e-9, 5] += 1.0
    upper = np.unique(blocks[0].nodes[blocks[0].ply == 2])
    points[upper, 5] = 1.0
    surface = surface_of(blocks, points)
    whole = 4 * synthetic.SIDE**2 + 4 * synthetic.SIDE * HIGH
    assert area(surface.points, surface.triangles) == pytest.approx(whole)


@pytest.mark.parametrize("quads", [4, 5])
def test_a_quarter_is_cut_away_along_and_through_elements(tmp_path: Path, quads: int) -> None:
    blocks, points = read_blocks(tmp_path, quads, True)
    middle = synthetic.SIDE / 2
    surface = cut_surface(blocks, points, (middle, middle))
    x, y = surface.points[surface.triangles][..., :2].mean(axis=1).T
    assert not np.any((x > middle + 0.01) & (y < middle - 0.01))
    # top and bottom lose a quarter; the sides keep their length
    whole = 1.5 * synthetic.SIDE**2 + 4 * synthetic.SIDE * HIGH
    assert area(surface.points, surface.triangles) == pytest.approx(whole, rel=1e-5)
    on_cut = np.all(np.abs(surface.ply_lines[..., 0] - middle) < 1e-3, axis=1)
    lengths = np.abs(np.diff(surface.ply_lines[on_cut][..., 1], axis=1))
    # two plies with two edges each, half the plate long
    assert lengths.sum() == pytest.approx(4 * middle, rel=1e-4)


def test_triangles_and_lines_are_cut_where_the_height_is_zero() -> None:
    points = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    for limit in (0.25, 0.5, 0.75):
        new, left = triangles_beyond(points, triangles, points[:, 0] - limit)
        assert area(new, left) == pytest.approx(1.0 - limit)
        assert new[left][..., 0].min() == pytest.approx(limit)
        normal = np.cross(new[left[:, 1]] - new[left[:, 0]], new[left[:, 2]] - new[left[:, 0]])
        assert np.all(normal[:, 2] > 0.0)
    lines = points[[[0, 1], [3, 0]]]
    kept = lines_beyond(lines, lines[..., 0] - 0.25)
    assert kept[:, :, 0].tolist() == [[0.25, 1.0]]
