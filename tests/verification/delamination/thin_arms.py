"""Double cantilevers of thin arms on quads that are long for them, as a table for the manual.

.venv/bin/python tests/verification/delamination/thin_arms.py [FOLDER]

The plates of thin plies that are struck have quads of four nodes and 2 mm, and come apart in
sublaminates of 0.6 to 1.6 mm. Their strengths of interfaces are lowered until the zone in a large
body spans three node distances; ahead of thin arms it is shorter than that.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import replace
from math import pi, sqrt
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/support"))

from delamination import PEEK, PEEK_BOND, Specimen, simulate  # noqa: E402

HEAD = (
    "| arms [mm] | nodes | quad [mm] | by the zone of | strength [MPa] | force over theory | G/Gc |"
)
LARGE_BODY = "a large body"
ARMS = (1.6, 0.8, 0.4)
MESHES = ((4, 2.0), (4, 1.0), (9, 2.0))
THIN = Specimen(0.0, 20.0, implicit=True, duration=5.0e-3, growth=12.0)
#: Share of E G / strength^2 that a zone has in a large body, and node distances that it spans
LARGE, POINTS = 9.0 * pi / 32.0, 3.0


def in_large_body(size: float) -> float:
    """Strength whose zone in a large body spans three distances of nodes (Turon et al., 2007)."""
    return sqrt(LARGE * PEEK.young[2] * PEEK_BOND.toughness[0] / (POINTS * size))


def between_thin_arms(arm: float, size: float) -> float:
    """Strength whose zone between two thin layers does (Yang and Cox, 2005)."""
    return sqrt(PEEK.young[0] * PEEK_BOND.toughness[0] * arm**3) / (POINTS * size) ** 2


def row(arm: float, nodes: int, size: float, zone: str, folder: Path) -> str:
    """Run a test: largest force until a growth of 4 mm, and resistance from 1 mm on."""
    apart = size if nodes == 4 else size / 2.0
    strength = in_large_body(apart) if zone == LARGE_BODY else between_thin_arms(arm, apart)
    bond = replace(PEEK_BOND, strength=(strength, PEEK_BOND.strength[1]))
    specimen = replace(THIN, arm=arm, nodes=nodes, size=size, bond=bond)
    found = simulate(specimen, folder)
    grown = found.growing(1.0, 4.0, specimen.crack)
    rate = specimen.resistance(found.force[grown], found.deflection[grown])
    peak = found.force[: grown.stop].max() / float(specimen.force(specimen.crack))
    return (
        f"| {arm:g} | {nodes} | {size:g} | {zone} | {strength:.2g} | {peak:.2f} | "
        f"{rate.mean():.2f} ± {rate.std():.2f} |"
    )


def rows(folder: Path) -> Iterator[str]:
    """The table row by row."""
    folder.mkdir(parents=True, exist_ok=True)
    yield HEAD
    yield f"|{' --- |' * (HEAD.count('|') - 1)}"
    for arm in ARMS:
        for nodes, size in MESHES:
            for zone in (LARGE_BODY, "thin arms"):
                yield row(arm, nodes, size, zone, folder)


if __name__ == "__main__":
    place = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "results/study/thin_arms"
    for line in rows(place):
        sys.stdout.write(line + "\n")
        sys.stdout.flush()
