"""How to run, and what to write."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol

from plydyn_pre.errors import (
    require,
    require_between,
    require_not_negative,
    require_positive,
)

#: Points of a profile in a numerical layer
_MOST_POINTS = 100

_INTERVALS = ("field", "energy", "impactor", "node", "support", "delamination", "fixture")

Quantity = Literal[
    "displacement",
    "velocity",
    "stress",
    "strain",
    "stress_ply",
    "strain_ply",
    "plastic_strain",
    "damage_fibre",
    "damage_matrix",
    "damage_shear",
    "dissipated",
]


@dataclass(frozen=True)
class Units:
    """Names of the units of all numbers of a study; nothing is converted."""

    # units of all numbers
    length: Literal["m", "mm", "cm", "um", "in", "ft"] = "mm"
    time: Literal["s", "ms", "us"] = "s"  # unit of time
    mass: Literal["kg", "g", "mg", "t", "slinch", "slug"] = "t"  # unit of mass


@dataclass(frozen=True)
class Control:
    """Time, step, strain measure, limits."""

    end_time: float  # time at which the run ends
    # strain measure: small strain as in the source paper, or large displacement
    kinematics: Literal["linear", "total_lagrangian"] = "total_lagrangian"
    # what is implicit: nothing, springs between plies, or the whole thickness direction
    scheme: Literal["explicit", "implicit_interfaces", "implicit_thickness"] = "explicit"
    largest_step: float = 0.0  # time; 0 for none
    step_factor: float = 0.0  # share of the stable step; 0 for the usual one (TSSFAC)
    first_step: float = 0.0  # time; 0 for the stable one
    mass_scaled_step: float = 0.0  # mass is added where the stable step is smaller; 0 for none
    smallest_step: float = 0.0  # share of the first step at which the run stops; 0 for none
    step_curve: str = ""  # name of a curve of the largest step over time
    end_cycle: int = 0  # 0 for none
    until_contact_ends: float = 0.0  # ends this time after the last contact; 0 for at end_time
    quasi_static: float | None = None  # warn above this kinetic over internal energy
    until_fall: float = 0.0  # ends where the load is below this share of its largest value
    damping: float = 0.0  # force per mass and velocity, 1 / time
    energy_limit: float = 0.05  # share by which the energy balance may be off
    check_only: bool = False  # check the deck and stop

    def __post_init__(self) -> None:
        """Refuse what cannot be run."""
        require_positive(self, "end_time", "energy_limit")
        require_between(self, 0.0, 1.0, "step_factor", "smallest_step")
        require_not_negative(self, "first_step", "largest_step", "damping", "end_cycle")
        require_not_negative(self, "mass_scaled_step", "until_contact_ends")
        require_quasi_static(self)


class Watched(Protocol):
    """A run or a stage whose energies and load are watched."""

    @property
    def quasi_static(self) -> float | None:
        """Largest kinetic over internal energy without a warning."""

    @property
    def until_fall(self) -> float:
        """Share of the largest load below which the run ends."""


def require_quasi_static(run: Watched) -> None:
    """Refuse what a run or a stage cannot watch of its energies and its load."""
    if run.quasi_static is not None:
        require_between(run, 0.0, 1.0, "quasi_static")
    require_between(run, 0.0, 1.0, "until_fall")
    watched = run.until_fall == 0.0 or run.quasi_static is not None
    require(watched, "until_fall", "needs quasi_static, which may be 0")


@dataclass(frozen=True)
class Profile:
    """Stress through the thickness at a place of the plane."""

    at: tuple[float, float]  # x, y
    interval: float = 0.0  # time between two profiles; 0 for every step
    points: int = 5  # in each numerical layer, both faces included

    def __post_init__(self) -> None:
        """Refuse what cannot be written."""
        require_between(self, 2, _MOST_POINTS, "points")
        require_not_negative(self, "interval")


@dataclass(frozen=True)
class Outputs:
    """What to write, and the time between; what is absent is left to the solver."""

    field_interval: float | None = None  # states of fields
    fields: tuple[Quantity, ...] | None = None  # which ones
    energy_interval: float | None = None  # rows of energies
    impactor_interval: float | None = None  # rows of impactors and contact
    node_interval: float | None = None  # motion of the nodes
    nodes: tuple[str, ...] = ()  # names of node sets with a history
    support_interval: float | None = None  # support forces; none if absent
    delamination_interval: float | None = None  # delaminated areas
    fixture_interval: float | None = None  # forces of fixtures
    restart_steps: int | None = None  # between two restart files, which replace each other
    profiles: tuple[Profile, ...] = ()

    def __post_init__(self) -> None:
        """Refuse what cannot be written."""
        for name in _INTERVALS:
            value = getattr(self, f"{name}_interval")
            rule = f"{value!r} must be above zero; leave it out for the solver's own"
            require(value is None or value > 0.0, f"{name}_interval", rule)
        rule = f"{self.restart_steps!r} must be above zero; leave it out for no restart files"
        require(self.restart_steps is None or self.restart_steps > 0, "restart_steps", rule)
        rule = "empty; name a field, or leave the key out for the solver's own"
        require(self.fields is None or len(self.fields) > 0, "fields", rule)
        both = bool(self.nodes) or self.node_interval is None
        require(both, "nodes", 'missing; name the node sets, such as nodes = ["centre"]')
