"""The impact of `decks/elastic_impact` by assembled matrices, with no code of the solver.

`python tests/support/elastic_reference.py le1` computes a row of the table that
`tests/verification/elastic_impact` compares the solver with, and compares it with what stands
there. The plate is a sparse stiffness and a diagonal mass with the same expansions, the points of
its face meet the sphere, and there is no gap. Both rows take eight minutes.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from contact_reference import Impact
from decks import Ply, Sphere
from elasticity import Material
from layered_plate import LayeredPlate
from meshes import Mesh
from plydyn_pre import load_recipe
from plydyn_pre.mesh import make_mesh

RECIPES = Path(__file__).resolve().parents[2] / "decks" / "elastic_impact"
#: Largest force, largest mean of it over 20 microseconds, largest deflection of the bottom, rebound
#: and end of contact
TABLE = {
    "le1": (905.8, 870.3, 0.6646, 4773.0, 0.5461e-3),
    "le2": (906.2, 869.8, 0.6649, 4773.0, 0.5466e-3),
}
#: By how much these may differ: half of the last printed digit
CLOSE = (0.05, 0.05, 5.0e-5, 0.5, 0.05e-6)
WINDOW = 20.0e-6
#: Share of the stable step
SHARE = 0.9


def impact(recipe: str) -> tuple[float, float, float, float, float]:
    """The numbers of a row."""
    study = load_recipe(RECIPES / f"{recipe}.toml")
    shape = make_mesh(study.mesh)
    mesh = Mesh(shape.nodes, shape.quads)
    plies = []
    for ply in study.laminate.stack:
        card = study.materials[ply.material]
        moduli, ratios = (card.E1, card.E2, card.E3), (card.nu12, card.nu13, card.nu23)
        material = Material(card.density, moduli, ratios, (card.G12, card.G13, card.G23))
        plies.append(Ply(material, ply.thickness, ply.angle))
    plate = LayeredPlate(mesh, plies, study.laminate.order)
    plate.hold(shape.node_sets["boundary"], "xyz")
    ball, velocity = study.impactor, study.impactor.velocity
    x, y = shape.middle
    centre = (x, y, ball.radius + 0.5 * plate.height)
    sphere = Sphere(ball.radius, ball.mass, centre, velocity, method=2)
    run = Impact(plate, [sphere], SHARE * plate.stable_step())
    below = plate.face(-1)[1][mesh.at(x, y), 2]
    forces, lowest = [], 0.0
    for _ in range(int(study.control.end_time / run.step)):
        run.advance()
        forces.append(run.impactors[0].force[2])
        lowest = min(lowest, run.displacement[below])
    force, count = np.array(forces), round(WINDOW / run.step)
    mean = np.convolve(force, np.ones(count) / count, "valid").max()
    end = run.step * (1 + np.flatnonzero(force > 0.0)[-1])
    return force.max(), mean, -lowest, run.impactors[0].velocity[2], end


def main() -> None:
    """Compute some rows, and end with 1 where one is not that of the table."""
    wrong = False
    for name in sys.argv[1:] or TABLE:
        found = impact(name)
        for what in (found, TABLE[name]):
            sys.stdout.write("({:.1f}, {:.1f}, {:.4f}, {:.0f}, {:.3e})\n".format(*what))
        rows = zip(found, TABLE[name], CLOSE, strict=True)
        wrong |= any(abs(own - printed) > close for own, printed, close in rows)
    sys.exit(int(wrong))


if __name__ == "__main__":
    main()
