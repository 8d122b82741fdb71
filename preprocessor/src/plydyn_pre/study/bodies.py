"""The bodies of a recipe, run by run of its chain."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from plydyn_pre.study.conditions import Contact, Lever, Motion
from plydyn_pre.study.fixtures import Fixture
from plydyn_pre.study.impactor import Impactor
from plydyn_pre.study.stages import Stage
from plydyn_pre.study.study import Study


@dataclass(frozen=True)
class Run:
    """What is there in the first run of a chain, or in a stage, each with its key."""

    path: str  # of its keys
    own: Study | Stage
    is_held: bool  # along z
    fixtures: dict[str, Fixture]
    impactor: tuple[str, Impactor] | None
    face: str  # that the impactor meets


def runs(study: Study) -> Iterator[Run]:
    """The first run and its stages, with the bodies that each one has."""
    fixtures: dict[str, Fixture] = {}
    impactor: tuple[str, Impactor] | None = None
    face, held = "top", False
    for path, own in study.named_runs:
        gone = own.remove if isinstance(own, Stage) else ()
        fixtures = {} if "fixtures" in gone else dict(fixtures)
        fixtures |= {f"{path}fixtures[{n}]": one for n, one in enumerate(own.fixtures, start=1)}
        impactor = None if "impactor" in gone else impactor
        if own.impactor is not None:
            impactor, face = (f"{path}impactor", own.impactor), (own.contact or Contact()).face
        if own is study or own.supports or own.loads:
            held = any("z" in each.hold for each in own.supports)
            held |= any(
                isinstance(each, Motion | Lever) and each.direction == "z" for each in own.loads
            )
        yield Run(path, own, held, fixtures, impactor, face)
