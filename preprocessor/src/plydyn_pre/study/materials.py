"""Materials of plies and of what joins them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from plydyn_pre.errors import require, require_positive

_YOUNG_SHEAR = ("E1", "E2", "E3", "G12", "G13", "G23")


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
        require(-1.0 < self.nu < 0.5, "nu", f"{self.nu:g} must be above -1 and below 0.5")


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


Material = PlyElastic | Elastic | Springs
