"""Coordinate systems and joined rigid parts of LS-DYNA: taken, or refused by name."""

from __future__ import annotations

from pathlib import Path

import pytest
from foreign_decks import SPEED, Foreign, control, rigid, rim, sphere_profile, standard
from foreign_forms import angles, plain, refused, same, translated

TEXT = standard()[0].text()
HOLD = TEXT[TEXT.index("*BOUNDARY") : TEXT.index("\n*INITIAL_VELOCITY")]
VELOCITY = "*INITIAL_VELOCITY_RIGID_BODY\n         9         0         0   -2000.0"
BOUND = "       1.0       4.0       7.0"
#: x along the global y, y along -x; and x along -z, y along y
QUARTER = "*DEFINE_COORDINATE_SYSTEM\n5,1,1,0,1,9,0\n-3,1,0\n"
DOWN = "*DEFINE_COORDINATE_VECTOR\n5,0,0,-2,0,3,1\n"
#: the same as QUARTER by three nodes of the plate: 1 at 0, 0; 73 at 0, 40; all to the left of it
NODES = "*DEFINE_COORDINATE_NODES\n5,9,81,1\n"
TILTED = "*DEFINE_COORDINATE_SYSTEM\n5,0,0,0,1,1,0\n-1,1,0\n"


def changed(*pairs: tuple[str, str]) -> str:
    """The plain deck with other words."""
    text = TEXT
    for old, new in pairs:
        assert text.count(old) == 1
        text = text.replace(old, new)
    return text


@pytest.mark.parametrize("system", [QUARTER, NODES, TILTED])
def test_a_support_in_all_directions_has_the_same_ones_in_any_system(
    system: str, tmp_path: Path
) -> None:
    same(tmp_path, changed((HOLD, f"{system}*BOUNDARY_SPC_SET\n1,5,1,1,1,1,1,1")), TEXT)


@pytest.mark.parametrize(("own", "there"), [("1,0,0", "0,1,0"), ("0,1,1", "1,0,1")])
@pytest.mark.parametrize("system", [QUARTER, NODES])
def test_supports_along_axes_that_are_turned(
    own: str, there: str, system: str, tmp_path: Path
) -> None:
    hold = "*BOUNDARY_SPC_SET\n1,{},{}"
    turned = changed((HOLD, system + hold.format(5, own)))
    same(tmp_path, turned, changed((HOLD, hold.format(0, there))))


def test_supports_along_other_axes_are_refused(tmp_path: Path) -> None:
    tilted = changed((HOLD, f"{TILTED}*BOUNDARY_SPC_SET\n1,5,1,0,1"))
    refused(tmp_path, tilted, "CID: 5 has other axes than x, y and z")
    line = changed((HOLD, "*DEFINE_COORDINATE_VECTOR\n5,1,0,0,2,0,0\n*BOUNDARY_SPC_SET\n1,5,1"))
    refused(tmp_path, line, "two of its points are one, or all lie on a line")


@pytest.mark.parametrize(
    "keyword",
    [
        "*INITIAL_VELOCITY_RIGID_BODY\n9,2000.,0,0,,,,5",
        "*INITIAL_VELOCITY_GENERATION\n9,2,,2000.,0,0,,5\n,",
        "*SET_NODE_GENERAL\n7\nPART,9\n*INITIAL_VELOCITY\n7,,,,5\n2000.,0,0",
    ],
)
def test_velocities_in_a_system_of_their_own(keyword: str, tmp_path: Path) -> None:
    same(tmp_path, changed((VELOCITY, DOWN + keyword)), TEXT)


@pytest.mark.parametrize("system", [QUARTER, NODES])
def test_the_axis_of_a_ply_is_that_of_a_system(system: str, tmp_path: Path) -> None:
    turned = changed(("                 2.0\n", "                -5.0\n"), (HOLD, system + HOLD))
    deck, _ = translated(tmp_path, turned)
    assert angles(deck) == [90.0, 0.0, 0.0, 90.0]
    upright = changed(("                 2.0\n", "                -5.0\n"), (HOLD, DOWN + HOLD))
    refused(tmp_path, upright, "AOPT: the first axis of system 5 is not in the plate")


def test_a_rigid_body_is_held_along_the_axes_of_a_system(tmp_path: Path) -> None:
    """It may move along x of the system, which is along -z."""
    held = changed((BOUND, "-1,5,011111"), (HOLD, DOWN + HOLD))
    same(tmp_path, held, TEXT)
    other = changed((BOUND, "-1,5,110111"), (HOLD, DOWN + HOLD))
    said = refused(tmp_path, other, "CON1: 5 is not translated")
    assert "TM" not in said


def test_two_motions_of_a_body_along_an_axis_are_refused(tmp_path: Path) -> None:
    """The second one took the place of the first."""
    curve = "*DEFINE_CURVE\n7\n0,0\n1,4000.\n"
    motion = f"{curve}*BOUNDARY_PRESCRIBED_MOTION_RIGID\n9,3,2,7,-1.\n9,3,2,7,-2."
    refused(tmp_path, changed((VELOCITY, motion)), "DOF: a second motion along z is not")


def test_a_velocity_along_an_axis_that_is_held_is_refused(tmp_path: Path) -> None:
    """CON1 4 leaves motion along z alone."""
    slanted = changed((VELOCITY, "*INITIAL_VELOCITY_RIGID_BODY\n9,1000.,0,-2000."))
    refused(tmp_path, slanted, "CON1: it holds x and y, along which the body has a velocity")


def test_a_motion_along_a_vector_is_one_along_its_axis(tmp_path: Path) -> None:
    curve = "*DEFINE_CURVE\n7\n0,0\n1,4000.\n*DEFINE_VECTOR\n3,1,1,1,1,1,-4\n"
    motion = f"{curve}*BOUNDARY_PRESCRIBED_MOTION_RIGID\n9,{{}},2,7,{{}},3"
    free = (BOUND, BOUND.replace("4.0", "7.0"))
    along = changed((VELOCITY, motion.format(4, 1.0)), free)
    same(tmp_path, along, changed((VELOCITY, motion.format(3, -1.0)), free))
    refused(tmp_path, along.replace("3,1,1,1,1,1,-4", "3,1,1,1,1,2,-4"), "vector 3 is not along")
    refused(
        tmp_path, along.replace("*DEFINE_VECTOR\n3", "*DEFINE_VECTOR\n4"), "no *DEFINE_VECTOR 3"
    )


def tup(parts: int) -> str:
    """A hemisphere on a rod, as one part or as two that are joined."""
    deck = Foreign(standard()[0].text().split("*NODE")[0].splitlines())
    plate = deck.layer()
    deck.quads(1, plate)
    text = TEXT[TEXT.index("*PART_COMPOSITE") : TEXT.index("*NODE", TEXT.index("*MAT_ENHANCED"))]
    deck.lines += text.splitlines()
    nose = sphere_profile(0.25)
    rod = [(8.0, nose[-1][1] + 10.0 * k) for k in (1, 2)]
    deck.revolved(9, [*nose, *rod])
    rigid(deck)
    deck.put("CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", (1, 9, 3, 3), (0.2, 0.2), (None,))
    deck.set_of("SET_NODE_LIST", 1, rim(plate))
    deck.put("BOUNDARY_SPC_SET", (1, 0, 1, 1, 1))
    deck.put("INITIAL_VELOCITY_RIGID_BODY", (9, 0, 0, -SPEED))
    control(deck)
    if parts == 1:
        return deck.text()
    last = deck.element - 24  # the rings of the rod
    for at, line in enumerate(deck.lines):
        words = line.split()
        if len(words) == 6 and words[1] == "9" and words[0].isdigit() and int(words[0]) > last:
            deck.lines[at] = f"{words[0]:>8}{10:8d}{line[16:]}"
    deck.put("PART", "rod", (10, 9, 10))
    deck.put("MAT_RIGID", (10, 7.8e-9, 210000.0, 0.3), (None,), (None,))
    deck.put("CONSTRAINED_RIGID_BODIES", (9, 10))
    return deck.text()


def test_rigid_parts_that_are_joined_are_one_body(tmp_path: Path) -> None:
    one, two = tup(1), tup(2)
    assert "*IMPACTOR_TUP" in translated(tmp_path, one)[0]
    same(tmp_path, two, one)
    inertia = one[one.index("*PART_INERTIA") : one.index("*CONTACT")]
    plain_part = "*PART\nball\n9,9,9\n"
    bare = one.replace(inertia, plain_part), two.replace(inertia, plain_part)
    rows = [translated(tmp_path, each)[0].split("*IMPACTOR_TUP")[1].splitlines() for each in bare]
    whole, parts = (float(lines[3].split()[2]) for lines in rows)
    assert parts == pytest.approx(whole, rel=1e-5)
    refused(tmp_path, two.replace("BODIES\n         9", "BODIES\n         8"), "no rigid part 8")


@pytest.mark.parametrize("mark", [" %", "%", " +", "+"])
def test_a_keyword_with_a_format_of_its_own(mark: str, tmp_path: Path) -> None:
    first = TEXT.index("*NODE\n")
    last = TEXT.index("*ELEMENT", first)
    width = 10 if "%" in mark else 20
    rows = [
        f"{row[:8].strip():>{width}}"
        + "".join(f"{row[k : k + 16].strip():>{max(16, width)}}" for k in (8, 24, 40))
        for row in TEXT[first:last].splitlines()[1:]
    ]
    nodes = "\n".join((f"*NODE{mark}", *rows, ""))
    assert plain(translated(tmp_path, TEXT[:first] + nodes + TEXT[last:])[0]) == plain(
        translated(tmp_path, TEXT)[0]
    )
