"""What a strength after impact stands on: materials, rate, mass scaling, relaxation, mesh, gaps."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import numpy as np

from plydyn_post.case import Case
from plydyn_post.compression import Compression
from plydyn_post.ending import Ending
from plydyn_post.grid import read_times
from plydyn_post.interfaces import DELAMINATED, Interfaces, read_interfaces
from plydyn_post.page import PageTable
from plydyn_post.results import Results
from plydyn_post.units import readable

#: Row of all parts in the table of mass scaling of a listing: mass, added mass, share in per cent
_ADDED = re.compile(r"^Mass scaling$.*?^\s*all\s+\S+\s+\S+\s+(\S+)", re.M | re.S)
#: Share of the energy of a run that damping may take by round-off
NOTHING = 1.0e-9
#: Delaminations are closed where no gap has this share of the thinner side of its interface
CLOSED = 0.01
_AT_REST = re.compile(r"at rest: the kinetic energy is (\S+) of its largest value")


def assumed_table(
    jobs: Sequence[Results], test: Compression, ending: Ending, cases: Sequence[Case]
) -> PageTable:
    """One row for each thing that the strength stands on."""
    rows = [
        *_materials(cases),
        ("rate", _rate(test)),
        ("mass scaling", _mass_scaling(jobs)),
        *(("relaxation", words) for job in jobs if (words := _relaxation(job))),
        *_delaminations(test, ending),
    ]
    words = (
        "Each of these can move the strength; manual/chains.md says by how much and what to try."
    )
    return PageTable("What the strength assumes", ("", ""), tuple(rows), words)


def _materials(cases: Sequence[Case]) -> Iterator[tuple[str, str]]:
    """Where the constants of the materials come from."""
    told = dict(row for case in cases for row in case.rows if row[0].startswith("origin of "))
    yield from told.items()
    if not told:
        yield "materials", "constants of the deck, without a source in it"


def _rate(test: Compression) -> str:
    """Speed of the end, and what it costs."""
    loaded = np.flatnonzero(test.loaded())
    span = test.time[loaded[-1]] - test.time[loaded[0]]
    moved = test.shortening[loaded[-1]] - test.shortening[loaded[0]]
    speed = float(moved / span) if span > 0.0 else 0.0
    unit = "/".join((test.units.get("length", ""), test.units.get("time", "")))
    return (
        f"the end moves at {speed:.3g} {unit}; at the peak the kinetic energy is"
        f" {test.kinetic_at_peak():.2%} of the internal one, and the forces of both ends are"
        f" {test.unbalance():.2%} of the load apart"
    )


def _mass_scaling(jobs: Sequence[Results]) -> str:
    """Mass that was added in each stage."""
    found = []
    for job in jobs:
        listing = job.folder / f"{job.job}.out"
        text = listing.read_text(errors="replace") if listing.is_file() else ""
        if match := _ADDED.search(text):
            found.append(f"{float(match[1]):.3g} % added in {job.job}")
    return "; ".join(found) or "none"


def _relaxation(job: Results) -> str:
    """What damping took from a stage, and what broke in it."""
    if not job.has("energy"):
        return ""
    energy = job.energy()
    taken = energy.get("damping")
    if taken is None:
        return ""
    took = abs(float(taken[-1] - taken[0]))
    if took <= NOTHING * float(np.abs(energy["total"]).max()):
        return ""
    broke = float(energy["dissipated"][-1] - energy["dissipated"][0])
    scale = readable(energy.unit("damping"), took)
    words = f"{job.job}: damping took {took * scale.factor:.3g} {scale.unit}"
    words += f", {broke * scale.factor:.3g} {scale.unit} broke meanwhile"
    listing = job.folder / f"{job.job}.out"
    text = listing.read_text(errors="replace") if listing.is_file() else ""
    if match := _AT_REST.search(text):
        return f"{words}; ended at rest, {float(match[1]):.2g} of the largest kinetic energy left"
    return f"{words}; ended with its time, not by coming to rest"


def _delaminations(test: Compression, ending: Ending) -> Iterator[tuple[str, str]]:
    """The quads over the delaminations at the start of the test, and their gaps."""
    if not test.job.interface_fields.is_file():
        return
    length = test.units.get("length", "")
    found = quads_over(_start(test))
    if found is None:
        yield "quads over the delaminations", "nothing is delaminated at the start of the test"
        return
    side, nodes = found
    yield (
        "quads over the delaminations",
        f"up to {side:.3g} {length} wide, nodes {side / (nodes - 1):.3g} {length} apart",
    )
    gaps = [one.gaps[0] for one in ending.interfaces]
    if gaps:
        words = ", ".join(f"{gap:.2g}" for gap in gaps)
        closed = begins_closed(test, ending)
        told = "the delaminations begin closed" if closed else "the largest of each interface"
        yield "gaps at the start, from the bottom up", f"{words} {length}; {told}"


def begins_closed(test: Compression, ending: Ending) -> bool:
    """Whether something is delaminated at the start of a test, and all of it is closed."""
    if not ending.interfaces or quads_over(_start(test)) is None:
        return False
    return all(one.gaps[0] < CLOSED * one.thickness for one in ending.interfaces)


def _start(test: Compression) -> Interfaces:
    """The interfaces at the start of a test."""
    return read_interfaces(test.job, float(read_times(test.job.interface_fields)[0]))


def quads_over(state: Interfaces) -> tuple[float, int] | None:
    """The longest side of quads that are delaminated at some node, and their nodes on a side."""
    longest, nodes = 0.0, 2
    for one in state.each:
        own = one.places[np.max(one.spent, axis=(1, 2)) >= DELAMINATED]
        nodes = own.shape[1]
        corners = own[:, [0, -1, -1, 0], [0, 0, -1, -1]]
        sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
        longest = max(longest, float(sides.max(initial=0.0)))
    return (longest, nodes) if longest > 0.0 else None
