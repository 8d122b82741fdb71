"""What the estimated contact of an impactor says of the end of a run."""

from __future__ import annotations

from collections.abc import Iterator
from math import isfinite

from plydyn_pre.deck.contact_duration import contact_durations
from plydyn_pre.mesh import Mesh
from plydyn_pre.study import Study


def contact_lines(study: Study, mesh: Mesh) -> Iterator[tuple[str, str]]:
    """Headings with the estimates."""
    names = study.units
    for found in contact_durations(study, mesh):
        sides = [f"{span:.4g}" for span in found.spans if isfinite(span)]
        kind = "plate" if len(sides) > 1 else "beam"
        stage = "" if found.path == "control." else f"{found.path}impactor: "
        yield (
            "contact",
            f"{stage}about {found.duration:.2g} {names.time}, half a period on a simply supported"
            f" {kind} of {' x '.join(sides)} {names.length}",
        )


def early_ends(study: Study, mesh: Mesh) -> Iterator[str]:
    """Ends of runs before that of the contact, by their keys."""
    for found in contact_durations(study, mesh):
        if found.start < found.end_time < found.end:
            yield (
                f"{found.path}end_time: the impactor will touch the plate for about"
                f" {found.duration:.2g} {study.units.time}, longer than the run lasts; give more"
                f" than {found.end:.2g}, and until_contact_ends for an end after the contact"
            )
