"""Coupons, the fixtures that hold them, and the templates of tests."""

from __future__ import annotations

from dataclasses import replace
from math import pi, sqrt
from pathlib import Path

import numpy as np
import pytest
from conftest import BOND, CARBON
from deck_cards import cards_of, fields_of, text_of
from programs import solve

import plydyn_pre as pre
from plydyn_pre.recipe import templates
from plydyn_pre.study.levels import fitted_strengths
from plydyn_pre.study.resolved import resolved

FRAME = pre.Coupon(plate=(150.0, 100.0), window=(125.0, 75.0), core=45.0, quad=3.0)
DISC = pre.Coupon(plate=100.0, window=75.0, core=24.0, quad=3.0, centre=(3.0, -2.0))
SQUARE = replace(DISC, plate=(110.0, 100.0))
#: Templates whose meshes have no level
NO_COUPONS = ("dcb", "impact", "impact-all")
COUPONS = pytest.mark.parametrize("shape", [FRAME, DISC, SQUARE])


@COUPONS
@pytest.mark.parametrize("order", [1, 2])
def test_the_core_has_equal_quads_along_the_axes_and_a_node_in_the_middle(
    shape: pre.Coupon, order: int
) -> None:
    mesh = pre.make_mesh(replace(shape, order=order))
    corners = mesh.nodes[mesh.quads[mesh.quad_sets["core"]][:, :4]]
    count = round(shape.core / shape.quad / 2 + 0.49) * 2
    assert len(corners) == count**2
    size = shape.core / count
    square = np.array([[0.0, 0.0], [size, 0.0], [size, size], [0.0, size]])
    turned = np.sort(corners - corners.min(axis=1, keepdims=True), axis=1)
    assert np.allclose(turned, np.sort(square, axis=0), atol=1e-9)
    assert np.allclose(mesh.nodes[mesh.node_sets["centre"]], [shape.centre])


@pytest.mark.parametrize(
    ("place", "middle"),
    # 16 quads of 2.8125 in the core; 13 more along x, 4 along y, leave one up to the window
    [
        ((10.0, -6.0), (4 * 2.8125, -2 * 2.8125)),
        ((22.5, 0.0), (22.5, 0.0)),
        ((58.0, 34.0), (13 * 2.8125, 4 * 2.8125)),
        ((-58.0, -34.0), (-13 * 2.8125, -4 * 2.8125)),
    ],
)
@pytest.mark.parametrize("order", [1, 2])
def test_the_core_lies_under_an_impact_beside_the_middle(
    place: tuple[float, float], middle: tuple[float, float], order: int
) -> None:
    """By whole quads: they stay equal, and mesh lines run through the middle and the window."""
    mesh = pre.make_mesh(replace(FRAME, core_at=place, order=order))
    corners = mesh.nodes[mesh.quads[mesh.quad_sets["core"]][:, :4]]
    assert len(corners) == 16**2
    assert np.allclose(np.ptp(corners, axis=1), 2.8125)
    assert np.allclose((corners.min(axis=(0, 1)) + corners.max(axis=(0, 1))) / 2, middle)
    assert np.allclose(mesh.nodes[mesh.node_sets["centre"]], [[0.0, 0.0]])
    for axis, half in ((0, 62.5), (1, 37.5)):
        assert np.isclose(np.unique(mesh.nodes[:, axis])[:, None], [-half, half]).any(axis=0).all()


def test_the_core_follows_the_only_impactor(tmp_path: Path) -> None:
    """With its cracks; a place of its own comes first, and two impacts leave it in the middle."""
    path = tmp_path / "coupon.toml"
    path.write_text(pre.example_recipe("astm-d7136"))
    beside = "impactor.position=[10.0, -6.0]"
    study = pre.load_recipe(path, [beside])
    assert isinstance(study.mesh, pre.Coupon)
    off = np.array(study.mesh.core_middle) - (10.0, -6.0)
    assert np.abs(off).max() <= study.mesh.quad / 2
    circle = resolved(study).parts["cracks"].circle
    assert circle is not None and circle[:2] == study.mesh.core_middle
    middle = pre.load_recipe(path, [beside, "mesh.core_at=[0.0, 0.0]"]).mesh
    path.write_text(pre.example_recipe("repeated-impact"))
    for mesh in (middle, pre.load_recipe(path).mesh):
        assert isinstance(mesh, pre.Coupon) and mesh.core_middle == (0.0, 0.0)


@COUPONS
def test_a_mesh_line_follows_the_window(shape: pre.Coupon) -> None:
    mesh = pre.make_mesh(shape)
    off = np.abs(mesh.nodes - shape.centre)
    if isinstance(shape.window, tuple):
        half = np.array(shape.window) / 2
        reach = (off / half).max(axis=1)
    else:
        reach = np.hypot(*off.T) / (shape.window / 2)
    line = mesh.node_sets["window"]
    assert np.allclose(reach[line], 1.0, atol=1e-9)
    # no quad lies on both sides of it, and it goes around once
    sides = np.sign(np.round(reach - 1.0, 6))[mesh.quads]
    assert not np.any((sides.min(axis=1) < 0) & (sides.max(axis=1) > 0))
    angles = np.sort(np.arctan2(*(mesh.nodes[line] - shape.centre).T))
    assert np.max(np.diff(angles)) < 0.3


@COUPONS
def test_quads_outside_of_the_core_grow_and_fill_the_plate(shape: pre.Coupon) -> None:
    mesh = pre.make_mesh(shape)
    assert pre.quality(mesh).smallest_jacobian > 0.5
    area = pi / 4 * 100.0**2 if mesh.node_sets.keys().isdisjoint({"left"}) else None
    exact = area or float(np.prod(shape.plate))
    assert pre.quality(mesh).area == pytest.approx(exact, rel=1e-4)


def test_neighbours_along_a_line_grow_by_the_growth_at_most() -> None:
    mesh = pre.make_mesh(replace(FRAME, order=1))
    along = np.unique(np.round(mesh.nodes[:, 0], 9))
    sizes = np.diff(along)
    assert np.max(sizes[1:] / sizes[:-1]) < 1.1 * FRAME.growth
    assert {-75.0, -62.5, -22.5, 0.0, 22.5, 62.5, 75.0} <= set(along)
    assert sizes.max() <= 1.1 * FRAME.largest


def test_a_quarter_of_a_coupon_is_what_lies_at_larger_x_and_y() -> None:
    whole, quarter = pre.make_mesh(DISC), pre.make_mesh(replace(DISC, quarter=True))
    assert 4 * len(quarter.quads) == len(whole.quads)
    assert {"symmetry_x", "symmetry_y", "window", "core"} <= set(quarter.node_sets)
    assert quarter.middle == DISC.centre


@pytest.mark.parametrize(
    ("key", "values"),
    [
        ("window", {"window": (125.0, 100.0)}),
        ("window", {"plate": 150.0}),
        ("core", {"core": 75.0}),
        ("core", {"window": 75.0, "core": 54.0}),
        ("quad", {"quad": 0.01}),
        ("growth", {"growth": 3.0}),
        ("plate", {"plate": (0.0, 100.0)}),
        ("core_at", {"core_at": (1.0, 0.0), "window": 75.0}),
        ("core_at", {"core_at": (1.0, 0.0), "quarter": True}),
    ],
)
def test_coupons_that_cannot_be_meshed_are_refused(key: str, values: dict[str, object]) -> None:
    with pytest.raises(pre.RecipeError) as caught:
        replace(FRAME, **values)
    assert caught.value.path == key


def study_of(shape: object = FRAME, **values: object) -> pre.Study:
    """A study of a coupon on a frame."""
    laminate = pre.Laminate(layup="[0/90]2s", material="carbon", thickness=0.25, order=1)
    return pre.Study(
        **{
            "title": "Coupon",
            "materials": {"carbon": CARBON, "bond": BOND},
            "laminate": replace(laminate, interfaces="bond"),
            "mesh": shape,
            "fixtures": (pre.Plane(face="bottom"),),
            "impactor": pre.Impactor(8.0, 2.0e-3, energy=16.0e3),
            "control": pre.Control(end_time=1.0e-3),
        }
        | values
    )


def test_zones_are_the_smaller_of_a_large_body_and_of_thin_layers() -> None:
    zone = pre.process_zone([study_of().laminate], {"carbon": CARBON, "bond": BOND})
    across, along = CARBON.E3, CARBON.E1
    opening = (along * BOND.GIC * 0.25**3 / BOND.N**2) ** 0.25
    sliding = sqrt(along * BOND.GIIC * 0.25) / BOND.S
    share = 9.0 * pi / 32.0 * across
    assert zone.opening == pytest.approx(min(opening, share * BOND.GIC / BOND.N**2))
    assert zone.sliding == pytest.approx(min(sliding, share * BOND.GIIC / BOND.S**2))
    assert pre.process_zone([pre.Laminate("[0]", 1.0, "carbon")], {"carbon": CARBON}) is None


def test_a_level_gives_quads_by_the_process_zone() -> None:
    sizes = {}
    for level in ("look", "standard", "fine"):
        study = study_of(replace(FRAME, quad=0.0, level=level))
        sizes[level] = study.mesh.quad
    zone = pre.process_zone(study.all_laminates, study.materials)
    assert sizes["look"] > sizes["standard"] > sizes["fine"]
    # three distances between nodes, two of which are in a quad of nine nodes
    assert sizes["fine"] == pytest.approx(2.0 * zone.sliding / 3.0, rel=0.05)
    assert sizes["fine"] <= 2.0 * zone.sliding / 3.0
    assert study_of().mesh.quad == pytest.approx(FRAME.core / 16)


def test_strengths_fitted_to_the_core_have_zones_of_three_node_distances() -> None:
    weak = replace(BOND, fit="core")
    study = study_of(materials={"carbon": CARBON, "bond": weak})
    card = cards_of(text_of(study))["MAT_COHESIVE_MIXED_MODE_TITLE"]
    lower = replace(BOND, N=float(fields_of("", card[2])[1]), S=float(fields_of("", card[2])[2]))
    share = 9.0 * pi / 32.0 * CARBON.E3
    spans = [share * BOND.GIC / lower.N**2, share * BOND.GIIC / lower.S**2]
    assert min(spans) == pytest.approx(3.0 * study.mesh.quad / 2.0, rel=1e-5)
    assert pytest.approx(BOND.S / BOND.N, rel=1e-5) == lower.S / lower.N
    assert fields_of("", cards_of(text_of(study))["INTERFACE_COHESIVE"][0])[-1] == "0"
    with pytest.raises(pre.RecipeError, match=r"materials\.bond\.fit: only a mesh"):
        study_of(pre.Rectangle((1.0, 1.0), (2, 2)), materials=study.materials)


def test_each_mode_has_the_strength_of_its_own_zone() -> None:
    """A quasi-isotropic laminate has the modulus of the invariants of its ply (Tsai, Pagano).

    The modes of a crack in an orthotropic body: Sih, Paris and Irwin, with compliances.
    """
    laminate = pre.Laminate("[45/0/-45/90]s", 0.2, "carbon", interfaces="bond")
    strong = replace(BOND, fit="modes", N=600.0, S=900.0, normal=1.0e7, shear=1.0e7)
    shape = pre.Coupon(plate=100.0, window=75.0, core=24.0, quad=2.0, order=1)
    materials = {"carbon": CARBON, "bond": strong}
    N, S = fitted_strengths("bond", shape, [laminate], materials)
    ply, share = CARBON, 1.0 - CARBON.nu12**2 * CARBON.E2 / CARBON.E1
    q11, q22, q12 = ply.E1 / share, ply.E2 / share, ply.nu12 * ply.E2 / share
    first = (3.0 * q11 + 3.0 * q22 + 2.0 * q12 + 4.0 * ply.G12) / 8.0
    fifth = (q11 + q22 - 2.0 * q12 + 4.0 * ply.G12) / 8.0
    a11, a33, a55 = first / (4.0 * fifth * (first - fifth)), 1.0 / ply.E3, 1.0 / ply.G13
    root = sqrt(sqrt(a33 / a11) + a55 / (2.0 * a11))
    opening, sliding = sqrt(a11 * a33 / 2.0) * root, a11 / sqrt(2.0) * root
    zone = 9.0 * pi / 32.0 / (3.0 * 2.0)
    assert pytest.approx(sqrt(zone * BOND.GIC / opening), rel=1e-9) == N
    assert pytest.approx(sqrt(zone * BOND.GIIC / sliding), rel=1e-9) == S
    own = replace(BOND, fit="modes")
    known = fitted_strengths("bond", shape, [laminate], {"carbon": CARBON, "bond": own})
    assert known[0] < BOND.N and known[1] == pytest.approx(S)
    weak = replace(BOND, fit="modes", N=1.0, S=2.0)
    kept = fitted_strengths("bond", shape, [laminate], {"carbon": CARBON, "bond": weak})
    assert kept == (1.0, 2.0)


def test_the_velocity_follows_from_the_energy_and_the_mass() -> None:
    assert study_of().impactor.velocity == pytest.approx((0.0, 0.0, -4000.0))
    with pytest.raises(pre.RecipeError, match="velocity: missing"):
        pre.Impactor(8.0, 2.0e-3)
    with pytest.raises(pre.RecipeError, match="leave one out"):
        pre.Impactor(8.0, 2.0e-3, (0.0, 0.0, -1.0), energy=1.0)
    with pytest.raises(pre.RecipeError, match=r"contact\.face: a fall hits the top face"):
        study_of(contact=pre.Contact(face="bottom"))


def test_an_impactor_rubs_and_follows_a_curve() -> None:
    study = study_of(
        impactor=pre.Impactor(8.0, 2.0e-3, motion_z="push"),
        contact=pre.Contact(friction=0.2),
        curves={"push": pre.Curve((0.0, 1.0e-3), (0.0, -500.0))},
    )
    cards = cards_of(text_of(study))
    assert fields_of("", cards["IMPACTOR_SPHERE"][1])[2] == "0.0"
    assert fields_of("", cards["IMPACTOR_SPHERE"][2]) == ["0.0", "0.0", "0.0", "0", "0", "1", "0"]
    assert fields_of("", cards["CONTACT_IMPACTOR"][1]) == ["0.2", "0.0", "0.0"]
    assert not pre.unused(study)
    with pytest.raises(pre.RecipeError, match=r"impactor\.motion_z: 'pull' is not a curve"):
        replace(study, impactor=pre.Impactor(8.0, 2.0e-3, motion_z="pull"))


def test_fixtures_are_written_with_their_friction_and_motion() -> None:
    fixtures = (
        pre.Plane(face="bottom", friction=0.3, gap=0.1, edge=0.5),
        pre.Plane(face="bottom", window=0.0, move_z="down"),
        pre.Ring(face="top", inner=40.0, outer=50.0, edge=0.5),
        pre.Punch(face="top", size=(4.0, 2.0), corner=0.5),
        pre.Bar(face="bottom", radius=2.0, start=(-40.0, 0.0), end=(40.0, 0.0)),
        pre.Clamp(face="top", force=1100.0, outer=6.0, centre=(50.0, 44.0), curve="on"),
    )
    curves = {
        "down": pre.Curve((0.0, 1.0), (0.0, -1.0)),
        "on": pre.Curve((0.0, 1.0), (0.0, 1.0)),
    }
    cards = cards_of(text_of(study_of(fixtures=fixtures, curves=curves)))
    planes = [fields_of("", line) for line in cards["FIXTURE_PLANE"]]
    assert planes[0] == ["1", "-1", "0.1", "0.5", "0.3", "0.0", "0.0"]
    assert planes[1] == ["1", "0.0", "0.0", "124.0", "74.0", "0.0"]
    assert planes[3][0] == "0"
    assert planes[4] == ["0", "0", "1"]
    assert fields_of("", cards["FIXTURE_RING"][1]) == ["0.0", "0.0", "40.0", "50.0"]
    assert fields_of("", cards["FIXTURE_PUNCH"][1])[0] == "1"
    assert fields_of("", cards["FIXTURE_BAR"][1]) == ["-40.0", "0.0", "40.0", "0.0"]
    clamp = [fields_of("", line) for line in cards["FIXTURE_CLAMP"]]
    assert clamp[0][:5] == ["6", "1", "1100.0", "2", "0.0"]
    assert clamp[1] == ["50.0", "44.0", "0.0", "6.0"]


def test_a_quarter_takes_its_share_of_a_clamp_in_the_middle() -> None:
    disc = replace(DISC, quarter=True)
    ring = pre.Clamp(face="top", force=2000.0, inner=37.5, outer=50.0)
    cards = cards_of(text_of(study_of(disc, fixtures=(ring,))))
    assert fields_of("", cards["FIXTURE_CLAMP"][0])[2] == "500.0"
    aside = pre.Clamp(face="top", force=2000.0, outer=5.0, centre=(3.0, 30.0))
    with pytest.raises(pre.RecipeError, match=r"fixtures\[1\]\.centre: a quarter needs clamps"):
        study_of(disc, fixtures=(aside,))
    with pytest.raises(pre.RecipeError, match=r"fixtures\[1\]\.centre: a quarter needs fixtures"):
        study_of(disc, fixtures=(pre.Plane(face="bottom", centre=(0.0, 0.0)),))


def test_fixtures_that_cannot_be_are_refused() -> None:
    with pytest.raises(pre.RecipeError, match="outer"):
        pre.Ring(face="top", inner=5.0, outer=4.0)
    with pytest.raises(pre.RecipeError, match="no length"):
        pre.Bar(face="top", radius=1.0, start=(0.0, 0.0), end=(0.0, 0.0))
    with pytest.raises(pre.RecipeError, match=r"fixtures\[1\]\.curve: 'on' is not a curve"):
        study_of(fixtures=(pre.Clamp(face="top", force=1.0, outer=1.0, curve="on"),))
    with pytest.raises(pre.RecipeError, match="fixtures: missing"):
        study_of(fixtures=(), outputs=pre.Outputs(fixture_interval=1.0e-6))


@pytest.mark.parametrize(
    ("template", "level"),
    [
        (name, level)
        for name in templates()
        for level in ("look", "standard")
        if name not in NO_COUPONS
    ]
    + [("dcb", "")],
)
def test_templates_pass_without_a_warning(
    template: str, level: str, solver: str, tmp_path: Path
) -> None:
    recipe = tmp_path / "mine.toml"
    recipe.write_text(pre.example_recipe(template))
    study = pre.load_recipe(recipe, [f"mesh.level={level}"] if level else [])
    assert not pre.unused(study)
    pre.write_deck(pre.deck_text(study, pre.make_mesh(study.mesh)), tmp_path / "job.k")
    assert "warning" not in solve(solver, tmp_path, "check", "job.k")


def test_a_template_is_found_by_its_name() -> None:
    assert "D7136" in pre.example_recipe("ASTM-D7136")
    with pytest.raises(pre.PreError, match="did you mean 'ring'"):
        pre.example_recipe("rng")
