"""What joins two plies."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from plydyn_pre.errors import require, require_between, require_not_negative, require_positive

#: Exponents of the toughness of mixed modes that the solver takes
_EXPONENTS = (0.1, 20.0)
#: Mixes of modes at which the law is looked at
_MIXES = 100
#: With a smaller modulus of Weibull, strengths vary by more than their half
_LEAST_SCATTER = 2.0

Quadrature = Literal["gauss", "nodes"]


def usually(words: str) -> dict[str, str]:
    """Metadata of a field: what is usually taken for it, which is told where it is missing."""
    return {"usual": words}


@dataclass(frozen=True)
class Springs:
    """Elastic springs between the faces of two plies."""

    kind: ClassVar[str] = "springs"

    normal: float  # traction per opening
    shear: float  # traction per sliding
    quadrature: Quadrature = "gauss"  # where springs are: Gauss points or nodes
    title: str = ""

    def __post_init__(self) -> None:
        """Refuse numbers that no material has."""
        require_positive(self, "normal", "shear")


@dataclass(frozen=True)
class Cohesive:
    """A bond between two plies that softens and fails in opening, sliding and both."""

    kind: ClassVar[str] = "cohesive"

    # traction per opening
    normal: float = field(metadata=usually("normal = 50 E3/thickness of a ply"))
    # traction per sliding
    shear: float = field(metadata=usually("shear = normal GIC/GIIC (S/N)^2"))
    N: float = field(metadata=usually("N = YT"))  # strength in opening
    S: float = field(metadata=usually("S = SL"))  # strength in sliding
    GIC: float  # toughness in opening, energy per area
    GIIC: float  # toughness in sliding
    exponent: float = 1.634  # of the toughness of mixed modes
    # law of the toughness in mixed mode
    mixing: Literal["benzeggagh_kenane", "power"] = "benzeggagh_kenane"
    quadrature: Quadrature = "gauss"  # where it is looked at: Gauss points or nodes
    closing: Literal["falling", "whole"] = "falling"  # stiffness against closing when damaged
    friction: float = 0.0  # coefficient, of failed faces
    # constants to fit; core: both strengths by one factor, modes: each by its own
    fit: Literal["none", "stiffness", "strengths", "both", "core", "modes"] = "none"
    mode_mix: Literal["opening", "work"] = "opening"  # present opening, or work so far
    pressure_gain: float = 0.0  # growth of the shear strength with the pressure
    scatter: float = 0.0  # modulus of Weibull of both strengths; 0 for none
    scatter_length: float = 0.0  # over which they are correlated
    seed: int = 0  # number of the realisation
    title: str = ""

    def __post_init__(self) -> None:
        """Refuse numbers that no material has."""
        require_positive(self, "normal", "shear", "N", "S", "GIC", "GIIC")
        require_not_negative(self, "friction", "pressure_gain")
        rule = f"{self.scatter:g} must be {_LEAST_SCATTER:g} or more, or 0"
        require(self.scatter == 0.0 or self.scatter >= _LEAST_SCATTER, "scatter", rule)
        require_not_negative(self, "seed")
        if self.scatters:
            require_positive(self, "scatter_length")
        require_between(self, *_EXPONENTS, "exponent")
        for name, strength, stiffness in (
            ("GIC", self.N, self.normal),
            ("GIIC", self.S, self.shear_stiffness),
        ):
            elastic = strength**2 / (2.0 * stiffness)
            rule = f"{getattr(self, name):g} must be above {elastic:g}, the elastic energy at onset"
            require(getattr(self, name) > elastic, name, rule)
        shares = [i / _MIXES for i in range(1, _MIXES)]
        rule = "some mix of modes has less toughness than elastic energy at onset"
        require(all(self.toughness(b) > self.elastic(b) for b in shares), "exponent", rule)

    @property
    def is_fitted_to_core(self) -> bool:
        """Whether strengths become those that the quads of the core of a coupon resolve."""
        return self.fit in ("core", "modes")

    @property
    def idle(self) -> tuple[str, ...]:
        """Keys that say something and have no effect, by what else is chosen."""
        keys = () if self.scatters else ("scatter_length", "seed")
        return tuple(key for key in keys if getattr(self, key))

    @property
    def scatters(self) -> bool:
        """Whether its strengths scatter from point to point."""
        return self.scatter > 0.0

    @property
    def shear_stiffness(self) -> float:
        """Traction per sliding, fitted where that is asked for."""
        if self.fit in ("stiffness", "both"):
            return self.normal * self.GIC / self.GIIC * (self.S / self.N) ** 2
        return self.shear

    def toughness(self, share: float) -> float:
        """Energy per area where sliding has a share of the energy."""
        if self.mixing == "benzeggagh_kenane":
            return self.GIC + (self.GIIC - self.GIC) * share**self.exponent
        parts = ((1.0 - share) / self.GIC, share / self.GIIC)
        largest = max(parts)
        powers = sum((part / largest) ** self.exponent for part in parts)
        return 1.0 / (largest * powers ** (1.0 / self.exponent))

    def elastic(self, share: float) -> float:
        """Elastic energy per area at onset where sliding has a share of the energy."""
        opening, sliding = self.normal / self.N**2, self.shear_stiffness / self.S**2
        return 0.5 / (opening * (1.0 - share) + sliding * share)


Joint = Springs | Cohesive
