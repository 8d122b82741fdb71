"""Zones of finer quads: their sizes on the mesh, and zones that cannot be."""

from __future__ import annotations

import subprocess
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from deck_cards import text_of

import plydyn_pre as pre
from plydyn_pre.mesh.lines import Span, zoned_line
from plydyn_pre.typed import build

PLATE = pre.Rectangle((150.0, 100.0), (25, 20), corner=(-70.0, 5.0))
TWO = (
    pre.Zone(1.0, box=(-40.0, -20.0, 30.0, 60.0)),
    pre.Zone(2.0, circle=(40.0, 50.0, 15.0)),
)
FRAME = pre.Coupon(
    plate=(150.0, 100.0), window=(125.0, 75.0), core=45.0, quad=3.0, centre=(3.0, -2.0)
)
MOST_SCALE = 1.1
ROUND_OFF = 1e-9


def sides(mesh: pre.Mesh) -> np.ndarray:
    """Lengths of the quads along x and y, (quads, 2)."""
    corners = mesh.nodes[mesh.quads[:, :4]]
    return corners.max(axis=1) - corners.min(axis=1)


def in_zone(mesh: pre.Mesh, zone: pre.Zone) -> np.ndarray:
    """Which quads have their middle in the box around a zone."""
    corners = mesh.nodes[mesh.quads[:, :4]].mean(axis=1)
    low, high = np.transpose([zone.reach(axis) for axis in (0, 1)])
    return np.all((corners > low) & (corners < high), axis=1)


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("number", [0, 1])
def test_quads_of_a_zone_have_its_size_and_fill_it(number: int, order: int) -> None:
    """Lengths that the size divides: all quads have the size, and none lies across the edge."""
    mesh = pre.make_mesh(replace(PLATE, zones=TWO, order=order))
    zone = TWO[number]
    found = sides(mesh)[in_zone(mesh, zone)]
    low, high = np.transpose([zone.reach(axis) for axis in (0, 1)])
    # the rows of both zones overlap from y = 35 to 60, where the finer counts
    assert found[:, 0] == pytest.approx(np.full(len(found), zone.size), rel=ROUND_OFF)
    assert found[:, 1].max() <= zone.size * (1.0 + ROUND_OFF)
    assert found.prod(axis=1).sum() == pytest.approx(float(np.prod(high - low)), rel=ROUND_OFF)


def test_quads_grow_outside_of_zones_and_keep_their_shape() -> None:
    """By the growth from row to row, a tenth of scale aside, up to the quads without zones."""
    mesh = pre.make_mesh(replace(PLATE, zones=TWO, order=1))
    measures = pre.quality(mesh)
    assert measures.smallest_jacobian == pytest.approx(1.0, rel=ROUND_OFF)
    assert measures.area == pytest.approx(150.0 * 100.0, rel=ROUND_OFF)
    for axis, largest in ((0, 6.0), (1, 5.0)):
        steps = np.diff(np.unique(mesh.nodes[:, axis].round(9)))
        ratios = steps[1:] / steps[:-1]
        assert max(ratios.max(), (1.0 / ratios).max()) <= MOST_SCALE * PLATE.growth
        assert 0.9 * largest < steps.max() <= MOST_SCALE * largest
    assert len(mesh.quads) < 4000


def test_zones_may_differ_in_x_and_y() -> None:
    """A strip one quad wide, fine around the tip of a crack."""
    zone = pre.Zone((0.5, 5.0), box=(40.0, 60.0, 0.0, 5.0))
    mesh = pre.make_mesh(pre.Rectangle((150.0, 5.0), (30, 1), zones=(zone,)))
    found = sides(mesh)[in_zone(mesh, zone)]
    assert len(found) == 40
    assert found == pytest.approx(np.tile([0.5, 5.0], (40, 1)), rel=ROUND_OFF)


def test_symmetric_zones_make_a_symmetric_mesh() -> None:
    """The lines are the same seen from both ends."""
    spans = [Span(20.0, 30.0, 1.0), Span(70.0, 80.0, 1.0)]
    steps = np.diff(zoned_line((0.0, 100.0), spans, 1.3, 6.0))
    assert steps == pytest.approx(steps[::-1], rel=ROUND_OFF)


def test_zones_within_zones_grow_within_the_outer_one() -> None:
    """No quad of the outer zone is larger than its size."""
    spans = [Span(40.0, 50.0, 1.0), Span(20.0, 80.0, 2.0)]
    line = zoned_line((0.0, 150.0), spans, 1.3, 6.0)
    middle, steps = (line[1:] + line[:-1]) / 2, np.diff(line)
    assert steps[(middle > 20.0) & (middle < 80.0)].max() <= 2.0 * (1.0 + ROUND_OFF)
    assert steps[(middle > 40.0) & (middle < 50.0)] == pytest.approx(np.ones(10), rel=ROUND_OFF)


def test_no_sliver_is_left_between_zones_and_at_the_edge() -> None:
    """A gap of a tenth of a quad goes to the zone."""
    for spans, end in (
        ([Span(10.0, 20.0, 1.0), Span(20.1, 30.0, 1.0)], 100.0),
        ([Span(10.0, 99.9, 1.0)], 100.0),
    ):
        assert np.diff(zoned_line((0.0, end), spans, 1.3, 6.0)).min() > 0.9


def test_any_spans_have_their_sizes_and_the_line_its_ends() -> None:
    """Spans at random, overlapping or not: no quad is larger than its span or folded over."""
    chance = np.random.default_rng(1)
    for _ in range(500):
        sizes = chance.choice([0.5, 1.0, 2.0, 3.0], chance.integers(1, 5))
        lows = chance.uniform(0.0, 90.0, len(sizes))
        highs = np.minimum(lows + sizes + chance.uniform(0.0, 40.0, len(sizes)), 100.0)
        spans = [Span(*span) for span in zip(lows, highs, sizes, strict=True)]
        line = zoned_line((0.0, 33.0, 100.0), spans, chance.choice([1.1, 1.3, 2.0]), 6.0)
        middle, steps = (line[1:] + line[:-1]) / 2, np.diff(line)
        assert steps.min() > 0.0
        assert (line[0], line[-1]) == (0.0, 100.0)
        assert 33.0 in line
        for span in spans:
            inside = steps[(middle > span.low) & (middle < span.high)]
            assert inside.max() <= span.size * (1.0 + ROUND_OFF)
        assert steps.max() <= MOST_SCALE * 6.0 * (1.0 + ROUND_OFF)


def test_zones_of_a_coupon_keep_its_core_and_window() -> None:
    """The core is a zone like the others, with a node in the middle of the plate."""
    zone = pre.Zone(1.0, box=(-45.0, -30.0, -12.0, 8.0))
    mesh = pre.make_mesh(replace(FRAME, zones=(zone,)))
    found = sides(mesh)[in_zone(mesh, zone)]
    assert found.max() == pytest.approx(1.0, rel=ROUND_OFF)
    assert {"centre", "core", "window"} <= set(mesh.node_sets)
    assert sides(mesh)[mesh.quad_sets["core"]].max() <= 45.0 / 16.0 + ROUND_OFF
    off = np.abs(mesh.nodes[mesh.node_sets["window"]] - FRAME.centre) / (62.5, 37.5)
    assert off.max(axis=1) == pytest.approx(np.ones(len(off)), rel=ROUND_OFF)
    assert pre.quality(mesh).smallest_jacobian == pytest.approx(1.0, rel=ROUND_OFF)


def test_the_core_may_hold_a_zone_and_be_cut_to_a_quarter() -> None:
    """A zone around the middle leaves a node there, and its quarter is one of the whole."""
    zone = pre.Zone(1.0, box=(-2.0, 8.0, -7.0, 3.0))
    shape = replace(FRAME, zones=(zone,))
    mesh = pre.make_mesh(shape)
    assert sides(mesh)[in_zone(mesh, zone)] == pytest.approx(np.ones((100, 2)), rel=ROUND_OFF)
    assert np.allclose(mesh.nodes[mesh.node_sets["centre"]], [FRAME.centre])
    half = pre.Zone(1.0, box=(3.0, 8.0, -2.0, 3.0))
    quarter = pre.make_mesh(replace(shape, zones=(half,), quarter=True))
    assert sides(quarter)[in_zone(quarter, half)] == pytest.approx(np.ones((25, 2)), rel=ROUND_OFF)


@pytest.mark.parametrize(
    ("shape", "zone", "path", "words"),
    [
        (PLATE, {"size": 1.0}, "", "needs one of box"),
        (PLATE, {"size": 1.0, "box": (0, 9, 9, 19), "circle": (0, 9, 2)}, "", "needs one of box"),
        (PLATE, {"size": 0.0, "box": (0, 9, 9, 19)}, "size", "above zero"),
        (PLATE, {"size": 1.0, "box": (9, 0, 9, 19)}, "box", "x1 <= x2"),
        (PLATE, {"size": 2.0, "box": (0, 1, 9, 19)}, "box", "1 wide along x, less than a quad"),
        (PLATE, {"size": 1.0, "circle": (0, 20, 0)}, "circle", "a radius above zero"),
        (
            PLATE,
            {"size": 1.0, "box": (90, 99, 9, 19)},
            "zones[1].box",
            "the mesh is from -70 to 80",
        ),
        (PLATE, {"size": 1.0, "circle": (0, 9, 5)}, "zones[1].circle", "the mesh is from 5 to 105"),
        (PLATE, {"size": 6.0, "box": (0, 9, 9, 19)}, "zones[1].size", "elsewhere, 6 x 5"),
        (PLATE, {"size": 1e-5, "box": (0, 9, 9, 19)}, "zones[1].size", "quads would be made"),
        (
            replace(FRAME, quarter=True),
            {"size": 1.0, "box": (-9, 9, 9, 19)},
            "zones[1].box",
            "3 to",
        ),
        (FRAME, {"size": 7.0, "box": (-9, 9, 9, 19)}, "zones[1].size", "elsewhere, 6 x 6"),
        (
            pre.Coupon(plate=100.0, window=75.0, core=24.0, quad=3.0),
            {"size": 1.0, "box": (-9, 9, 9, 19)},
            "zones",
            "a round window takes none",
        ),
        (
            replace(PLATE, quads=(24, 20), grading=2.0),
            {"size": 1.0, "box": (0, 9, 9, 19)},
            "gr",
            "1 is",
        ),
    ],
)
def test_zones_that_cannot_be_are_refused(
    shape: object, zone: dict[str, object], path: str, words: str
) -> None:
    """Each with its key and what would be right."""
    with pytest.raises(pre.RecipeError, match=None) as caught:
        replace(shape, zones=(pre.Zone(**zone),))
    assert caught.value.path.startswith(path)
    assert words in caught.value.message


def test_recipes_name_the_zone_that_is_wrong(tmp_path: Path) -> None:
    """Keys within the list are told as elsewhere."""
    recipe = tmp_path / "zones.toml"
    text = """
title = "Zones"
materials.metal = { kind = "elastic", density = 2.7e-9, E = 70000, nu = 0.33 }
laminate = { layup = "[0]", material = "metal", thickness = 1 }
control.end_time = 1e-3
[mesh]
kind = "rectangle"
sides = [100, 50]
quads = [20, 10]
[[mesh.zones]]
size = 1
box = [10, 30, 10, 30]
[[mesh.zones]]
size = [1, 2]
"""
    recipe.write_text(f"{text}circle = [80, 25, 10]")
    assert pre.load_recipe(recipe).mesh.zones[1] == pre.Zone((1.0, 2.0), circle=(80.0, 25.0, 10.0))
    for line, place in (
        ("circle = [95, 25, 10]", "mesh.zones[2].circle: from x = 85 to 105"),
        (
            "cirle = [80, 25, 10]",
            "mesh.zones[2].cirle: there is no such key; did you mean 'circle'",
        ),
        ("", "mesh.zones[2]: a zone needs one of"),
    ):
        recipe.write_text(f"{text}{line}")
        with pytest.raises(pre.RecipeError) as caught:
            pre.load_recipe(recipe)
        assert place in str(caught.value)


def test_the_recipe_of_the_manual_has_the_quads_that_it_tells() -> None:
    """The first block of the section, and the count in its text."""
    page = Path(__file__).resolve().parents[2] / "manual" / "recipes.md"
    section = page.read_text(encoding="utf-8").split("## Zones of finer quads")[1]
    shape = build(
        pre.Rectangle, tomllib.loads(section.split("```")[1].removeprefix("toml"))["mesh"]
    )
    count = len(pre.make_mesh(shape).quads)
    assert f"{count:,} quads" in " ".join(section.split())


def test_the_solver_takes_zones(study: pre.Study, solver: str, tmp_path: Path) -> None:
    """No warning about the mesh."""
    deck = tmp_path / "zones.k"
    zone = pre.Zone(1.0, circle=(15.0, 15.0, 5.0))
    deck.write_text(
        text_of(
            replace(
                study,
                mesh=pre.Rectangle((30.0, 30.0), (6, 6), zones=(zone,)),
                sets={},
                loads=(),
                outputs=pre.Outputs(),
                control=replace(study.control, end_time=1.0e-3),  # behind the contact
            )
        )
    )
    done = subprocess.run([solver, "check", deck], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "warning" not in done.stdout + done.stderr
