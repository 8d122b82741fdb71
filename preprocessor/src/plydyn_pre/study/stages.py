"""Stages of a chain: what changes when a run goes on from the end of the one before."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Literal

from plydyn_pre.errors import require, require_between, require_not_negative, require_positive
from plydyn_pre.study.conditions import Contact, InitialVelocity, Lever, Load, Support
from plydyn_pre.study.control import Outputs, require_quasi_static
from plydyn_pre.study.fixtures import Fixture
from plydyn_pre.study.impactor import Impactor

#: Outputs that a restart does not change
_OF_FIRST = {"fields": "fields", "nodes": "nodes with a history", "profiles": "profiles"}


@dataclass(frozen=True)
class Stage:
    """A restart of the run with other supports, bodies and loads; times count from its start."""

    name: str  # of its deck, and of its results behind the name of the recipe
    end_time: float  # after its start, at the latest
    remove: tuple[Literal["impactor", "fixtures"], ...] = ()  # of the stages before
    at_rest: float = 0.0  # dynamic relaxation until this share of the largest kinetic energy
    damping: float | None = None  # force per mass and velocity; as before if absent
    mass_scaled_step: float | None = None  # as that of the control; as before if absent
    quasi_static: float | None = None  # warn above this kinetic over internal energy
    until_contact_ends: float = 0.0  # ends this time after the last contact; 0 for at end_time
    until_fall: float = 0.0  # ends where the load is below this share of its largest value
    supports: tuple[Support, ...] = ()  # these and the loads replace those before, if any are given
    loads: tuple[Load, ...] = ()
    fixtures: tuple[Fixture, ...] = ()
    impactor: Impactor | None = None
    contact: Contact | None = None
    outputs: Outputs = field(default_factory=Outputs)

    def __post_init__(self) -> None:
        """Refuse what is no stage."""
        rule = f"{self.name!r} must be letters, digits, - and _: it is part of the names of files"
        require(bool(re.fullmatch(r"[A-Za-z0-9_-]+", self.name)), "name", rule)
        require_positive(self, "end_time")
        require_not_negative(self, "until_contact_ends")
        require_between(self, 0.0, 1.0, "at_rest")
        rule = "every motion has this share of the largest kinetic energy; 1e-4 is usual"
        require(self.at_rest < 1.0, "at_rest", rule)
        if self.damping is not None:
            require_not_negative(self, "damping")
        if self.mass_scaled_step is not None:
            require_not_negative(self, "mass_scaled_step")
        require_quasi_static(self)
        hit = self.contact is None or self.impactor is not None
        require(hit, "contact", "needs an impactor of the stage")
        for name, what in _OF_FIRST.items():
            rule = f"{what} are those of the first run; leave it out of a stage"
            require(not getattr(self.outputs, name), f"outputs.{name}", rule)
        stays = not any(isinstance(load, Lever) for load in self.loads)
        require(stays, "loads", "a lever is there from the start; it belongs to the recipe's loads")
        starts = any(isinstance(load, InitialVelocity) for load in self.loads)
        rule = "a stage begins with the velocities of the one before; no initial_velocity"
        require(not starts, "loads", rule)


def check_stages(stages: tuple[Stage, ...], *, has_impactor: bool, has_fixtures: bool) -> None:
    """Refuse names that stand twice, and the removal of what is not there."""
    names = [stage.name for stage in stages]
    is_none = {"impactor": "is no impactor", "fixtures": "are no fixtures"}
    there = {"impactor": has_impactor, "fixtures": has_fixtures}
    for number, stage in enumerate(stages, start=1):
        path = f"stages[{number}]"
        require(names.count(stage.name) == 1, f"{path}.name", f"{stage.name!r} stands twice")
        for what in stage.remove:
            require(there[what], f"{path}.remove", f"there {is_none[what]} to remove")
            there[what] = False
        both = there["impactor"] and stage.impactor is not None
        require(not both, f"{path}.impactor", "the one before is still there; remove it")
        there["impactor"] |= stage.impactor is not None
        waits = stage.until_contact_ends > 0.0
        rule = "there is no impactor in this stage"
        require(there["impactor"] or not waits, f"{path}.until_contact_ends", rule)
        there["fixtures"] |= bool(stage.fixtures)
        asked = stage.outputs.fixture_interval is not None
        rule = "there are no fixtures in this stage"
        require(there["fixtures"] or not asked, f"{path}.outputs.fixture_interval", rule)
