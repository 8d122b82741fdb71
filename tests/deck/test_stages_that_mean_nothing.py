"""Stages that leave a plate without what held it, or in the way of what is to be removed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from broken import said
from decks import BOTTOM, TOP, Deck, Ply, Sphere
from elasticity import CARBON
from meshes import regular

SIDE, PLY, RADIUS, END = 10.0, 0.5, 3.0, 2.0e-6
LINES = f"*CONTROL_STAGE\n1\n*CONTROL_TERMINATION\n{END},\n"
HELD = "*SET_NODE_GENERAL\n90\nBOX,90\n*DEFINE_BOX\n90,-1.0,0.1,-1.0,11.0,-1.0,1.0\n"
HELD += "*BOUNDARY_SPC_SET\n90,0,1,1,{z}\n"
BASE = "*FIXTURE_PLANE\n9,-1\n0\n"


@pytest.fixture(scope="module")
def dump(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Restart file of an impact on a plate between a base, 1, and two clamps, 2 and 3."""
    folder = tmp_path_factory.mktemp("stages")
    deck = Deck("clamped", END)
    deck.mesh(regular(SIDE, SIDE, 4, 4, 9))
    deck.laminate([Ply(CARBON, PLY, angle) for angle in (0.0, 90.0)], 1)
    deck.add("FIXTURE_PLANE", (1, BOTTOM), (1, 5.0, 5.0, 8.0, 8.0, 0.0))
    for number, corner in ((2, 0.0), (3, SIDE)):
        deck.add("FIXTURE_CLAMP", (number, TOP, 100.0), (corner, corner, 0.0, 2.0))
    centre = (5.0, 5.0, RADIUS + PLY + 0.01)
    deck.sphere(Sphere(RADIUS, 1.0e-5, centre, (0.0, 0.0, -1.0e3), method=1))
    deck.add("DATABASE_BINARY_D3DUMP", (10,))
    code, text = said("run", deck.write(folder / "job.k"), "-o", folder)
    assert code == 0, text
    return sorted(folder.glob("job.dump??"))[0]


def told(dump: Path, folder: Path, body: str) -> str:
    """What a restart with a stage says up to its first step."""
    path = folder / "stage.k"
    path.write_text(f"*KEYWORD\n{LINES}{body}*END\n")
    code, text = said("restart", dump, path, "-j", folder / "stage")
    assert code == 0, text
    return text


def test_a_stage_that_removes_the_base_alone_is_told(dump: Path, tmp_path: Path) -> None:
    """Both clamps, at the line that removes the base, which is the fifth behind *KEYWORD."""
    text = told(dump, tmp_path, "*DELETE_FIXTURE\n1\n")
    for clamp in (2, 3):
        assert f"stage.k:6: clamp {clamp} stays and presses the plate, and nothing holds" in text


@pytest.mark.parametrize(
    "body",
    [
        "*DELETE_FIXTURE\n1\n2\n3\n",
        "*DELETE_FIXTURE\n2\n3\n",
        "*DELETE_FIXTURE\n1\n" + BASE,
        "*DELETE_FIXTURE\n1\n" + HELD.format(z=1),
    ],
    ids=["all", "clamps", "another base", "supports"],
)
def test_other_removals_are_sound(body: str, dump: Path, tmp_path: Path) -> None:
    assert "stays and presses" not in told(dump, tmp_path, body)


def test_supports_along_the_plate_do_not_stand_against_a_clamp(dump: Path, tmp_path: Path) -> None:
    text = told(dump, tmp_path, "*DELETE_FIXTURE\n1\n" + HELD.format(z=0))
    assert "clamp 2 stays and presses" in text


def test_a_stage_that_removes_nothing_is_told(dump: Path, tmp_path: Path) -> None:
    """Supports of its own, and the impactor, the base and two clamps are all there."""
    text = told(dump, tmp_path, HELD.format(z=1))
    assert "stage.k:11: *BOUNDARY_SPC_SET: the plate is held anew, and no impactor or" in text
    assert "is removed: 4 in all" in text
    for body in ("*DELETE_IMPACTOR\n1\n" + HELD.format(z=1), ""):
        assert "is held anew" not in told(dump, tmp_path, body)


def test_a_stage_at_rest_with_its_impactor_is_told(dump: Path, tmp_path: Path) -> None:
    relax = "*DAMPING_RELAXATION\n1.0e-4\n"
    assert "impactor 1 is not damped" in told(dump, tmp_path, relax)
    assert "is not damped" not in told(dump, tmp_path, relax + "*DELETE_IMPACTOR\n1\n")


#: Points of an edge that move, and the factor of their curve
MOVED = "*SET_NODE_LIST\n91\n1,2,3\n*DEFINE_CURVE\n91\n0.0,0.0\n1.0e-7,1.0\n1.0,1.0\n"


def test_birth_and_death_count_from_the_stage(dump: Path, tmp_path: Path) -> None:
    """As the curves do: the force of the motion begins and ends so long behind the restart."""
    birth, death = 0.5 * END, 0.8 * END
    motion = f"*BOUNDARY_PRESCRIBED_MOTION_SET\n91,1,0,91,1.0e-3,0,{death},{birth}\n"
    told(dump, tmp_path, f"{MOVED}{motion}*DELETE_IMPACTOR\n1\n*DATABASE_SPCFORC\n0.0\n")
    path = next(tmp_path.glob("stage.supports*.csv"))
    table = np.genfromtxt(path, delimiter=",", skip_header=1)
    names = path.read_text().splitlines()[0].split(",")
    force = table[:, next(k for k, name in enumerate(names) if name.startswith("motion 91 fx"))]
    times = table[force != 0.0, 0] - table[0, 0]
    step = np.diff(table[:, 0]).max()
    assert birth - step <= times.min() <= birth + 2.0 * step
    assert death - 2.0 * step <= times.max() <= death + 2.0 * step


def test_a_displacement_that_leaves_its_points_is_told(dump: Path, tmp_path: Path) -> None:
    """It counts from the undeformed plate, where the points are no more."""
    curve = MOVED.replace("0.0,0.0\n1.0e-7,1.0", "0.0,1.0\n1.0e-7,1.0")
    motion = "*BOUNDARY_PRESCRIBED_MOTION_SET\n91,1,2,91,1.0e-6\n"
    text = told(dump, tmp_path, f"{curve}{motion}*DELETE_IMPACTOR\n1\n")
    assert "warning: motion 91 moves its points by up to" in text
    assert "in the first step" in text
    velocity = motion.replace("91,1,2", "91,1,0")
    text = told(dump, tmp_path, f"{MOVED}{velocity}*DELETE_IMPACTOR\n1\n")
    assert "in the first step" not in text


def test_a_motion_before_the_restart_is_told(dump: Path, tmp_path: Path) -> None:
    """Times of a deck without *CONTROL_STAGE are those of the whole run."""
    path = tmp_path / "stage.k"
    motion = "*BOUNDARY_PRESCRIBED_MOTION_SET\n91,1,0,91,1.0e-3,0,1.0e-12\n"
    path.write_text(f"*KEYWORD\n{MOVED}{motion}*DELETE_IMPACTOR\n1\n*END\n")
    code, text = said("restart", dump, path, "-j", tmp_path / "stage")
    assert code == 0, text
    assert "DEATH: the motion ends before the restart" in text


def test_a_displacement_of_a_new_body_begins_at_zero(dump: Path, tmp_path: Path) -> None:
    """Where the times of the deck are those of the whole run, the curve is 0 at the restart."""
    body = "*DEFINE_CURVE\n92\n0.0,0.0\n1.0e-5,-0.1\n*IMPACTOR_SPHERE\n8,3.0,1.0e-5,5.0,5.0,3.6\n"
    body += "0.0,0.0,0.0\n0,0,0,0,0,92,2\n*CONTACT_IMPACTOR\n8,8,1,1\n*DELETE_IMPACTOR\n1\n"
    path = tmp_path / "stage.k"
    path.write_text(f"*KEYWORD\n{body}*END\n")
    code, text = said("restart", dump, path, "-j", tmp_path / "stage")
    assert code == 2, text
    assert "LCZ: the displacement does not begin at 0" in text
    told(dump, tmp_path, body)


def test_a_deck_that_cannot_be_read_is_in_no_other(dump: Path) -> None:
    """The message does not begin with the deck of the run."""
    for deck, words in (
        (dump, f"error: the file '{dump}' is an HDF5 file, not a deck"),
        ("missing.k", "error: the file 'missing.k' cannot be read"),
    ):
        code, text = said("restart", dump, deck, "-j", "none")
        assert code == 2, text
        assert words in text
