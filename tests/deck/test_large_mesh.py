"""A mesh that is larger than the stack: no array of its size may lie there."""

from __future__ import annotations

import resource
import subprocess
from pathlib import Path

import pytest

from decks import Deck, Ply, Sphere, ramp
from elasticity import CARBON, GLASS
from meshes import regular
from runs import SOLVER

STACK = 256 * 1024  # bytes, less than one real number for each freedom
QUADS = 40  # along each side
STEP = 1.0e-9


def limit_stack() -> None:
    """Give the program little stack."""
    resource.setrlimit(resource.RLIMIT_STACK, (STACK, STACK))


def everything(joint: str, method: int) -> Deck:
    """A plate with all kinds of loads, supports and results, for a few steps."""
    mesh = regular(20.0, 20.0, QUADS, QUADS, 9)
    deck = Deck("more freedoms than stack", 3.0 * STEP)
    deck.control(linear=joint == "springs", damping=10.0)
    deck.mesh(mesh)
    deck.laminate([Ply(CARBON, 0.5), Ply(GLASS, 0.5, 45.0), Ply(CARBON, 0.5, 90.0)])
    if joint != "tied":
        deck.interfaces(*((1.0e4, 1.0e4) if joint == "springs" else ()))
    deck.hold(mesh.where(x=0.0), "xyz")
    curve = deck.curve(ramp(STEP))
    edge = deck.node_set(mesh.where(x=20.0))
    deck.add("LOAD_FACE_LINE", (edge, 1, 3, curve, 0.1))
    deck.add("LOAD_FACE_PRESSURE", (0, -1, curve, 0.1))
    deck.add("LOAD_BODY_Z", (curve, 1.0))
    deck.move_face(mesh.where(x=10.0, y=20.0), 1, 1, curve, 1.0e-6)
    deck.sphere(Sphere(8.0, 1.0e-5, (10.0, 10.0, 8.7501), (0.0, 0.0, -5.0e3), method=method))
    deck.histories(mesh.where(y=0.0), 0.0)
    deck.profile(1, 9.0, 9.0, 0.0)
    deck.add("DATABASE_FIELD", "displacement velocity stress strain stress_ply strain_ply")
    deck.intervals(spcforc=0.0, binary_d3plot=STEP)
    return deck


@pytest.mark.parametrize("method", [1, 2])
@pytest.mark.parametrize("joint", ["tied", "apart", "springs"])
def test_mesh_is_larger_than_the_stack(joint: str, method: int, tmp_path: Path) -> None:
    """The run ends well."""
    deck = everything(joint, method).write(tmp_path / "deck.k")
    command = [SOLVER, "run", deck, "-o", tmp_path]
    done = subprocess.run(
        command, preexec_fn=limit_stack, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
