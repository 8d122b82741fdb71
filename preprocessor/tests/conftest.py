"""What several tests need."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from programs import plydyn_pre, run_deck

import plydyn_pre as pre

DECKS = Path(__file__).resolve().parents[2] / "decks"

CARBON = pre.PlyElastic(
    density=1.7e-9,
    E1=165000.0,
    E2=9000.0,
    E3=9000.0,
    nu12=0.34,
    nu13=0.34,
    nu23=0.5,
    G12=5600.0,
    G13=5600.0,
    G23=2800.0,
)

#: Tables 5 and 6 of the paper
DAMAGED = pre.PlyCodam2(
    density=1.6e-9,
    E1=153000.0,
    E2=10300.0,
    E3=10300.0,
    nu12=0.3,
    nu13=0.3,
    nu23=0.4,
    G12=6000.0,
    G13=6000.0,
    G23=3700.0,
    XT=2537.0,
    XC=1580.0,
    YT=82.0,
    YC=236.0,
    SL=90.0,
    G1T=91.6,
    G1C=79.9,
    G2T=0.22,
    G2C=1.1,
)
BOND = pre.Cohesive(normal=1373300.0, shear=493300.0, N=62.3, S=92.3, GIC=0.28, GIIC=0.79)

LOADS = (
    pre.Pressure(value=0.1, set="core", curve="ramp"),
    pre.Pressure(value=0.2, face="bottom"),
    pre.Force(set="centre", direction="z", value=-1.0),
    pre.LineForce(set="bottom", direction="y", value=2.0),
    pre.FrameAcceleration(direction="z", value=9810.0),
    pre.Motion(set="right", direction="x", quantity="displacement", value=0.1, curve="ramp"),
    pre.InitialVelocity(velocity=(0.0, 0.0, 1.0)),
)


@pytest.fixture(scope="session")
def solver() -> str:
    """The solver, where there is one."""
    path = shutil.which(os.environ.get("PLYDYN", "plydyn"))
    if path is None:
        pytest.skip("no solver: PLYDYN does not name one and none is on the path")
    return path


@pytest.fixture(scope="session")
def force_of(
    solver: str, tmp_path_factory: pytest.TempPathFactory
) -> Callable[[str], tuple[np.ndarray, np.ndarray]]:
    """Times and forces of the impact of a recipe, which runs once for all that compare with it."""

    @cache
    def run(recipe: str) -> tuple[np.ndarray, np.ndarray]:
        folder = tmp_path_factory.mktemp("own")
        (folder / "own.toml").write_text(recipe)
        result = plydyn_pre(folder, "deck", "own.toml", "-o", "own.k")
        assert result.returncode == 0, result.stdout + result.stderr
        run_deck(solver, folder, "own.k")
        times, forces = np.loadtxt(folder / "own.impactor_1.csv", delimiter=",", skiprows=1).T[:2]
        return times, forces

    return run


@pytest.fixture
def decks() -> Path:
    """The folder of the recipes that come with plydyn."""
    return DECKS


@pytest.fixture
def ply() -> pre.PlyCodam2:
    """A ply that is damaged."""
    return DAMAGED


@pytest.fixture
def bond() -> pre.Cohesive:
    """A bond between plies that fails."""
    return BOND


@pytest.fixture
def study() -> pre.Study:
    """A small study that uses most of what there is."""
    return pre.Study(
        title="Everything, at once",
        materials={
            "carbon": CARBON,
            "metal": pre.Elastic(density=2.7e-9, E=70000.0, nu=0.33, title="Aluminium"),
            "resin": pre.Springs(normal=1.0e6, shear=0.5e6),
        },
        laminate=pre.Laminate(
            layup="[metal/0/90]s",
            thickness={"carbon": 0.125, "metal": 0.3},
            material="carbon",
            interfaces="resin",
            refine=(pre.PlyRange((3, 4), 3, 2),),
        ),
        mesh=pre.OgridSquare(side=30.0, core=10.0, n=2, rings=1),
        sets={
            "line": pre.PlaceSet(box=(0.0, 30.0, 15.0, 15.0)),
            "gauge": pre.PlaceSet(at=(20, 15)),
        },
        supports=(
            pre.Support("left"),
            pre.Support("right", hold="z", face="bottom"),
            pre.Support("top", hold="y", face="plane", height=0.125),
        ),
        impactor=pre.Impactor(
            radius=4.0, mass=1.0e-5, velocity=(0.0, 0.0, -1000.0), title="Ball", guided=True
        ),
        loads=LOADS,
        curves={"ramp": pre.Curve(time=(0.0, 1.0e-4), value=(0.0, 1.0))},
        control=pre.Control(1.0e-4, kinematics="linear", damping=10.0, step_factor=0.8),
        outputs=pre.Outputs(
            field_interval=1.0e-5,
            fields=("displacement", "stress_ply"),
            node_interval=1.0e-6,
            nodes=("gauge", "line"),
            support_interval=1.0e-6,
            profiles=(pre.Profile((12.0, 13.0), 1.0e-5, 3),),
        ),
    )
