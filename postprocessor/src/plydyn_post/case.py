"""What a job computes and what its listing notes: the beginning of a page."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

import numpy as np

from plydyn_post.header import Header, read_header
from plydyn_post.results import Results

#: Sections of the listing with lines of a label and a value, and labels that are of no use here
_SECTIONS = ("Size and mass", "Stable step")
_LAST = "largest step taken"
#: Sections that name a material
_MATERIAL = re.compile(r"(?:Damage of|Interface) material (\d+) (.*)")
#: What a comment of the deck begins with that says what is from the library
_ORIGIN = re.compile(r"\$ origin of (.*?): ((?:from|all constants).*)")
#: What the listing says of bands that are too wide
_BANDS = re.compile(r"of \d+ Gauss points; (.*)")
#: The listing's warning of a kinetic energy that is large, and the time of it
_FAST = re.compile(r"warning: (the kinetic energy is \S+ of the internal one at time (\S+)).*")
#: Shares of the energy that the balance may be off: well, and until a warning
_GOOD, _DOUBTFUL = 0.01, 0.05
#: Of findings, from the worst on
COLOURS = ("red", "amber", "green")


@dataclass(frozen=True)
class Light:
    """A finding: green, amber or red, in words that say what to do."""

    colour: str
    words: str


@dataclass(frozen=True)
class Case:
    """Rows of a label and words, and the findings of a job."""

    job: str
    rows: tuple[tuple[str, str], ...]
    lights: tuple[Light, ...]


def read_case(job: Results, label: str, peak: float | None = None) -> Case:
    """The case of a job from its listing, its fields and its deck; without them less is told.

    A plate that has a peak load in the job collapses from that time on, and may be fast then.
    """
    header = read_header(job.fields)
    listing = job.folder / f"{job.job}.out"
    lines = _lines_of(listing)
    rows = [
        ("title", header.title),
        ("laminate", _laminate(header)),
        *_materials(lines),
        *_origins(header, job.folder),
        *_sizes(lines),
        ("deck", header.deck),
        ("version", _version(lines) or header.version),
    ]
    lights = _lights(job, lines, peak)
    return Case(label, tuple((name, words) for name, words in rows if words), lights)


def _version(lines: list[str]) -> str:
    """The build that made a listing, in its first three lines or below the heading of a restart."""
    starts = [place for place, line in enumerate(lines) if line.startswith("plydyn ")]
    return "; ".join(lines[starts[0] : starts[0] + 3]) if starts else ""


def _lines_of(path: Path) -> list[str]:
    """Lines of a text file that may not be there."""
    try:
        return path.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return []


def _laminate(header: Header) -> str:
    """Angles of each part from the bottom up, and its thickness; those of equal parts once."""
    unit, words = header.units.get("length", ""), []
    for _, plies in groupby(header.plies, key=lambda ply: ply.get("part")):
        own = list(plies)
        if not {"angle", "bottom", "top"} <= own[0].keys():
            continue
        angles = "/".join(f"{ply['angle']:g}" for ply in own)
        thick = own[-1]["top"] - own[0]["bottom"]
        words.append(f"[{angles}], {len(own)} plies, {thick:.4g} {unit}")
    return "; ".join(dict.fromkeys(words))


def _sections(lines: list[str]) -> Iterator[tuple[str, list[str]]]:
    """Headings of a listing with the lines below."""
    starts = [place for place, line in enumerate(lines[1:]) if line and set(line) == {"-"}]
    for start, end in zip(starts, [*starts[1:], len(lines)], strict=False):
        yield lines[start].strip(), lines[start + 2 : end]


def _materials(lines: list[str]) -> Iterator[tuple[str, str]]:
    """Materials with damage, and interfaces."""
    for heading, _ in _sections(lines):
        if found := _MATERIAL.fullmatch(heading):
            kind = "interface" if heading.startswith("Interface") else "ply"
            yield f"material {found[1]}", f"{found[2]} ({kind})"


def _origins(header: Header, folder: Path) -> Iterator[tuple[str, str]]:
    """What materials have from the library, as comments of the deck say."""
    text: list[str] = []
    for path in (Path(header.deck), folder / Path(header.deck).name):
        text = text or (_lines_of(path) if header.deck else [])
    joined: list[str] = []
    for line in text:
        if line.startswith("$ origin of "):
            joined.append(line)
        elif joined and line.startswith("$ ") and not joined[-1].endswith("\n"):
            joined[-1] += f" {line[2:]}"
        elif joined and not joined[-1].endswith("\n"):
            joined[-1] += "\n"
    for line in joined:
        if found := _ORIGIN.fullmatch(line.strip()):
            yield f"origin of {found[1]}", found[2]


def _sizes(lines: list[str]) -> Iterator[tuple[str, str]]:
    """Mesh, masses, impactors, fixtures and the step, line by line as the listing has them."""
    for heading, own in _sections(lines):
        if heading not in _SECTIONS:
            continue
        for line in own:
            name, _, words = line.partition("  ")
            if line.startswith("   "):
                name, _, words = line.strip().partition("  ")
            if words.strip() and len(name) > 1 and not line.startswith(("note", "warning")):
                yield name.strip(), " ".join(words.split())
            if name.strip() == _LAST:
                break


def _lights(job: Results, lines: list[str], peak: float | None) -> tuple[Light, ...]:
    """Warnings and notes of the listing, how the run ended, and its energy balance."""
    told = [
        line
        for line in dict.fromkeys(map(str.strip, lines))
        if line.startswith(("note: ", "warning: "))
    ]
    found = [_light_of(line, peak) for line in told]
    bands = dict.fromkeys(match[1] for line in lines if (match := _BANDS.match(line)))
    wide = "crack bands are too wide at some points; smaller quads help"
    found += [Light("amber", f"{wide}: {words}") for words in bands]
    if lines and "normal end" not in lines:
        found.append(Light("red", "the run has not come to its normal end; see the listing"))
    if job.has("energy"):
        error = float(np.abs(job.energy()["error"]).max())
        colour = "green" if error <= _GOOD else "amber" if error <= _DOUBTFUL else "red"
        advice = "" if colour == "green" else "; see what stops a run, in the manual, for remedies"
        found.append(Light(colour, f"the energy balance is off by at most {error:.2g}{advice}"))
    if lines and not told and not any(light.colour != "green" for light in found):
        found.append(Light("green", "the listing has no note and no warning"))
    return worst_first(found)


def _light_of(line: str, peak: float | None) -> Light:
    """The light of a warning or note of the listing."""
    fast = _FAST.fullmatch(line)
    if fast and peak is not None and float(fast[2]) > peak:
        return Light("green", f"{fast[1]}: after the peak, as the plate collapses")
    return Light("red" if line.startswith("warning") else "amber", line.partition(": ")[2])


def worst_first(lights: Iterable[Light]) -> tuple[Light, ...]:
    """Findings by their colours."""
    return tuple(sorted(lights, key=lambda light: COLOURS.index(light.colour)))
