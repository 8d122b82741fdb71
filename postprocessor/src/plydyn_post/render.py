"""Two ways to draw a scene: by VTK, and by matplotlib where VTK cannot draw."""

from __future__ import annotations

import os

import numpy as np
import pyvista as pv
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import Normalize
from matplotlib.patches import Polygon

from plydyn_post.body import hull
from plydyn_post.camera import Camera
from plydyn_post.offscreen import CHOICE
from plydyn_post.scene import Lines, Scene
from plydyn_post.style import INK

# Pixels that VTK draws for each one that is shown, along each side
FINER = 2
# Opacity and colour of an impactor
GLASS, STEEL = 0.38, "#8c929a"
# Opacity of the lines between elements
FAINT = 0.22
# Light that comes from everywhere; the rest comes from beside the eye
AMBIENT = 0.6


def render_vtk(scene: Scene, camera: Camera, width: int, window: str) -> np.ndarray:
    """A picture by VTK, (height, width, 3) from 0 to 1."""
    os.environ[CHOICE] = window
    size = [FINER * width, FINER * round(width * camera.aspect)]
    plotter = pv.Plotter(off_screen=True, window_size=size, lighting="none")
    plotter.background_color = pv.Color("white")
    plotter.add_light(pv.Light(position=tuple(_light(camera)), focal_point=(0, 0, 0)))
    _add_plate(plotter, scene)
    _add_lines(plotter, scene, camera, ply_strength(scene, camera, width))
    for body in scene.bodies:
        surface = pv.PolyData.from_regular_faces(*body.surface())
        plotter.add_mesh(
            surface,
            color=STEEL,
            opacity=GLASS,
            smooth_shading=True,
            split_sharp_edges=True,
            ambient=0.4,
            culling="back",
        )
    _look(plotter, scene, camera)
    image = np.asarray(plotter.screenshot(None, return_img=True))
    plotter.close()
    rows, columns = (number // FINER * FINER for number in image.shape[:2])
    tiles = image[:rows, :columns].reshape(rows // FINER, FINER, columns // FINER, FINER, 3)
    return tiles.mean(axis=(1, 3)) / 255.0


def _light(camera: Camera) -> np.ndarray:
    """Direction to the light, from above the eye, far away, (3,)."""
    way = camera.towards - 0.1 * camera.right + 1.2 * camera.up
    return way / np.linalg.norm(way)


def _add_plate(plotter: pv.Plotter, scene: Scene) -> None:
    mesh = pv.PolyData.from_regular_faces(scene.points, scene.triangles)
    mesh.point_data["value"] = scene.values
    mesh = mesh.compute_normals(cell_normals=False, split_vertices=False, consistent_normals=False)
    plotter.add_mesh(
        mesh,
        scalars="value",
        cmap=scene.colours,
        clim=scene.limits,
        n_colors=256,
        show_scalar_bar=False,
        smooth_shading=True,
        ambient=AMBIENT,
        diffuse=1.0 - AMBIENT,
    )


def ply_strength(scene: Scene, camera: Camera, width: int) -> float:
    """Opacity of the lines between plies, less where there are many in little space."""
    return float(np.clip(0.2 * (camera.pixels(scene.ply_height, width) - 1.0), 0.0, 0.85))


def _seen(lines: Lines, camera: Camera) -> np.ndarray:
    """Segments on faces that look to the eye, (segments, 2, 3)."""
    return lines.ends[lines.looks @ camera.towards > 0.0]


def _add_lines(plotter: pv.Plotter, scene: Scene, camera: Camera, strength: float) -> None:
    """Lines on faces that look to the eye, moved a little to it so that faces do not cover them."""
    ahead = 3e-4 * float(np.ptp(scene.points[:, :2], axis=0).max()) * camera.towards
    for lines, opacity in ((scene.mesh_lines, FAINT), (scene.ply_lines, strength)):
        segments = _seen(lines, camera)
        if len(segments) == 0 or opacity == 0.0:
            continue
        ends = segments.reshape(-1, 3) + ahead
        pairs = np.arange(len(ends)).reshape(-1, 2)
        drawn = pv.PolyData(ends, lines=np.insert(pairs, 0, 2, axis=1).ravel())
        plotter.add_mesh(drawn, color=INK, opacity=opacity, line_width=FINER * 0.8, lighting=False)


def _look(plotter: pv.Plotter, scene: Scene, camera: Camera) -> None:
    """Set the parallel view."""
    far = 10.0 * float(np.ptp(scene.points, axis=0).max())
    view = plotter.camera
    view.focal_point = tuple(camera.middle)
    view.position = tuple(camera.middle + far * camera.towards)
    view.up = tuple(camera.up)
    view.parallel_projection = True
    view.parallel_scale = (camera.window[3] - camera.window[2]) / 2
    plotter.renderer.ResetCameraClippingRange()


def draw_plain(axes: Axes, scene: Scene, camera: Camera, width: int) -> None:
    """Draw by matplotlib: triangles from the farthest to the nearest, then lines."""
    corners = camera.seen(scene.points[scene.triangles])
    order = np.argsort(corners[..., 2].mean(axis=1))
    shapes, colours = corners[order, :, :2], _shaded(scene, camera)[order]
    axes.add_collection(
        PolyCollection(list(shapes), facecolors=colours, edgecolors=colours, linewidths=0.3)
    )
    strength = ply_strength(scene, camera, width)
    for lines, opacity in ((scene.mesh_lines, FAINT), (scene.ply_lines, strength)):
        segments = camera.seen(_seen(lines, camera))[..., :2]
        axes.add_collection(
            LineCollection(list(segments), colors=INK, alpha=opacity, linewidths=0.35)
        )
    for body in scene.bodies:
        seen = camera.seen(body.surface()[0])[:, :2]
        axes.add_patch(Polygon(hull(seen), facecolor=STEEL, edgecolor=INK, alpha=GLASS))


def _shaded(scene: Scene, camera: Camera) -> np.ndarray:
    """Colours of triangles in light, (triangles, 4)."""
    a, b, c = (scene.points[scene.triangles[:, corner]] for corner in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
    light = AMBIENT + (1.0 - AMBIENT) * np.abs(normal @ _light(camera))
    value = scene.values[scene.triangles].mean(axis=1)
    colours = scene.colours(Normalize(*scene.limits)(value))
    colours[:, :3] *= light[:, None]
    return colours
