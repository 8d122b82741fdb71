"""Materials of plies and of what joins them."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import prod, sqrt
from typing import ClassVar, Literal

from plydyn_pre.errors import require, require_between, require_not_negative, require_positive
from plydyn_pre.study.joints import Cohesive, Springs, usually

_YOUNG_SHEAR = ("E1", "E2", "E3", "G12", "G13", "G23")
#: Moduli over strengths at least
_FAR_BELOW = 20.0
_POISSON = "must be above -1 and below 0.5"
#: Largest damage: the solver keeps a share of the stiffness
_MOST_DAMAGE = 0.999999
#: Share of XC that crushed fibres keep
_MOST_CRUSHED = 0.99


@dataclass(frozen=True)
class _Orthotropic:
    """What every ply has: density and elastic constants."""

    density: float  # mass per volume
    E1: float  # Young's moduli, stress: 1 along the fibres, 2 across in the plane, 3 normal
    E2: float
    E3: float = field(metadata=usually("E3 = E2"))
    nu12: float  # strain along the second direction from stress along the first
    nu13: float = field(metadata=usually("nu13 = nu12"))
    nu23: float = field(metadata=usually("nu23 = 0.4 to 0.5"))
    G12: float  # shear moduli, stress
    G13: float = field(metadata=usually("G13 = G12"))
    G23: float = field(metadata=usually("G23 = E2/(2 (1 + nu23))"))


@dataclass(frozen=True)
class PlyElastic(_Orthotropic):
    """An orthotropic elastic ply: 1 along the fibres, 2 across in the plane, 3 normal."""

    kind: ClassVar[str] = "ply_elastic"

    title: str = ""

    def __post_init__(self) -> None:
        """Refuse numbers that no material has."""
        require_positive(self, "density", *_YOUNG_SHEAR)
        require_stable(self)


@dataclass(frozen=True)
class PlyCodam2(_Orthotropic):
    """A ply whose fibres and matrix are damaged after nonlinear shear."""

    kind: ClassVar[str] = "ply_codam2"

    XT: float  # strengths of fibres in tension and compression
    XC: float
    YT: float  # strengths of matrix in tension and compression
    YC: float
    SL: float  # shear strength in the plane 12
    # toughnesses of fibres, energy per area
    G1T: float = field(metadata=usually("G1T of a similar ply"))
    G1C: float = field(metadata=usually("G1C of a similar ply"))
    G2T: float = field(metadata=usually("G2T = GIC of the interfaces"))  # toughnesses of matrix
    G2C: float = field(metadata=usually("G2C = GIIC/cos 53"))
    ST: float = 0.0  # shear strength in the plane 23, for matrix_compression = "hashin"
    G2S: float = 0.0  # toughness of matrix in shear; 0 for G2T or G2C
    largest_damage: float = 0.999  # the rest keeps points below an impactor from coming loose
    # shear 12 until the matrix cracks
    shear: Literal["linear", "exponential", "curve", "ramberg_osgood"] = "linear"
    shear_curve: str = ""  # name of a curve of stress over strain, for shear = "curve"
    shear_strain: float = 0.05  # at which an exponential curve reaches SL
    shear_coefficient: float = 0.0  # of Ramberg and Osgood
    shear_exponent: float = 0.0
    width: float = 0.0  # of the crack band, length; 0 for width_rule
    # without a width: "band" a share of the length of the quad along the direction, "gauss_point"
    # the length of the Gauss point along it, "root_point" and "root_quad" roots of their areas
    width_rule: Literal["band", "gauss_point", "root_point", "root_quad"] = "band"
    # where the band is too wide for the toughness: damage starts below the strength, an error, or
    # the stress drops at once
    snap_back: Literal["reduce", "refuse", "drop"] = "reduce"
    snap_ratio: float = 1.05  # least ratio of the strains at the end and at onset of damage
    # criterion of matrix damage in compression
    matrix_compression: Literal["quadratic", "hashin"] = "quadratic"
    closure: bool = True  # cracks close in compression, but never with averages
    plateau: float = 0.0  # share of XC that crushed fibres keep
    weakens_across: bool = False  # damage weakens G13 and G23
    average_along: float = 0.0  # radii of the ellipse over which strains are averaged before they
    average_across: float = 0.0  # drive damage, along and across the fibres; 0 for no average
    FXT: float = 1.0  # share of XT in one of two laws by which fibres soften; 1 for one line
    FGXT: float = 1.0  # share of G1T in that law
    FXC: float = 1.0  # and of XC and G1C in compression
    FGXC: float = 1.0
    GIC: float = 0.0  # toughnesses of cracks through a ply, for in-situ strengths, in opening
    GIIC: float = 0.0  # and in shear; 0 for G2T and G2S
    cubic: float = 0.0  # coefficient of stress**3 in the shear strain, for in-situ strengths
    title: str = ""

    def __post_init__(self) -> None:
        """Refuse numbers that no material has."""
        require_positive(self, "density", *_YOUNG_SHEAR, "XT", "XC", "YT", "YC", "SL")
        require_positive(self, "G1T", "G1C", "G2T", "G2C")
        require_stable(self)
        require_not_negative(self, "ST", "G2S", "width", "average_along", "average_across")
        require_not_negative(self, "GIC", "GIIC", "cubic")
        above = 0.0 < self.largest_damage <= _MOST_DAMAGE
        rule = f"{self.largest_damage!r} must be above 0 and at most {_MOST_DAMAGE}"
        require(above, "largest_damage", rule)
        rule = f"{self.snap_ratio!r} must be 1 or more"
        require(self.snap_ratio >= 1.0, "snap_ratio", rule)
        require_between(self, 0.0, _MOST_CRUSHED, "plateau")
        require_strengths_below_moduli(self)
        self._check_shear()
        hashin = self.matrix_compression == "hashin"
        require(self.ST > 0.0 or not hashin, "ST", 'needed for matrix_compression = "hashin"')
        radii = (self.average_along, self.average_across)
        both = min(radii) > 0.0 or max(radii) == min(radii) == 0.0
        require(both, "average_across", "above zero as average_along is, or none of the two")
        require_line_shares(self)

    def _check_shear(self) -> None:
        """Refuse a curve of shear that cannot be."""
        require_curve(self)
        require_not_negative(self, "shear_coefficient", "shear_exponent")
        require_positive(self, "shear_strain")
        least = self.SL / self.G12
        rule = f"{self.shear_strain!r} must be above SL/G12 = {least:g}"
        reached = self.shear != "exponential" or self.shear_strain > least
        require(reached, "shear_strain", rule)
        if self.shear == "ramberg_osgood":
            require_positive(self, "shear_coefficient")
            rule = f"{self.shear_exponent!r} must be above 1"
            require(self.shear_exponent > 1.0, "shear_exponent", rule)

    @property
    def closes(self) -> bool:
        """Whether cracks close."""
        return self.closure and self.average_along <= 0.0

    @property
    def idle(self) -> tuple[str, ...]:
        """Keys that say something and have no effect, by what else is chosen."""
        power = self.shear == "ramberg_osgood"
        without = {
            "shear_strain": self.shear != "exponential" and self.shear_strain != 0.05,
            "shear_coefficient": not power and self.shear_coefficient > 0.0,
            "shear_exponent": not power and self.shear_exponent > 0.0,
            "width_rule": self.width > 0.0 and self.width_rule != "band",
            "ST": self.matrix_compression != "hashin" and self.ST > 0.0,
        }
        return tuple(name for name, has_none in without.items() if has_none)


@dataclass(frozen=True)
class PlyFracture3d(_Orthotropic):
    """A ply whose matrix cracks on planes of fracture, with friction and permanent strain."""

    kind: ClassVar[str] = "ply_fracture_3d"

    XT: float  # strengths of fibres in tension and compression
    XC: float
    YT: float  # strengths of matrix in tension and compression
    YC: float
    SL: float  # shear strength along the fibres
    # toughnesses of fibres, energy per area
    G1T: float = field(metadata=usually("G1T of a similar ply"))
    G1C: float = field(metadata=usually("G1C of a similar ply"))
    # toughness of opened matrix cracks
    G2T: float = field(metadata=usually("G2T = GIC of the interfaces"))
    G2S: float = field(metadata=usually("G2S = GIIC of the interfaces"))  # and of sheared ones
    fracture_angle: float = 53.0  # degrees, of the plane of fracture in compression across
    mode_exponent: float = 1.45  # of Benzeggagh and Kenane, between G2T and G2S
    largest_damage: float = 0.999  # the rest keeps points below an impactor from coming loose
    # permanent shear
    shear: Literal["linear", "curve", "ramberg_osgood", "hardening"] = "linear"
    shear_curve: str = ""  # name of a curve of stress over total strain, for shear = "curve"
    shear_coefficient: float = 0.0  # of Ramberg and Osgood
    shear_exponent: float = 0.0
    shear_yield: float = 0.0  # stress 12 of first yield, for shear = "hardening"
    shear_hardening: float = 0.0  # slope over the permanent strain, as a share of G12
    friction: float = 0.0  # of closed cracks
    width: float = 0.0  # of the crack band, length; 0 for width_rule
    # without a width: "band" a share of the length of the quad along the direction, "gauss_point"
    # the length of the Gauss point along it, "root_point" and "root_quad" roots of their areas
    width_rule: Literal["band", "gauss_point", "root_point", "root_quad"] = "band"
    plateau: float = 0.0  # share of XC that crushed fibres keep
    FXT: float = 1.0  # share of XT in one of two laws by which fibres soften; 1 for one line
    FGXT: float = 1.0  # share of G1T in that law
    FXC: float = 1.0  # and of XC and G1C in compression
    FGXC: float = 1.0
    crush_stress: float = 0.0  # pressure that crushes through the thickness; 0 for none
    debris_limit: float = 0.0  # largest opening of cracks, a strain, that debris holds; fitted
    debris_share: float = 0.0  # share of the largest opening that it holds; fitted
    title: str = ""

    def __post_init__(self) -> None:
        """Refuse numbers that no material has."""
        require_positive(self, "density", *_YOUNG_SHEAR, "XT", "XC", "YT", "YC", "SL")
        require_positive(self, "G1T", "G1C", "G2T", "G2S", "mode_exponent")
        require_stable(self)
        require_not_negative(self, "width", "crush_stress", "debris_limit")
        require_between(self, 0.0, 1.0, "friction", "debris_share")
        require_between(self, 0.0, _MOST_CRUSHED, "plateau")
        above = 0.0 < self.largest_damage <= _MOST_DAMAGE
        rule = f"{self.largest_damage!r} must be above 0 and at most {_MOST_DAMAGE}"
        require(above, "largest_damage", rule)
        rule = f"{self.fracture_angle!r} must be above 45 and at most 60 degrees"
        require(45.0 < self.fracture_angle <= 60.0, "fracture_angle", rule)
        both = (self.debris_limit > 0.0) == (self.debris_share > 0.0)
        require(both, "debris_share", "above zero as debris_limit is, or none of the two")
        require_line_shares(self)
        require_strengths_below_moduli(self)
        self._check_shear()

    def _check_shear(self) -> None:
        """Refuse constants of permanent shear that cannot be."""
        require_curve(self)
        require_not_negative(self, "shear_coefficient", "shear_exponent")
        require_not_negative(self, "shear_yield", "shear_hardening")
        if self.shear == "ramberg_osgood":
            require_positive(self, "shear_coefficient")
            rule = f"{self.shear_exponent!r} must be above 1"
            require(self.shear_exponent > 1.0, "shear_exponent", rule)
        if self.shear == "hardening":
            require_positive(self, "shear_yield", "shear_hardening")
            rule = f"{self.shear_yield!r} must be below SL = {self.SL:g}"
            require(self.shear_yield < self.SL, "shear_yield", rule)

    @property
    def idle(self) -> tuple[str, ...]:
        """Keys that say something and have no effect, by what else is chosen."""
        without = {
            "shear_coefficient": self.shear != "ramberg_osgood",
            "shear_exponent": self.shear != "ramberg_osgood",
            "shear_yield": self.shear != "hardening",
            "shear_hardening": self.shear != "hardening",
        }
        idle = [name for name, has_none in without.items() if has_none and getattr(self, name) > 0]
        if self.width > 0.0 and self.width_rule != "band":
            idle.append("width_rule")
        return tuple(idle)


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
    yield_stress: float = field(metadata={"key": "yield"})  # in tension
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
        require_not_negative(self, "rate", "power")
        has_power = self.rate <= 0.0 or self.power > 0.0
        require(has_power, "power", f"{self.power!r} must be above zero where there is a rate")


def require_stable(ply: _Orthotropic) -> None:
    """Refuse Poisson's ratios with which some strain would give energy."""
    shares = []
    for first, second in ((1, 2), (1, 3), (2, 3)):
        name = f"nu{first}{second}"
        bound = sqrt(getattr(ply, f"E{first}") / getattr(ply, f"E{second}"))
        value = getattr(ply, name)
        rule = f"{value:g} must be less than sqrt(E{first}/E{second}) = {bound:g} in size"
        require(abs(value) < bound, name, rule)
        shares.append(value / bound)
    determinant = 1.0 - sum(share**2 for share in shares) - 2.0 * prod(shares)
    rule = "the three Poisson's ratios together are too large for these moduli"
    require(determinant > 0.0, "nu23", rule)


def require_curve(ply: PlyCodam2 | PlyFracture3d) -> None:
    """Refuse a curve of shear without its name, and a name without its curve."""
    has_curve = bool(ply.shear_curve) == (ply.shear == "curve")
    require(has_curve, "shear_curve", 'the name of a curve, for shear = "curve" only')


def require_line_shares(ply: PlyCodam2 | PlyFracture3d) -> None:
    """Refuse shares that leave a law of fibres without strength or energy."""
    for share, energy in (("FXT", "FGXT"), ("FXC", "FGXC")):
        for name in (share, energy):
            value = getattr(ply, name)
            require(0.0 < value <= 1.0, name, f"{value!r} must be above 0 and at most 1")
        both = (getattr(ply, share) < 1.0) == (getattr(ply, energy) < 1.0)
        require(both, energy, f"below 1 as {share} is, or 1 in both for one line")
    rule = "1 with a plateau, with which crushed fibres soften on one line"
    require(ply.plateau <= 0.0 or ply.FXC >= 1.0, "FXC", rule)


def require_strengths_below_moduli(ply: PlyCodam2 | PlyFracture3d) -> None:
    """Refuse strengths in other units than the moduli."""
    for names, modulus in ((("XT", "XC"), "E1"), (("YT", "YC"), "E2"), (("SL",), "G12")):
        for name in names:
            value, limit = getattr(ply, name), getattr(ply, modulus)
            thousand = 1.0e3 * limit > _FAR_BELOW * value
            hint = f"; is {modulus} in GPa, and {name} in MPa?" if thousand else ""
            rule = f"{value:g} must be far below {modulus} = {limit:g}, in the same unit{hint}"
            require(value < limit, name, rule)


Material = PlyElastic | PlyCodam2 | PlyFracture3d | Elastic | PlasticKinematic | Springs | Cohesive
