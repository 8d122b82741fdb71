"""Sketches of the manual: layered plate, crack band, cohesive law, contact, fixture, coupon, zones.

.venv/bin/python decks/sketches.py
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.patches import Arc, Circle, Polygon, Rectangle

import plydyn_pre as pre
from plydyn_post.style import COLOURS, INK, QUIET, WIDE, figure, save
from runner.pages import PICTURES

BLUE, ORANGE, GREEN = COLOURS[:3]


def bare(axes: Axes, width: tuple[float, float], height: tuple[float, float]) -> None:
    """Leave nothing of the axes but their room."""
    axes.set(xlim=width, ylim=height, aspect="equal")
    axes.axis("off")


def note(axes: Axes, text: str, at: tuple[float, float], **more: object) -> None:
    """Words in the sketch."""
    look: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": 8.5, **more}
    axes.text(*at, text, **look)


def arrow(axes: Axes, start: tuple[float, float], end: tuple[float, float], **more: object) -> None:
    """A straight arrow."""
    look = {"arrowstyle": "-|>", "color": INK, "lw": 1.0, "shrinkA": 0, "shrinkB": 0, **more}
    axes.annotate("", xy=end, xytext=start, arrowprops=look)


def layerwise() -> Path:
    """Columns of points above the nodes of the plane, plies of order 1, 2 and 3, and u(z)."""
    with figure(1, 2, size=(WIDE, 2.7), width_ratios=[2.2, 1.0]) as (made, (left, right)):
        bare(left, (-0.6, 6.4), (-1.15, 3.75))
        heights, orders = (0.0, 1.0, 2.0, 3.0), (1, 2, 3)
        for k, order in enumerate(orders):
            low, high = heights[k], heights[k + 1]
            shade = Rectangle((0, low), 4.4, high - low, color=COLOURS[k], alpha=0.18, lw=0)
            left.add_patch(shade)
            for x in (0.0, 2.2, 4.4):
                points = np.linspace(low, high, order + 1)
                left.plot(
                    [x] * len(points), points, "o", color=COLOURS[k], markersize=4.5, zorder=3
                )
            note(left, f"ply {k + 1}, order {order}", (5.35, low + 0.5))
        for x in (0.0, 2.2, 4.4):
            left.plot([x, x], [0.0, 3.0], color=QUIET, lw=0.8, zorder=1)
            left.plot(x, -0.6, "s", color=INK, markersize=4)
        left.plot([0.0, 4.4], [-0.6, -0.6], color=INK, lw=1.0)
        note(left, "nodes of the plane mesh", (2.2, -0.95))
        note(left, "column of points", (2.2, 3.35))
        for height in (1.0, 2.0):
            left.plot([0.0, 4.4], [height, height], color=INK, lw=0.8)
        bare(right, (-1.2, 1.5), (-1.15, 3.75))
        z = np.linspace(0.0, 1.0, 30)
        cubic = 0.4 + 0.2 * z + 1.2 * z * (z - 1.0) * (z - 0.4)
        pieces = (-0.75 + 0.5 * z, -0.25 + 0.65 * z**2, cubic)
        for k, piece in enumerate(pieces):
            right.plot(piece, k + z, color=COLOURS[k], lw=1.8)
        right.plot([0, 0], [0, 3], color=QUIET, lw=0.8)
        note(right, r"$u(z) = F_\tau(z)\,u_\tau$", (0.2, 3.35))
        arrow(right, (-1.0, -0.6), (-0.2, -0.6))
        note(right, "$u$", (0.0, -0.6))
        return save(made, PICTURES / "sketch_layerwise.png")


def crack_band() -> Path:
    """A crack across quads, its band, and the softening whose area is G over the width."""
    with figure(1, 2, size=(WIDE, 2.5)) as (made, (left, right)):
        bare(left, (-0.6, 5.6), (-1.1, 3.3))
        left.add_patch(Rectangle((2.0, 0.0), 1.0, 3.0, color=ORANGE, alpha=0.35, lw=0))
        for x in range(6):
            left.plot([x, x], [0, 3], color=QUIET, lw=0.8)
        for row in range(4):
            left.plot([0, 5], [row, row], color=QUIET, lw=0.8)
        y = np.linspace(0.0, 3.0, 40)
        left.plot(2.5 + 0.08 * np.sin(9 * y), y, color=INK, lw=1.6)
        for side in (-1, 1):
            arrow(left, (2.5 + side * 2.6, 1.5), (2.5 + side * 3.0, 1.5), color=BLUE, lw=1.6)
        arrow(left, (2.5, -0.4), (3.0, -0.4))
        arrow(left, (2.5, -0.4), (2.0, -0.4))
        note(left, "width of the band $l$", (2.5, -0.85))
        strain = np.array([0.0, 1.0, 3.4])
        stress = np.array([0.0, 1.0, 0.0])
        right.plot(strain, stress, color=BLUE, lw=2)
        right.fill(strain, stress, color=BLUE, alpha=0.15)
        note(right, "$G / l$", (1.45, 0.38), fontsize=11)
        right.set_xticks([1.0, 3.4], [r"$\varepsilon^i$", r"$\varepsilon^s = 2G/lT$"])
        right.set_yticks([1.0], ["$T$"])
        right.set(xlabel="equivalent strain", ylabel="equivalent stress", ylim=(0, 1.2))
        right.set_xlim(0, 4.0)
        return save(made, PICTURES / "sketch_crack_band.png")


def cohesive() -> Path:
    """The bilinear law: stiffness, strength, fracture energy, unloading, closing."""
    with figure(1, 1, size=(4.6, 2.8)) as (made, axes):
        law = np.array([[-0.28, -0.28], [0.0, 0.0], [0.5, 1.0], [3.0, 0.0]])
        axes.plot(*law[1:].T, color=BLUE, lw=2)
        axes.fill(*law[1:].T, color=BLUE, alpha=0.13)
        axes.plot([0.0, 1.5], [0.0, 0.6], color=ORANGE, lw=1.4, ls=(0, (5, 1.5)))
        axes.plot([-0.3, 0.0], [-0.6, 0.0], color=BLUE, lw=2)
        axes.plot([-0.3, 0.0], [-0.24, 0.0], color=ORANGE, lw=1.4, ls=(0, (5, 1.5)))
        axes.axhline(0.0, color=INK, lw=0.8)
        axes.axvline(0.0, color=INK, lw=0.8)
        note(axes, "$K$", (0.16, 0.62))
        note(axes, "$(1-d)\\,K$", (1.12, 0.30), color=ORANGE)
        note(axes, "fracture energy $G_c$", (1.55, 0.13))
        note(axes, "strength", (0.9, 1.03))
        note(axes, "closed: intact, damaged", (0.62, -0.42), fontsize=7.5)
        axes.set_xticks([0.5, 3.0], ["onset", "failure"])
        axes.set_yticks([])
        axes.set(xlabel="opening or sliding", ylabel="traction")
        axes.set(xlim=(-0.45, 3.4), ylim=(-0.65, 1.2))
        axes.grid(visible=False)
        return save(made, PICTURES / "sketch_cohesive.png")


def contact_row() -> Path:
    """Both discretisations of contact: a node on the sphere, a point of the plate."""
    with figure(1, 2, size=(WIDE, 2.5)) as (made, both):
        titles = ("METHOD 1: node on the impactor", "METHOD 2: point of the plate")
        for axes, title in zip(both, titles, strict=True):
            bare(axes, (-2.4, 2.4), (-1.35, 2.1))
            axes.add_patch(Circle((0.0, 1.6), 1.9, fill=False, color=INK, lw=1.2, clip_on=True))
            x = np.linspace(-2.3, 2.3, 80)
            axes.plot(x, 0.10 * x**2 - 0.15, color=BLUE, lw=2)
            points = np.array([-2.2, -1.1, 0.0, 1.1, 2.2])
            axes.plot(points, 0.10 * points**2 - 0.15, "o", color=BLUE, markersize=4.5)
            note(axes, title, (0.0, -1.2))
        first, second = both
        angles = np.radians(np.arange(-40, 41, 16) - 90.0)
        nodes = np.stack([1.9 * np.cos(angles), 1.6 + 1.9 * np.sin(angles)])
        first.plot(*nodes, "o", color=ORANGE, markersize=4.5)
        below = nodes[:, 3]
        surface = np.array([below[0] - 0.02, 0.10 * below[0] ** 2 - 0.15])
        arrow(first, tuple(surface), (surface[0] + 0.05, surface[1] + 0.9), color=GREEN, lw=1.6)
        note(first, r"$\mathbf{n}$", (surface[0] + 0.25, surface[1] + 0.85), color=GREEN)
        note(first, r"gap $g < 0$", (1.2, -0.55))
        first.plot([below[0], 0.85], [below[1], -0.5], color=QUIET, lw=0.7)
        note(first, "facet", (-1.75, -0.25))
        point = np.array([0.0, -0.15])
        arrow(second, tuple(point), (0.0, 0.75), color=GREEN, lw=1.6)
        note(second, r"$\mathbf{n}$", (0.22, 0.7), color=GREEN)
        second.plot(0.0, 1.6, "+", color=INK, markersize=8)
        second.plot([0.0, 1.34], [1.6, 0.26], color=QUIET, lw=0.8)
        note(second, "$R$", (0.85, 1.05))
        note(second, r"$g = |\mathbf{x} - \mathbf{c}| - R$", (1.15, -0.6))
        return save(made, PICTURES / "sketch_contact.png")


def fixture() -> Path:
    """A plate on a base with a window and edge radius, clamps with soft tips, a hemisphere."""
    with figure(1, 1, size=(WIDE, 2.6)) as (made, axes):
        bare(axes, (-5.6, 5.6), (-1.75, 2.6))
        axes.add_patch(Rectangle((-4.6, 0.0), 9.2, 0.34, color=BLUE, alpha=0.45, lw=0))
        note(axes, "plate", (0.0, 0.17))
        for side in (-1, 1):
            edge = [(side * x, z) for x, z in ((5.2, 0), (3.3, 0))]
            turn = np.radians(np.linspace(90, 180, 12))
            round_ = [(side * (3.3 + 0.35 * np.cos(a)), -0.35 + 0.35 * np.sin(a)) for a in turn]
            low = [(side * 2.95, -1.1), (side * 5.2, -1.1)]
            axes.add_patch(Polygon([*edge, *round_, *low], color=QUIET, alpha=0.55, lw=0))
            axes.add_patch(
                Rectangle((side * 4.0 - 0.35, 0.34), 0.7, 0.5, color=ORANGE, alpha=0.7, lw=0)
            )
            arrow(axes, (side * 4.0, 1.7), (side * 4.0, 0.88), color=ORANGE, lw=1.8)
        note(axes, "clamp: $F - k\\,u$", (4.1, 1.98), color=ORANGE)
        note(axes, "base", (-4.2, -0.65))
        note(axes, "edge radius", (-1.75, -0.55))
        axes.plot([-2.35, -2.95], [-0.45, -0.15], color=INK, lw=0.7)
        arrow(axes, (-0.2, -1.45), (-2.95, -1.45))
        arrow(axes, (0.2, -1.45), (2.95, -1.45))
        note(axes, "window", (0.0, -1.22))
        axes.add_patch(Arc((0.0, 1.24), 1.8, 1.8, theta1=180, theta2=360, color=INK, lw=1.3))
        axes.plot([-0.9, -0.9], [1.24, 2.2], color=INK, lw=1.3)
        axes.plot([0.9, 0.9], [1.24, 2.2], color=INK, lw=1.3)
        arrow(axes, (0.0, 2.3), (0.0, 1.3), lw=1.6)
        note(axes, "impactor", (1.75, 2.1))
        for place in (3.55, -3.55):
            arrow(axes, (place, -0.75), (place, -0.02), color=GREEN, lw=1.4)
        note(axes, r"$p_n \geq 0$, $|p_t| \leq \mu p_n$", (1.35, -0.75), color=GREEN)
        return save(made, PICTURES / "sketch_fixture.png")


def template(name: str) -> pre.Study:
    """The study of a template."""
    with TemporaryDirectory() as folder:
        recipe = Path(folder) / "recipe.toml"
        recipe.write_text(pre.example_recipe(name))
        return pre.load_recipe(recipe)


def coupon() -> Path:
    """The coupon of the template astm-d7136 from above, to scale: its mesh, base, clamps, tup."""
    study = template("astm-d7136")
    kind, tup = study.mesh, study.impactor
    assert isinstance(kind, pre.Coupon) and not isinstance(kind.plate, float) and tup is not None
    mesh = pre.make_mesh(kind)
    with figure(1, 1, size=(WIDE, 4.3)) as (made, axes):
        bare(axes, (-81.0, 81.0), (-59.0, 54.0))
        length, width = kind.plate
        hole = np.array(kind.window)
        axes.add_patch(Rectangle((-0.5 * length, -0.5 * width), length, width, color="0.82", lw=0))
        axes.add_patch(Rectangle(tuple(-0.5 * hole), *hole, color="white", lw=0))
        corners = mesh.nodes[mesh.quads[:, :4]] - mesh.nodes.mean(axis=0)
        lines = PolyCollection(corners, facecolors="none", edgecolors=BLUE, linewidths=0.35)
        axes.add_collection(lines)
        axes.add_patch(Rectangle(tuple(-0.5 * hole), *hole, fill=False, ec=INK, lw=1.2))
        core = kind.core
        square = Rectangle((-0.5 * core, -0.5 * core), core, core, fill=False, ec=GREEN, lw=1.4)
        axes.add_patch(square)
        for clamp in study.fixtures:
            if isinstance(clamp, pre.Clamp) and clamp.centre is not None:
                axes.add_patch(Circle(clamp.centre, clamp.outer, color=ORANGE, alpha=0.75, lw=0))
        axes.add_patch(Circle((0.0, 0.0), tup.radius, fill=False, ec=INK, lw=1.3))
        white = {"bbox": {"fc": "white", "ec": "none", "pad": 1.5, "alpha": 0.85}}
        note(axes, "tup", (0.0, 0.0), **white)
        note(axes, "core: equal quads", (0.0, 0.5 * core + 4.0), color=GREEN, **white)
        note(axes, "window of the base", (-46.0, 22.0), **white)
        note(axes, "base", (69.0, 0.0), rotation=90, **white)
        note(axes, "clamps", (0.0, 44.0), color=ORANGE, **white)
        for side in (-1, 1):
            arrow(axes, (side * 10.0, 44.0), (side * 42.0, 44.0), color=ORANGE)
        measure(axes, f"{length:g} mm, 0° along it", (-0.5 * length, -55.0), (0.5 * length, -55.0))
        measure(axes, f"{width:g} mm", (-79.0, -0.5 * width), (-79.0, 0.5 * width), rotation=90)
        return save(made, PICTURES / "sketch_coupon.png")


def zones() -> Path:
    """A plate with two zones of finer quads, an insert and a set, as in the page of recipes."""
    fine = pre.Zone(1.0, box=(40.0, 60.0, 40.0, 60.0)), pre.Zone(1.5, circle=(100.0, 50.0, 12.0))
    mesh = pre.make_mesh(pre.Rectangle((150.0, 100.0), (25, 17), zones=fine))
    corners, middles = mesh.nodes[mesh.quads[:, :4]], mesh.nodes[mesh.quads[:, 8]]
    low, high = np.array([10.0, 70.0]), np.array([33.0, 93.0])
    chosen = np.all((middles > low) & (middles < high), axis=1)
    # 3 x 3 Gauss points of each quad
    steps = 0.5 * np.sqrt(0.6) * np.array([(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)])
    points = (middles[:, None] + steps * np.ptp(corners, axis=1)[:, None]).reshape(-1, 2)
    insert = points[np.hypot(*(points - (100.0, 50.0)).T) <= 10.0]
    with figure(1, 1, size=(WIDE, 4.6)) as (made, axes):
        bare(axes, (-2.0, 152.0), (-2.0, 102.0))
        axes.add_collection(
            PolyCollection(list(corners[chosen]), facecolors=GREEN, alpha=0.45, lw=0)
        )
        lines = PolyCollection(list(corners), facecolors="none", edgecolors=BLUE, linewidths=0.3)
        axes.add_collection(lines)
        axes.plot(*insert.T, ".", color=ORANGE, markersize=0.7)
        axes.add_patch(Circle((100.0, 50.0), 10.0, fill=False, ec=ORANGE, lw=1.4))
        axes.add_patch(Rectangle(tuple(low), *(high - low), fill=False, ec=GREEN, lw=1.4))
        for zone in fine:
            (x1, x2), (y1, y2) = (zone.reach(axis) for axis in (0, 1))
            axes.add_patch(Rectangle((x1, y1), x2 - x1, y2 - y1, fill=False, ec=INK, lw=1.4))
        white = {"bbox": {"fc": "white", "ec": "none", "pad": 1.5, "alpha": 0.9}}
        note(axes, "zone: box, size 1", (50.0, 66.0), **white)
        note(axes, "zone: circle, size 1.5", (100.0, 68.0), **white)
        note(axes, "insert: points in a circle", (100.0, 32.0), color=ORANGE, **white)
        note(axes, "set: quads with their middle in a box", (38.0, 97.0), color=GREEN, **white)
        return save(made, PICTURES / "sketch_zones.png")


def measure(
    axes: Axes, text: str, start: tuple[float, float], end: tuple[float, float], rotation: float = 0
) -> None:
    """A length between two arrow heads."""
    arrow(axes, start, end, arrowstyle="<|-|>")
    middle = (0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1]))
    note(axes, text, middle, rotation=rotation, bbox={"fc": "white", "ec": "none", "pad": 2.0})


SKETCHES: tuple[Callable[[], Path], ...] = (
    layerwise,
    crack_band,
    cohesive,
    contact_row,
    fixture,
    coupon,
    zones,
)

if __name__ == "__main__":
    for draw in SKETCHES:
        draw()
