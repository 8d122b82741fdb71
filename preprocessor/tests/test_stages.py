"""Stages of a chain: their decks, and what is refused."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from deck_cards import cards_of

import plydyn_pre as pre
from plydyn_pre.deck import stage_text
from plydyn_pre.recipe import example_recipe, load_recipe
from plydyn_pre.study import Stage

FALL = pre.Impactor(radius=8.0, mass=1.0e-3, energy=1.0e3)


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> pre.Study:
    """The compression after impact of the template, on a coarse mesh."""
    path = tmp_path_factory.mktemp("recipe") / "cai.toml"
    path.write_text(example_recipe("astm-d7137"))
    return load_recipe(path, ["mesh.quad=7.5"])


def decks(study: pre.Study) -> list[str]:
    """The texts of all stages."""
    mesh = pre.make_mesh(study.mesh)
    return ["\n".join(stage_text(study, mesh, k + 1, "0" * 64)) for k in range(len(study.stages))]


def numbers(text: str, keyword: str) -> list[int]:
    """The first field of each card of a keyword."""
    return [int(line[:10]) for line in cards_of(text)[keyword]]


def test_stages_remove_what_was_there(study: pre.Study) -> None:
    settle, press = decks(study)
    assert numbers(settle, "DELETE_IMPACTOR") == [1]
    assert numbers(settle, "DELETE_FIXTURE") == [1, 2, 3, 4, 5]
    assert len(numbers(settle, "BOUNDARY_SPC_SET")) == 5
    assert "DELETE" not in press


def test_a_quasi_static_stage_says_so(study: pre.Study) -> None:
    settle, press = decks(study)
    assert "CONTROL_QUASI_STATIC" not in settle
    share, fall = (float(field) for field in cards_of(press)["CONTROL_QUASI_STATIC"][0].split())
    assert (share, fall) == (0.05, 0.5)


def test_a_stage_forgets_the_end_of_the_run_before(study: pre.Study) -> None:
    """A first run that ends when its load falls writes it, and the settling after it does not."""
    control = replace(study.control, quasi_static=0.05, until_fall=0.5)
    pulled = replace(study, control=control)
    text = "\n".join(pre.deck_text(pulled, pre.make_mesh(study.mesh)))
    first = cards_of(text)["CONTROL_QUASI_STATIC"]
    settle, press = (cards_of(deck)["CONTROL_QUASI_STATIC"] for deck in decks(pulled))
    assert [float(field) for field in first[0].split()] == [0.05, 0.5]
    assert float(settle[0]) == 0.0
    assert [float(field) for field in press[0].split()] == [0.05, 0.5]
    with pytest.raises(pre.PreError, match="until_fall: needs quasi_static"):
        replace(study.control, until_fall=0.5)


def test_a_stage_has_its_own_mass_scaling(study: pre.Study) -> None:
    """With the other fields of the step as before; without the key the stage leaves the step."""
    settle, press = decks(study)
    assert "CONTROL_TIMESTEP" not in settle + press
    stage = replace(study.stages[1], mass_scaled_step=2.0e-7)
    scaled = replace(study, stages=(study.stages[0], stage))
    card = [float(field) for field in cards_of(decks(scaled)[1])["CONTROL_TIMESTEP"][0].split()]
    assert card == [0.0, study.control.step_factor, 0.0, 0.0, -2.0e-7, 0.0]


def test_numbers_of_a_stage_are_its_own(study: pre.Study) -> None:
    """Those of the decks before are taken."""
    _, press = decks(study)
    assert min(numbers(press, "BOUNDARY_SPC_SET")) > 2000
    motion = cards_of(press)["BOUNDARY_FACE_MOTION"][0]
    nsid, _, _, _, lcid, _ = (float(field) for field in motion.split())
    assert min(nsid, lcid) > 2000


def test_a_line_is_the_mesh_line_next_to_it(study: pre.Study) -> None:
    mesh = pre.make_mesh(study.mesh)
    names = pre.deck.names.Names(study, mesh)
    nodes = mesh.nodes[names.nodes_of("left_side", "")]
    assert np.ptp(nodes[:, 1]) == 0.0
    others = np.unique(mesh.nodes[:, 1].round(9))
    assert abs(nodes[0, 1] + 45.0) == pytest.approx(np.abs(others + 45.0).min(), abs=1e-8)
    assert np.abs(nodes[:, 0]).max() <= 66.9


@pytest.mark.parametrize(
    ("template", "free"),
    [("astm-d7137", (134.0, 90.0)), ("aitm-1-0010-compression", (130.0, 90.0))],
)
def test_a_compression_test_leaves_its_field_free(
    template: str, free: tuple[float, float], tmp_path: Path
) -> None:
    """Ends are clamped beside the field, to one quad, and sides stand between knife edges."""
    recipe = tmp_path / "cai.toml"
    recipe.write_text(example_recipe(template))
    study = load_recipe(recipe, ["mesh.quad=7.5"])
    names = pre.deck.names.Names(study, pre.make_mesh(study.mesh))
    press = study.stages[-1]
    held = {support.set: support.hold for support in press.supports}
    assert held["lower_end"] == "xz"
    assert all(held[name] == "z" for name in ("lower_faces", "upper_faces"))
    quad = np.diff(np.unique(names.mesh.nodes[:, 0].round(6))).max() * 2.0
    for name, side in (("lower_faces", -1.0), ("upper_faces", 1.0)):
        ends = side * names.mesh.nodes[names.nodes_of(name, "")][:, 0]
        assert 0.5 * free[0] <= ends.min() <= 0.5 * free[0] + quad
    for name, side in (("left_side", -1.0), ("right_side", 1.0)):
        line = names.mesh.nodes[names.nodes_of(name, "")]
        assert np.ptp(line[:, 1]) == 0.0
        assert abs(side * line[0, 1] - 0.5 * free[1]) <= 0.5 * quad
        assert np.abs(line[:, 0]).max() <= 0.5 * free[0]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"name": "a b"}, "part of the names"),
        ({"remove": ("impactor", "impactor")}, "no impactor to remove"),
        ({"remove": ("fixtures", "fixtures")}, "there are no fixtures to remove"),
        ({"end_time": 0.0}, "end_time"),
        ({"loads": (pre.InitialVelocity((0.0, 0.0, 1.0)),)}, "no initial_velocity"),
        ({"at_rest": 2.0}, "at_rest"),
        ({"quasi_static": 1.5}, "quasi_static"),
        ({"quasi_static": 0.0, "until_fall": 2.0}, "until_fall"),
        ({"until_fall": 0.5}, "needs quasi_static"),
        ({"until_contact_ends": -1.0e-4}, "until_contact_ends"),
        (
            {"until_contact_ends": 1.0e-4, "remove": ("impactor",)},
            r"stages\[1\]\.until_contact_ends: there is no impactor in this stage",
        ),
        ({"mass_scaled_step": -1.0e-7}, "mass_scaled_step"),
        ({"contact": pre.Contact()}, "needs an impactor"),
        ({"outputs": pre.Outputs(fields=("displacement",))}, r"outputs\.fields: fields are those"),
        ({"outputs": pre.Outputs(nodes=("end",))}, r"outputs\.nodes: nodes with a history are"),
        ({"outputs": pre.Outputs(profiles=(pre.Profile((0.0, 0.0)),))}, r"outputs\.profiles"),
        (
            {"outputs": pre.Outputs(fixture_interval=1.0e-6)},
            r"stages\[1\]\.outputs\.fixture_interval: there are no fixtures",
        ),
        (
            {"impactor": FALL, "contact": pre.Contact(face="bottom")},
            r"stages\[1\]\.contact\.face: a fall hits the top",
        ),
        ({"impactor": replace(FALL, velocity=(0.0, 0.0, -3.0e7), energy=None)}, "faster than any"),
    ],
)
def test_what_is_no_stage_is_refused(
    change: dict[str, object], words: str, study: pre.Study
) -> None:
    with pytest.raises(pre.RecipeError, match=words):
        replace(study, stages=(replace(study.stages[0], **change),))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            {"supports": (pre.Support("upper_end", hold="x"),)},
            r"stages\[2\]\.loads\[1\]\.set: node \d+ is held or moved along x by supports",
        ),
        (
            {"supports": (pre.Support("lower"),)},
            r"stages\[2\]\.supports\[1\]\.set: 'lower' is not a node set",
        ),
    ],
)
def test_places_of_a_stage_are_told_by_their_keys(
    change: dict[str, object], words: str, study: pre.Study
) -> None:
    stages = (study.stages[0], replace(study.stages[1], **change))
    with pytest.raises(pre.RecipeError, match=words):
        decks(replace(study, stages=stages))


def test_sets_are_told_by_their_own_keys(study: pre.Study) -> None:
    """A stage uses them, and the recipe has them."""
    sets = study.sets | {"upper_end": pre.PlaceSet(box=(500.0, 600.0, 0.0, 1.0))}
    with pytest.raises(pre.RecipeError, match=r"^sets\.upper_end\.box: no node lies in it"):
        decks(replace(study, sets=sets))


def test_stages_of_a_quarter_are_symmetric() -> None:
    metal = pre.Elastic(density=2.7e-9, E=70000.0, nu=0.33)
    aside = pre.Impactor(radius=8.0, mass=1.0e-3, energy=1.0e3, position=(5.0, 0.0))
    with pytest.raises(pre.RecipeError, match=r"stages\[1\]\.impactor\.position: a quarter is hit"):
        pre.Study(
            title="quarter",
            materials={"metal": metal},
            laminate=pre.Laminate(layup="[0/90]s", thickness=1.0, material="metal"),
            mesh=pre.Coupon(plate=60.0, window=40.0, core=10.0, quad=5.0, quarter=True),
            control=pre.Control(1.0e-4),
            stages=(Stage("hit", 1.0e-4, impactor=aside),),
        )


def test_names_of_stages_differ(study: pre.Study) -> None:
    twice = (study.stages[0], replace(study.stages[1], name="settle"))
    with pytest.raises(pre.RecipeError, match="stands twice"):
        replace(study, stages=twice)


def test_chain_is_written_beside_its_deck(tmp_path: Path) -> None:
    """The sum of the first deck stands in each stage."""
    from typer.testing import CliRunner

    from plydyn_pre.cli import app

    recipe = tmp_path / "cai.toml"
    recipe.write_text(example_recipe("astm-d7137"))
    line = ["deck", str(recipe), "-o", f"{tmp_path}/", "--set", "mesh.quad=7.5"]
    assert CliRunner().invoke(app, line).exit_code == 0
    heads = [
        (tmp_path / f"cai_{name}.k").read_text().splitlines()[2]
        for name in ("settle", "compression")
    ]
    assert heads[0].startswith("$ stage 1 of ")
    assert heads[1] == heads[0].replace("stage 1", "stage 2")
