"""Plies that are damaged, as *MAT_PLY_CODAM2 has them."""

from __future__ import annotations

from dataclasses import dataclass

from elasticity import Material

# Fields of the card of the switches; the last, GZ, is not zero where it is empty
SWITCHES = 8


@dataclass(frozen=True)
class DamagedPly(Material):
    """A ply with strengths and toughnesses, each in tension and in compression."""

    fibre_strength: tuple[float, float]
    matrix_strength: tuple[float, float]
    shear_strength: float
    fibre_toughness: tuple[float, float]
    matrix_toughness: tuple[float, float]
    cross_strength: float = 0.0
    shear_toughness: float = 0.0
    band: float = 0.0  # width of the crack band; 0 by the rule
    largest: float = 0.999999  # damage, so that closed forms need no term for what remains
    curve: tuple[float, ...] = (0,)  # card of the shear curve
    switches: tuple[float, ...] = (0,)  # card of the switches; what lacks is zero
    radii: tuple[float, float] = (0.0, 0.0)  # of the average, along and across the fibres
    lines: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)  # FXT FGXT FXC FGXC

    def cards(self, number: int) -> list[tuple[float, ...]]:
        """Cards of the material with this number."""
        strengths = (*self.fibre_strength, *self.matrix_strength)
        toughnesses = (*self.fibre_toughness, *self.matrix_toughness)
        return [
            (number, self.density, *self.young, *self.poisson),
            self.shear,
            (*strengths, self.shear_strength, self.cross_strength),
            (*toughnesses, self.band, self.largest, self.shear_toughness),
            self.curve,
            (*self.switches, *(0,) * (SWITCHES - len(self.switches))),
            (0.0, *self.radii, *self.lines),
        ]


# The paper's Table 5, in mm, s, t: HTS40/9772, shear along a line
HTS40 = DamagedPly(
    density=1.6e-9,
    young=(153.0e3, 10.3e3, 10.3e3),
    poisson=(0.3, 0.3, 0.4),
    shear=(6.0e3, 6.0e3, 3.7e3),
    fibre_strength=(2537.0, 1580.0),
    matrix_strength=(82.0, 236.0),
    shear_strength=90.0,
    fibre_toughness=(91.6, 79.9),
    matrix_toughness=(0.22, 1.1),
    cross_strength=40.0,
)

# Its modes: fibre angle, modulus, strength, toughness, sense of the load along x, or of shear
MODES = {
    "fibre tension": (0.0, HTS40.young[0], 2537.0, 91.6, 1.0),
    "fibre compression": (0.0, HTS40.young[0], 1580.0, 79.9, -1.0),
    "matrix tension": (90.0, HTS40.young[1], 82.0, 0.22, 1.0),
    "matrix compression": (90.0, HTS40.young[1], 236.0, 1.1, -1.0),
    "shear": (0.0, HTS40.shear[0], 90.0, 0.22, 1.0),
}
# Rules of the width of the crack band, as LRULE counts them
BAND, POINT, ROOT_POINT, ROOT_QUAD = range(4)
