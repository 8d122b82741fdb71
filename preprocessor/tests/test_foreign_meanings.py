"""Numbers of LS-DYNA that mean something else: curves, options, and what other fields say."""

from __future__ import annotations

from pathlib import Path

import pytest
from foreign_decks import Foreign, standard
from foreign_forms import LAYUPS, angles, refused, same, stacked, translated, with_more
from test_foreign_bonds import LAW, bonded, glued, law_of

TEXT = standard()[0].text()
FRICTION = "       0.2       0.2\n"
GRAVITY = "*DEFINE_CURVE\n7,{}\n0,9810.\n1,9810.\n*LOAD_BODY_Z\n7\n"


def test_a_curve_of_the_dynamic_relaxation_is_refused(tmp_path: Path) -> None:
    words = "LCID: 7 is a curve of the dynamic relaxation alone (SIDR 1)"
    refused(tmp_path, with_more(GRAVITY.format(1)), words)
    same(tmp_path, with_more(GRAVITY.format(2)), with_more(GRAVITY.format(0)))


def test_a_death_below_zero_ends_a_contact_all_the_same(tmp_path: Path) -> None:
    """It only has no effect during a dynamic relaxation."""
    early = TEXT.replace(FRICTION, "0.2,0.2,,,,,,-1.0e-4\n")
    refused(tmp_path, early, "DT: a contact that ends early is not translated")
    late = TEXT.replace(FRICTION, "0.2,0.2,,,,,-1.0e-5,-1.0e-3\n")
    same(tmp_path, late, TEXT)


def test_a_limit_of_friction_without_friction_has_no_effect(tmp_path: Path) -> None:
    same(tmp_path, TEXT.replace(FRICTION, "0,0,0,50.\n"), TEXT.replace(FRICTION, ",\n"))


@pytest.mark.parametrize(
    ("keyword", "words"),
    [
        ("*CONTROL_TIMESTEP\n0,0,0,0,-1e-8\n0,7\n", "DT2MSLC: mass scaling that grows over time"),
        ("*DEFINE_BOX\n1,5,-5\n*INITIAL_VELOCITY\n0,0,1\n1.\n", "XMX: -5 is below 5: the box is"),
        ("*CONTROL_START\n1.0e-4\n", "*CONTROL_START: a run begins at time zero"),
        ("*DEFINE_ELEMENT_DEATH_SHELL\n12,1.0e-5\n", "no element is deleted"),
        ("*RIGIDWALL_PLANAR\n0\n20,20,-5,20,20,-6\n", "ZH: the normal looks away from the plate"),
        ("*RIGIDWALL_PLANAR\n0\n20,20,-5,20,20,-4,1.0\n", "FRIC: 1 is not translated"),
        ("*SET_NODE_LIST_GENERATE\n1\n8,3\n", "B1END: 3 is below 8: numbers run from low to high"),
    ],
)
def test_what_changes_the_result_is_refused(keyword: str, words: str, tmp_path: Path) -> None:
    refused(tmp_path, with_more(keyword), words)


def test_an_attribute_of_a_set_is_no_remark(tmp_path: Path) -> None:
    own = TEXT.replace("*SET_NODE_LIST\n         1\n", "*SET_NODE_LIST\n1,0.5\n")
    refused(tmp_path, own, "*SET_NODE_LIST DA1: 0.5 is not translated")


def test_a_share_of_the_step_below_zero_is_a_curve(tmp_path: Path) -> None:
    same(tmp_path, with_more("*CONTROL_TIMESTEP\n0,-7\n"), TEXT)


def test_hardening_does_not_turn_a_ply(tmp_path: Path) -> None:
    """BETA of MAT_262 and MAT_261 is the share of isotropic hardening; MANGLE is the angle."""
    text = glued(LAW)
    start, end = text.index("*MAT_262"), text.index("\n*", text.index("*MAT_262")) + 1
    law = (
        "*MAT_261\n1,1.6e-9,153000.,10300.,10300.,.0202,.0202,.4\n6000.,3700.,6000.,3.\n,\n"
        "0,-1.,0,,,,{}\n79.9,91.6,0.22,1.1,0.8\n1580.,2537.,236.,82.,90.\n53.,0,0,{}\n"
    )
    made = [
        angles(translated(tmp_path, text[:start] + law.format(*pair) + text[end:])[0])
        for pair in ((0.0, 0.0), (0.0, 1.0), (30.0, 1.0))
    ]
    assert made[0] == made[1]
    turned = [(after - angle) % 180.0 for after, angle in zip(made[2], made[0], strict=True)]
    assert turned == [30.0] * 3


@pytest.mark.parametrize("last", [1.0, 2.0])
def test_separations_of_a_trapezoid_count_from_its_last(last: float, tmp_path: Path) -> None:
    """NLS is the separation at failure, by whatever LAMDAF."""
    ends = f"{0.1 * last},{0.6 * last},{last}"
    law = f"*MAT_185\n11,0,0,1,60.,0.02,0.03,0.03\n{ends}\n"
    first, second = law_of(translated(tmp_path, glued(law))[0])
    energy = 60.0 * 0.02 * 0.5 * (1.0 + 0.6 - 0.1)
    slope = 60.0 / (0.1 * 0.02)
    assert first[4:] == pytest.approx([slope, slope * (0.02 / 0.03) ** 2, energy, energy])
    assert second[1:3] == pytest.approx([60.0, 40.0])


def test_a_strength_of_a_bond_that_is_a_function_is_refused(tmp_path: Path) -> None:
    words = "T: -3 is below zero: a curve over the size of elements is not translated"
    refused(tmp_path, glued(LAW.replace("62.3,92.3", "-3,92.3")), words)


def test_rates_and_a_plateau_that_are_left_out_are_told(tmp_path: Path) -> None:
    law = "*MAT_240\n11,1e-9,0,1,4000,2000,.004\n.28,,,{0}62.3,,,{1}\n.79,,,92.3\n"
    for sign, plateau, words in (("", "", ""), ("-", "", "at rest"), ("", "0.3", "no plateau")):
        deck, notes = translated(tmp_path, glued(law.format(sign, plateau)))
        assert law_of(deck)[1][1:3] == [62.3, 92.3]
        told = [note for note in notes if "*MAT_240" in note]
        assert len(told) == bool(words) and words in "".join(told)


def test_a_modulus_that_is_a_curve_does_not_hide_behind_units(tmp_path: Path) -> None:
    words = "EA: -7 is below zero: a curve is not translated"
    said = refused(tmp_path, TEXT.replace("  153000.0", "      -7.0"), words)
    assert "units" not in said
    words = "RO: -1.6e-09 was given, a number above zero is needed"
    assert "units" not in refused(tmp_path, TEXT.replace("   1.6e-09", "  -1.6e-09"), words)


def test_contact_at_half_of_the_thickness_of_rigid_shells_is_told(tmp_path: Path) -> None:
    """Those of the ball are 1 thick; a given contact thickness grows it, and tells of that."""
    words = "part 9: contact is at its shells, in LS-DYNA 0.5 outside of them (T1)"
    thick = TEXT.replace(FRICTION, f"{FRICTION},,,0.4\n$")
    plain = TEXT.replace("CONTACT_AUTOMATIC_", "CONTACT_")
    told = [translated(tmp_path, text)[1] for text in (TEXT, thick, plain)]
    assert [any(words in note for note in notes) for notes in told] == [True, False, False]


MOTION = "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n9,3,2,7\n"
VELOCITY = "*INITIAL_VELOCITY_RIGID_BODY\n         9         0         0   -2000.0\n"


def moved(curve: str) -> str:
    """The deck with a ball that follows a curve."""
    assert VELOCITY in TEXT
    return TEXT.replace(VELOCITY, f"*DEFINE_CURVE\n7{curve}{MOTION}")


@pytest.mark.parametrize(
    ("points", "words"),
    [
        ("\n0,0\n1.e-4,-1\n", "curve 7 ends at 0.0001: its value there holds on"),
        ("\n1.e-5,0\n5.e-4,-1\n", "curve 7 begins at 1e-05: its value there holds on"),
        ("\n0,0\n5.e-4,-1\n", ""),
        ("\n0,0\n1.e-4,-1\n2.e-4,-1\n", ""),
    ],
)
def test_a_run_that_leaves_a_curve_on_a_slope_is_told(
    points: str, words: str, tmp_path: Path
) -> None:
    """LS-DYNA goes on along the last slope, plydyn with the last value."""
    notes = [note for note in translated(tmp_path, moved(points))[1] if "curve 7" in note]
    assert [note[: len(words)] for note in notes] == [words] * bool(words)


@pytest.mark.parametrize(
    ("curve", "words"),
    [
        ("\n0,0\n", "A1: two points or more are needed"),
        ("\n0,0\n1,1\n1,2\n", "A1: 1 behind 1: each abscissa must be above the one before"),
        (",0,-1.\n0,0\n1,1\n", "A1: -1 behind 0: each abscissa must be above the one before"),
        (",0,1,1,1e-5\n0,1\n1,2\n", "OFFA: a curve that LS-DYNA begins with zero"),
    ],
)
def test_a_curve_that_is_none_is_refused_with_its_place(
    curve: str, words: str, tmp_path: Path
) -> None:
    refused(tmp_path, moved(curve), f"*DEFINE_CURVE {words}", "user.k:")


def test_a_part_of_one_ply_is_told(tmp_path: Path) -> None:
    def one(deck: Foreign, *sides: object) -> None:
        bonded(deck, *sides)
        plies = "         1     0.125       0.0         0         1     0.125      90.0         0"
        text = "\n".join(deck.lines)
        assert plies in text
        deck.lines = text.replace(plies, "1,0.25,0.0").splitlines()

    _, notes = translated(tmp_path, stacked(one)[0])
    assert [note.split(" of line")[0] for note in notes if "has one ply" in note] == ["part 1"]
    _, notes = translated(tmp_path, LAYUPS["cards"])
    assert not any("has one ply" in note for note in notes)
