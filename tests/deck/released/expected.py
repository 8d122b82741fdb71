"""Points whose prescribed motion is over are free for contact as well."""

import numpy as np
import pytest

from runs import Results

MASS, SPEED = 1.0e-6, 1000.0


def check(results: Results) -> None:
    """What the sphere loses the plate gains: nothing else acts on either of them."""
    momentum = results.table("energy")["momentum z"]
    sphere = results.table("impactor_7")
    assert sphere["velocity"][-1] > -0.9 * SPEED
    assert momentum == pytest.approx(np.full(momentum.size, -MASS * SPEED), rel=1.0e-8)
