"""A point of an interface that fails, step by step, as section 7.1 of `manual/theory.md` has it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from decks import Bond
from elasticity import Array

# What is left of the stiffness against closing where the penalty falls
FLOOR = 0.1


@dataclass
class CohesivePoint:
    """The bilinear law of unequal stiffnesses, closing, and friction of the failed share."""

    bond: Bond
    damage: float = 0.0
    fracture: float = 0.0
    released: float = 0.0  # by a penalty that falls under pressure
    friction: float = 0.0
    slip: Array = field(default_factory=lambda: np.zeros(2))
    stretch: float = 0.0
    works: Array = field(default_factory=lambda: np.zeros(2))

    def step(self, jump: Array) -> None:
        """Go to the next separation: sliding along x and y, opening."""
        before, held = self.damage, self._held()
        stiffness, strength = np.array(self.bond.stiffness), np.array(self.bond.strength)
        pressure = held * stiffness[0] * max(-jump[2], 0.0)
        gain = 1.0 + self.bond.pressure_gain * pressure / strength[1]
        parts = np.array([max(jump[2], 0.0), np.hypot(jump[0], jump[1])])
        energies = stiffness * parts**2
        load = float(np.linalg.norm(stiffness * parts / (strength * [1.0, gain])))
        if load > 0.0:
            mix = energies[1] / energies.sum()
            if self.bond.by_work:
                self._grow_by_work(load, mix, float(energies.sum()))
            else:
                self._grow(load, mix, float(energies.sum()), gain)
        self.released += 0.5 * stiffness[0] * (held - self._held()) * min(jump[2], 0.0) ** 2
        if self.bond.friction > 0.0 and self.damage > 0.0:
            self._rub(jump, before)

    def _held(self) -> float:
        """Share of the stiffness against closing."""
        return max(1.0 - self.damage, 1.0 if self.bond.whole_penalty else FLOOR)

    def _toughness(self, mix: float, gain: float = 1.0) -> float:
        """Energy of a mix of modes; that of sliding grows with the square of its strength."""
        first, second = self.bond.toughness
        return replace(self.bond, toughness=(first, second * gain**2)).toughness_of(mix)

    def _grow(self, load: float, mix: float, twice: float, gain: float) -> None:
        """Damage by the mode of the present separation."""
        toughness = self._toughness(mix, gain)
        ratio = 2.0 * toughness * load**2 / twice
        damage = min(1.0, ratio * (load - 1.0) / (load * (ratio - 1.0)))
        if damage > self.damage:
            left = ratio - self.damage * (ratio - 1.0)
            self.fracture += toughness * (damage - self.damage) * min(load, ratio) / left
            self.damage = damage

    def _grow_by_work(self, load: float, mix: float, twice: float) -> None:
        """Damage by the work of both modes: (1 - d) f = 1 - s - (d - d_old) f g / r.

        Where f reaches r first, or nothing is left, what is stored goes at once.
        """
        if self.damage >= 1.0:
            return
        done, lost, damage = float(self.works.sum()), 0.0, self.damage
        for _ in range(50):
            share = (self.works[1] + mix * lost) / (done + lost) if done + lost > 0.0 else mix
            toughness = self._toughness(share)
            ratio = 2.0 * toughness * load**2 / twice
            left = 1.0 - done / toughness
            slope = left / (1.0 - self.damage)
            if load <= slope:
                return
            part = slope / ratio
            if left <= 0.0 or part >= 1.0:
                damage, part = 1.0, (load if left <= 0.0 else slope) / ratio
                lost = toughness * (1.0 - self.damage) * ratio * part**2
                continue
            damage = min((load - left - self.damage * load * part) / (load * (1.0 - part)), 1.0)
            lost = toughness * (damage - self.damage) * min(load, ratio) * part
        self.damage = damage
        self.fracture += lost
        self.works = self.works + lost * np.array([1.0 - mix, mix])

    def _rub(self, jump: Array, before: float) -> None:
        """Coulomb's traction of the failed share, which newly failed area joins without friction.

        Work of the mean traction over the slip, which is what storage does not take.
        """
        first, stiff = self.bond.stiffness
        stiff *= 1.0 if self.bond.whole_penalty else FLOOR
        pressure = self._held() * first * max(-jump[2], 0.0)
        away = jump[:2] - self.slip
        full, share = float(np.linalg.norm(away)), before / self.damage
        carried = min(share * full, self.bond.friction * pressure / stiff)
        slid = (share * full - carried) * (carried + self.stretch) + (1.0 - share) * full * carried
        self.friction += 0.5 * self.damage * stiff * slid
        self.slip = jump[:2] - (carried / full if full > 0.0 else 0.0) * away
        self.stretch = carried
