"""Materials of plies and of what joins them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from plydyn_pre.errors import require, require_positive

_YOUNG_SHEAR = ("E1", "E2", "E3", "G12", "G13", "G23")
_POISSON = "must be above -1 and below 0.5"


@dataclass(frozen=True)
class PlyElastic:
    """An orthotropic elastic ply: 1 along the fibres, 2 across in the plane, 3 normal."""

    kind: ClassVar[str] = "ply_elastic"

    density: float  # mass per volume
    E1: float  # Young's moduli, stress
    E2: float
    E3: float
    nu12: float  # strain along the second direction from stress along the first
    nu13: float
    nu23: float
    G12: float  # shear moduli, stress
    G13: float
    G23: float
    title: str = ""

    def __post_init__(self) -> None:
        """Refuse numbers that no material has."""
        require_positive(self, "density", *_YOUNG_SHEAR)


@dataclass(frozen=True)
class Elastic:
    """An isotropic elastic ply."""

    kind: ClassVar[str] = "elastic"

    density: float  # mass per volume
    E: float  # Young's modulus, stress
    nu: float  # Poisson's ratio
    title: str = ""

    def __post_init__(self) -> None:
        """Refuse numbers that no material has."""
        require_positive(self, "density", "E")
        require(-1.0 < self.nu < 0.5, "nu", f"{self.nu:g} {_POISSON}")


@dataclass(frozen=True)
class PlasticKinematic:
    """A metal that yields by von Mises with linear hardening."""

    kind: ClassVar[str] = "plastic_kinematic"

    density: float  # mass per volume
    young: float  # Young's modulus, stress
    poisson: float  # Poisson's ratio
    yield_stress: float = field(metadata={"key": "yield"})
    tangent: float = 0.0  # slope of stress over strain beyond yield; 0 is perfect plasticity
    beta: float = 0.0  # share of hardening that is isotropic: 1 isotropic, 0 kinematic
    rate: float = 0.0  # at which the yield stress is doubled; 0 for no effect of the rate
    power: float = 0.0  # of the rise with the rate
    title: str = ""

    def __post_init__(self) -> None:
        """Refuse numbers that no material has."""
        require_positive(self, "density", "young")
        require(-1.0 < self.poisson < 0.5, "poisson", f"{self.poisson:g} {_POISSON}")
        require(self.yield_stress > 0.0, "yield", f"{self.yield_stress!r} must be above zero")
        between = f"{self.tangent!r} must be zero or more and below young"
        require(0.0 <= self.tangent < self.young, "tangent", between)
        require(0.0 <= self.beta <= 1.0, "beta", f"{self.beta!r} must be from 0 to 1")
        require(self.rate >= 0.0, "rate", f"{self.rate!r} must be zero or more")
        has_power = self.power > 0.0 if self.rate > 0.0 else self.power >= 0.0
        require(has_power, "power", f"{self.power!r} must be above zero where there is a rate")


@dataclass(frozen=True)
class Springs:
    """Elastic springs between the faces of two plies."""

    kind: ClassVar[str] = "springs"

    normal: float  # traction per opening, stress per length
    shear: float  # traction per sliding, stress per length
    title: str = ""

    def __post_init__(self) -> None:
        """Refuse numbers that no material has."""
        require_positive(self, "normal", "shear")


Material = PlyElastic | Elastic | PlasticKinematic | Springs
