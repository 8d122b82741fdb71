"""Two masses on a lever: accelerations, force of the lever and work follow in closed form."""

import numpy as np
import pytest

from runs import DIGITS, Results

# a quarter of each plate: density times thickness times area
LIGHT, HEAVY = 2.0e-9 * 1.5 * 1.0, 2.0e-9 * 1.5 * 2.0
FORCE, SPEED = 5.0, 800.0
FLIGHT = (600.0, -300.0)
# 2 w_1 - w_2 = 0, and 1.5 u_1 - 0.5 u_2 = SPEED t
LEVER, LED = (2.0, -1.0), (1.5, -0.5)


def check(results: Results) -> None:
    """Central differences are exact for constant accelerations; nothing is strained."""
    nodes, forces = results.table("nodes"), results.table("constraints")
    time, exact = nodes["time"], {"rel": 3.0 * DIGITS, "abs": 1.0e-15}

    # F w_1 = m_1 w_1'' w_1 + m_2 w_2'' w_2 with w_2 = 2 w_1
    first = FORCE / (LIGHT + LEVER[0] ** 2 * HEAVY)
    for node, acceleration in (("n1", first), ("n5", LEVER[0] * first)):
        for face in ("bottom", "top"):
            found = nodes[f"{node} {face} uz"]
            assert found == pytest.approx(0.5 * acceleration * time**2, **exact)
    # what moves the second plate
    force = LEVER[0] * HEAVY * first / LEVER[1]
    for number in (11, 12, 13, 14):
        assert forces[f"force {number}"] == pytest.approx(np.full(time.size, force), **exact)
        assert forces[f"displacement {number}"] == pytest.approx(0.0 * time, abs=1.0e-15)

    # impulses along the coefficients that give the sum its speed at once
    whole = LED[0] ** 2 / LIGHT + LED[1] ** 2 / HEAVY
    for node, k, mass in (("n1", LED[0], LIGHT), ("n5", LED[1], HEAVY)):
        speed = SPEED * k / mass / whole
        assert nodes[f"{node} bottom ux"] == pytest.approx(speed * time, **exact)
    assert forces["displacement 21"] == pytest.approx(SPEED * time, **exact)

    for node, speed in zip(("n1", "n5"), FLIGHT, strict=True):
        assert nodes[f"{node} top uy"] == pytest.approx(speed * time, **exact)

    # external: the load, and the jump of the led sums; a workless lever adds nothing
    energy = results.table("energy")
    load = 4.0 * FORCE * 0.5 * first * energy["time"][1:] ** 2
    jump = 4.0 * 0.5 * SPEED**2 / whole
    assert energy["external"][1:] == pytest.approx(load + jump, **exact)
    assert np.abs(energy["error"]).max() < 1.0e-12
