"""Chains of the templates: they run, and their forces are those of closed forms."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from programs import solve

import plydyn_pre as pre
from plydyn_pre.deck import stage_text
from plydyn_pre.recipe import example_recipe, load_recipe

CHAINS = (
    "bending-after-impact",
    "indentation-compression",
    "preload-impact",
    "repeated-impact",
    "tension-after-impact",
)
#: Four plies of the library on quads of 15 mm, and blows of 20 mJ, which damage nothing
PLY, PLIES = 0.5, 4
COARSE = {
    "laminate.layup": "[0/90]s",
    "laminate.thickness": PLY,
    "cracks": "false",
    "control.scheme": "implicit_thickness",
    "mesh.order": 2,
    "mesh.core": 45,
    "mesh.quad": 15,
    "mesh.largest": 25,
    "control.step_factor": 0.8,
    "outputs.energy_interval": 1.0e-5,
    "materials.bond.fit": "none",
}
BLOW = {"impactor.energy": 20, "impactor.mass": 5.5e-4}
SHORT = BLOW | {"control.end_time": 2.0e-4}
#: A smooth step from 0 to 1, 10 s^3 - 15 s^4 + 6 s^5
SHARES = np.linspace(0.0, 1.0, 11)
STEP = 10.0 * SHARES**3 - 15.0 * SHARES**4 + 6.0 * SHARES**5
LENGTH, WIDTH = 150.0, 100.0
#: Columns of a history by their names
Table = dict[str, np.ndarray]


def curve(name: str, times: np.ndarray, values: np.ndarray) -> dict[str, object]:
    """What replaces a curve of a recipe."""
    return {f"curves.{name}.time": times.tolist(), f"curves.{name}.value": values.tolist()}


def run_chain(name: str, replaced: dict[str, object], folder: Path, solver: str) -> pre.Study:
    """Run the recipe of a template with values replaced; jobs are c, and c_STAGE."""
    recipe = folder / "c.toml"
    recipe.write_text(example_recipe(name))
    study = load_recipe(recipe, [f"{key}={value}" for key, value in (COARSE | replaced).items()])
    mesh = pre.make_mesh(study.mesh)
    pre.write_deck(pre.deck_text(study, mesh), folder / "c.k")
    line, before = ["run", "c.k"], "c"
    for number, stage in enumerate((None, *study.stages)):
        if stage is not None:
            job = f"c_{stage.name}"
            pre.write_deck(stage_text(study, mesh, number, "0" * 64), folder / f"{job}.k")
            line, before = ["restart", f"{before}.dump01", f"{job}.k", "-j", job], job
        solve(solver, folder, *line)
    return study


def history(folder: Path, name: str) -> Table:
    """A table of a job; times count from its first line."""
    path = folder / f"{name}.csv"
    with path.open() as file:
        names = [head.split("[")[0].strip() for head in file.readline().split(",")]
        values = np.loadtxt(file, delimiter=",", ndmin=2)
    table = dict(zip(names, values.T, strict=True))
    table["time"] = table["time"] - table["time"][0]
    return table


def pulled(table: Table) -> np.ndarray:
    """Force of the end that moves along x."""
    return next(table[name] for name in table if name.startswith("face motion") and "fx" in name)


def stiffnesses(study: pre.Study) -> tuple[np.ndarray, np.ndarray]:
    """Matrices A and D of the laminate along x and y by laminate theory, (3,): 11, 22, 12."""
    ply = study.materials["ply"]
    share = 1.0 - ply.nu12**2 * ply.E2 / ply.E1
    along = np.array([ply.E1, ply.E2, ply.nu12 * ply.E2]) / share
    layers = [along, along[[1, 0, 2]], along[[1, 0, 2]], along]
    z = PLY * (np.arange(PLIES + 1) - 0.5 * PLIES)
    return (
        sum(q * (z[k + 1] - z[k]) for k, q in enumerate(layers)),
        sum(q * (z[k + 1] ** 3 - z[k] ** 3) / 3.0 for k, q in enumerate(layers)),
    )


def end_stiffness(study: pre.Study) -> float:
    """Force over end displacement of the plate, whose sides are free."""
    a = stiffnesses(study)[0]
    return float(WIDTH / LENGTH * (a[0] - a[2] ** 2 / a[1]))


@pytest.mark.parametrize("name", CHAINS)
def test_the_decks_of_a_chain_are_written(name: str, tmp_path: Path) -> None:
    """Each is a stage of its own, and no key is without effect."""
    recipe = tmp_path / "c.toml"
    recipe.write_text(example_recipe(name))
    study = load_recipe(recipe)
    assert not pre.unused(study)
    mesh = pre.make_mesh(study.mesh)
    for number in range(1, len(study.stages) + 1):
        lines = list(stage_text(study, mesh, number, "0" * 64))
        assert lines[0].endswith(f"$ stage {number} of {'0' * 64}")
        assert lines[-1] == "*END"


def test_preload_stays_through_the_impact(solver: str, tmp_path: Path) -> None:
    """The force is E A eps at the end of the first run, and again after the blow.

    Large displacement changes the force by half of the strain, 0.02 %, and the blow bends the plate
    by less than a tenth of a millimetre: 1e-3 of the force for each.
    """
    moved = 0.05
    blow = {f"stages[1].{key}": value for key, value in BLOW.items()}
    values = blow | {"stages[1].end_time": 5.0e-4, "loads[1].value": moved}
    study = run_chain("preload-impact", values, tmp_path, solver)
    force = moved * end_stiffness(study)
    assert pulled(history(tmp_path, "c.supports"))[-1] == pytest.approx(force, rel=1.0e-3)
    stage = history(tmp_path, "c_impact.supports")
    assert pulled(stage)[0] == pytest.approx(force, rel=1.0e-3)
    assert history(tmp_path, "c_impact.impactor_2")["force"].max() > 0.0
    stress = force / (WIDTH * PLY * PLIES)
    strain = moved / LENGTH
    a = stiffnesses(study)[0] / (PLY * PLIES)
    assert stress == pytest.approx((a[0] - a[2] ** 2 / a[1]) * strain)


def test_blows_at_mirrored_places_have_the_same_force(solver: str, tmp_path: Path) -> None:
    """The second and the third impact are the mirror image of each other about the middle.

    They hit points of the mesh. There is no friction, which would hold the deflection of the blow
    before.
    """
    values = BLOW | {"control.end_time": 7.0e-4, "laminate.thickness": 1.0}
    values |= {"mesh.core": 40, "mesh.quad": 10}
    values |= {f"fixtures[{number}].friction": 0.0 for number in range(1, 6)}
    for rest in (1, 3):
        values |= {f"stages[{rest}].end_time": 1.0e-3, f"stages[{rest}].damping": 2.3e4}
    for blow in (2, 4):
        values |= {f"stages[{blow}].{key}": value for key, value in BLOW.items()}
        values |= {f"stages[{blow}].end_time": 7.0e-4}
    run_chain("repeated-impact", values, tmp_path, solver)
    second, third = (
        history(tmp_path, name)["force"] for name in ("c_second.impactor_3", "c_third.impactor_5")
    )
    assert second.max() > 100.0
    # damping near the critical one of the lowest mode: beyond it that mode would not come to rest
    assert third.max() == pytest.approx(second.max(), rel=1.0e-3)


@pytest.mark.parametrize(
    ("name", "job", "more"),
    [
        ("tension-after-impact", "c_tension", SHORT),
        (
            "indentation-compression",
            "c_compression",
            {"control.end_time": 2.2e-3}
            | curve(
                "push",
                np.concatenate((1.0e-3 * SHARES, 1.0e-3 * (1.0 + SHARES[1:]))),
                -0.3 * np.concatenate((STEP, STEP[-2::-1])),
            ),
        ),
    ],
)
def test_a_plate_without_damage_has_its_section_force(
    name: str, job: str, more: dict[str, object], solver: str, tmp_path: Path
) -> None:
    """Force over end displacement is E A / L, by the slope from the time of a constant rate on.

    Waves travel along the plate and back twenty times in that time, so that the slope is known to
    about a hundredth.
    """
    study = run_chain(name, more | {"stages[2].end_time": 2.0e-3}, tmp_path, solver)
    rate = abs(study.stages[-1].loads[0].value)
    table = history(tmp_path, f"{job}.supports")
    steady = table["time"] > study.curves["start"].time[-1]
    slope = np.polyfit(rate * table["time"][steady], pulled(table)[steady], 1)[0]
    assert abs(slope) == pytest.approx(end_stiffness(study), rel=0.01)
    assert np.sign(slope) == np.sign(study.stages[-1].loads[0].value)
    if name == "indentation-compression":
        push = history(tmp_path, "c.impactor_1")
        assert push["force"].max() > 10.0
        assert push["force"][-1] == 0.0


def test_four_bars_bend_the_plate_as_a_beam(solver: str, tmp_path: Path) -> None:
    """The force of each bar is that of a beam in four-point bending, with its deflection by shear.

    Shear is 1 % of the deflection here, and is known to a fifth of itself. The plate comes to rest
    below the bars before the end.
    """
    depth, time = 0.6, 2.0e-3
    values = SHORT | {"mesh.core": 60} | curve("push", time * SHARES, -depth * STEP)
    rest = {"end_time": 2.0 * time, "damping": 6.0e3, "until_fall": 0.0}
    values |= {f"stages[2].{key}": value for key, value in rest.items()}
    study = run_chain("bending-after-impact", values, tmp_path, solver)
    d, ply = stiffnesses(study)[1], study.materials["ply"]
    bending = WIDTH * (d[0] - d[2] ** 2 / d[1])
    span, arm = 125.0, 32.5
    modulus = 2.0 / (1.0 / ply.G13 + 1.0 / ply.G23)
    shear = arm / (5.0 / 6.0 * modulus * WIDTH * PLY * PLIES)
    force = depth / (arm**2 * (3.0 * span - 4.0 * arm) / (6.0 * bending) + shear)
    for number, sign in ((2001, -1.0), (2002, -1.0), (2003, 1.0), (2004, 1.0)):
        found = sign * history(tmp_path, f"c_bending.fixture_{number}")["force z"][-1]
        assert found == pytest.approx(force, rel=5.0e-3), number
