"""Stages of a chain: a restart removes bodies, adds others, and counts its times from its start."""

from __future__ import annotations

import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest

from broken import CYCLES, END, PLY, SIDE, impact, said, unlike
from decks import BOTTOM, TOP, Deck, Ply, Sphere
from elasticity import CARBON
from fixture_decks import all_fixtures
from meshes import regular
from ranks import launch
from runs import Results

NORMAL, INPUT = 0, 2
STAGE = "*KEYWORD\n*CONTROL_STAGE\n1\n*CONTROL_TERMINATION\n{end},\n{body}*END\n"


def impact_until_contact(folder: Path) -> Path:
    """Restart file of an impact in which the ball presses."""
    deck = impact(1, end=2.0 * END)
    deck.add("DATABASE_BINARY_D3DUMP", (CYCLES,))
    code, text = said("run", deck.write(folder / "job.k"), "-o", folder)
    assert code == NORMAL, text
    for dump in sorted(folder.glob("job.dump??")):
        with h5py.File(dump) as file:
            if file["state/impactor_1"][8] > 0.0:
                return dump
    raise AssertionError("the ball never touches")


def stage(folder: Path, body: str, end: float = END) -> Path:
    """The deck of a stage."""
    path = folder / "stage.k"
    path.write_text(STAGE.format(end=end, body=body))
    return path


def time_of(dump: Path) -> float:
    """Time at which a restart file was written."""
    with h5py.File(dump) as file:
        return float(file["state/time"][0])


def test_impactor_is_removed(tmp_path: Path) -> None:
    """Its energy leaves the balance as external work; the stage ends ENDTIM after its start."""
    dump = impact_until_contact(tmp_path)
    deck = stage(tmp_path, "*DELETE_IMPACTOR\n1\n")
    code, text = said("restart", dump, deck, "-j", tmp_path / "free")
    assert code == NORMAL, text
    energy = Results(tmp_path, "free").table("energy")
    assert energy["time"][0] == pytest.approx(time_of(dump), rel=1e-9)
    assert energy["time"][-1] == pytest.approx(time_of(dump) + END, rel=1e-9)
    assert np.all(energy["impactor"] == 0.0)
    assert energy["external"][0] < 0.0
    assert np.abs(energy["error"]).max() < 1e-9
    assert not (tmp_path / "free.impactor_1.csv").exists()
    assert not (tmp_path / "free.contact.csv").exists()


def test_curves_of_a_stage_begin_with_it(tmp_path: Path) -> None:
    """A held edge moves by a curve of the stage, from where it was."""
    dump = impact_until_contact(tmp_path)
    distance = 0.01
    deck = stage(
        tmp_path,
        "*DELETE_IMPACTOR\n1\n*DATABASE_SPCFORC\n1.0e-9\n"
        f"*DEFINE_CURVE\n90\n0.0,0.0\n{END},{2.0 * distance / END}\n"
        "*SET_NODE_GENERAL\n90\nBOX,90\n*DEFINE_BOX\n90,-1.0,0.1,-1.0,100.0,-9.0,9.0\n"
        "*BOUNDARY_PRESCRIBED_MOTION_SET\n90,1,0,90,1.0\n",
    )
    code, text = said("restart", dump, deck, "-j", tmp_path / "moved")
    assert code == NORMAL, text
    before, after = (
        Results(tmp_path, job).field("displacement")[:, 0] for job in ("moved", "moved")
    )
    with h5py.File(tmp_path / "moved.vtkhdf") as file:
        grid = file["VTKHDF"]
        counts = grid["NumberOfPoints"][()]
        field = grid["PointData/displacement"][:, 0]
        edge = grid["Points"][: counts[0], 0] < 0.1
    before, after = field[: counts[0]][edge], field[-counts[-1] :][edge]
    assert after - before == pytest.approx(np.full(edge.sum(), distance), rel=2e-3)


def test_impactor_of_a_stage_may_stand_in_a_dent(tmp_path: Path) -> None:
    """Below the face as it was, above the face as it is: the state of the restart file counts."""
    impact_until_contact(tmp_path)
    dump = sorted(tmp_path.glob("job.dump??"))[-1]
    top, radius, dent = 1.5 * PLY, 1.0, Results(tmp_path, "job").field("displacement")[:, 2].min()
    assert dent < -0.15
    middle = 0.5 * SIDE
    for name, depth, expected in (("in_dent", -0.5 * dent, NORMAL), ("inside", 0.3, INPUT)):
        deck = Deck("a second ball", END)
        centre = (middle, middle, top + radius - depth)
        deck.sphere(Sphere(radius, 5.0e-6, centre, (0.0, 0.0, -8.0e3), method=1), number=2)
        body = deck.text()[deck.text().index("*IMPACTOR") :].replace("*END\n", "")
        deck_of_stage = stage(tmp_path, f"*DELETE_IMPACTOR\n1\n{body}")
        code, text = said("restart", dump, deck_of_stage, "-j", tmp_path / name)
        assert code == expected, text
    assert "inside the plate" in text
    # the chain goes on without another judgement on the plate of time zero
    later = sorted(tmp_path.glob("in_dent.dump??"))[-1]
    end = "*KEYWORD\n*CONTROL_TERMINATION\n1.0e-4,\n*END\n"
    (tmp_path / "later.k").write_text(end)
    code, text = said("restart", later, tmp_path / "later.k", "-j", tmp_path / "later")
    assert code == NORMAL, text


def test_fixtures_of_a_stage_stand_before_the_plate(tmp_path: Path) -> None:
    """GAP counts from the plate as the stage before left it; what falls is caught."""
    dump = impact_until_contact(tmp_path)
    middle = 0.5 * SIDE
    deck = stage(
        tmp_path,
        f"*DELETE_IMPACTOR\n1\n*FIXTURE_PUNCH\n7,{BOTTOM},0.0\n2,{middle},{middle},0.0,0.0,5.0\n"
        f"*FIXTURE_PUNCH\n8,{TOP},0.5\n2,{middle},{middle},0.0,0.0,5.0\n",
    )
    code, text = said("restart", dump, deck, "-j", tmp_path / "caught")
    assert code == NORMAL, text
    results = Results(tmp_path, "caught")
    below, above = results.table("fixture_7"), results.table("fixture_8")
    assert np.all(below["force z"] <= 0.0)
    assert below["force z"].min() < -1.0
    assert np.all(above["force z"] == 0.0)
    assert np.abs(results.table("energy")["error"]).max() < 1e-9


def test_a_fixture_of_a_stage_has_one_height_on_all_ranks(tmp_path: Path) -> None:
    """A plate that tilts about its edge: its highest point, on one rank, sets the plane above it.

    The plane that is one gap above it takes part of the turn away at the same step on any ranks.
    """
    mesh, turn, gap = regular(SIDE, SIDE, 12, 6, 9), 4.0e3, 0.01
    deck = Deck("a plate that tilts", END)
    deck.control(linear=True)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, 0.5, angle) for angle in (0.0, 90.0)], 1)
    deck.velocities(np.array([(0.0, 0.0, turn * x / SIDE) for x, _ in mesh.points]))
    deck.add("DATABASE_BINARY_D3DUMP", (CYCLES,))
    done = launch(2, "run", deck.write(tmp_path / "job.k"), "-o", tmp_path)
    assert done.returncode == NORMAL, done.stderr
    assert "have nothing to do" not in (tmp_path / "job.out").read_text()
    dump = sorted(tmp_path.glob("job.dump??"))[-1]
    body = f"*FIXTURE_PLANE\n7,{TOP},{gap}\n0\n*DATABASE_FIXTURE\n0.0,\n"
    new = stage(tmp_path, body)
    for ranks in (1, 2):
        (tmp_path / str(ranks)).mkdir()
        done = launch(ranks, "restart", dump, new, "-j", tmp_path / str(ranks) / "job")
        assert done.returncode == NORMAL, done.stderr
    assert unlike(tmp_path / "1", tmp_path / "2") == []
    plane = Results(tmp_path / "1", "job").table("fixture_7")
    # the lowest point has stayed at 0 and the highest has risen by the turn, and both by the bend
    # that they share; until the plane is met the uplift is that of the lowest
    risen = turn * time_of(dump)
    assert plane["uplift"][0] == pytest.approx(risen + gap, rel=0.02)
    assert plane["force z"].max() > 0.0


def test_second_impactor_meets_the_plate_where_it_is(tmp_path: Path) -> None:
    """A stage brings another ball, which begins above the bent plate and presses."""
    dump = impact_until_contact(tmp_path)
    sphere = next(line for line in impact(1).text().split("*") if line.startswith("IMPACTOR"))
    contact = next(line for line in impact(1).text().split("*") if line.startswith("CONTACT_I"))
    sphere, contact = sphere.replace("\n1,", "\n2,", 1), contact.replace("\n1,1,", "\n2,2,", 1)
    deck = stage(tmp_path, f"*DELETE_IMPACTOR\n1\n*{sphere}*{contact}")
    code, text = said("restart", dump, deck, "-j", tmp_path / "again")
    assert code == NORMAL, text
    again = Results(tmp_path, "again").table("impactor_2")
    assert again["force"].max() > 0.0
    # the last steps are shorter, and where damping acts the balance is of first order in that
    assert np.abs(Results(tmp_path, "again").table("energy")["error"][:-2]).max() < 1e-9


def test_stage_is_continued_with_the_same_bits(tmp_path: Path) -> None:
    """A restart within a stage, on other ranks too, ends as the stage in one piece."""
    dump = impact_until_contact(tmp_path)
    middle = 0.5 * SIDE
    deck = stage(
        tmp_path,
        f"*DELETE_IMPACTOR\n1\n*FIXTURE_PUNCH\n7,{BOTTOM},0.0\n2,{middle},{middle},0.0,0.0,5.0\n"
        "*DATABASE_BINARY_D3DUMP\n50\n*DAMPING_RELAXATION\n1.0e-30\n",
    )
    for job in ("whole", "broken"):
        (tmp_path / job).mkdir()
    code, text = said("restart", dump, deck, "-j", tmp_path / "whole" / "job")
    assert code == NORMAL, text
    for path in (tmp_path / "whole").iterdir():
        shutil.copy(path, tmp_path / "broken")
    (tmp_path / "job.k").unlink()
    deck.unlink()
    done = launch(2, "restart", tmp_path / "broken" / "job.dump01")
    assert done.returncode == NORMAL, done.stderr
    assert unlike(tmp_path / "whole", tmp_path / "broken") == []


def test_fixtures_are_removed(tmp_path: Path) -> None:
    """The others stay, with what they have felt so far."""
    deck = all_fixtures()
    deck.add("DATABASE_BINARY_D3DUMP", (CYCLES,))
    code, text = said("run", deck.write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == NORMAL, text
    dump = sorted(tmp_path.glob("job.dump??"))[-2]
    removed = stage(tmp_path, "*DELETE_FIXTURE\n2\n4\n")
    code, text = said("restart", dump, removed, "-j", tmp_path / "less")
    assert code == NORMAL, text
    assert sorted(path.name for path in tmp_path.glob("less.fixture_*.csv")) == [
        f"less.fixture_{number}.csv" for number in (1, 3, 5)
    ]
    with h5py.File(dump) as file:
        impulse = file["state/fixture_5"][3:6]
    found = Results(tmp_path, "less").table("fixture_5")
    assert found["impulse z"][0] == pytest.approx(impulse[2], rel=1e-8)


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ("*DELETE_IMPACTOR\n9\n", "no deck before has IMPACTOR 9"),
        ("*DELETE_FIXTURE\n1\n", "no deck before has FIXTURE 1"),
        ("*DELETE_IMPACTOR\n1\n1\n", "IMPACTOR 1 was deleted already"),
        ("*DELETE_IMPACTOR\n1\n*DELETE_IMPACTOR\n1\n", "IMPACTOR 1 was deleted already"),
        ("*DELETE_IMPACTOR\n1\n*IMPACTOR_SPHERE\n1,1.0,1.0,0.0,0.0,9.0\n", "was deleted"),
        ("*FIXTURE_BAR\n1,9\n", "FIXTURE_BAR"),
    ],
)
def test_what_cannot_be_is_refused(body: str, words: str, tmp_path: Path) -> None:
    """With file, line and field, and the results of before untouched."""
    dump = impact_until_contact(tmp_path)
    code, text = said("restart", dump, stage(tmp_path, body), "-j", tmp_path / "new")
    assert code == INPUT, text
    assert words in text
    assert "stage.k:" in text
    assert not (tmp_path / "new.out").exists()


@pytest.mark.parametrize("name", ["CONTROL_STAGE", "DELETE_IMPACTOR"])
def test_first_deck_is_no_stage(name: str, tmp_path: Path) -> None:
    """Such a keyword says nothing without a restart, and no body of the deck is to blame."""
    deck = impact(1)
    deck.add(name, (1,))
    code, text = said("check", deck.write(tmp_path / "job.k"))
    assert code == INPUT
    assert f"*{name}: the first deck of a run is no stage" in text
    assert text.endswith("\n1 error\n")
