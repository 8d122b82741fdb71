"""Recipes with seeded faults: what becomes of each.

``python recipe_fuzzer.py --count 5000 --seed 7 --solver plydyn`` tries as many as it is told, and
prints those that end in any other way than with a deck, or with one sentence and exit code 2.
"""

from __future__ import annotations

import argparse
import copy
import random
import resource
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from programs import plydyn_pre
from test_recipe import switched_on

from plydyn_pre import example_recipe

MEMORY = 3 << 30  # bytes of data
RESIDENT = 2 << 20  # kB
SECONDS = 60
DEEP = 3000

HOSTILE: tuple[Any, ...] = (
    *(0, -1, 1, 2, 3, 1000, 10**6, 10**9, 2**31, 2**63, 10**400, -(10**400)),
    *(0.0, -0.0, 1e-300, 1e-30, 0.5, 1e30, 1e99, 1e101, 1e300, -1e-9, -1e9),
    *(float("nan"), float("inf"), -float("inf"), True, False),
    *("", " ", "x", "all", "tied", "apart", "linear", "\n", "\x1b[31m", "é" * 200, "x" * 10_000),
    *("*END", "$", "a,b", "'", '"', "/dev/zero", "../../..", "[0/90]s", "[0_9999]", "%s{}"),
    *([], [[]], [1], [1.0, 2.0], ["x"], [0, 0, 0, 0], {}, {"kind": "x"}, {"kind": [1]}, {"x": 1}),
    *([float("nan")] * 2, [1e9, -1e9], [2, 1], ["centre"], {"x": {"x": {"x": 1}}}),
)
LAYUPS = (
    "[(" * 5,
    "(" * DEEP,
    "]s",
    "_9",
    "_{3s}",
    "~",
    "±",
    "+-",
    "/",
    "carbon:",
    "1e5",
    "²",
    "90",
)


@dataclass(frozen=True)
class Mutant:
    """A recipe and the options of a command."""

    number: int
    text: str
    options: tuple[str, ...] = ()


@dataclass(frozen=True)
class Outcome:
    """How a command ended."""

    code: int
    output: str
    seconds: float
    resident: int  # kB

    @property
    def faults(self) -> list[str]:
        """What is wrong with how it ended."""
        found = []
        if self.code not in (0, 2):
            found.append(f"exit code {self.code}")
        if "Traceback" in self.output or "│" in self.output:
            found.append("traceback")
        if self.code == 2 and self.output.count("error: ") != 1:
            found.append("not one error")
        if self.seconds > SECONDS or self.resident > RESIDENT:
            found.append(f"{self.seconds:.0f} s, {self.resident >> 10} MB")
        return found


def bases(decks: Path) -> list[dict[str, Any]]:
    """Recipes that faults are put into."""
    long = example_recipe("impact-all")
    texts = [example_recipe(), long, switched_on(long, tables=True), example_recipe("dcb")]
    for name in ("elastic_impact/bricks_1", "damage_impact/q192_le2", "bimetal_impact/le1"):
        texts.append((decks / f"{name}.toml").read_text(encoding="utf-8"))
    tables = [tomllib.loads(text) for text in texts]
    for table in tables:
        if "base" in table:
            table["base"] = str(decks / "elastic_impact" / table["base"])
    return tables


def mutants(seed: int, count: int, decks: Path) -> Iterator[Mutant]:
    """Recipes with one to three faults each."""
    known = bases(decks)
    for number in range(count):
        chance = random.Random(f"{seed} {number}")
        table = copy.deepcopy(chance.choice(known))
        for _ in range(chance.choice((1, 1, 1, 2, 3))):
            _mutate(table, chance)
        text, options = toml_text(table), ()
        kind = chance.random()
        if kind < 0.15:
            text = _scratched(text, chance)
        elif kind < 0.3:
            options = ("--set", f"{_dotted(_pick(table, chance))}={_inline(_value(None, chance))}")
        yield Mutant(number, text, options)


def run(mutant: Mutant, folder: Path, solver: str | None = None) -> Outcome:
    """Make the deck of a mutant in a process of its own, with bounds; let the solver check it."""
    (folder / "job.toml").write_text(mutant.text, encoding="utf-8", errors="surrogateescape")
    (folder / "job.k").unlink(missing_ok=True)
    words = ("deck", "job.toml", *mutant.options)
    done = plydyn_pre(folder, *words, memory=MEMORY, seconds=2 * SECONDS)
    code, output = done.returncode, done.stdout + done.stderr
    if code == 0 and solver:
        code, output = _checked(folder, solver)
    return Outcome(code, output, done.seconds, done.resident)


def _checked(folder: Path, solver: str) -> tuple[int, str]:
    """What the solver says of a deck: it accepts what was made of a recipe, and does so soon."""
    result = subprocess.run(
        [solver, "check", "job.k"],
        cwd=folder,
        capture_output=True,
        check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS)),
    )
    text = (result.stdout + result.stderr).decode(errors="replace")
    return (0 if result.returncode == 0 else 70 + result.returncode), text


def _mutate(table: dict[str, Any], chance: random.Random) -> None:
    """Put one fault into a table."""
    path = _pick(table, chance)
    under: Any = table
    for step in path[:-1]:
        under = under[step]
    last = path[-1]
    kind = chance.random()
    if kind < 0.12:
        del under[last]
    elif kind < 0.2 and isinstance(under, dict):
        under[f"{last}{chance.choice(('s', '_', 'x'))}"] = under.pop(last)
    elif kind < 0.28 and isinstance(under, list):
        under.append(copy.deepcopy(under[last]))
    else:
        under[last] = _value(under[last], chance)


def _value(old: object, chance: random.Random) -> Any:  # noqa: ANN401
    """Another value, near the old one or hostile."""
    kind = chance.random()
    if isinstance(old, int | float) and not isinstance(old, bool) and kind < 0.7:
        return chance.choice(_near(old))
    if isinstance(old, str) and kind < 0.5:
        at = chance.randrange(len(old) + 1)
        return old[:at] + chance.choice(LAYUPS) + old[at + chance.randrange(3) :]
    return copy.deepcopy(chance.choice(HOSTILE))


def _near(old: float) -> tuple[float, ...]:
    """Numbers that someone may have meant or typed."""
    if isinstance(old, int):
        return (-old, old + 1, old - 1, 2 * old, old * 1000, old // 2, 0)
    return (-old, old * 1.5, old * 0.7, old * 2.0, old * 1e3, old * 1e-3, 0.0)


def _pick(table: dict[str, Any], chance: random.Random) -> list[str | int]:
    """Keys that lead to some value."""
    found: list[list[str | int]] = []

    def walk(value: object, path: list[str | int]) -> None:
        if path:
            found.append(path)
        entries = enumerate(value) if isinstance(value, list) else ()
        for key, inner in value.items() if isinstance(value, dict) else entries:
            walk(inner, [*path, key])

    walk(table, [])
    return chance.choice(found or [["title"]])


def _dotted(path: list[str | int]) -> str:
    """Keys as on the command line."""
    steps = [f"[{step + 1}]" if isinstance(step, int) else f".{step}" for step in path]
    return "".join(steps).lstrip(".")


def _scratched(text: str, chance: random.Random) -> str:
    """A text with some characters lost, doubled or changed."""
    for _ in range(chance.randrange(1, 4)):
        at = chance.randrange(len(text) + 1)
        piece = chance.choice(("", "[", "]", "=", '"', "\n", "\x00", "é", "#", text[at : at + 40]))
        text = text[:at] + piece + text[at + chance.randrange(4) :]
    return text


def toml_text(table: dict[str, Any]) -> str:
    """A table as TOML, a line for each of its keys."""
    return "".join(f"{_quoted(key)} = {_inline(value)}\n" for key, value in table.items())


def _inline(value: object) -> str:
    """A value as TOML on one line."""
    match value:
        case bool():
            return str(value).lower()
        case str():
            return _quoted(value)
        case list():
            return f"[{', '.join(map(_inline, value))}]"
        case dict():
            pairs = (f"{_quoted(key)} = {_inline(inner)}" for key, inner in value.items())
            return f"{{{', '.join(pairs)}}}"
        case int():
            return str(value)
        case _:
            return repr(value)


def _quoted(text: str) -> str:
    """Text in quotes."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c >= " " else f"\\u{ord(c):04x}" for c in escaped) + '"'


def main() -> int:
    """Try many, and print those that end as they must not."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--solver", help="checks every deck that is made")
    chosen = parser.parse_args()
    decks = Path(__file__).resolve().parents[2] / "decks"
    failed, made = 0, 0
    with tempfile.TemporaryDirectory() as folder:
        for mutant in mutants(chosen.seed, chosen.count, decks):
            outcome = run(mutant, Path(folder), chosen.solver)
            made += outcome.code == 0
            if outcome.faults:
                failed += 1
                kept = Path(f"mutant_{chosen.seed}_{mutant.number}.toml")
                kept.write_text(mutant.text, encoding="utf-8")
                words = f"{kept} {mutant.options}: {outcome.faults}\n{outcome.output[-1500:]}\n"
                sys.stdout.write(f"{words}\n")
    sys.stdout.write(f"{chosen.count} recipes, {made} decks, {failed} that ended wrongly\n")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
