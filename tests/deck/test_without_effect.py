"""What stands in a deck and changes nothing in the run is told with its field."""

from __future__ import annotations

from pathlib import Path

import pytest

from broken import bricks, check_changed, said
from decks import Deck, Ply, Sphere
from elasticity import CARBON
from meshes import regular

SIDE, PLY, RADIUS, END = 10.0, 0.5, 3.0, 1.0e-5
CURVE = "*DEFINE_CURVE\n9\n{},0\n{},1\n"
#: A curve that begins behind the end of the run, and one within it
LATE, EARLY = CURVE.format(1.0, 2.0), CURVE.format(0.0, END)
EDGE, MIDDLE = "*SET_NODE_LIST\n8\n1,2\n", "*SET_NODE_LIST\n8\n41\n"
WINDOW = "*FIXTURE_PLANE\n1,-1{}\n{}\n"
ON_PLANE = "*FIXTURE_PLANE card "


def plate() -> Deck:
    """A square plate of held edges, struck by a ball."""
    mesh = regular(SIDE, SIDE, 4, 4, 9)
    deck = Deck("idle", END)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, PLY, angle) for angle in (0.0, 90.0)], 1)
    deck.hold(mesh.boundary(), "xyz")
    centre = (0.5 * SIDE, 0.5 * SIDE, RADIUS + PLY + 0.01)
    deck.sphere(Sphere(RADIUS, 1.0e-5, centre, (0.0, 0.0, -1.0e3), method=2))
    return deck


def found(folder: Path, more: str, *changes: tuple[str, str]) -> tuple[int, str]:
    """Exit code and words of a check of the plate with more cards, and others."""
    return check_changed(plate(), folder, *changes, more=more)


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (f"{LATE}*LOAD_NODE_POINT\n41,3,9\n", "LCID: curve 9 is 0 from the start to the end"),
        (f"{LATE}*LOAD_BODY_Z\n9,1.0\n", "LCID: curve 9 is 0 from the start to the end"),
        (f"{LATE}*LOAD_FACE_PRESSURE\n0,1,9\n", "LCID: curve 9 is 0 from the start to the"),
        (
            f"{LATE}{MIDDLE}*BOUNDARY_PRESCRIBED_MOTION_SET\n8,3,0,9\n",
            "LCID: curve 9 is 0 from the start to the end",
        ),
        (
            f"{EARLY}{MIDDLE}*BOUNDARY_PRESCRIBED_MOTION_SET\n8,3,0,9,1.0,0,0,1.0\n",
            "BIRTH: the motion begins behind the end of the run",
        ),
        (
            f"{EARLY}{MIDDLE}*BOUNDARY_PRESCRIBED_MOTION_SET\n8,3,2,9,1.0,0,0,{0.5 * END}\n",
            "BIRTH: the points move freely until then, and jump to 0.5",
        ),
        (f"{EARLY}{EDGE}*LOAD_NODE_SET\n8,3,9\n", "DOF: all points of the load are held"),
        ("*LOAD_FACE_POINT\n1,1,3,0\n", "DOF: all points of the load are held"),
        (f"{EDGE}*INITIAL_VELOCITY\n8\n0,0,1.0\n", "the velocity moves nothing"),
        ("*INITIAL_VELOCITY_NODE\n41,0,0,0\n", "the velocity moves nothing"),
        ("*INITIAL_VELOCITY\n0\n0,0,1.0e8\n", "a velocity of 100000 m/s"),
        ("*DATABASE_IMPACTOR\n1.0\n", "DT: the run, of 1e-5, is shorter"),
        ("*DATABASE_GLSTAT\n1.0\n", "DT: the run, of 1e-5, is shorter"),
        ("*DATABASE_BINARY_D3PLOT\n1.0\n", "DT: the run, of 1e-5, is shorter"),
        ("*DATABASE_PROFILE\n1,5.0,5.0,5,1.0\n", "DT: the run, of 1e-5, is shorter"),
        ("*CONTROL_END_OF_CONTACT\n1.0\n", "DUR: DUR is without effect"),
        ("*CONTROL_TIMESTEP\n1.0\n", "DTINIT of *CONTROL_TIMESTEP, 1, is without effect"),
        (WINDOW.format("", "2,5.0,5.0,9.0,9.0,4.0"), "LX: LX is without effect"),
        (WINDOW.format(",0,0,0,0,0.1", "2,5.0,5.0,0,0,4.0"), "DC: DC is without effect"),
        (
            f"{EARLY}*FIXTURE_PLANE\n1,-1,1.0\n2,5.0,5.0,0,0,4.0\n10\n"
            f"*DEFINE_CURVE\n10\n0,0.1\n1,0.1\n*LOAD_BODY_Z\n9,1.0\n",
            "LCX: the fixture is displaced by 0.1 where it begins",
        ),
    ],
)
def test_cards_without_effect(more: str, words: str, tmp_path: Path) -> None:
    code, text = found(tmp_path, more)
    assert code == 0, text
    assert words in text


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("\n1,1,1,1,2,0.0", "\n1,1,1,1,2,0.5", "SPACING: SPACING is without effect"),
        ("5.0,5.0,3.51", "5.0,5.0,3.51,7.8e-9", "RO: RO is without effect"),
        (
            "0.0,0.0,-1000.0,0,0.0,0",
            "0.0,0.0,-1000.0,0,0.0,0\n0,0,0,0,0,0,2",
            "VAD: VAD is without effect",
        ),
    ],
)
def test_fields_of_an_impactor_without_effect(
    old: str, new: str, words: str, tmp_path: Path
) -> None:
    code, text = found(tmp_path, "", (old, new))
    assert code == 0, text
    assert words in text


@pytest.mark.parametrize("field", ["9.0,9.0,0", "0,0,4.0"])
def test_a_window_that_is_not_asked_for_is_refused(field: str, tmp_path: Path) -> None:
    """Without WINDOW the base would be whole, under the ball, too."""
    code, text = found(tmp_path, WINDOW.format("", f"0,5.0,5.0,{field}"))
    assert code == 2, text
    assert "is given for a plane without a window" in text


def test_sound_cards_are_not_blamed(tmp_path: Path) -> None:
    """A load of the plate in part of the run, some of it on held points, and usual intervals."""
    more = f"{EARLY}*LOAD_NODE_SET\n8,3,9\n*SET_NODE_LIST\n8\n1,41\n"
    more += f"*DATABASE_GLSTAT\n{END}\n*INITIAL_VELOCITY\n0\n0,0,1.0\n"
    code, text = found(tmp_path, more + WINDOW.format(",0,0,0.3,0.1,0.1", "1,5.0,5.0,7.5,7.5,0"))
    assert code == 0, text
    for words in ("held in this", "is 0 from", "is shorter", "moves nothing", "without effect"):
        assert words not in text


def test_a_sum_that_stays_zero_moves_nothing(tmp_path: Path) -> None:
    """Without the ball nothing else happens, which is told."""
    deck = Deck("idle", END)
    deck.mesh(regular(SIDE, SIDE, 4, 4, 9))
    deck.laminate([Ply(CARBON, PLY, angle) for angle in (0.0, 90.0)], 1)
    deck.add("CONSTRAINED_LINEAR_GLOBAL", (1,), (1, 3, 1.0), (2, 3, -1.0))
    code, text = said("check", deck.write(tmp_path / "job.k"))
    assert code == 0, text
    assert "nothing will happen in a run" in text


def test_damping_that_turns_velocities_around_is_refused(tmp_path: Path) -> None:
    """Central differences with a damping of 2 over the step."""
    code, text = found(tmp_path, "*DAMPING_GLOBAL\n0,1.0e30\n")
    assert code == 2, text
    assert "*DAMPING_GLOBAL VALDMP: damping of 1e30 reverses velocities" in text
    assert "job.k:" in text
    assert found(tmp_path, "*DAMPING_GLOBAL\n0,1.0e6\n")[0] == 0


@pytest.mark.parametrize(
    ("angles", "words"),
    [
        (("0.5,0.0", "0.5,1.5708"), "the angles of part 1, up to 1.5708, look like radians"),
        (("0.5,90.0", "0.5,0.785"), "the angles of part 1, up to 0.785, look like radians"),
        (("0.5,90.0", "0.5,900.0"), "a ply of part 1 has an angle of 900 degrees"),
    ],
)
def test_angles_in_radians(angles: tuple[str, str], words: str, tmp_path: Path) -> None:
    changes = [angles] if angles[0] == "0.5,90.0" else [angles, ("0.5,90.0", "0.5,0.0")]
    code, text = found(tmp_path, "", *changes)
    assert code == 0, text
    assert words in text


def test_angles_in_degrees_are_not_blamed(tmp_path: Path) -> None:
    """Misaligned by a degree, too."""
    for angle in ("45.0", "1.0", "-2.5", "180.0"):
        assert "radians" not in found(tmp_path, "", ("0.5,90.0", f"0.5,{angle}"))[1]


def test_characters_of_two_bytes_are_named(tmp_path: Path) -> None:
    """As redirected output of Windows has them."""
    deck = tmp_path / "wide.k"
    for code in ("utf-16-le", "utf-16-be"):
        deck.write_bytes(("\ufeff" + plate().text()).encode(code))
        number, text = said("check", deck)
        assert number == 2, text
        assert "has characters of two bytes (UTF-16)" in text
        assert "1 error" in text


@pytest.mark.parametrize(("ratio", "times"), [("1.05", 0), ("0", 0), ("1.5", 1)])
def test_a_ratio_of_strains_that_a_drop_does_not_ask_for(
    ratio: str, times: int, tmp_path: Path
) -> None:
    """Decks of recipes have the usual one beside SNAP 2."""
    old = "*MAT_PLY_ELASTIC\n1,1.6e-09,153000.0,10300.0,10300.0,0.3,0.3,0.4\n6000.0,6000.0,3700.0\n"
    new = old.replace("ELASTIC", "CODAM2") + "2537.0,1580.0,82.0,236.0,90.0\n"
    new += f"91.6,79.9,0.22,1.1\n0\n0,2,{ratio}\n"
    code, text = found(tmp_path, "", (old, new))
    assert code == 0, text
    assert text.count("RSNAP is without effect") == times


@pytest.mark.parametrize(
    ("cards", "words"),
    [
        ("*MAT_PLASTIC_KINEMATIC\n1,7.8e-9,2.1e5,0.3,210.0,0,1.0\n", "BETA is without effect"),
        (
            "*MAT_SIMPLIFIED_JOHNSON_COOK\n1,7.8e-9,2.1e5,0.3\n210.0,300.0,0.4,0,0,0,0,5.0\n",
            "EPSO is without effect",
        ),
    ],
)
def test_constants_of_metals_without_effect(cards: str, words: str, tmp_path: Path) -> None:
    old = "*MAT_PLY_ELASTIC\n1,1.6e-09,153000.0,10300.0,10300.0,0.3,0.3,0.4\n6000.0,6000.0,3700.0\n"
    code, text = found(tmp_path, "", (old, cards))
    assert code == 0, text
    assert words in text


def held(folder: Path, nodes: str, directions: str, *, keyword: str = "BOUNDARY_SPC_SET") -> str:
    """Exit code and findings of a check of the plate with other supports."""
    text = plate().text()
    start, end = text.index("*SET_NODE_LIST"), text.index("*IMPACTOR")
    cards = f"*SET_NODE_GENERAL\n1\n{nodes}\n*{keyword}\n1,{directions}\n"
    deck = folder / "job.k"
    deck.write_text(text[:start] + cards + text[end:])
    code, said_words = said("check", deck)
    return f"{code} {said_words}"


def test_supports_that_leave_nothing_free_are_told(tmp_path: Path) -> None:
    """A foundation under the plate, and a plate in a plane, can move."""
    words = "all nodes are held along x, y and z: the plate cannot move"
    assert words in held(tmp_path, "ALL", "0,1,1,1")
    assert words not in held(tmp_path, "ALL", "0,0,1,1")
    assert words not in held(tmp_path, "ALL", "-1,0,1,1,1", keyword="BOUNDARY_FACE")


def test_corners_without_the_nodes_between_them_are_told(tmp_path: Path) -> None:
    """Quads of nine nodes on an edge of 9 nodes; its corners are apart where some are left out."""
    words = "nodes 1 and 3 are held, and node 2 between them is free"
    assert words in held(tmp_path, "NODE,1,3,5,7,9", "0,0,0,1")
    assert "between them is free" not in held(tmp_path, "NODE,1,2,3,4,5,6,7", "0,0,0,1")
    assert "between them is free" not in held(tmp_path, "NODE,1,9,73,81", "0,0,0,1")


def test_a_plate_that_nothing_holds_is_noted(tmp_path: Path) -> None:
    """It may fly; the note is none where z is held somewhere."""
    assert "note: nothing holds the plate along z" in held(tmp_path, "NODE,1", "0,1,1,0").replace(
        f"{tmp_path / 'job.k'}: ", ""
    )
    assert "nothing holds the plate" not in held(tmp_path, "NODE,1", "0,0,0,1")


def test_a_clamp_that_the_step_is_too_long_for_is_refused(tmp_path: Path) -> None:
    """Its spring alone would be unstable, which the run would blame on a point of the plate."""
    clamp = "*FIXTURE_CLAMP\n1,1,10.0,0,{}\n2.0,2.0,0,1.5\n"
    code, text = found(tmp_path, clamp.format("1.0e9"))
    assert code == 2, text
    assert "*FIXTURE_CLAMP STIFF: clamp 1 is too stiff for the step" in text
    assert "job.k:" in text
    assert found(tmp_path, clamp.format("1.0e2"))[0] == 0


def test_a_power_of_the_rate_that_no_metal_has_is_refused(tmp_path: Path) -> None:
    """Numbers would be out of range in the first step that yields."""
    old = "*MAT_PLY_ELASTIC\n1,1.6e-09,153000.0,10300.0,10300.0,0.3,0.3,0.4\n6000.0,6000.0,3700.0\n"
    metal = "*MAT_PLASTIC_KINEMATIC\n1,7.8e-9,2.1e5,0.3,210.0,1.0e3\n40.0,{}\n"
    code, text = found(tmp_path, "", (old, metal.format("1.0e-5")))
    assert code == 2
    assert "SRP: 1/SRP is the power of the rate, 100000" in text
    assert found(tmp_path, "", (old, metal.format("5.0")))[0] == 0


def test_hourglass_control_that_no_brick_needs(tmp_path: Path) -> None:
    """Bricks of eight points have none."""
    deck = tmp_path / "job.k"
    text = bricks(1).text()
    for points, part, words in (
        ("1,1\n", "1,1,1\n", ""),
        ("1,2\n", "1,1,1\n", "IHQ: no brick needs hourglass control"),
        ("1,2\n", "1,1,1,0,7\n", "HGID: HGID is without effect"),
    ):
        cards = text.replace("*SECTION_SOLID\n1,1\n", f"*SECTION_SOLID\n{points}")
        cards = cards.replace("bricks\n1,1,1\n", f"bricks\n{part}")
        if "7" in part:
            cards = cards.replace("*END", "*HOURGLASS\n7,6,0.1\n*END")
        deck.write_text(cards)
        code, found_words = said("check", deck)
        assert code == 0, found_words
        assert ("hourglass control" in found_words and "warning" in found_words) <= bool(words)
        assert words in found_words


@pytest.mark.parametrize(
    ("more", "gravity", "words"),
    [
        (f"{EARLY}*LOAD_BODY_Z\n9,9.81\n", "0.0", "an acceleration of 0.00981 m/s2"),
        ("", "-9.81", "an acceleration of 0.00981 m/s2"),
        (f"{EARLY}*LOAD_BODY_Z\n9,9810.0\n", "-9810.0", ""),
        (f"{EARLY}*LOAD_BODY_Z\n9,5.0\n", "-2.0e3", ""),
    ],
)
def test_a_weight_in_other_units(more: str, gravity: str, words: str, tmp_path: Path) -> None:
    """9.81 where lengths are in mm."""
    weight = ("-1000.0,0,0.0,0", f"-1000.0,0,{gravity},0")
    code, text = found(tmp_path, more, weight)
    assert code == 0, text
    assert ("an acceleration of" in text) == bool(words)
    assert words in text


def test_an_impactor_over_a_support_is_told(tmp_path: Path) -> None:
    """The middle of the plate is held, too."""
    words = "impactor 1 comes down at node 41, which is held along z"
    assert words in held(tmp_path, "NODE,1,41", "0,0,0,1")
    assert words not in held(tmp_path, "NODE,1,40", "0,0,0,1")
