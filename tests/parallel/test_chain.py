"""Impact, settling, compression: the same bits on any ranks, and from amid the collapse."""

from __future__ import annotations

import shutil
from pathlib import Path

import h5py
import numpy as np

from broken import END, SIDE, crack_lines, unlike
from ranks import launch
from runs import Results

NORMAL = 0
#: Speed of each of two edges, and how long they move: to 3 % of the width
SPEED, PRESSED = 1.0e4, 3.0e-5
EDGES = (("90", -1.0, 0.1, SPEED), ("91", SIDE - 0.1, SIDE + 1.0, -SPEED))
SETTLE = "*DELETE_IMPACTOR\n1\n*DAMPING_RELAXATION\n1.0e-3\n"
PRESS = (
    "*DAMPING_RELAXATION\n0.0\n*DATABASE_SPCFORC\n1.0e-9\n*DATABASE_BINARY_D3DUMP\n30\n"
    f"*DEFINE_CURVE\n90\n0.0,1.0\n{PRESSED},1.0\n"
    + "".join(
        f"*SET_NODE_GENERAL\n{number}\nBOX,{number}\n"
        f"*DEFINE_BOX\n{number},{left},{right},-1.0,100.0,-9.0,9.0\n"
        f"*BOUNDARY_PRESCRIBED_MOTION_SET\n{number},1,0,90,{speed}\n"
        for number, left, right, speed in EDGES
    )
)
STAGES = {"settle": (2.0 * END, SETTLE), "press": (PRESSED, PRESS)}


def last_dump(folder: Path, job: str) -> Path:
    """The restart file of the end of a stage."""
    return sorted(folder.glob(f"{job}.dump??"))[-1]


def run_chain(folder: Path, ranks: int) -> None:
    """An impact on a plate with crack lines, and the stages after it."""
    folder.mkdir()
    deck = crack_lines()
    deck.add("DATABASE_BINARY_D3DUMP", (100000,))
    done = launch(ranks, "run", deck.write(folder / "job.k"), "-o", folder)
    assert done.returncode == NORMAL, done.stderr
    job = "job"
    for stage, (end, body) in STAGES.items():
        path = folder / f"{stage}.k"
        path.write_text(f"*KEYWORD\n*CONTROL_STAGE\n1\n*CONTROL_TERMINATION\n{end},\n{body}*END\n")
        dump = last_dump(folder, job)
        done = launch(ranks, "restart", dump, path, "-j", folder / stage)
        assert done.returncode == NORMAL, done.stdout + done.stderr
        job = stage


def test_chain_has_the_same_bits_on_any_ranks_and_from_amid_its_collapse(tmp_path: Path) -> None:
    """Whole on one rank and on three; and gone on with on two after the largest load."""
    whole, shared, broken = (tmp_path / name for name in ("whole", "shared", "broken"))
    run_chain(whole, 1)
    run_chain(shared, 3)
    assert unlike(whole, shared) == []

    table = Results(whole, "press").table("supports")
    load = np.abs(table["motion 90 fx"])
    peak = int(load.argmax())
    assert load[-1] < 0.5 * load[peak], "the plate is to collapse"
    late = []
    for dump in sorted(whole.glob("press.dump??")):
        with h5py.File(dump) as file:
            if file["state/time"][0] > table["time"][peak]:
                late.append(dump)
    assert len(late) > 1, "a restart file is to be written amid the collapse"
    shutil.copytree(whole, broken)
    done = launch(2, "restart", broken / late[0].name)
    assert done.returncode == NORMAL, done.stderr
    assert unlike(whole, broken) == []
