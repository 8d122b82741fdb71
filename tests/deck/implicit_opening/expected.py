"""Two plies on stiff springs under a slow pull p: they open by p / K, in steps of the plies."""

import numpy as np
import pytest

from runs import Results

PULL = 3.6 / 16.0
STIFFNESS, YOUNG, DENSITY, PLY = 4.0e5, 70000.0, 2.0e-9, 1.0
# of two faces with half of the mass of their plies each
SPRING_STEP = 2.0 / np.sqrt(STIFFNESS * 4.0 / (DENSITY * PLY))


def check(results: Results) -> None:
    """At rest to some 1e-5: the pull rises over 40 periods of the plies and is damped since.

    The energy balance is an identity of the scheme but for damping where the last two steps are
    shorter.
    """
    nodes, energy = results.table("nodes"), results.table("energy")
    assert energy["step"][1:-2].min() > 2.0 * SPRING_STEP
    stretch = PULL * (1.0 / STIFFNESS + 2.0 * PLY / YOUNG)
    for name in ("n1", "n9"):
        found = nodes[f"{name} top uz"] - nodes[f"{name} bottom uz"]
        assert found[-1] == pytest.approx(stretch, rel=1.0e-4)
    assert np.abs(energy["error"]).max() < 1.0e-6
    assert np.abs(energy["momentum z"]).max() < 1.0e-12 * PULL * 16.0 * nodes["time"][-1]
