"""A bond that has failed over one quad and fails over the other: its area times its toughness."""

import numpy as np
import pytest

from runs import Results

FAILED, WHOLE = 4.0, 6.0
TOUGHNESS, STRENGTH, STIFFNESS = 0.3, 30.0, 1.0e4
# both plies, which the bond pulls at
COMPLIANCE = 2.0 * 1.0 / 70000.0

# the plies are pulled at one side and bend: a little sliding comes in
BENT = 1.0e-5


def check(results: Results) -> None:
    """Opening: the energy is exact whatever the steps; onset and failure at their openings."""
    energy, area = results.table("energy"), results.table("delamination")
    assert energy["delamination"][-1] == pytest.approx(WHOLE * TOUGHNESS, rel=BENT)
    assert area["interface 1 energy"][-1] == pytest.approx(WHOLE * TOUGHNESS, rel=BENT)
    assert np.all(np.diff(energy["delamination"]) >= 0.0)
    assert np.all(energy["friction"] == 0.0)
    for name in ("interface 1 area", "sum", "projected area"):
        for column in (name, name.replace("area", "failed area").replace("sum", "failed sum")):
            assert area[column][0] == pytest.approx(FAILED)
            assert area[column][-1] == pytest.approx(FAILED + WHOLE)
    time = energy["time"]
    motion = 1000.0 * np.where(time < 2.0e-5, time**2 / 4.0e-5, time - 1.0e-5)
    opening, final = STRENGTH / STIFFNESS, 2.0 * TOUGHNESS / STRENGTH
    onset = motion[np.argmax(energy["delamination"] > 0.0)]
    failure, half = (
        np.interp(area["time"], time, motion)[np.argmax(area[name] > FAILED)]
        for name in ("failed sum", "sum")
    )
    # a state later at most, and the plies swing by as much as they stretch
    late = 1000.0 * 1.0e-6 + STRENGTH * COMPLIANCE
    assert opening < onset < opening + STRENGTH * COMPLIANCE + late
    assert abs(failure - final) < late
    # of the triangle of traction over opening, half is spent half-way between onset and failure
    assert abs(half - 0.5 * (opening + final)) < late
    listing = results.listing()
    assert "Interface material 9 glue" in listing
    # openings at onset and failure, in the table of the material
    assert "0.3000E-02" in listing
    assert "0.2000E-01" in listing
