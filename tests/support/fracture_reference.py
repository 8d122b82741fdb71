"""A point of a ply with planes of fracture, step by step, as section 4 of the theory has it.

Dense matrices, a search of all angles, and roots by bisection: no formulas of the solver.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from elasticity import Array, Material

#: Permanent shear: none, a curve by points, Ramberg and Osgood, linear hardening
ELASTIC, POINTS, POWER, HARDENING = 0, 2, 3, 4
#: Permanent strain below which a power curve and one by points are elastic
NEGLECTED = 1.0e-6
SNAP = 1.05


@dataclass(frozen=True)
class FracturePly(Material):
    """A ply as *MAT_PLY_FRACTURE_3D has it."""

    fibre_strength: tuple[float, float]
    matrix_strength: tuple[float, float]
    shear_strength: float
    fibre_toughness: tuple[float, float]
    matrix_toughness: tuple[float, float]  # opened, sheared
    angle: float = 53.0
    band: float = 0.0
    largest: float = 0.999
    exponent: float = 1.45
    shear_curve: tuple[float, ...] = (0,)  # SHEAR ALPHA N SP KP
    points: tuple[tuple[float, float], ...] = ()  # strain and stress 12, for SHEAR 2
    friction: float = 0.0
    plateau: float = 0.0
    crush: float = 0.0
    debris: tuple[float, float] = (0.0, 0.0)  # limit, share
    lines: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)  # FXT FGXT FXC FGXC

    def cards(self, number: int, curve: int = 0) -> list[tuple[float, ...]]:
        """Cards of the material with this number, with the number of its curve of shear."""
        return [
            (number, self.density, *self.young, *self.poisson),
            self.shear,
            (*self.fibre_strength, *self.matrix_strength, self.shear_strength, self.angle),
            (
                *self.fibre_toughness,
                *self.matrix_toughness,
                self.band,
                self.largest,
                self.exponent,
            ),
            (*(*self.shear_curve, 0, 0, 0, 0)[:5], curve),
            (self.friction, self.plateau, 0, self.crush, *self.debris),
            self.lines,
        ]

    @property
    def across(self) -> float:
        """Shear strength across the fibres."""
        alpha = np.radians(self.angle)
        return float(
            self.matrix_strength[1]
            * np.cos(alpha)
            * (np.sin(alpha) + np.cos(alpha) / np.tan(2.0 * alpha))
        )

    @property
    def neglected(self) -> float:
        """Permanent strain that is neglected on a curve that begins without an elastic line."""
        strain, stress = self.points[1]
        return NEGLECTED if stress < (1.0 - 1.0e-9) * self.shear[0] * strain else 0.0

    def yield_stress(self, left: float) -> float:
        """Stress 12 of a curve by points that has left this permanent strain."""
        total, stress = np.array(self.points).T
        permanent = total - stress / self.shear[0]
        last = (stress[-1] - stress[-2]) / (permanent[-1] - permanent[-2])
        beyond = max(left - permanent[-1], 0.0)
        return float(np.interp(left, permanent, stress) + last * beyond)

    def stiffness(self, left: float = 1.0, sheared: float | None = None) -> Array:
        """Stiffness with this share of E1, and of G12 and G13."""
        sheared = left if sheared is None else sheared
        (e1, e2, e3), (n12, n13, n23), (g12, g13, g23) = self.young, self.poisson, self.shear
        compliance = np.diag(
            [1 / (left * e1), 1 / e2, 1 / e3, 1 / (sheared * g12), 1 / (sheared * g13), 1 / g23]
        )
        for i, j, value in ((0, 1, -n12 / e1), (0, 2, -n13 / e1), (1, 2, -n23 / e2)):
            compliance[i, j] = compliance[j, i] = value
        return np.linalg.inv(compliance)


# IM7/8552 of 134 g/m2, in mm, s, t
IM7 = FracturePly(
    density=1.58e-9,
    young=(171.42e3, 9.08e3, 9.08e3),
    poisson=(0.32, 0.32, 0.45),
    shear=(5.29e3, 5.29e3, 3.131e3),
    fibre_strength=(2326.2, 1200.1),
    matrix_strength=(62.3, 199.8),
    shear_strength=92.3,
    fibre_toughness=(97.8, 106.3),
    matrix_toughness=(0.277, 0.788),
    exponent=1.634,
    shear_curve=(HARDENING, 0, 0, 66.9, 0.05),
    friction=0.3,
)

# T700/M21: stress = 37833 g^3 - 16512 g^2 + 2334.3 g of twice the strain g, every half hundredth
SHEAR_CURVE = tuple(
    (0.5 * g, round(37833.0 * g**3 - 16512.0 * g**2 + 2334.3 * g, 2))
    for g in (0.01 * i for i in range(11))
)


def normals(angle: float) -> Array:
    """Strains of unit slips of a plane: opening, across the fibres, along them, (6, 3)."""
    c, s = np.cos(angle), np.sin(angle)
    n, t, along = np.array([0, c, s]), np.array([0, -s, c]), np.array([1.0, 0, 0])
    columns = []
    for jump in (n, t, along):
        strain = 0.5 * (np.outer(jump, n) + np.outer(n, jump))
        shear = [2.0 * strain[0, 1], 2.0 * strain[0, 2], 2.0 * strain[1, 2]]
        columns.append([*np.diag(strain), *shear])
    return np.array(columns).T


@dataclass
class Fibres:
    """Damage of fibres in tension or in compression, and the ends of its two laws."""

    damage: float = 0.0
    onset: float = 0.0
    ends: tuple[float, float] = (0.0, 0.0)

    def left(self, shares: tuple[float, float], size: float) -> float:
        """Stress over the strength at a strain beyond onset: the sum of two laws."""
        laws = zip((shares[0], 1.0 - shares[0]), self.ends, strict=True)
        return sum(
            share * max(end - size, 0.0) / (end - self.onset) for share, end in laws if share > 0.0
        )


@dataclass
class FracturePoint:
    """A point with its history; strain and stress 11, 22, 33, 12, 13, 23."""

    ply: FracturePly
    permanent: Array = field(default_factory=lambda: np.zeros(6))
    summed: Array = field(default_factory=lambda: np.zeros(3))
    fibres: tuple[Fibres, Fibres] = field(default_factory=lambda: (Fibres(), Fibres()))
    last: Array = field(default_factory=lambda: np.zeros(6))
    plane: float | None = None
    damage: float = 0.0
    slip: Array = field(default_factory=lambda: np.zeros(3))
    held: float = 0.0

    def step(self, strain: Array) -> Array:
        """Stress at the next strain of the path."""
        self.last = self._stress(strain)
        return self.last

    def _stress(self, strain: Array) -> Array:
        """Stress, and all that happens to the point."""
        self._shear(strain)
        self._crush(strain)
        elastic = strain - self.permanent
        pressed = self._break_fibres(elastic)
        sheared = 1.0 - max(mode.damage for mode in self.fibres)
        stiffness = self.ply.stiffness(1.0 - self.fibres[1].damage if pressed else sheared, sheared)
        stress = stiffness @ elastic
        if self.plane is None:
            self._find_plane(stress, stiffness)
        if self.plane is None:
            return stress
        unit = normals(self.plane)
        traction, rigid = unit.T @ stress, unit.T @ stiffness @ unit
        driver, softening = self._drive(traction, rigid)
        if driver > 1.0:
            damage = softening * (driver - 1.0) / (driver * (softening - 1.0))
            self.damage = max(self.damage, min(damage, self.ply.largest))
        self._slide(traction, rigid)
        return stiffness @ (elastic - self.damage * unit @ self.slip)

    def _shear(self, strain: Array) -> None:
        """Permanent shear, component by component, until there is a plane."""
        kind, alpha, exponent, first, hardening = (*self.ply.shear_curve, 0, 0, 0, 0)[:5]
        if kind == ELASTIC or self.plane is not None:
            return
        for k in range(3):
            ratio = self.ply.across / self.ply.shear_strength if k == 2 else 1.0
            modulus = self.ply.shear[k]
            trial = modulus * (strain[3 + k] - self.permanent[3 + k])

            def yields(summed: float, ratio: float = ratio) -> float:
                if kind == POINTS:
                    return ratio * self.ply.yield_stress(summed + self.ply.neglected)
                if kind == POWER:
                    return ratio * ((summed + NEGLECTED) / alpha) ** (1.0 / exponent)
                return ratio * (first + hardening * self.ply.shear[0] * summed)

            summed = self.summed[k]
            if abs(trial) <= yields(summed):
                continue
            grown = brentq(
                lambda g, s=summed, t=trial, m=modulus, y=yields: abs(t) - m * g - y(s + g),
                0.0,
                abs(trial) / modulus,
                xtol=1e-16,
                rtol=1e-14,
            )
            self.summed[k] += grown
            self.permanent[3 + k] += np.copysign(grown, trial)

    def _crush(self, strain: Array) -> None:
        """Permanent strain through the thickness under too much pressure."""
        if self.ply.crush == 0.0:
            return
        stiffness = self.ply.stiffness()
        over = -(stiffness @ (strain - self.permanent))[2] - self.ply.crush
        if over > 0.0:
            self.permanent[2] -= over / stiffness[2, 2]

    def _break_fibres(self, elastic: Array) -> bool:
        """Damage of fibres by the sign of their stress, and whether they are pressed."""
        ply, size = self.ply, abs(elastic[0])
        stress = (ply.stiffness() @ elastic)[0]
        sense = int(stress < 0.0)
        share, energy = ply.lines[2 * sense : 2 * sense + 2]
        parts = [(energy, share), (1.0 - energy, 1.0 - share)]
        reaches = [part / strong if strong > 0.0 else 1.0 for part, strong in parts]
        toughness = ply.fibre_toughness[sense]
        steep = toughness * min(reaches)
        strength = min(
            ply.fibre_strength[sense], np.sqrt(2.0 * ply.young[0] * steep / (SNAP * ply.band))
        )
        mode = self.fibres[sense]
        if mode.onset == 0.0 and abs(stress) >= strength:
            mode.onset = size * strength / abs(stress)
            single = 2.0 * toughness / (ply.band * strength)
            mode.ends = tuple(max(reach * single, SNAP * mode.onset) for reach in reaches)
        sideways = ply.poisson[0] * self.last[1] + ply.poisson[1] * self.last[2]
        pressed = bool(elastic[0] + sideways / ply.young[0] < 0.0)
        mode = self.fibres[pressed]
        if 0.0 < mode.onset < size:
            shares = ply.lines[2 * pressed : 2 * pressed + 2]
            rest = max(mode.left(shares, size), ply.plateau if pressed else 0.0)
            mode.damage = max(mode.damage, min(1.0 - rest * mode.onset / size, ply.largest))
        return pressed

    def _exposure(self, traction: Array) -> float:
        """Tractions over those of onset on the same ray: the root of the criterion along it."""
        tension, compression = self.ply.matrix_strength
        across, alpha = self.ply.across, np.radians(self.ply.angle)
        n, t, along = traction
        if n <= 0.0:
            gain = -np.cos(2.0 * alpha) / (compression * np.cos(alpha) ** 2)
            return max(float(np.hypot(t / across, along / self.ply.shear_strength) + gain * n), 0.0)
        # (n^2 + t^2)/ST^2 + kappa n/ST = 1 on the ray
        kappa = (across**2 - tension**2) / (across * tension)
        a, b = (n * n + t * t) / across**2, kappa * n / across
        root = 0.5 * (b + np.sqrt(b * b + 4.0 * a))
        return float(np.hypot(root, along / self.ply.shear_strength))

    def _find_plane(self, stress: Array, stiffness: Array) -> None:
        """The most exposed plane, where it cracks."""

        def exposed(angle: float) -> float:
            return self._exposure(normals(angle).T @ stress)

        angles = np.radians(np.arange(-90.0, 90.0, 15.0))
        best = angles[np.argmax([exposed(angle) for angle in angles])]
        width = np.radians(15.0)
        found = minimize_scalar(
            lambda angle: -exposed(angle),
            bounds=(best - width, best + width),
            method="bounded",
            options={"xatol": 1e-9},
        )
        angle = float(found.x)
        if exposed(angle) < exposed(best):
            angle = best
        unit = normals(angle)
        if self._drive(unit.T @ stress, unit.T @ stiffness @ unit)[0] >= 1.0:
            self.plane = angle

    def _drive(self, traction: Array, rigid: Array) -> tuple[float, float]:
        """Exposure, and the ratio of tractions at the end of softening to those of onset."""
        sheared = float(traction[1] ** 2 / rigid[1, 1] + traction[2] ** 2 / rigid[2, 2])
        normal = float(traction[0] - rigid[0, 1] * traction[1] / rigid[1, 1])
        if normal > 0.0:
            energy = float(traction @ np.linalg.solve(rigid, traction))
            share = min(sheared / energy, 1.0)
        else:
            size = float(np.hypot(traction[1], traction[2]))
            beyond = max(size + self.ply.friction * normal, 0.0)
            energy = (beyond / size) ** 2 * sheared if size > 0.0 else 0.0
            share = 1.0
        first, second = self.ply.matrix_toughness
        toughness = first + (second - first) * share**self.ply.exponent
        whole = self.ply.stiffness()
        ratio = SNAP * max(whole[1, 1] / self.ply.young[1], whole[2, 2] / self.ply.young[2])
        spent = max(0.5 * self.ply.band * energy / toughness, 1.0e-30)
        driver = max(self._exposure(traction), np.sqrt(ratio * spent))
        return driver, driver**2 / spent

    def _slide(self, traction: Array, rigid: Array) -> None:
        """Slip of the cracked share, open or closed."""
        open_slip = np.linalg.solve(rigid, traction)
        if open_slip[0] > self.held:
            limit, share = self.ply.debris
            self.held = max(self.held, min(share * open_slip[0], limit))
            self.slip = open_slip
            return
        stuck = np.array([self.held, self.slip[1], self.slip[2]])
        contact = traction - rigid @ stuck
        borne = self.ply.friction * max(-contact[0], 0.0)
        size = float(np.hypot(contact[1], contact[2]))
        kept = contact[1:] * (min(borne / size, 1.0) if size > 0.0 else 1.0)
        block = rigid[1:, 1:]
        stuck[1:] = np.linalg.solve(block, traction[1:] - rigid[1:, 0] * self.held - kept)
        self.slip = stuck
