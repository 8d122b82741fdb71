"""Materials of one's own: what is missing, what is filled in, curves from files, and notes."""

from __future__ import annotations

from math import cos, radians
from pathlib import Path

import pytest
from programs import Done, plydyn_pre

import plydyn_pre as pre
from plydyn_pre.curve_file import read_columns
from plydyn_pre.study import plausible

PLY = {
    "density": 1.6e-9, "E1": 153e3, "E2": 10.3e3, "E3": 10.3e3, "nu12": 0.3, "nu13": 0.3,
    "nu23": 0.4, "G12": 6e3, "G13": 6e3, "G23": 3.7e3, "XT": 2537, "XC": 1580, "YT": 82,
    "YC": 236, "SL": 90, "G1T": 91.6, "G1C": 79.9, "G2T": 0.22, "G2C": 1.1,
}  # fmt: skip
REST = """
[laminate]
layup = "[0/90]s"
material = "ply"
interfaces = "{joint}"
thickness = {thickness}
[mesh]
kind = "rectangle"
sides = [{side}, {side}]
quads = [2, 2]
[control]
end_time = 1e-6
"""
SHEAR = 'shear = "curve"\nshear_curve = "s"\n[curves.s]\n'


def recipe(folder: Path, ply: str, joint: str = "tied", size: float = 1.0) -> Path:
    """A recipe with the lines of a material of a ply and tables; lengths times a size."""
    rest = REST.format(joint=joint, thickness=0.25 * size, side=10.0 * size)
    (folder / "mine.toml").write_text(f'title = "Mine"\n[materials.ply]\n{ply}\n{rest}')
    return folder / "mine.toml"


def own(**changes: object) -> str:
    """Lines of a ply with all constants, some of them changed, or left out by None."""
    values = PLY | changes
    lines = [f"{key} = {value}" for key, value in values.items() if value is not None]
    return "\n".join(['kind = "ply_codam2"', *lines])


def deck(path: Path) -> Done:
    """Make the deck of a recipe."""
    return plydyn_pre(path.parent, "deck", path.name)


def notes(path: Path) -> list[str]:
    """Notes about materials."""
    done = deck(path)
    assert done.returncode == 0, done.stderr
    lines = done.stderr.splitlines()
    return [line.split("materials.", 1)[1] for line in lines if "materials." in line]


def test_all_missing_constants_are_told_at_once_with_what_is_usual(tmp_path: Path) -> None:
    sheet = dict.fromkeys(("E3", "nu13", "nu23", "G13", "G23", "G1T", "G1C", "G2T", "G2C"))
    bond = '[materials.bond]\nkind = "cohesive"\nGIC = 0.28\nGIIC = 0.79\nN = 60\nS = 90'
    path = recipe(tmp_path, f"{own(**sheet)}\n{bond}", "bond")
    with pytest.raises(pre.RecipeError) as caught:
        pre.load_recipe(path)
    ply, joint = str(caught.value).splitlines()
    assert f"materials.ply.{', '.join(sheet)}: missing; a number is needed for each" in ply
    for words in ("E3 = E2", "nu13 = nu12", "G13 = G12", "G23 = E2/(2 (1 + nu23))"):
        assert words in ply
    assert joint.startswith("materials.bond.normal, shear: missing")
    assert "shear = normal GIC/GIIC (S/N)^2" in joint


def test_what_a_card_derives_follows_own_constants(tmp_path: Path) -> None:
    own_ones = "E2 = 9500.0\nG12 = 4900.0\nnu23 = 0.45\nnu12 = 0.3\nYC = 210.0\nG2S = 0.9"
    text = f'like = "IM7/8552"\n{own_ones}\nmatrix_compression = "hashin"'
    study = pre.load_recipe(recipe(tmp_path, text))
    ply = study.materials["ply"]
    assert (ply.E3, ply.G13, ply.nu13, ply.GIIC) == (9500.0, 4900.0, 0.3, 0.9)
    assert pytest.approx(9500.0 / 2.9) == ply.G23
    assert pytest.approx(0.9 / cos(radians(53.0))) == ply.G2C
    assert pytest.approx(210.0 * 75.3 / 199.8, rel=1e-3) == ply.ST
    assert (ply.E1, ply.XT) == (171420.0, 2326.2)
    origin = study.origins["ply"]
    assert set(origin.derived) == {"E3", "G13", "nu13", "G23", "G2C", "ST", "GIIC"}
    assert {"E1", "XT", "G1T"} <= set(origin.filled)
    assert not {"E2", "YC", *origin.derived} & set(origin.filled)


def test_a_constant_of_a_card_that_is_no_rule_of_others_stays(tmp_path: Path) -> None:
    # G23 of T700/M21 is 3800, not 7700/2.7
    study = pre.load_recipe(recipe(tmp_path, 'like = "T700/M21"\nE2 = 8000.0'))
    assert (study.materials["ply"].E3, study.materials["ply"].G23) == (8000.0, 3800.0)
    both = 'like = "T700/M21"\nE2 = 8000.0\nE3 = 7900.0'
    assert pre.load_recipe(recipe(tmp_path, both)).materials["ply"].E3 == 7900.0


def test_what_the_library_filled_in_is_printed_and_stands_in_the_deck(tmp_path: Path) -> None:
    bond = '[materials.bond]\nlike = "IM7/8552 interface"'
    path = recipe(tmp_path, f'like = "IM7/8552"\nE2 = 9500.0\n{bond}', "bond")
    done = deck(path)
    told = [line for line in done.stdout.splitlines() if line.startswith("origin")]
    assert "XT 2326.2" in told[0] and "E3 = E2" in told[0]
    assert told[1].endswith("bond: all constants are those of IM7/8552 interface of the library")
    text = path.with_suffix(".k").read_text()
    before = text.partition("*MAT_PLY_CODAM2")[0].splitlines()
    comments = " ".join(line.removeprefix("$ ") for line in before if line.startswith("$ "))
    assert "origin of ply, like IM7/8552: from IM7/8552 of the library: density" in comments
    assert "XT 2326.2" in comments and "E3 = E2" in comments


@pytest.mark.parametrize(
    ("text", "first"),
    [
        ("0,0\n0.2,9.8\n0.5,23.5\n", 0.2),
        ("\ufeffshear strain [%],shear stress [MPa]\r\n0,0\r\n0.2,9.8\r\n0.5,23.5\r\n", 0.2),
        ("Versuch 7\nGleitung;Spannung\n0;0\n0,2;9,8\n0,5;23,5\n", 0.2),
        ("strain\tstress\n0\t0\n0,2\t9,8\n0,5\t23,5\n\n", 0.2),
        ("# test 7\n0 0\n0.2 9.8\n0.5 23.5\n", 0.2),
    ],
)
def test_files_of_two_columns_are_read(text: str, first: float, tmp_path: Path) -> None:
    (tmp_path / "s.csv").write_text(text, encoding="utf-8")
    assert read_columns(tmp_path / "s.csv", "file") == ([0.0, first, 0.5], [0.0, 9.8, 23.5])


def test_a_curve_from_a_file_is_converted_to_the_units_of_the_recipe(tmp_path: Path) -> None:
    (tmp_path / "data").mkdir()
    (tmp_path / "data/s.csv").write_text("0,0\n0.2,0.0098\n5,0.09\n")
    units = '[units]\nlength = "m"\nmass = "kg"\n'
    stress = {key: PLY[key] * 1e6 for key in PLY if key[0] in "EGXYS" and key not in ("G1T", "G1C")}
    tough = {key: PLY[key] * 1e3 for key in ("G1T", "G1C", "G2T", "G2C")}
    more = SHEAR + 'file = "data/s.csv"\nstrain = "%"\nstress = "GPa"\n' + units
    text = own(**(stress | tough | {"density": 1600.0})) + "\n" + more
    curve = pre.load_recipe(recipe(tmp_path, text, size=1e-3)).curves["s"]
    assert curve.time == pytest.approx((0.0, 0.002, 0.05))
    assert curve.value == pytest.approx((0.0, 9.8e6, 90e6))


def test_lists_of_a_curve_may_be_strain_and_stress(tmp_path: Path) -> None:
    lists = "strain = [0.0, 0.005, 0.05]\nstress = [0.0, 28.0, 88.0]"
    curve = pre.load_recipe(recipe(tmp_path, f"{own()}\n{SHEAR}{lists}")).curves["s"]
    assert (curve.time, curve.value) == ((0.0, 0.005, 0.05), (0.0, 28.0, 88.0))


def test_a_curve_over_time_from_a_file(tmp_path: Path) -> None:
    (tmp_path / "ramp.csv").write_text("t;F\n0;0\n0,5;1\n")
    more = '[curves.ramp]\nfile = "ramp.csv"\ntime = "ms"'
    curve = pre.load_recipe(recipe(tmp_path, f"{own()}\n{more}")).curves["ramp"]
    assert curve.time == pytest.approx((0.0, 0.5e-3))


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        ('strain = "%"', r"curves\.s\.stress: missing; the unit of this column is needed"),
        ('strain = "cm"\nstress = "MPa"', r"curves\.s\.strain: 'cm' was given; the unit of this"),
        ("", r"curves\.s\.strain: missing; .*or time, for a curve over time"),
    ],
)
def test_a_file_without_the_units_of_its_columns_is_refused(
    keys: str, told: str, tmp_path: Path
) -> None:
    (tmp_path / "s.csv").write_text("0,0\n0.2,9.8\n")
    with pytest.raises(pre.RecipeError, match=told):
        pre.load_recipe(recipe(tmp_path, f'{own()}\n{SHEAR}file = "s.csv"\n{keys}'))


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("0,0\n0.2,9.8\nend,1\n", r"curves\.s\.file: s\.csv, line 3: 'end,1' is not two numbers"),
        ("0,0\n", r"s\.csv has no two lines of two numbers"),
        (None, r"s\.csv cannot be read: No such file"),
    ],
)
def test_a_file_that_is_no_curve_is_refused(text: str | None, told: str, tmp_path: Path) -> None:
    if text is not None:
        (tmp_path / "s.csv").write_text(text)
    keys = 'file = "s.csv"\nstrain = "%"\nstress = "MPa"'
    with pytest.raises(pre.RecipeError, match=told):
        pre.load_recipe(recipe(tmp_path, f"{own()}\n{SHEAR}{keys}"))


@pytest.mark.parametrize(
    ("strain", "stress", "told"),
    [
        ([0.0, 0.5, 5.0], [0.0, 28.0, 88.0], "of 56, 0.0093 of G12 = 6000; is the strain in %"),
        ([0.0, 5000.0, 5e4], [0.0, 28.0, 88.0], "is the strain in microstrain?"),
        ([0.0, 28.0, 88.0], [0.0, 0.005, 0.05], "are strain and stress swapped?"),
        ([0.0, 0.005, 0.05], [0.0, 0.028, 0.088], "is the stress in GPa?"),
    ],
)  # fmt: skip
def test_curves_in_other_units_are_refused(
    strain: list[float], stress: list[float], told: str, tmp_path: Path
) -> None:
    lists = f"strain = {strain}\nstress = {stress}"
    with pytest.raises(pre.RecipeError) as caught:
        pre.load_recipe(recipe(tmp_path, f"{own()}\n{SHEAR}{lists}"))
    assert told in str(caught.value)


def test_a_curve_that_begins_far_from_the_modulus_is_noted(tmp_path: Path) -> None:
    low, high = plausible._USUAL_SLOPE
    for share in (low - 0.01, high + 0.01, low + 0.01, high - 0.01):
        lists = f"strain = [0.0, 0.01, 0.05]\nstress = [0.0, {share * 60.0}, 88.0]"
        found = notes(recipe(tmp_path, f"{own()}\n{SHEAR}{lists}"))
        assert len(found) == (not low <= share <= high), share
    printed = "strain = [0.0, 0.002, 0.1]\nstress = [0.0, 4.6, 106.0]"
    (found,) = notes(recipe(tmp_path, f"{own()}\n{SHEAR}{printed}"))
    assert "begins with a slope of 2300, 0.38 of G12 = 6000" in found


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"density": 1.6}, "ply.density: 1.6, usual are 1e-11 to 2.5e-08; is it in g/cm3? 1.6"),
        ({"density": 1600.0}, "is it in kg/m3? 1600 kg/m3 are 1.6e-09"),
        ({"E3": 50.0}, "ply.E3: 50, usual are 100 to 1.5e+06; is it in GPa? 50 GPa are 50000"),
        ({"nu12": 2.3}, "ply.nu12: 2.3 is above 0.5 (nu21 = 0.155)"),
        ({"nu12": 0.02}, "ply.nu12: 0.02 gives nu21 = 0.00135"),
        ({"XT": 2.5}, "ply.XT: 2.5 is E1/6.12e+04, usual are E1/2000 to E1/20; is it in GPa?"),
        ({"YC": 600}, "ply.YC: 600 is E2/17.2"),
        ({"SL": 2}, "ply.SL: 2 is G12/3e+03"),
        ({"G2T": 220}, "ply.G2T: 220, usual are 0.005 to 50; is it in J/m2? 220 J/m2 are 0.22"),
    ],
)
def test_constants_that_no_ply_has_are_noted(
    changes: dict[str, float], told: str, tmp_path: Path
) -> None:
    (found,) = notes(recipe(tmp_path, own(**changes)))
    assert told in found


def test_moduli_in_gpa_beside_strengths_in_mpa_are_named(tmp_path: Path) -> None:
    with pytest.raises(pre.RecipeError, match="is E1 in GPa, and XT in MPa"):
        pre.load_recipe(recipe(tmp_path, own(E1=153.0, E2=10.3, E3=10.3, G12=6.0, G13=6.0)))


def test_no_material_of_the_library_is_noted(tmp_path: Path) -> None:
    units = {"length": "mm", "time": "s", "mass": "t"}
    for name in pre.library():
        if name.endswith("interface"):
            continue
        joint = f"{name} interface" if f"{name} interface" in pre.library() else "tied"
        text = f'[materials.unused]\nlike = "{name}"'
        path = recipe(tmp_path, f'like = "{name}"\n{text}', joint)
        study = pre.load_recipe(path)
        assert list(plausible.implausible(study.materials, study.curves, units)) == [], name


@pytest.mark.parametrize(
    "change",
    [
        '[laminate]\nmaterial = "IM7/8552"\ninterfaces = "IM7/8552"\n',
        '[materials.glue]\nlike = "IM7/8552 interface"\n[laminate]\ninterfaces = "glue"\n',
    ],
)
def test_interfaces_that_drop_the_fit_of_a_template_say_so(change: str, tmp_path: Path) -> None:
    (tmp_path / "coupon.toml").write_text(pre.example_recipe("astm-d7136"))
    (tmp_path / "mine.toml").write_text(
        f'base = "coupon.toml"\ncracks = false\n{change}[mesh]\nquad = 9.0\n'
    )
    (found,) = notes(tmp_path / "mine.toml")
    assert "not fitted to the mesh, as those of materials.bond are" in found
    assert 'fit = "core"' in found
