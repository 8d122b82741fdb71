"""A point of a damaged ply, step by step, as section 4 of `manual/theory.md` describes it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from damage import DamagedPly
from elasticity import Array

#: Shear of a ply: along a line, along an exponential
LINE, EXPONENTIAL = 0, 1
#: What a band that is too wide does: the stress drops at once
DROP = 2
#: Compression across below this share of the shear counts as tension
IDLE = 1.0e-3
#: Least strain at onset over that in uniaxial stress
LEAST = 0.1
#: Tension and compression
OPEN, CLOSED = 0, 1


@dataclass(frozen=True)
class Choices:
    """The switches of *MAT_PLY_CODAM2, card 6."""

    rule: int = 0
    snap: int = 0
    ratio: float = 1.05
    hashin: int = 0
    removed: int = 0
    closes: int = 0
    plateau: float = 0.0
    whole_across: int = 0


@dataclass
class Mode:
    """Damage of fibres or matrix, and the strains between which it grows; 0 before onset."""

    damage: float = 0.0
    onset: float = 0.0
    finish: float = 0.0
    plateau: float = 0.0
    #: Share of the strength in a second law, and where that ends
    second: tuple[float, float] = (0.0, 0.0)

    def grow(self, strain: float) -> None:
        """Let the stress fall along its line, or to the plateau; never heal."""
        if self.onset == 0.0 or strain <= self.onset:
            return
        left = 0.0
        if self.finish > self.onset:
            left = max((self.finish - strain) / (self.finish - self.onset), 0.0)
        share, end = self.second
        if share > 0.0:
            left *= 1.0 - share
            left += share * max(end - strain, 0.0) / (end - self.onset)
        left = max(left, self.plateau)
        self.damage = max(self.damage, 1.0 - left * self.onset / strain)


class PlyPoint:
    """A point with its history; strain and stress 11, 22, 33, 12, 13, 23."""

    def __init__(self, ply: DamagedPly) -> None:
        """Begin without damage."""
        self.ply, self.choices = ply, Choices(*ply.switches)
        self.fibre, self.matrix = (Mode(), Mode()), (Mode(), Mode())
        self.peak = self.set = 0.0
        self.asymptote = _asymptote(ply)

    def step(self, strain: Array) -> Array:
        """Stress at the next strain of the path."""
        elastic = strain.copy()
        elastic[3] = self._bend(strain[3])
        shear = self.ply.shear[0] * abs(elastic[3])
        senses = self._senses(elastic, shear)
        first, second = self.fibre[senses[0]], self.matrix[senses[1]]
        sizes = abs(strain[0]), float(np.hypot(strain[1], elastic[3]))
        first.grow(sizes[0])
        second.grow(sizes[1])
        trial = self._trial(elastic, senses)
        if first.onset == 0.0:
            self._begin_fibre(first, trial[0], strain[0])
        if second.onset == 0.0:
            self._begin_matrix(second, trial[1], strain[1], shear, abs(elastic[3]))
        first.grow(sizes[0])
        second.grow(sizes[1])
        return self._stress(elastic, senses)

    def _bend(self, strain: float) -> float:
        """Elastic shear strain: what is on the curve less what stays."""
        uncracked = all(mode.onset == 0.0 for mode in self.matrix)
        if uncracked and abs(strain) > self.peak:
            self.peak = abs(strain)
            if self.asymptote > 0.0:
                rate = self.ply.shear[0] / self.asymptote
                self.set = self.peak + np.expm1(-rate * self.peak) / rate
        return float(np.sign(strain) * max(abs(strain) - self.set, 0.0))

    def _senses(self, elastic: Array, shear: float) -> tuple[int, int]:
        """Whether fibres and matrix are in compression, where that matters."""
        if not self.choices.closes:
            return OPEN, OPEN
        senses = OPEN, OPEN
        remains = np.ones(2)
        for _ in range(2):
            across = self._normal(elastic, remains) / remains
            senses = int(across[0] < 0.0), int(across[1] < -IDLE * shear)
            remains = self._remains(senses)
        return senses

    def _remains(self, senses: tuple[int, int]) -> Array:
        """R1 and R2 for normal stress: compression feels its own damage, tension the larger."""
        damages = [
            pair[CLOSED].damage if sense == CLOSED else max(mode.damage for mode in pair)
            for pair, sense in zip((self.fibre, self.matrix), senses, strict=True)
        ]
        return np.maximum(1.0 - np.array(damages), self._least())

    def _least(self) -> float:
        """Least part of a stiffness that remains."""
        return 1.0 - self.ply.largest

    def _normal(self, elastic: Array, remains: Array) -> Array:
        """Stresses 11 and 22 from the compliance of what remains."""
        return (self._block(remains) @ elastic[:3])[:2]

    def _block(self, remains: Array) -> Array:
        """Stiffness of the normal strains, (3, 3)."""
        young, (nu12, nu13, nu23) = np.array(self.ply.young), self.ply.poisson
        compliance = np.diag(1.0 / (young * np.append(remains, 1.0)))
        compliance[0, 1] = compliance[1, 0] = -nu12 / young[0]
        compliance[0, 2] = compliance[2, 0] = -nu13 / young[0]
        compliance[1, 2] = compliance[2, 1] = -nu23 / young[1]
        return np.linalg.inv(compliance)

    def _trial(self, elastic: Array, senses: tuple[int, int]) -> Array:
        """Stresses of onset: on what remains in the other direction."""
        remains = self._remains(senses)
        return self._normal(elastic, remains) / remains

    def _begin_fibre(self, mode: Mode, stress: float, strain: float) -> None:
        """Freeze the strains between which fibre damage grows, at its onset."""
        ply, sense = self.ply, int(stress < 0.0)
        size = max(abs(strain), LEAST * abs(stress) / ply.young[0])
        plateau = self.choices.plateau * sense
        density = ply.fibre_toughness[sense] / (ply.band * (1.0 - plateau) ** 2)
        share, energy = ply.lines[2 * sense : 2 * sense + 2]
        laws = [(energy / share, share)]
        if share < 1.0:
            laws.append(((1.0 - energy) / (1.0 - share), 1.0 - share))
        laws.sort()
        steep = density * laws[0][0]
        beyond = max(
            (stress / ply.fibre_strength[sense]) ** 2, self._spent(size * abs(stress), steep)
        )
        if beyond < 1.0:
            return
        mode.onset = size / np.sqrt(beyond)
        mode.plateau = plateau
        single = 2.0 * density / (abs(stress) / np.sqrt(beyond))
        mode.finish = laws[0][0] * single
        if len(laws) > 1:
            mode.second = laws[1][1], laws[1][0] * single

    def _begin_matrix(
        self, mode: Mode, stress: float, strain: float, shear: float, slide: float
    ) -> None:
        """Freeze the strains between which matrix damage grows, at its onset."""
        ply, least = self.ply, LEAST * abs(stress) / self.ply.young[1]
        across, along = max(stress * strain, least * abs(stress)), shear * slide
        if across + along == 0.0:
            return
        normal = ply.matrix_toughness[int(stress < -IDLE * shear)]
        shares = across * normal + along * (ply.shear_toughness or normal)
        density = shares / ((across + along) * ply.band)
        beyond = max(self._matrix_load(stress, shear), self._spent(across + along, density))
        if beyond < 1.0:
            return
        size = float(np.hypot(max(abs(strain), least), slide))
        mode.onset = size / np.sqrt(beyond)
        mode.finish = 2.0 * density * size * np.sqrt(beyond) / (across + along)

    def _matrix_load(self, stress: float, shear: float) -> float:
        """Square of the load over that at which F2 is 1."""
        ply = self.ply
        strength = ply.matrix_strength[int(stress < 0.0)]
        along = (shear / ply.shear_strength) ** 2
        if stress >= 0.0 or not self.choices.hashin:
            return float((stress / strength) ** 2 + along)
        square = (stress / (2.0 * ply.cross_strength)) ** 2 + along
        linear = ((strength / (2.0 * ply.cross_strength)) ** 2 - 1.0) * stress / strength
        return float((0.5 * (linear + np.sqrt(linear**2 + 4.0 * square))) ** 2)

    def _spent(self, work: float, density: float) -> float:
        """Square of the load over that from which a line cannot end behind its onset."""
        return 0.0 if self.choices.snap == DROP else self.choices.ratio * work / (2.0 * density)

    def _stress(self, elastic: Array, senses: tuple[int, int]) -> Array:
        """Secant stress."""
        stress = np.zeros(6)
        stress[:3] = self._block(self._remains(senses)) @ elastic[:3]
        open_both = self._remains((OPEN, OPEN))
        across = np.ones(2) if self.choices.whole_across else open_both
        moduli = np.array(self.ply.shear) * np.append(open_both.prod(), across)
        stress[3:] = moduli * elastic[3:]
        return stress


def _asymptote(ply: DamagedPly) -> float:
    """What an exponential that reaches the strength at its strain tends to; 0 for a line."""
    if ply.curve[0] == LINE:
        return 0.0
    strength, modulus, strain = ply.shear_strength, ply.shear[0], float(ply.curve[2])
    return float(
        brentq(
            lambda top: top * -np.expm1(-modulus * strain / top) - strength,
            strength * (1.0 + 1.0e-12),
            1.0e3 * strength,
            xtol=1.0e-12,
        )
    )
