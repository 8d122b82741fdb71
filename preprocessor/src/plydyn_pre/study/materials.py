"""Materials of plies and of what joins them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from plydyn_pre.errors import require, require_positive

_YOUNG_SHEAR = ("E1", "E2", "E3", "G12", "G13", "G23")
_POISSON = "must be above -1 and below 0.5"

Quadrature = Literal["gauss", "nodes"]


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
class PlyCodam2:
    """A ply whose fibres and matrix are damaged after nonlinear shear."""

    kind: ClassVar[str] = "ply_codam2"

    density: float  # mass per volume
    E1: float  # Young's moduli, stress: 1 along the fibres, 2 across in the plane, 3 normal
    E2: float
    E3: float
    nu12: float  # strain along the second direction from stress along the first
    nu13: float
    nu23: float
    G12: float  # shear moduli, stress
    G13: float
    G23: float
    XT: float  # strengths of fibres in tension and compression
    XC: float
    YT: float  # strengths of matrix in tension and compression
    YC: float
    SL: float  # shear strength in the plane 12
    G1T: float  # toughnesses of fibres, energy per area
    G1C: float
    G2T: float  # toughnesses of matrix
    G2C: float
    ST: float = 0.0  # shear strength in the plane 23, for matrix_compression = "hashin"
    G2S: float = 0.0  # toughness of matrix in shear; 0 for G2T or G2C
    largest_damage: float = 0.999999
    shear: Literal["linear", "exponential", "curve", "ramberg_osgood"] = "linear"
    shear_curve: str = ""  # name of a curve of stress over strain, for shear = "curve"
    shear_strain: float = 0.05  # at which an exponential curve reaches SL
    shear_coefficient: float = 0.0  # of Ramberg and Osgood
    shear_exponent: float = 0.0
    width: float = 0.0  # of the crack band, length; 0 for width_rule
    width_rule: Literal["band", "gauss_point", "root_point", "root_quad"] = "band"
    snap_back: Literal["reduce", "refuse", "drop"] = "reduce"
    snap_ratio: float = 1.05  # least ratio of the strains at the end and at onset of damage
    matrix_compression: Literal["quadratic", "hashin"] = "quadratic"
    onset: Literal["remaining", "intact"] = "remaining"  # whose stress starts damage
    closure: bool = False  # cracks close in compression, which has damage of its own
    plateau: float = 0.0  # share of XC that crushed fibres keep
    brittle: float = 0.0  # share of XC from which their stress drops to nothing
    weakens_across: bool = True  # damage weakens G13 and G23
    average_along: float = 0.0  # radii of the ellipse over which strains are averaged before they
    average_across: float = 0.0  # drive damage, along and across the fibres; 0 for no average
    title: str = ""

    def __post_init__(self) -> None:
        """Refuse numbers that no material has."""
        require_positive(self, "density", *_YOUNG_SHEAR, "XT", "XC", "YT", "YC", "SL")
        require_positive(self, "G1T", "G1C", "G2T", "G2C")
        has_curve = bool(self.shear_curve) == (self.shear == "curve")
        require(has_curve, "shear_curve", 'the name of a curve, for shear = "curve" only')
        hashin = self.matrix_compression == "hashin"
        require(self.ST > 0.0 or not hashin, "ST", 'needed for matrix_compression = "hashin"')
        require(min(self.plateau, self.brittle) <= 0.0, "brittle", "0 with a plateau")
        radii = (self.average_along, self.average_across)
        both = min(radii) > 0.0 or max(radii) == min(radii) == 0.0
        require(both, "average_across", "above zero as average_along is, or none of the two")
        require(not (self.closure and max(radii) > 0.0), "closure", "false with averages")


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
    quadrature: Quadrature = "gauss"  # where springs are: Gauss points or nodes
    title: str = ""

    def __post_init__(self) -> None:
        """Refuse numbers that no material has."""
        require_positive(self, "normal", "shear")


@dataclass(frozen=True)
class Cohesive:
    """A bond between two plies that softens and fails in opening, sliding and both."""

    kind: ClassVar[str] = "cohesive"

    normal: float  # traction per opening, stress per length
    shear: float  # traction per sliding, stress per length
    N: float  # strength in opening
    S: float  # strength in sliding
    GIC: float  # toughness in opening, energy per area
    GIIC: float  # toughness in sliding
    exponent: float = 1.634  # of the toughness of mixed modes
    mixing: Literal["benzeggagh_kenane", "power"] = "benzeggagh_kenane"
    quadrature: Quadrature = "gauss"  # where it is looked at: Gauss points or nodes
    closing: Literal["falling", "whole"] = "falling"  # stiffness against closing when damaged
    friction: float = 0.0  # coefficient, of failed faces
    fit: Literal["none", "stiffness", "strengths", "both"] = "none"  # constants that are fitted
    title: str = ""

    def __post_init__(self) -> None:
        """Refuse numbers that no material has."""
        require_positive(self, "normal", "shear", "N", "S", "GIC", "GIIC", "exponent")
        require(self.friction >= 0.0, "friction", f"{self.friction!r} must be zero or more")


Joint = Springs | Cohesive
Material = PlyElastic | PlyCodam2 | Elastic | PlasticKinematic | Springs | Cohesive
