"""The strength of a test in print: a sentence, a table, and what makes it doubtful."""

from __future__ import annotations

import csv
from collections.abc import Callable
from pathlib import Path

from plydyn_post.compression import EVENTS, MOST_BENDING, QUASI_STATIC, Compression
from plydyn_post.page import PageTable
from plydyn_post.units import in_brackets, readable


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
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("quantity", *table.headings[1:]))
        writer.writerows(table.rows)
    return path
