"""The strength of a test in print: a sentence, a table, and whether it may be trusted."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np

from plydyn_post.case import COLOURS, Case, Light, worst_first
from plydyn_post.compression import EVENTS, MOST_BENDING, QUASI_STATIC, Compression
from plydyn_post.ending import Ending
from plydyn_post.page import PageTable
from plydyn_post.strength_assumed import begins_closed
from plydyn_post.sublaminates import states_of
from plydyn_post.table import write_csv
from plydyn_post.units import in_brackets, readable

#: Difference of the forces of both ends over the load: in equilibrium, and no longer
BALANCED, UNBALANCED = 0.02, 0.05
#: A picture of a state below this share of the strength does not show the peak
NEAR_PEAK = 0.9


def strength_table(test: Compression, pristine: Compression | None, words: str = "") -> PageTable:
    """The numbers of the test, and of the pristine plate beside it."""
    tests = [test] if pristine is None else [test, pristine]
    length, stress = (test.units.get(kind, "") for kind in ("length", "stress"))
    force = readable(test.units.get("force", ""), test.strength * test.width * test.thickness)
    quantities: list[tuple[str, str, Callable[[Compression], float]]] = [
        ("strength, peak force / (w h)", stress, lambda one: one.strength),
        (
            "peak force",
            force.unit,
            lambda one: one.strength * one.width * one.thickness * force.factor,
        ),
        (f"{test.moved} at the peak", length, lambda one: float(one.shortening[one.peak])),
        ("mean strain at the peak", "µm/m", lambda one: 1.0e6 * one.strain),
        ("bending at the peak", "%", lambda one: one.bending),
        ("largest kinetic / internal energy", "%", lambda one: 100.0 * one.kinetic_share()),
        ("kinetic / internal energy at the peak", "%", lambda one: 100.0 * one.kinetic_at_peak()),
        ("forces of both ends apart at the peak", "%", lambda one: 100.0 * one.unbalance()),
    ]
    rows = [
        (in_brackets(name, unit), *(f"{value(one):.4g}" for one in tests))
        for name, unit, value in quantities
    ]
    taken = [one.broken() for one in tests]
    scale = readable(test.job.energy().unit("internal"), max(taken[0].values(), default=0.0))
    for name in taken[0]:
        cells = (f"{each.get(name, 0.0) * scale.factor:.4g}" for each in taken)
        rows.append((in_brackets(f"taken by {EVENTS[name]} in the fall", scale.unit), *cells))
    if pristine is not None:
        rows.append(("strength / that of the pristine plate", f"{ratio(test, pristine):.4g}", "1"))
    heads = ("", *(one.job.job for one in tests))
    return PageTable("Strength", heads, tuple(rows), words, strength_words(test, pristine))


def strength_words(test: Compression, pristine: Compression | None) -> tuple[str, ...]:
    """The strength in a sentence, beside that of the pristine plate or with how to get it."""
    stress = test.units.get("stress", "")
    kind = "Tensile strength" if test.pulled else "Strength"
    said = f"{kind}: {test.strength:.4g} {stress}".rstrip()
    if pristine is not None:
        whole = f"{pristine.strength:.4g} {stress}".rstrip()
        return (f"{said}, {ratio(test, pristine):.0%} of the {whole} of the pristine plate.",)
    how = (
        "The strength of the pristine plate was not given. For it give --with-pristine to"
        " plydyn-pre run, which runs the recipe without its impact, too, or the job of its test"
        " with --pristine."
    )
    return f"{said}.", how


def ratio(test: Compression, pristine: Compression) -> float:
    """Strength that is left."""
    return test.strength / pristine.strength


def notes_of(test: Compression) -> tuple[str, ...]:
    """What makes a test doubtful."""
    notes, name = [], test.job.job
    share = test.kinetic_share()
    if share > QUASI_STATIC:
        notes.append(
            f"{name}: the kinetic energy reaches {share:.1%} of the internal one, more than"
            f" {QUASI_STATIC:.0%}: not quasi-static; load more slowly"
        )
    if test.bending > MOST_BENDING:
        notes.append(
            f"{name}: the gauges bend by {test.bending:.3g} % at the peak, more than"
            f" {MOST_BENDING:g} %"
        )
    if test.fallen is None:
        notes.append(f"{name}: the stress has not fallen from its peak; the strength may be higher")
    return tuple(notes)


def write_table(table: PageTable, path: Path) -> Path:
    """Write a table as CSV."""
    return write_csv(path, (("quantity", *table.headings[1:]), *table.rows))


def strength_lights(test: Compression, ending: Ending, cases: Sequence[Case]) -> tuple[Light, ...]:
    """Findings on the test, then the worst of each stage; the worst first."""
    found = [*_of_end(test, ending), *_of_state(test, ending), *_of_rate(test), *_of_stages(cases)]
    return worst_first(found)


def _of_end(test: Compression, ending: Ending) -> Iterator[Light]:
    """How the test ended, and whether the standard would count it."""
    if test.fallen is None:
        yield Light("red", "the stress has not fallen from its peak; the strength may be higher")
    else:
        yield Light("green", "the stress has fallen from its peak, which is the strength")
    if ending.at_ends > 0.5:
        yield Light("amber", "the plate broke at its ends, which the standards do not count")
    if ending.is_away and "fibre damage" in ending.order:
        words = "fibres broke away from the delaminations: this may be no strength after impact"
        yield Light("red", f"{words}; wide quads start kinking below its strength, see Checks")
    if test.bending > MOST_BENDING:
        words = f"the gauges bend by {test.bending:.3g} % at the peak, more than {MOST_BENDING:g} %"
        yield Light("amber", f"{words}: ASTM D7137 asks for less")
    shown = states_of(test, test.job.fields).peak
    share = float(np.interp(shown, test.time, test.stress)) / test.strength
    if share < NEAR_PEAK:
        words = f"the state next to the peak is at {share:.0%} of the strength"
        yield Light("amber", f"{words}: give the stage a smaller outputs.field_interval")


def _of_state(test: Compression, ending: Ending) -> Iterator[Light]:
    """Whether delaminations are as open at the start as in a coupon."""
    if not test.pulled and begins_closed(test, ending):
        words = "all delaminations begin closed; in a coupon debris and permanent shear hold them"
        yield Light("amber", f"{words} open, which can lower the strength by a fifth or more")


def _of_rate(test: Compression) -> Iterator[Light]:
    """Whether the test was slow enough."""
    most, peak = test.kinetic_share(), test.kinetic_at_peak()
    words = f"kinetic energy: {peak:.2g} of the internal one at the peak, at most {most:.2g} before"
    slow = (
        "quasi-static"
        if most <= QUASI_STATIC
        else f"more than {QUASI_STATIC:.0%}: load more slowly"
    )
    yield Light("green" if most <= QUASI_STATIC else "amber", f"{words}: {slow}")
    apart = test.unbalance()
    colour = "green" if apart <= BALANCED else "amber" if apart <= UNBALANCED else "red"
    words = f"the forces of both ends differ by {apart:.2%} at the peak"
    slow = (
        "in balance"
        if colour == "green"
        else "inertia carries a part of the load; load more slowly"
    )
    yield Light(colour, f"{words}: {slow}")


def _of_stages(cases: Sequence[Case]) -> Iterator[Light]:
    """The worst colour of each stage, and how many findings it has; they stand below."""
    for case in cases:
        if not case.lights:
            continue
        worst = min((light.colour for light in case.lights), key=COLOURS.index)
        count = sum(light.colour == worst for light in case.lights)
        if worst == "green":
            yield Light("green", f"{case.job}: no warning and no note")
        else:
            kind = {"red": "warning", "amber": "note"}[worst] + ("s" if count > 1 else "")
            yield Light(worst, f"{case.job}: {count} {kind}; see Checks of {case.job} below")
