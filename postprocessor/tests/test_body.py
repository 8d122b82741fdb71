"""Bodies of revolution: their surface, and how far they reach."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest

from plydyn_post.body import Body, hull
from plydyn_post.header import read_header

SPHERE = Body(4.0, (1.0, 2.0, 3.0))
ROD = Body(4.0, (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 4.0, ((0.0, 0.0), (20.0, 0.0)), 20.0)
FLAT = Body(3.0, (0, 0, 0), (1.0, 0.0, 0.0), 0.5, ((-4.5, 0), (-4.5, 2.5), (4.5, 2.5), (4.5, 0)))
CONE = Body(3.0, (0, 0, 0), (0.0, 0.0, 1.0), 1.0, ((-2.0, 0.0), (0.0, 2.0), (9.0, 2.0)), 9.0)


def volume(body: Body) -> float:
    """Volume inside of the triangles, whose normals look outwards."""
    points, triangles = body.surface()
    a, b, c = (points[triangles[:, i]] - np.array(body.centre) for i in range(3))
    return float(np.sum(np.einsum("ij,ij->i", a, np.cross(b, c)))) / 6.0


@pytest.mark.parametrize(
    ("body", "exact"),
    [
        (SPHERE, 4.0 / 3.0 * np.pi * 4.0**3),
        (ROD, 2.0 / 3.0 * np.pi * 4.0**3 + np.pi * 4.0**2 * 20.0),
        # Pappus: core, half discs of its edges
        (FLAT, np.pi * (2.5**2 * 10 + 9 * (3**2 - 2.5**2)) + 2 * np.pi**2 * 0.25 / 2 * 2.712206591),
    ],
)
def test_volume(body: Body, exact: float) -> None:
    """A body of triangles inside of a convex one: below its volume, by less than a per cent."""
    assert 0.99 < abs(volume(body)) / exact < 1.0


@pytest.mark.parametrize("body", [SPHERE, ROD, FLAT, CONE])
def test_reach_is_that_of_the_surface(body: Body) -> None:
    points = body.surface()[0] - np.array(body.centre)
    for direction in (1.0, -1.0) if np.isinf(body.back) else (-1.0,):
        farthest = (direction * points[:, 2]).max()
        assert farthest == pytest.approx(body.reach(direction), rel=1e-3)
    across = points - np.outer(points @ body.axis, body.axis)
    assert np.linalg.norm(across, axis=1).max() == pytest.approx(body.radius, rel=1e-12)


def test_hull() -> None:
    square = np.array([[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.5, 0.5], [0.0, 1.0], [0.5, 1.0]])
    corners = {tuple(corner) for corner in hull(square)}
    assert corners == {(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)}


def test_a_body_is_read_from_its_tables(tmp_path: Path) -> None:
    """A sphere and a rod whose outline has two corners; without outlines both are spheres."""
    path = tmp_path / "job.vtkhdf"
    rows = [[2, 4.0, 0.0, 0.0, 1.0, 20.0, along, 0.0] for along in (0.0, 20.0)]
    with h5py.File(path, "w") as file:
        file.create_group("VTKHDF")
        own = file.create_group("plydyn")
        table = own.create_dataset("impactors", data=[[1, 5.0, 1, 0, 0, 6], [2, 4.0, 1, 0, 0, 0]])
        table.attrs["columns"] = "id,radius,mass,x,y,z"
    assert read_header(path).impactors == {1: Body(5.0, (0, 0, 6)), 2: Body(4.0, (0, 0, 0))}
    with h5py.File(path, "a") as file:
        table = file["plydyn"].create_dataset("impactor_outlines", data=rows)
        table.attrs["columns"] = "id,rounding,axis x,axis y,axis z,back,along,across"
    assert read_header(path).impactors == {1: Body(5.0, (0, 0, 6)), 2: ROD}
