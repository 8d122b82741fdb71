"""What the solver would refuse, and what no machine could hold, is refused with its key."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from programs import plydyn_pre, solve

import plydyn_pre as pre

MEMORY = 1 << 29  # bytes that a refusal may ask for


def refused(folder: Path, *overrides: str, text: str | None = None) -> str:
    """What is said of the example with some values replaced, in little memory and time."""
    (folder / "job.toml").write_text(text or pre.example_recipe(), encoding="utf-8")
    sets = [word for override in overrides for word in ("--set", override)]
    result = plydyn_pre(folder, "deck", "job.toml", *sets, memory=MEMORY, seconds=60)
    assert result.returncode == 2, result.stdout + result.stderr
    assert "Traceback" not in result.stderr
    assert not (folder / "job.k").exists()
    return result.stderr


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("mesh.n=1000000", "mesh.n: 1,000,008,000,000 quads would be made"),
        ("mesh.rings=2000000000", "mesh.n: 32,000,000,016 quads would be made"),
        ("mesh={kind='rectangle', sides=[1, 1], quads=[1000000, 2]}", "mesh.quads: 2,000,000"),
        ("mesh={kind='ogrid_disc', diameter=9, core=2, n=100000, rings=9}", "mesh.n: 10,003,6"),
        ("mesh.grading=1e30", "mesh.grading: 1e+30 must be from"),
        ("mesh.core=1e-30", "too short beside coordinates"),
        ("mesh.corner=[1e12, 0]", "too short beside coordinates of up to 1e+12"),
        ("bricks.per_ply=1000000", "bricks.per_ply: 1000000 must be from 1 to 100"),
        ("laminate.layers=1000000000", "laminate.layers: 1000000000 must be from 1 to 100"),
        ("laminate.layup='[(0_9999)9999]'", "more than 10000 plies"),
        ("laminate.layup='[0_9000]s'", "more than 10000 plies"),
        ("fixtures=[{kind='plane', face='top', window=[-8.0, 8.0]}]", "fixtures[1].window: -8"),
        (
            "fixtures=[{kind='plane', face='top', window=-8.0}]",
            "fixtures[1].window: -8 must be above zero",
        ),
        ("units.mass={x=1}", "units.mass: a table was given"),
        ("laminate.thickness=1e99", "laminate.thickness: 8e+99 in all, too thick for the radius"),
        ("laminate.layup='[" + 2000 * "(" + "0" + 2000 * ")" + "]'", "more than 20 groups within"),
        ("materials.carbon={kind=[1]}", "materials.carbon.kind: a list was given"),
        ("materials.carbon.kind=1", "materials.carbon.kind: 1 was given, one of"),
        ("title=''", "title: empty"),
        ("title='  '", "title: empty"),
        ("outputs.fields=[]", "outputs.fields: empty; name a field"),
        ("outputs.fields=['dissipated']", "outputs.fields[1]: 'dissipated' needs a ply of a mat"),
        ("outputs.delamination_interval=1e-6", "outputs.delamination_interval: needs interfaces"),
        ("outputs.profiles=[{at=[48, 48], points=101}]", "points: 101 must be from 2 to 100"),
        ("control.scheme=implicit_interfaces", "control.scheme: no plies are joined"),
        ("control.end_cycle=3000000000", "control.end_cycle: 3000000000 was given, a whole"),
        ("control.end_time=1e-200", "control.end_time: 1e-200 was given, a number from 1e-100"),
        ("materials.carbon.E1=1" + 400 * "0", "materials.carbon.E1: a huge number was given"),
        ("materials.carbon.nu12=5.0", "materials.carbon.nu12: 5 must be less than sqrt(E1/E2)"),
        ("materials.carbon.nu23=0.999", "materials.carbon.nu23: the three Poisson's ratios"),
        ("impactor={radius=1, mass=1, velocity=[1, 0, -1], guided=true}", "impactor.velocity: a g"),
        ("impactor={radius=1, mass=1, velocity=[0, 1e30, -1]}", "impactor.velocity: 1e+30 is fas"),
        ("impactor={kind='tup', radius=1, mass=1e-30, energy=1e6}", "impactor.energy: 1.41421e+18"),
        # a cap as high as an eighth of the radius: 2 pi 8 1 / 1e6 = 0.00709 ** 2
        ("contact.spacing=0.005", "contact.spacing: 0.005 gives too many contact nodes; 0.00716 o"),
        ("mesh.core=0.02", ", that of the mesh, gives too many contact nodes; 0.00716 or more"),
        ("outputs.profiles=[{at=[48, 130]}]", "outputs.profiles[1].at: [48.0, 130.0] is not on"),
        (
            "loads=[{kind='motion', set='left', direction='x', quantity='velocity', value=1}]",
            "is held or moved along x by supports[1] already",
        ),
        ("laminate.thickness={carbon=0.1, steel=0.2}", "laminate.thickness.steel: the layup has"),
    ],
)
def test_what_cannot_be_is_refused_with_its_key(override: str, words: str, tmp_path: Path) -> None:
    assert words in refused(tmp_path, override)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("x = " + 5000 * "[" + 5000 * "]", "nested too deeply"),
        ("x = 1" + 5000 * "0", "is not TOML"),
        ('base = "/dev/zero"', "base: there is no file '/dev/zero'"),
        (f'base = "{500 * "x"}"', "base: there is no file"),
        ('base = "a\\u0000b"', "base: there is no file"),
    ],
)
def test_files_that_are_no_recipes_are_refused(text: str, words: str, tmp_path: Path) -> None:
    assert words in refused(tmp_path, text=text)


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("ST", -1.0),
        ("G2S", -0.1),
        ("width", -1.0),
        ("average_along", -1.0),
        ("average_across", -1.0),
        ("largest_damage", 0.0),
        ("largest_damage", 1.0),
        ("snap_ratio", 0.9),
        ("plateau", 1.0),
        ("shear_strain", 0.0),
        ("shear_coefficient", -1.0),
        ("shear_exponent", -1.0),
        ("YT", 10300.0),
        ("SL", 6000.0),
        ("nu12", -4.0),
    ],
)
def test_a_damaged_ply_that_cannot_be_is_refused(
    key: str, value: float, ply: pre.PlyCodam2
) -> None:
    with pytest.raises(pre.RecipeError, match=f"^{key}: "):
        replace(ply, **{key: value})


def test_a_shear_curve_that_cannot_be_is_refused(ply: pre.PlyCodam2) -> None:
    with pytest.raises(pre.RecipeError, match=r"shear_strain: 0\.014 must be above SL/G12 = 0\.01"):
        replace(ply, shear="exponential", shear_strain=0.014)
    with pytest.raises(pre.RecipeError, match=r"shear_coefficient: 0\.0 must be above zero"):
        replace(ply, shear="ramberg_osgood")
    with pytest.raises(pre.RecipeError, match=r"shear_exponent: 1\.0 must be above 1"):
        replace(ply, shear="ramberg_osgood", shear_coefficient=1e-9, shear_exponent=1.0)


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"friction": -0.1}, "friction"),
        ({"exponent": 0.05}, "exponent"),
        # N**2/(2 normal) = 62.3**2/2/1e4 = 0.194 is above 0.1
        ({"normal": 1.0e4, "GIC": 0.1}, "GIC"),
        # with the fitted stiffness: 1e4 0.28/0.79 (92.3/62.3)**2 = 7780, 92.3**2/2/7780 = 0.547
        ({"normal": 1.0e4, "GIIC": 0.79, "GIC": 0.19, "fit": "stiffness"}, "GIC"),
    ],
)
def test_a_bond_that_cannot_be_is_refused(
    changes: dict[str, float], key: str, bond: pre.Cohesive
) -> None:
    with pytest.raises(pre.RecipeError, match=f"^{key}: "):
        replace(bond, **changes)


def test_a_bond_with_too_little_toughness_in_a_mix_of_modes_is_refused() -> None:
    # each mode alone has half as much again as its elastic energy at onset; a power law with a
    # small exponent falls far below both in between: at half and half to (2 * 2**4)**-1 of it
    stiff = {"normal": 1.0e4, "shear": 1.0e4, "N": 50.0, "S": 50.0, "GIC": 0.19, "GIIC": 0.19}
    assert pre.Cohesive(**stiff, mixing="power", exponent=1.0)
    with pytest.raises(pre.RecipeError, match=r"exponent: some mix of modes"):
        pre.Cohesive(**stiff, mixing="power", exponent=0.25)


def test_constants_without_effect_are_noted_and_not_written(
    study: pre.Study, ply: pre.PlyCodam2
) -> None:
    idle = {"shear_strain": 0.04, "shear_coefficient": 1e-9, "shear_exponent": 5.0, "ST": 75.0}
    idle |= {"width": 1.0, "width_rule": "root_quad"}
    ply = replace(ply, **idle)
    damaged = replace(study, materials=study.materials | {"carbon": ply})
    keys = ("shear_strain", "shear_coefficient", "shear_exponent", "width_rule", "ST")
    assert pre.unused(damaged) == [f"materials.carbon.{key}" for key in keys]
    text = "\n".join(pre.deck_text(damaged, pre.make_mesh(damaged.mesh)))
    header = text[text.index("gamu") :].splitlines()
    assert [float(value) for value in header[1].split()] == [0.0, 0.0, 0.0, 0.0, 0.0]


def test_the_share_of_the_stable_step_is_left_to_the_solver(study: pre.Study) -> None:
    """Its field tells the rule; a recipe writes a factor of its own only."""
    usual = replace(study, control=pre.Control(1.0e-4))
    assert "CONTROL_TIMESTEP" not in "".join(pre.deck_text(usual, pre.make_mesh(usual.mesh)))
    own = replace(study, control=pre.Control(1.0e-4, step_factor=0.7))
    text = "\n".join(pre.deck_text(own, pre.make_mesh(own.mesh)))
    card = text.split("*CONTROL_TIMESTEP\n")[1].splitlines()[1]
    assert float(card[10:20]) == 0.7


def test_the_solver_has_no_word_of_warning_for_the_example(solver: str, tmp_path: Path) -> None:
    (tmp_path / "job.toml").write_text(pre.example_recipe(), encoding="utf-8")
    study = pre.load_recipe(tmp_path / "job.toml")
    pre.write_deck(pre.deck_text(study, pre.make_mesh(study.mesh)), tmp_path / "job.k")
    said = solve(solver, tmp_path, "check", "job.k")
    assert not [line for line in said.splitlines() if line.startswith(("note:", "warning:"))]
