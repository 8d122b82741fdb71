"""A quad strained alike everywhere: averages are strains, the band is as the ellipse says."""

import numpy as np
import pytest

from runs import Results

YOUNG, STRENGTH, TOUGHNESS = 9.0e3, 72.0, 6.4512
RADII = (6.0, 4.0)
LENGTH, AREA = 2.0, 1.0 * 0.25
# 1.4 radii across a crack
BANDS = (8.4, 5.6)
ONSET = STRENGTH / YOUNG
FINISH = 2.0 * TOUGHNESS / (BANDS[1] * STRENGTH)

PATH = ((0.0, 1.0e-3, 1.5e-3, 2.5e-3), (0.0, 0.025, 0.01, 0.04))

# The damped ply lags behind by the inertia of 30 1/s times 2 mm: 1e-3 MPa; damage behind strain by
# a step, 2e-6 of strain, as the corner of onset falls between two
TOLERANCE = 4.0e-6 / ONSET


def falling(strain: float) -> float:
    """Stress on the line between onset and the end."""
    return STRENGTH * (FINISH - strain) / (FINISH - ONSET)


def check(results: Results) -> None:
    """Along the path; energy; what the listing says of band and neighbours."""
    profile = results.table("profile_1")
    for time, expected in [
        (2.5e-4, lambda strain: YOUNG * strain),
        (1.0e-3, falling),
        (1.5e-3, lambda strain: falling(0.025) * strain / 0.025),
        (2.5e-3, lambda _: 0.0),
    ]:
        row = np.argmin(np.abs(profile["time"] - time))
        strain = np.interp(profile["time"][row], *PATH)
        assert profile["exx"][row] == pytest.approx(strain, rel=1.0e-4)
        assert profile["sxx"][row] == pytest.approx(expected(strain), rel=1.0e-3, abs=2.0e-3)
    energy = results.table("energy")
    spent = energy["matrix damage"]
    expected = TOUGHNESS / BANDS[1] * AREA * LENGTH
    assert spent[-1] == pytest.approx(expected, rel=TOLERANCE)
    assert energy["internal"][-1] == pytest.approx(spent[-1], rel=1.0e-4)
    assert np.all(np.diff(spent) >= 0.0)
    assert np.abs(energy["error"]).max() < 1.0e-9
    check_listing(results.listing().splitlines())


def check_listing(lines: list[str]) -> None:
    """Radii, points within them, widths.

    The four points of the quad lie within 2 mm of each other.
    """
    row = next(line for line in lines if line.startswith("strains averaged"))
    assert [float(word) for word in row.split() if word[0].isdigit()] == [*RADII]
    row = next(line for line in lines if "Gauss points in the ellipse" in line)
    assert [int(word) for word in row.split() if word[0].isdigit()] == [4, 4]
    for words, width in zip(("broken fibres", "matrix cracks"), BANDS, strict=True):
        row = next(line for line in lines if f"across {words}" in line)
        found = [float(word) for word in row.split() if word[0].isdigit()]
        assert found == pytest.approx([width, width], rel=1.0e-5)
