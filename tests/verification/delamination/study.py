"""All tests of delamination, orders 1 to 3 and quads of 0.5 to 2 mm, as a table for the manual.

.venv/bin/python tests/verification/delamination/study.py [FOLDER]

Rows are printed as they come; a run takes from seconds to a minute, the whole some minutes.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/support"))

from delamination import PEEK_BOND, TESTS, Specimen, simulate  # noqa: E402

HEAD = (
    "| test | order | quad [mm] | variant | force [N] | over theory | over test | G/Gc | kinetic |"
)


def variants() -> Iterator[tuple[str, Specimen, str]]:
    """Name of the test, specimen, what is special about it."""
    for name, (specimen, _) in TESTS.items():
        yield name, specimen, ""
    for name in ("DCB", "ENF"):
        specimen = TESTS[name][0]
        for size in (2.0, 1.0, 0.5):
            for order in (2, 1, 3):
                if (size, order) != (1.0, 2):
                    yield name, replace(specimen, size=size, order=order), ""
    fitted = replace(PEEK_BOND, fit=2)
    for size in (2.0, 1.0):
        yield "DCB", replace(TESTS["DCB"][0], size=size, nodal=True), "nodes"
        yield "DCB", replace(TESTS["DCB"][0], size=size, bond=fitted), "fitted strengths"
    for name in ("DCB", "ENF"):
        yield name, replace(TESTS[name][0], size=2.0, implicit=True), "implicit, steps of 61 ns"


def row(name: str, specimen: Specimen, what: str, folder: Path) -> str:
    """Run a test; largest force, resistance over 1 to 4 mm of growth."""
    found = simulate(specimen, folder)
    theory, measured = float(specimen.force(specimen.crack)), TESTS[name][1]
    grown = found.growing(1.0, 4.0, specimen.crack)
    rate = specimen.resistance(found.force[grown], found.deflection[grown])
    onset = int((found.crack > specimen.crack).argmax())
    return (
        f"| {name} | {specimen.order} | {specimen.size:g} | {what} | {found.peak:.1f} | "
        f"{found.peak / theory:.3f} | {found.peak / measured:.3f} | "
        f"{rate.mean():.3f} ± {rate.std():.3f} | {found.kinetic[onset]:.1e} |"
    )


def rows(folder: Path) -> Iterator[str]:
    """The table row by row."""
    folder.mkdir(parents=True, exist_ok=True)
    yield HEAD
    yield f"|{' --- |' * HEAD.count(' | ')} --- |"
    for name, specimen, what in variants():
        yield row(name, specimen, what, folder)


if __name__ == "__main__":
    place = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "results/study/delamination"
    for line in rows(place):
        sys.stdout.write(line + "\n")
        sys.stdout.flush()
