"""Ranks: the results are the same to the last bit for any number of them."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest

from broken import CYCLES, KINDS, averaged, averaged_parts, impact, unlike, weak_plies
from decks import Deck, Ply
from elasticity import CARBON
from fixture_decks import all_bodies, all_fixtures
from lever_decks import levers, under_ball
from meshes import regular
from ranks import launch, peaks, results
from restart_files import change
from spread import solid, springs, tied

NORMAL, INPUT, FAILED = 0, 2, 3


def scattered() -> Deck:
    """Interfaces with scattered strengths, damage by work and strength under pressure."""
    deck = impact(2, "cohesive")
    material = 201
    deck.add("INTERFACE_SCATTER", (material, 3, 10.0, 2.0))
    deck.add("INTERFACE_LAW", (material, 1, 0.5))
    return deck


def closing_plies() -> Deck:
    """Plies with a shear curve and cracks that close."""
    return impact(1, "springs", failing=True, closing=True)


def heavy_columns() -> Deck:
    """Implicit columns whose masses are scaled."""
    deck = impact(1, "springs", implicit=2)
    deck.add("CONTROL_TIMESTEP", (0.0, 0.9, 0, 0.0, -2.0e-7))
    return deck


CASES: dict[str, Callable[[], Deck]] = {
    **KINDS,
    "tied": tied,
    "springs": springs,
    "averages in two parts": averaged_parts,
    "bricks of many chunks": solid,
    "scattered strengths": scattered,
    "cracks that close": closing_plies,
    "levers": levers,
    "levers under a ball": under_ball,
    "fixtures": all_fixtures,
    "fixtures and points of the plate": lambda: all_fixtures(method=2),
    "bodies of every shape": all_bodies,
    "bodies of every shape, implicit": lambda: all_bodies(2),
    "fixtures under implicit columns": lambda: all_fixtures(2),
    "added mass": lambda: springs(scaled=4.5e-8),
    "added mass of bricks": lambda: solid(scaled=8.0e-8),
    "added mass of implicit columns": heavy_columns,
}
#: Every kind of message between ranks: these run on more and on fewer ranks than three
ON_MANY = (
    "failing interfaces",
    "averages in two parts",
    "crack lines",
    "bricks of many chunks",
    "levers under a ball",
    "bodies of every shape, implicit",
    "added mass of implicit columns",
)


def run(deck: Path, folder: Path, ranks: int, threads: int = 1) -> dict[str, bytes]:
    """What a run writes."""
    folder.mkdir()
    done = launch(ranks, "run", deck, "-o", folder, threads=threads)
    assert done.returncode == NORMAL, done.stdout + done.stderr
    if ranks > 1:
        table = (folder / "job.out").read_text().split("\nRanks\n")[1].splitlines()
        assert [line.split()[0] for line in table[3 : 3 + ranks]] == [str(r) for r in range(ranks)]
    model = (folder / "job.out").read_text().split("\nEffort\n")[0]
    assert "\nStable step\n" in model
    return {**results(folder), "what the listing says of the model": model.encode()}


@pytest.mark.parametrize("case", CASES)
def test_same_bits_for_any_number_of_ranks(case: str, tmp_path: Path) -> None:
    """Every file of histories, profiles and fields, and the last state, byte by byte."""
    deck = CASES[case]()
    deck.add("DATABASE_BINARY_RUNRSF", (CYCLES,))
    path = deck.write(tmp_path / "job.k")
    alone = run(path, tmp_path / "1", 1)
    assert {"job.vtkhdf", "job.energy.csv", "job.supports.csv", "job.runrsf"} <= set(alone)
    for ranks in (2, 7) if case in ON_MANY else (3,):
        assert run(path, tmp_path / str(ranks), ranks) == alone, f"{ranks} ranks"


def strip(failing: bool) -> Deck:
    """A strip of 256 quads by 4, which ranks cut across; plies without histories or with them."""
    mesh = regular(256.0, 4.0, 256, 4, 9)
    deck = Deck("strip", CYCLES)
    deck.control()
    deck.mesh(mesh)
    if failing:
        weak_plies(deck)
    else:
        deck.laminate([Ply(CARBON, 0.25, angle) for angle in (0.0, 90.0)], 2)
    deck.hold(mesh.where(x=0.0), "xyz")
    return deck


def memory(deck: Path, ranks: int) -> tuple[float, float]:
    """Memory of mesh, motion and histories that the rank with most of it has, and of all, MB."""
    listing = launch(ranks, "check", deck).stdout
    if ranks == 1:
        counted = sum(float(mb) for mb in re.findall(r"memory of \D+([\d.]+) MB", listing))
        return counted, counted
    table = listing.split("\nRanks\n")[1].splitlines()[3 : 3 + ranks]
    each = [sum(float(word) for word in line.split()[-2:]) for line in table]
    return max(each), sum(each)


@pytest.mark.parametrize("failing", [False, True])
def test_memory_is_shared_out(failing: bool, tmp_path: Path) -> None:
    """No rank has much more than its part of what one has alone: nodes where ranks meet, no more.

    A rank has 16 chunks or more, which METIS may miss by one; it has both rows of nodes at its
    ends, and there columns for the forces of both sides: all in all less than 15 %.
    """
    deck = strip(failing).write(tmp_path / "job.k")
    whole, _ = memory(deck, 1)
    for ranks in (2, 4, 8):
        most, total = memory(deck, ranks)
        assert most < 1.15 * whole / ranks
        assert total < 1.15 * whole


def test_restart_file_takes_no_memory_of_the_whole(tmp_path: Path) -> None:
    """What a rank needs more for a restart file is in proportion to its part, also on the root.

    A band of the longest array and a copy of the accelerations are less than what each of three
    ranks has of mesh, motion and histories. The state of the whole model would be twice that and
    more. The library's own buffers, and what differs from run to run, are some megabytes.
    """
    ranks, own, buffers = 3, 0.0, 8.0
    more = {}
    for dumps in (False, True):
        deck = Deck("panel of plies with histories", 1.0, end_cycle=2)
        deck.control()
        deck.mesh(regular(48.0, 48.0, 48, 48, 9))
        weak_plies(deck)
        deck.add("INITIAL_VELOCITY", (0,), (0.0, 0.0, 1.0e3))
        if dumps:
            deck.add("DATABASE_BINARY_RUNRSF", (2,))
        folder = tmp_path / str(dumps)
        folder.mkdir()
        path = deck.write(folder / "job.k")
        more[dumps] = peaks(ranks, "run", path, "-o", folder)
        own, _ = memory(path, ranks)
    assert (tmp_path / "True" / "job.runrsf").stat().st_size > 2.0e6 * own, "most of it is state"
    for rank in range(ranks):
        assert more[True][rank] - more[False][rank] < own + buffers, more


@pytest.mark.parametrize("case", ["springs", "failing interfaces", "averages over neighbours"])
def test_ranks_have_threads(case: str, tmp_path: Path) -> None:
    """Four ranks of one thread, two of two and one of one do the same."""
    path = CASES[case]().write(tmp_path / "job.k")
    alone = run(path, tmp_path / "1x1", 1)
    assert run(path, tmp_path / "4x1", 4) == alone
    assert run(path, tmp_path / "2x2", 2, threads=2) == alone


@pytest.mark.parametrize(
    "before, after, case",
    [
        (1, 3, "failing interfaces"),
        (3, 1, "failing interfaces"),
        (2, 4, "failing interfaces"),
        (4, 3, "failing interfaces"),
        (2, 3, "averages over neighbours"),
    ],
)
def test_restart_on_another_number_of_ranks(
    before: int, after: int, case: str, tmp_path: Path
) -> None:
    """In mid-contact and mid-damage, the run goes on to the bits of the run in one piece."""
    deck = CASES[case]()
    deck.add("DATABASE_BINARY_D3DUMP", (CYCLES,))
    path = deck.write(tmp_path / "job.k")
    run(path, tmp_path / "whole", 1)
    run(path, tmp_path / "broken", before)
    dump = sorted((tmp_path / "broken").glob("job.dump??"))[1]
    with h5py.File(dump) as file:
        assert file["state/impactor_1"][8] > 0, "contact nodes press"
    done = launch(after, "restart", dump)
    assert done.returncode == NORMAL, done.stdout + done.stderr
    assert unlike(tmp_path / "whole", tmp_path / "broken") == []


def test_restart_changes_supports_on_ranks(tmp_path: Path) -> None:
    """A small deck may change supports and the end, on any number of ranks."""
    deck = impact(1)
    deck.add("DATABASE_BINARY_D3DUMP", (CYCLES,))
    first = tmp_path / "first"
    run(deck.write(tmp_path / "job.k"), first, 1)
    small = tmp_path / "small.k"
    small.write_text(
        "*KEYWORD\n*CONTROL_TERMINATION\n2.0e-5,\n*SET_NODE_LIST\n77,\n1,2,3,4,5,6,7\n"
        "*BOUNDARY_SPC_SET\n77,0,1,1,1,0,0,0\n*END\n"
    )
    for ranks in (1, 2):
        shutil.copytree(first, tmp_path / str(ranks))
        done = launch(ranks, "restart", tmp_path / str(ranks) / "job.dump01", small)
        assert done.returncode == NORMAL, done.stdout + done.stderr
    assert unlike(tmp_path / "1", tmp_path / "2") == []


def test_broken_deck_is_told_once(tmp_path: Path) -> None:
    """The message is that of one rank, and so is the exit code."""
    text = impact(1).text().replace("*END", "*NO_SUCH_KEYWORD\n*END")
    (tmp_path / "job.k").write_text(text)
    alone, several = (launch(ranks, "run", tmp_path / "job.k") for ranks in (1, 3))
    assert alone.returncode == several.returncode == INPUT
    assert several.stderr.count(alone.stderr.strip()) == 1


def test_averages_count_the_points_of_all_ranks(tmp_path: Path) -> None:
    """The listing says how many points the ellipses have, whoever has them."""
    path = averaged().write(tmp_path / "job.k")
    said = [
        re.search(r"Gauss points in the ellipse.*", launch(r, "check", path).stdout)[0]
        for r in (1, 2, 4)
    ]
    assert said[1:] == said[:1] * 2


def test_ellipse_without_neighbours_is_refused_on_ranks(tmp_path: Path) -> None:
    """All ranks come to what one rank says: by file, line and field, with the least cell of all."""
    path = impact(1, "springs", failing=True, radii=(4.0, 0.1)).write(tmp_path / "job.k")
    line = 1 + path.read_text().splitlines().index("0.0,4.0,0.1")
    alone, several = (launch(ranks, "run", path) for ranks in (1, 3))
    assert alone.returncode == several.returncode == INPUT
    assert f"job.k:{line}: *MAT_PLY_CODAM2 R2: " in alone.stderr
    assert several.stderr.count(alone.stderr.strip()) == 1


def test_wide_bands_are_refused_on_ranks(tmp_path: Path) -> None:
    """All ranks name the quad with the widest band of all, as one rank does."""
    text = impact(1, "springs", failing=True).text()
    tough, choices = "80.0,80.0,1.0,2.0,0.0,0.999999\n0,\n", "0,0,0.0,0,0,0,0.0,0\n"
    brittle = text.replace(tough + choices, "80.0,80.0,0.05,0.1\n0,\n0,1\n")
    assert brittle != text
    (tmp_path / "job.k").write_text(brittle)
    alone, several = (launch(ranks, "run", tmp_path / "job.k") for ranks in (1, 3))
    assert alone.returncode == several.returncode == INPUT
    assert "*MAT_PLY_CODAM2 SNAP: in quad " in alone.stderr
    assert several.stderr.count(alone.stderr.strip()) == 1


# places of motion along y of the lower point of the second ply: of the last node, and of many, in
# columns of three directions, two points of a layer and eight lanes behind the front
COLUMN, FRONT = 48, 6
LAST = 17 - COLUMN
MANY = slice(FRONT + 30 * COLUMN + 17, 120 * COLUMN, COLUMN)


@pytest.mark.parametrize(
    "array, places, value, words",
    [
        ("state/displacement", LAST, np.nan, "the motion is no longer finite"),
        ("state/displacement", MANY, np.nan, "the motion is no longer finite"),
        ("state/velocity", LAST, 1.0e6, "the energy balance is off"),
        ("state/velocity", MANY, 1.0e5, "the energy balance is off"),
    ],
)
def test_culprit_is_found_on_any_rank(
    array: str, places: int | slice, value: float, words: str, tmp_path: Path
) -> None:
    """What went wrong is told as by one rank, whichever has it, and also where many have it."""
    deck = impact(1, "springs")
    deck.add("DATABASE_BINARY_RUNRSF", (CYCLES,))
    folder = tmp_path / "job"
    run(deck.write(tmp_path / "job.k"), folder, 1)
    small = tmp_path / "small.k"
    small.write_text("*KEYWORD\n*CONTROL_TERMINATION\n2.5e-5,\n*END\n")
    change(folder / "job.runrsf", array, places, value)
    told = []
    for ranks in (1, 2, 3):
        done = launch(ranks, "restart", folder / "job.runrsf", small)
        assert done.returncode == FAILED, done.stdout + done.stderr
        told.append([line for line in done.stderr.splitlines() if words in line])
    assert len(told[0]) == 1
    assert " at node " in told[0][0]
    assert told == [told[0]] * 3


def test_broken_restart_file_is_told_once(tmp_path: Path) -> None:
    """A file that is cut, foreign, or of another model: all ranks end with the message of one."""
    deck = impact(1, "springs")
    deck.add("DATABASE_BINARY_RUNRSF", (CYCLES,))
    run(deck.write(tmp_path / "job.k"), tmp_path / "job", 2)
    good = tmp_path / "job" / "job.runrsf"
    for name, words in (
        ("cut", "is no restart file, or not a whole one"),
        ("foreign", "is a file of HDF5, but no restart file of plydyn"),
        ("velocity", "does not hold the velocity of the model"),
        ("support_force", "does not hold the support_force of the model"),
        ("clock", "does not hold the clock of the model"),
        ("displacement", "is damaged: the displacement is not what was written"),
        ("nowhere", "there is no restart file"),
    ):
        path = tmp_path / "job" / name
        if name == "cut":
            path.write_bytes(good.read_bytes()[: good.stat().st_size // 2])
        elif name == "foreign":
            with h5py.File(path, "w") as file:
                file["nothing"] = 1
        elif name != "nowhere":
            shutil.copy(good, path)
            with h5py.File(path, "r+") as file:
                chunk = file[f"state/{name}"].id.get_chunk_info(0)
                if name != "displacement":
                    short = file[f"state/{name}"][1:]
                    del file[f"state/{name}"]
                    file[f"state/{name}"] = short
            if name == "displacement":
                damaged = bytearray(path.read_bytes())
                damaged[chunk.byte_offset + chunk.size // 2] ^= 1
                path.write_bytes(damaged)
        alone, several = (launch(ranks, "restart", path, seconds=60.0) for ranks in (1, 3))
        assert alone.returncode == several.returncode == INPUT, name
        assert words in alone.stderr
        assert several.stderr.count(alone.stderr.strip()) == 1
