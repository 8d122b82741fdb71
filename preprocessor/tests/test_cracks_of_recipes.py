"""Cracks as lines: the zone of a recipe, its cards, and what it cannot go with."""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from deck_cards import cards_of, fields_of, text_of
from typer.testing import CliRunner

import plydyn_pre as pre
from plydyn_pre.cli import app
from plydyn_pre.deck.shearing import early_shear
from plydyn_pre.study import doubts
from plydyn_pre.study.cracks import quads_with_cracks

RECIPE = """
title = "Zone of cracks"
[materials.ply]
like = "T700GC/M21"
[materials.bond]
like = "T700GC/M21 interface"
normal = 1.0e5
shear = 1.0e5
[laminate]
layup = "[0_2/45_2/90_2/-45_2]s"
thickness = 0.26
material = "ply"
order = 1
join_alike = true
interfaces = "bond"
[mesh]
kind = "coupon"
plate = [40.0, 30.0]
window = [36.0, 26.0]
core = 16.0
quad = 1.0
order = 1
[[supports]]
set = "boundary"
[impactor]
radius = 8.0
mass = 2.0e-3
energy = 1.0e3
[contact]
method = "points_on_plate"
[cracks]
radius = 6.0
spacing = 2.0
[control]
end_time = 2.0e-6
"""


def loaded(folder: Path, text: str = RECIPE) -> pre.Study:
    """The study of a recipe."""
    path = folder / "zone.toml"
    path.write_text(text, encoding="utf-8")
    return pre.load_recipe(path)


def test_the_zone_is_a_part_of_quads_in_the_circle(tmp_path: Path) -> None:
    study = loaded(tmp_path)
    text = text_of(study)
    cards = cards_of(text)
    (lines, strengths) = cards["CRACK_LINES"]
    # a spacing, the energy of a crack that begins in mode I, and friction of closed cracks
    assert [float(each) for each in fields_of("", lines)] == [2.0, 2.0, 0.3, 0.3, 0.0]
    assert [float(each) for each in fields_of("", strengths)] == [0.0, 0.0, 0.0, 0.0]
    held = loaded(tmp_path, RECIPE.replace("spacing = 2.0", 'spacing = 2.0\ndebris = "20 um"'))
    assert float(fields_of("", cards_of(text_of(held))["CRACK_LINES"][1])[3]) == 0.02
    mesh = pre.make_mesh(study.mesh)
    middles = mesh.nodes[mesh.quads].mean(axis=1)
    parts = [fields_of("ELEMENT_SHELL", line)[1] for line in cards["ELEMENT_SHELL"]]
    assert parts.count("2") == np.sum(np.hypot(*middles.T) <= 6.0) > 0
    # both parts have the same laminate of seven plies, the middle one four thick
    plies = [line for line in cards["PART_COMPOSITE_LONG"] if len(fields_of("", line)) == 5]
    thick = [float(fields_of("", line)[1]) for line in plies if float(fields_of("", line)[1]) < 2.0]
    assert np.allclose(sorted(thick), [0.52] * 12 + [1.04] * 2)


def test_the_solver_takes_the_deck(tmp_path: Path) -> None:
    solver = os.environ.get("PLYDYN")
    if not solver:
        pytest.skip("PLYDYN names no solver")
    deck = tmp_path / "zone.k"
    deck.write_text(text_of(loaded(tmp_path)), encoding="utf-8")
    done = subprocess.run(
        [solver, "run", deck.name, "-j", "zone"], cwd=tmp_path, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    listing = (tmp_path / "zone.out").read_text(encoding="utf-8")
    assert "Crack lines of part 2" in listing
    # damage of the matrix is listed where it can be, outside of the zone
    around, inside = listing.split("Interface material")[0].split("Damage of material 1")[1:]
    assert "matrix tension" in around
    assert "where its cracks are lines" in inside
    assert "fibre tension" in inside
    assert "matrix tension" not in inside
    spacings = [line.split()[1] for line in listing.split("STIFF [")[1].splitlines()[2:9]]
    # at 0 and 90 degrees every second line of nodes, at 45 every third of 0.707 mm
    assert [float(each) for each in spacings] == pytest.approx(
        [2.0, 3.0 * np.sqrt(0.5), 2.0, 3.0 * np.sqrt(0.5), 2.0, 3.0 * np.sqrt(0.5), 2.0], rel=1e-3
    )


def test_plies_of_the_zone_may_have_a_material_of_their_own(tmp_path: Path) -> None:
    """With permanent shear through the thickness; the listing has its fibres, and no plane."""
    text = RECIPE.replace("spacing = 2.0", 'spacing = 2.0\nmaterial = "struck"')
    with pytest.raises(pre.RecipeError, match=r"cracks.material: 'struck'"):
        loaded(tmp_path, text)
    study = loaded(tmp_path, text + '[materials.struck]\nlike = "T700GC/M21 3D"\n')
    cards = cards_of(text_of(study))
    plies = [fields_of("", line) for line in cards["PART_COMPOSITE_LONG"]]
    assert [ply[0] for ply in plies if len(ply) == 5] == ["1"] * 7 + ["3"] * 7
    (number, *_) = fields_of("", cards["MAT_PLY_FRACTURE_3D_TITLE"][1])
    assert number == "3"
    assert not pre.unused(study)
    solver = os.environ.get("PLYDYN")
    if not solver:
        pytest.skip("PLYDYN names no solver")
    deck = tmp_path / "zone.k"
    deck.write_text(text_of(study), encoding="utf-8")
    subprocess.run([solver, "run", deck.name, "-j", "zone"], cwd=tmp_path, check=True)
    listing = (tmp_path / "zone.out").read_text(encoding="utf-8").split("Interface material")[0]
    inside = listing.split("T700GC/M21 3D where its cracks are lines")[1]
    assert "permanent shear from stresses of" in inside
    assert "fibre tension" in inside
    assert "matrix tension" not in inside


def test_quads_that_are_coarse_for_cracks_are_told(tmp_path: Path) -> None:
    for size, words in (("1.5", 0), ("2.0", 1)):
        study = loaded(tmp_path, RECIPE.replace("quad = 1.0", f"quad = {size}"))
        found = [each for each in doubts(study, pre.make_mesh(study.mesh)) if "cracks" in each]
        assert len(found) == words
    assert found[0].startswith("mesh.quad: cracks on quads of 2 mm; forces and areas were the same")


def test_units_of_the_energy_of_a_crack(tmp_path: Path) -> None:
    metres = pre.Units(length="m", mass="kg")
    assert pre.Cracks(radius=1.0, spacing=1.0).toughness(metres) == pytest.approx(300.0)
    assert pre.Cracks(radius=1.0, spacing=1.0, GC=5.0).toughness(metres) == 5.0
    study = loaded(tmp_path, RECIPE.replace("spacing = 2.0", 'spacing = 2.0\nGC = "500 J/m2"'))
    assert study.cracks == pre.Cracks(radius=6.0, spacing=2.0, GC=0.5)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("order = 1\n[[supports]]", "order = 2\n[[supports]]", "mesh.order: cracks need quads of"),
        ("order = 1\njoin", "order = 2\njoin", "laminate.order: ply 1 has order 2; cracks need 1"),
        ("order = 1\njoin", "order = 1\nlayers = 2\njoin", "laminate.layers: ply 1 has 2 layers"),
        (
            'true\ninterfaces = "bond',
            'false\ninterfaces = "bond between unlike plies',
            "plies 1 and 2 are alike; cracks need them",
        ),
        ('"bond"', '"tied"', "laminate.interfaces: cracks need plies that are not tied"),
        ("45_2", "60_2", "laminate.layup: ply 2 at 60 degrees: crack lines follow edges and"),
        ("45_2", "60_2", "--set cracks=false"),
        ("core = 16.0", "core = 2.0", "mesh.core: 2 must be above 2, two quads"),
        ("radius = 6.0", "radius = 7.1", "cracks.radius: 7.1 must be at most 7, half of the core"),
        ("spacing = 2.0", "spacing = 0.0", "cracks.spacing: 0.0 must be above zero"),
        ("end_time", 'scheme = "implicit_interfaces"\nend_time', "control.scheme: cracks need"),
        ("points_on_plate", "nodes_on_impactor", "contact.method: cracks need"),
        ("shear = 1.0e5", 'shear = 1.0e5\nfit = "strengths"', "materials.bond.fit: strengths are"),
        ("shear = 1.0e5", 'shear = 1.0e5\nfit = "both"', "materials.bond.fit: strengths are"),
        (
            "[cracks]",
            "[laminates.b]\nlayup = '[0]'\nmaterial = 'ply'\nthickness = 2.08\n[cracks]",
            "laminates: cracks",
        ),
    ],
)
def test_what_cracks_cannot_go_with(old: str, new: str, words: str, tmp_path: Path) -> None:
    assert old in RECIPE
    with pytest.raises(pre.RecipeError) as caught:
        loaded(tmp_path, RECIPE.replace(old, new))
    assert words in str(caught.value)


@pytest.mark.parametrize("fit", ["none", "stiffness", "core", "modes"])
def test_fits_that_leave_strengths_to_the_quads_go_with_cracks(fit: str, tmp_path: Path) -> None:
    """Those of the core are lowered before the deck is made: its FIT is 0."""
    study = loaded(tmp_path, RECIPE.replace("shear = 1.0e5", f'shear = 1.0e5\nfit = "{fit}"'))
    fields = fields_of("INTERFACE_COHESIVE", cards_of(text_of(study))["INTERFACE_COHESIVE"][0])
    assert int(fields[-1]) == (1 if fit == "stiffness" else 0)


@pytest.mark.parametrize(("level", "quad"), [("look", 1.5), ("standard", 1.0), ("fine", 0.75)])
def test_a_level_gives_the_quads_that_were_compared(
    level: str, quad: float, tmp_path: Path
) -> None:
    """And the zone fills the core but for a quad, where no radius is given."""
    text = RECIPE.replace("core = 16.0\nquad = 1.0", f'core = 18.0\nlevel = "{level}"')
    study = loaded(tmp_path, text.replace("radius = 6.0\n", ""))
    assert study.mesh.quad == pytest.approx(quad)
    assert study.cracks.radius == pytest.approx(9.0 - quad)
    again = loaded(tmp_path, text)
    assert again.cracks.radius == 6.0


def test_a_level_is_in_the_units_of_the_recipe() -> None:
    coupon = pre.Coupon(plate=0.1, window=0.08, core=0.018, order=1)
    assert quads_with_cracks(coupon, pre.Units(length="m", mass="kg")).quad == pytest.approx(1e-3)


def test_false_leaves_cracks_out(tmp_path: Path) -> None:
    """In a recipe on top of another, and on the command line; other keys are not lost so."""
    (tmp_path / "zone.toml").write_text(RECIPE, encoding="utf-8")
    above = tmp_path / "above.toml"
    above.write_text('base = "zone.toml"\ncracks = false\nlaminate.layup = "[30/-30]s"\n')
    assert pre.load_recipe(above).cracks is None
    words = ["cracks=false", "laminate.layup=[30/-30]s"]
    assert pre.load_recipe(tmp_path / "zone.toml", words).cracks is None
    with pytest.raises(pre.RecipeError, match="craks: there is no such key"):
        pre.load_recipe(tmp_path / "zone.toml", ["craks=false"])
    with pytest.raises(pre.RecipeError, match="laminate: missing"):
        pre.load_recipe(tmp_path / "zone.toml", ["laminate=false"])
    with pytest.raises(pre.RecipeError, match="title: false was given, text in quotes is needed"):
        pre.load_recipe(tmp_path / "zone.toml", ["title=false"])


def test_a_quarter_would_cut_through_cracks(tmp_path: Path) -> None:
    cross = RECIPE.replace("[0_2/45_2/90_2/-45_2]s", "[0/90]s")
    with pytest.raises(pre.RecipeError, match=r"mesh.quarter: cracks would lie on the planes"):
        loaded(tmp_path, cross.replace("order = 1\n[[s", "order = 1\nquarter = true\n[[s"))


def on_rectangle(mesh: str = "quads = [40, 30]", cracks: str = "spacing = 2.0") -> str:
    """The recipe with a rectangle that lies on a frame."""
    text = RECIPE.replace("radius = 6.0\nspacing = 2.0", cracks)
    start, end = text.index('kind = "coupon"'), text.index("[[supports]]")
    grid = f'kind = "rectangle"\nsides = [40.0, 30.0]\n{mesh}\ncorner = [-20.0, -15.0]\norder = 1\n'
    frame = '[[fixtures]]\nkind = "plane"\nface = "bottom"\nwindow = [30.0, 20.0]\n'
    return text[:start] + grid + frame + text[text.index("[impactor]", end) :]


def test_a_rectangle_cracks_everywhere(tmp_path: Path) -> None:
    """It has one part, whose lines may lie above the frame."""
    study = loaded(tmp_path, on_rectangle())
    text = text_of(study)
    cards = cards_of(text)
    assert fields_of("", cards["CRACK_LINES"][0])[0] == "1"
    assert len(cards["PART_COMPOSITE_LONG"]) == 9
    assert not [each for each in doubts(study, pre.make_mesh(study.mesh)) if "cracks" in each]
    crossed = loaded(tmp_path, on_rectangle().replace("[0_2/45_2/90_2/-45_2]s", "[0_2/90_2]s"))
    assert not list(early_shear(crossed, pre.make_mesh(crossed.mesh)))
    coarse = loaded(tmp_path, on_rectangle("quads = [20, 15]"))
    found = [each for each in doubts(coarse, pre.make_mesh(coarse.mesh)) if "cracks" in each]
    assert found[0].startswith("mesh.quads: cracks on quads of 2 mm;")
    solver = os.environ.get("PLYDYN")
    if not solver:
        pytest.skip("PLYDYN names no solver")
    (tmp_path / "zone.k").write_text(text, encoding="utf-8")
    subprocess.run([solver, "run", "zone.k", "-j", "zone"], cwd=tmp_path, check=True)
    assert "Crack lines of part 1" in (tmp_path / "zone.out").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("mesh", "cracks", "words"),
    [
        ("quads = [40, 30]\ngrading = 1.5", "spacing = 2.0", "mesh.grading: cracks need equal"),
        (
            "quads = [40, 30]\nzones = [{box = [-4, 4, -4, 4], size = 0.5}]",
            "spacing = 2.0",
            "mesh.zones: cracks need equal",
        ),
        ("quads = [40, 30]", "spacing = 2.0\nradius = 5.0", "cracks.radius: a rectangle cracks"),
        ("quads = [40, 30]", 'spacing = 2.0\nmaterial = "ply"', "cracks.material: a rectangle"),
        ("quads = [40, 40]", "spacing = 2.0", "mesh.quads: the diagonals of quads of 1 x 0.75"),
    ],
)
def test_rectangles_that_cannot_crack(mesh: str, cracks: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(pre.RecipeError, match=re.escape(words)):
        loaded(tmp_path, on_rectangle(mesh, cracks))


HELD = """
[[stages]]
name = "press"
end_time = 1.0e-5
remove = ["impactor"]
supports = [{ set = "left", hold = "x" }]
[[stages.loads]]
kind = "motion"
set = "right"
direction = "x"
quantity = "velocity"
value = -1.0
"""
CLAMPED = """
[[stages]]
name = "again"
end_time = 1.0e-5
[[stages.fixtures]]
kind = "clamp"
face = "top"
force = 100.0
centre = [10.0, 10.0]
outer = 3.0
"""


@pytest.mark.parametrize(
    ("layup", "more", "key"),
    [
        ("[0_2/90_2]s", '[[supports]]\nset = "boundary"\n', "supports[1].set"),
        ("[0_2/90_2]s", HELD, "stages[1].supports[1].set"),
        ("[45_2/-45_2]s", HELD, "stages[1].supports[1].set"),
        ("[90]8", HELD, ""),
        ("[90]8", HELD.replace('set = "right"', 'set = "bottom"'), "stages[1].loads[1].set"),
        ("[0_2/90_2]s", CLAMPED, "stages[1].fixtures[1]"),
        ("[90]8", '[[loads]]\nkind = "pressure"\nface = "top"\nvalue = 1.0\n', "loads[1]"),
    ],
)
def test_nodes_on_cracks_are_not_held(layup: str, more: str, key: str, tmp_path: Path) -> None:
    """Told by the key, before an impact is computed; an edge along the only lines may be held."""
    study = loaded(tmp_path, on_rectangle().replace("[0_2/45_2/90_2/-45_2]s", layup) + more)
    if not key:
        assert text_of(study)
        return
    with pytest.raises(pre.RecipeError, match=re.escape(f"{key}: a rectangle with cracks has")):
        text_of(study)


def test_other_meshes_have_no_equal_quads(tmp_path: Path) -> None:
    start, end = RECIPE.index('kind = "coupon"'), RECIPE.index("[[supports]]")
    grid = 'kind = "ogrid_square"\nside = 40.0\ncore = 16.0\nn = 16\nrings = 8\norder = 1\n'
    with pytest.raises(pre.RecipeError, match=r"mesh.kind: cracks need equal quads"):
        loaded(tmp_path, RECIPE[:start] + grid + RECIPE[end:])


def test_alike_neighbours_are_joined_to_one_ply() -> None:
    common = {"material": "ply", "thickness": 0.2, "interfaces": "bond"}
    laminate = pre.Laminate("[0_2/90/-90/45]", join_alike=True, **common)
    assert [(ply.angle, ply.thickness) for ply in laminate.stack] == [
        (0.0, pytest.approx(0.4)),
        (90.0, pytest.approx(0.4)),
        (45.0, 0.2),
    ]
    assert laminate.opened == (1, 2)
    assert laminate.total == pytest.approx(1.0)


def test_a_command_tells_what_cracks_double_and_what_a_fit_leaves(tmp_path: Path) -> None:
    path = tmp_path / "zone.toml"

    def told(value: str) -> str:
        words = ["deck", str(path), "-o", f"{tmp_path}/", "--set", value]
        return CliRunner().invoke(app, words).output

    path.write_text(RECIPE.replace("shear = 1.0e5", 'shear = 1.0e5\nfit = "core"'))
    fine = told("mesh.quad=0.5")
    assert "and those of nodes that cracks double" in fine
    assert "N 20 and S 36 as they are" in fine
    assert "in place of 90" in told("materials.bond.N=90.0")
    path.write_text(RECIPE)
    assert "cracks double" not in told("cracks=false")
