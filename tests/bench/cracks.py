"""Measure what cracks as lines cost: 25 J on quads of 1.5 mm with and without, in the manual.

    .venv/bin/python tests/bench/cracks.py [--repeats N] [--print]

Takes some minutes; needs build/release. Steps are measured as those of whole coupons are, by turns.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from coupon import MILLI, ROOT, ROW, STATES, Crew, steps_of
from run import BUILD, PAGE, machine, publish, table

from plydyn_pre import deck_text, load_recipe, make_mesh, write_deck

RECIPES = {"smeared": "t700gc_25J_smeared", "as lines": "t700gc_25J_cracks"}
ENERGY = 25.0e3  # mJ
NANO = 1.0e-9
HEADS = ["cracks", "DOF", "step [ns]", "ms per step, before damage", "times", "amid damage"]
HEADS += ["times", "at most, for the same time of the plate"]


@dataclass(frozen=True)
class Measured:
    """One model: degrees of freedom, its time step, processor seconds of one in each state."""

    name: str
    freedoms: int
    length: float
    seconds: tuple[float, ...]


def written(recipe: str, folder: Path, end: float, speed: float) -> Path:
    """The deck of a recipe that ends at a time, with an impactor so many times as fast."""
    changed = [f"control.end_time={end:.3g}", f"impactor.energy={ENERGY * speed**2:.6g}"]
    path = ROOT / f"decks/validation/{recipe}.toml"
    deck = folder / f"{recipe}_{end:.3g}_{speed:.0f}.k"
    study = load_recipe(path, changed)
    write_deck(deck_text(study, make_mesh(study.mesh)), deck)
    return deck


def sizes(deck: Path) -> tuple[int, float]:
    """Degrees of freedom with those of twins, and the step, as the check of a deck says them."""
    told = subprocess.run(
        [BUILD / "plydyn", "check", deck], check=True, capture_output=True, text=True
    ).stdout
    counted = re.search(r"degrees of freedom\s+(\d+)", told)
    length = re.search(r"largest step taken\s+(\S+)", told)
    assert counted and length
    return int(counted[1]), float(length[1])


def measured(folder: Path, repeats: int) -> list[Measured]:
    """Both models by turns."""
    solver = BUILD / "plydyn"
    decks = {
        name: [
            (written(recipe, folder, start, speed), written(recipe, folder, start + ROW, speed))
            for start, speed in STATES.values()
        ]
        for name, recipe in RECIPES.items()
    }
    jobs = [(Crew(solver), pair) for name in RECIPES for pair in decks[name]]
    seconds = iter(steps_of(jobs, repeats))
    return [
        Measured(name, *sizes(decks[name][0][0]), tuple(next(seconds) for _ in STATES))
        for name in RECIPES
    ]


def rows(found: list[Measured]) -> list[list[str]]:
    """Each model beside the first."""
    first = found[0]
    lines = []
    for one in found:
        line = [one.name, f"{one.freedoms:,}", f"{one.length / NANO:.1f}"]
        for own, other in zip(one.seconds, first.seconds, strict=True):
            line += [f"{own / MILLI:.1f}", f"{own / other:.2f}"]
        pairs = zip(one.seconds, first.seconds, strict=True)
        whole = max(own / other for own, other in pairs) * first.length / one.length
        lines.append([*line, f"{whole:.2f}"])
    return lines


def main() -> None:
    """Measure, and print or write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeats", type=int, default=3, help="turns of both")
    parser.add_argument("--print", action="store_true", help="leave the page alone")
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        text = table(HEADS, rows(measured(Path(name), chosen.repeats)))
    publish(
        f"{machine()}\n\n{text}",
        None if chosen.print else PAGE,
        ("<!-- cracks -->", "<!-- /cracks -->"),
    )


if __name__ == "__main__":
    main()
