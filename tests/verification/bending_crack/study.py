"""Energy of a bending crack and moment of the delamination that it starts, quads of 0.25 to 1 mm.

.venv/bin/python tests/verification/bending_crack/study.py [FOLDER]

Rows are printed as they come; a run takes from seconds to two minutes.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/support"))

from cracked_beam import INNER, Bent, Strip, bend, growth_moment  # noqa: E402
from damage import HTS40  # noqa: E402

# Between the inner bars
QUADS = (25, 49, 97)
# Largest damage and shear across the thickness, as the cards DMAX and GZ have them
RESIDUALS = ((0.999999, 1), (0.999, 0), (0.999, 1), (0.99, 0), (0.99, 1))
HEAD = (
    "| quad [mm] | NU23 | DMAX | GZ | energy of the crack | moment of growth [N] | over theory |"
    " sides | length [mm] |"
)


def row(found: Bent) -> str:
    """Energy of the crack over toughness times area; moment; both sides, and their length."""
    moment = found.moment[found.growing].mean()
    last = found.states()[1][-1]
    sides = -last[0] / last[-1]
    return (
        f"| {INNER / found.strip.quads:.2f} | {found.strip.poisson:g} | {found.strip.largest:g} | "
        f"{found.strip.shear} | {found.crack[-1]:.3f} | "
        f"{moment:.1f} | {moment / growth_moment():.3f} | {sides:.2f} | "
        f"{found.failed[-1]:.1f} |"
    )


def rows(folder: Path) -> Iterator[str]:
    """The table row by row."""
    folder.mkdir(parents=True, exist_ok=True)
    yield HEAD
    yield "|" + " ---: |" * HEAD.count(" |")
    for poisson in (HTS40.poisson[2], 0.0):
        for quads in QUADS:
            yield row(bend(Strip(quads, poisson=poisson), folder))
    for largest, shear in RESIDUALS:
        yield row(bend(Strip(QUADS[0], largest=largest, shear=shear), folder))


if __name__ == "__main__":
    place = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "results/study/bending_crack"
    for line in rows(place):
        sys.stdout.write(line + "\n")
        sys.stdout.flush()
