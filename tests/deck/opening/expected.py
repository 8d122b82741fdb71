"""Two rigid plies on springs under a sudden pull p: opening p / K (1 - cos w t)."""

import numpy as np
import pytest

from runs import Results

PULL = 3.6 / 16.0
STIFFNESS, MASS = 100.0, 2.0e-9 * 1.0


def check(results: Results) -> None:
    """The plies are K h / E = 0.14 % as soft as the springs; over three periods that adds up."""
    nodes = results.table("nodes")
    omega = np.sqrt(2.0 * STIFFNESS / MASS)
    opening = PULL / STIFFNESS * (1.0 - np.cos(omega * nodes["time"]))
    for name in ("n1", "n9"):
        found = nodes[f"{name} top uz"] - nodes[f"{name} bottom uz"]
        assert found == pytest.approx(opening, abs=0.03 * opening.max())
