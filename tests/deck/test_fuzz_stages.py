"""Decks of stages changed by chance: refused in words or run, and nothing before them is lost.

`FUZZ=1000 pytest tests/deck/test_fuzz_stages.py` tries that many; `FUZZ_SEED=7` tries others.
"""

from __future__ import annotations

import os
import random
from collections.abc import Callable
from pathlib import Path

import pytest

from broken import CYCLES, END, SIDE, impact, said
from decks import BOTTOM, TOP, Deck
from fixture_decks import all_bodies, all_fixtures
from fuzzing import INPUT, NORMAL, OUTPUT, RUN, STOPPED, check, check_finite, run
from mutants import mutate

MUTANTS = int(os.environ.get("FUZZ", "240"))
SEED = int(os.environ.get("FUZZ_SEED", "20260"))
MIDDLE = 0.5 * SIDE
AT = f"{MIDDLE},{MIDDLE}"
FIRST: dict[str, Callable[[], Deck]] = {
    "fixtures": all_fixtures,
    "shapes": lambda: all_bodies(apart=True),
    "cracks": lambda: impact(1, "cohesive", fracture=True),
    "damage": lambda: impact(1, "springs", failing=True, closing=True),
}
FALL = "0.0,0.0,-8.0e3"
#: What stages of each kind of run have
BODIES = [
    f"*FIXTURE_PUNCH\n7,{BOTTOM},0.0\n2,{AT},0.0,0.0,5.0\n"
    f"*FIXTURE_PUNCH\n8,{TOP},0.5\n2,{AT},0.0,0.0,5.0\n",
    f"*FIXTURE_PLANE\n7,{BOTTOM},0.1,0,0.3\n1,{AT},14.0,12.0,2.0\n",
    f"*FIXTURE_RING\n7,{BOTTOM},0.0\n{AT},6.0,8.0\n*DATABASE_FIXTURE\n1.0e-6\n",
    f"*FIXTURE_BAR\n7,{BOTTOM},0.0,1.0,0.2\n4.0,0.0,4.0,20.0\n",
    f"*FIXTURE_CLAMP\n7,{TOP},100.0,0,50.0,0.3\n4.0,4.0,0.0,2.0\n",
    f"*IMPACTOR_SPHERE\n7,3.0,2.0e-6,{AT},6.0\n{FALL}\n*CONTACT_IMPACTOR\n7,7,1,1\n",
    f"*IMPACTOR_TUP\n7,3.0,2.0e-6,{AT},6.0\n10.0\n{FALL}\n*CONTACT_IMPACTOR\n7,7,1,1\n",
    f"*IMPACTOR_CYLINDER\n7,3.0,2.0e-6,{AT},6.0\n6.0,0.5\n{FALL}\n*CONTACT_IMPACTOR\n7,7,1,1\n",
    f"*IMPACTOR_CONE\n7,3.0,2.0e-6,{AT},6.0\n45.0,1.0\n{FALL}\n*CONTACT_IMPACTOR\n7,7,1,1\n",
    "*DAMPING_RELAXATION\n1.0e-4\n*DATABASE_BINARY_D3DUMP\n20\n",
    "*DEFINE_BOX\n90,-1.0,0.1,-1.0,100.0,-9.0,9.0\n*SET_NODE_GENERAL\n90\nBOX,90\n"
    f"*DEFINE_CURVE\n90\n0.0,0.0\n{END},1.0e3\n*CONTROL_QUASI_STATIC\n0.05\n"
    "*BOUNDARY_PRESCRIBED_MOTION_SET\n90,1,0,90,1.0\n*DATABASE_SPCFORC\n1.0e-6\n",
    f"*DEFINE_CURVE\n90\n0.0,0.0\n{END},1.0\n*LOAD_FACE_PRESSURE\n0,1,90,2.0\n",
]


@pytest.mark.parametrize("kind", FIRST)
def test_mutants_of_stages(kind: str, tmp_path: Path) -> None:
    """From restart files in mid-contact; the files of the run before keep every byte."""
    deck, chance = FIRST[kind](), random.Random(f"{SEED} {kind}")
    deck.add("DATABASE_BINARY_D3DUMP", (CYCLES,))
    code, text = said("run", deck.write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == NORMAL, text
    before = {path: path.read_bytes() for path in tmp_path.glob("job.*")}
    dumps = sorted(tmp_path.glob("job.dump??"))
    path = tmp_path / "stage.k"
    for i in range(max(2, MUTANTS // 16)):
        text = stage(kind, chance) if i % 8 == 0 else mutate(stage(kind, chance), chance)
        path.write_text(text, errors="replace")
        words = ("restart", chance.choice(dumps), path, "-j", "next", "--wall-time", "1")
        done = run(tmp_path, *words)
        check(done, {NORMAL, INPUT, RUN, STOPPED, OUTPUT}, f"stage {kind} {i}")
        if done.returncode in (NORMAL, STOPPED):
            check_finite(tmp_path, "next", f"stage {kind} {i}")
        for result in tmp_path.glob("next.*"):
            result.unlink()
    assert before == {path: path.read_bytes() for path in before}


def stage(kind: str, chance: random.Random) -> str:
    """A deck that goes on with a run, by some of what a stage may have."""
    lines = f"*KEYWORD\n*CONTROL_STAGE\n1\n*CONTROL_TERMINATION\n{END},\n"
    bodies = {"fixtures": 1, "shapes": 4, "cracks": 1, "damage": 1}[kind]
    if chance.random() < 0.7:
        lines += "*DELETE_IMPACTOR\n" + "".join(f"{1 + k}\n" for k in range(bodies))
    if kind == "fixtures" and chance.random() < 0.7:
        lines += "*DELETE_FIXTURE\n2\n4\n"
    return lines + "".join(chance.sample(BODIES, chance.choice((1, 1, 2)))) + "*END\n"
