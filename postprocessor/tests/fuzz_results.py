"""Results with flipped bits, lost ends, missing parts and impossible numbers.

Every command must draw them or say in one sentence what is wrong. ``python tests/fuzz_results.py
--mutants 5000 --seed 3`` tries many; the tests try some hundred.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
import synthetic
import synthetic_damage
from typer.testing import CliRunner

from plydyn_post import style
from plydyn_post.cli import app

JOB = "plate"
# Commands that read each file
COMMANDS = {
    "impactor_1.csv": (["numbers"], ["force"], ["force", "--over", "displacement"], ["velocity"]),
    "energy.csv": (["energy"], ["energy", "--stacked"], ["dissipation"], ["numbers"]),
    "profile_1.csv": (["profile"], ["profile", "--component", "sxz"]),
    "delamination.csv": (["delamination", "--over-time"], ["cscan"]),
    "vtkhdf": (
        ["picture", "--plain"],
        ["picture", "--plain", "--show", "sxx", "--cut"],
        ["damage"],
        ["section", "--angle", "0"],
        ["numbers"],
        ["pvd"],
        ["animate", "--plain"],
        ["dent"],
    ),
    "interfaces.vtkhdf": (
        ["cscan"],
        ["delamination"],
        ["section", "--angle", "30"],
        ["animate", "--plain"],
    ),
}
# Share of the mutants that go through a whole report
REPORTS = 0.03


@dataclass(frozen=True)
class Mutant:
    """A damaged file and the command that reads it."""

    file: str
    change: str
    command: tuple[str, ...]

    def __str__(self) -> str:
        return f"{' '.join(self.command)} with {self.file}: {self.change}"


def write_small_job(folder: Path) -> None:
    """A job with damage on few elements."""
    synthetic.write_job(folder, JOB)
    synthetic.write_fields(folder, JOB, quads=2)
    synthetic_damage.write_interfaces(folder, JOB, quads=4)
    synthetic_damage.add_ply_damage(folder, JOB)
    synthetic_damage.write_delamination(folder, JOB)
    synthetic_damage.add_dissipation(folder, JOB)


def mutate(path: Path, rng: np.random.Generator) -> str:
    """Damage a file; says how."""
    of_kind = HDF_CHANGES if path.suffix == ".vtkhdf" else TEXT_CHANGES
    changes = (*of_kind, *BYTE_CHANGES)
    change = changes[rng.integers(len(changes))]
    return f"{change.__name__} {change(path, rng)}"


def flip_bits(path: Path, rng: np.random.Generator) -> str:
    """Flip some bits anywhere, more often in the first bytes."""
    data = bytearray(path.read_bytes())
    end = len(data) if rng.random() < 0.5 else min(len(data), 4096)
    places = rng.integers(end, size=rng.integers(1, 9))
    for place in places:
        data[place] ^= 1 << int(rng.integers(8))
    path.write_bytes(data)
    return str(sorted(places.tolist()))


def write_junk(path: Path, rng: np.random.Generator) -> str:
    """Write random bytes, or nothing, over a block."""
    data = bytearray(path.read_bytes())
    place, size = int(rng.integers(len(data))), int(rng.integers(1, 200))
    size = min(size, len(data) - place)
    data[place : place + size] = rng.bytes(size) if rng.random() < 0.5 else bytes(size)
    path.write_bytes(data)
    return f"{place} +{size}"


def cut_short(path: Path, rng: np.random.Generator) -> str:
    """Keep the first bytes only."""
    data = path.read_bytes()
    kept = int(rng.integers(len(data)))
    path.write_bytes(data[:kept])
    return f"after {kept}"


def _cells(path: Path) -> list[list[str]]:
    return [line.split(",") for line in path.read_text().splitlines()]


def _write(path: Path, cells: list[list[str]]) -> None:
    path.write_text("".join(",".join(row) + "\n" for row in cells))


def bad_number(path: Path, rng: np.random.Generator) -> str:
    """Put something that is no number of a result into a row."""
    cells = _cells(path)
    row, column = int(rng.integers(1, len(cells))), int(rng.integers(len(cells[0])))
    words = ("nan", "inf", "-inf", "1e300", "", "***", "1,2", "0x1p3", "1e400", "-1e-320")
    cells[row][column] = words[rng.integers(len(words))]
    _write(path, cells)
    return f"{cells[row][column]!r} at {row}, {column}"


def same_number(path: Path, rng: np.random.Generator) -> str:
    """Give a column the same number in all rows."""
    cells = _cells(path)
    column = int(rng.integers(len(cells[0])))
    word = ("0", "1", "-1", "1e40", "1e-300")[rng.integers(5)]
    for row in cells[1:]:
        row[column] = word
    _write(path, cells)
    return f"{word} in {cells[0][column]}"


def swap_rows(path: Path, rng: np.random.Generator) -> str:
    """Exchange two rows, so that times fall."""
    cells = _cells(path)
    one, other = (int(number) for number in rng.integers(1, len(cells), size=2))
    cells[one], cells[other] = cells[other], cells[one]
    _write(path, cells)
    return f"{one} and {other}"


def drop_column(path: Path, rng: np.random.Generator) -> str:
    """Leave a column out, or its name only."""
    cells = _cells(path)
    column = int(rng.integers(len(cells[0])))
    name = cells[0][column]
    rows = cells if rng.random() < 0.7 else cells[:1]
    for row in rows:
        del row[column]
    _write(path, cells)
    return f"{name} in {len(rows)} rows"


def change_header(path: Path, rng: np.random.Generator) -> str:
    """Another name or unit."""
    cells = _cells(path)
    column = int(rng.integers(len(cells[0])))
    words = ("", "time [s]", "force [mm]", "x", "time", "a [$b$]", "t [\x07]", "[s]", '"', "é [µ]")
    cells[0][column] = words[rng.integers(len(words))]
    _write(path, cells)
    return f"{cells[0][column]!r} at {column}"


def few_rows(path: Path, rng: np.random.Generator) -> str:
    """Keep the header and very few rows."""
    kept = int(rng.integers(4))
    cells = _cells(path)
    start = int(rng.integers(1, max(2, len(cells) - kept)))
    _write(path, [cells[0], *cells[start : start + kept]])
    return f"{kept} from {start}"


def _things(path: Path, kind: type) -> list[str]:
    names: list[str] = []
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, thing: names.append(name) if isinstance(thing, kind) else None)
    return names


def delete_part(path: Path, rng: np.random.Generator) -> str:
    """Delete a group or a dataset."""
    names = _things(path, h5py.Group) + _things(path, h5py.Dataset)
    name = names[rng.integers(len(names))]
    with h5py.File(path, "r+") as file:
        del file[name]
    return name


def change_shape(path: Path, rng: np.random.Generator) -> str:
    """Another shape, or another kind of numbers."""
    names = _things(path, h5py.Dataset)
    name = names[rng.integers(len(names))]
    with h5py.File(path, "r+") as file:
        values = file[name][...]
        attributes = dict(file[name].attrs)
        changes: tuple[Callable[[], object], ...] = (
            lambda: values[: len(values) // 2],
            lambda: np.concatenate([values, values]),
            lambda: values[..., None],
            values.ravel,
            lambda: np.column_stack([values, values]),
            lambda: values.astype("f8") + 0.5,
            lambda: values.astype("S8"),
            lambda: values.astype("i4"),
            lambda: values[:0],
            lambda: np.float64(1.0),
            lambda: values.T,
        )
        change = int(rng.integers(len(changes)))
        del file[name]
        file[name] = changes[change]()
        for key, value in attributes.items():
            file[name].attrs[key] = value
    return f"{name} by change {change}"


def change_values(path: Path, rng: np.random.Generator) -> str:
    """Impossible or random numbers in a dataset."""
    names = _things(path, h5py.Dataset)
    name = names[rng.integers(len(names))]
    with h5py.File(path, "r+") as file:
        values = file[name][...]
        flat = values.reshape(-1)
        some = rng.integers(flat.size, size=rng.integers(1, 4)) if flat.size else []
        whole = rng.random() < 0.3
        if values.dtype.kind == "f":
            new = (np.nan, np.inf, 0.0, -1.0, 1e38, 1e-38, 7.5)[rng.integers(7)]
        else:
            new = (-1, 0, 1, 255 if values.itemsize == 1 else 2**31 - 1, 3)[rng.integers(5)]
            new = max(new, 0) if values.dtype.kind == "u" else new
        flat[slice(None) if whole else some] = new
        file[name][...] = flat.reshape(values.shape)
    return f"{name} {'all' if whole else 'some'} {new}"


def change_attribute(path: Path, rng: np.random.Generator) -> str:
    """Another value of an attribute, or none."""
    with h5py.File(path, "r+") as file:
        places: list[tuple[str, str]] = []
        file.visititems(lambda name, thing: places.extend((name, key) for key in thing.attrs))
        name, key = places[rng.integers(len(places))]
        words = (b"\xff\xfe", "", "a,b", -1, 10**9, 2.5, np.nan, [1, 2, 3], "$x$ {y} _z^", "kN\n")
        place = int(rng.integers(len(words) + 1))
        del file[name].attrs[key]
        if place < len(words):
            file[name].attrs[key] = words[place]
    return f"{name} {key} by word {place}"


BYTE_CHANGES = (flip_bits, flip_bits, write_junk, cut_short)
TEXT_CHANGES = (
    bad_number, same_number, swap_rows, drop_column, change_header, few_rows,
)  # fmt: skip
HDF_CHANGES = (delete_part, change_shape, change_values, change_attribute, change_values)


def run(words: list[str]) -> tuple[int, str, str, BaseException | None]:
    """Run a command where a warning is an error: exit code, output, errors and what was raised."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = CliRunner().invoke(app, words)
    raised = None if isinstance(result.exception, SystemExit) else result.exception
    return result.exit_code, result.stdout, result.stderr, raised


def fault(code: int, errors: str, raised: BaseException | None) -> str:
    """What is wrong with how a command ended; nothing if all is well."""
    if raised is not None:
        return f"{type(raised).__name__}: {raised}"
    if code not in (0, 2):
        return f"exit code {code}"
    if code == 0:
        return "errors beside exit code 0" if errors else ""
    if errors.count("\n") != 1 or not errors.startswith("plydyn-post: "):
        return f"not one sentence: {errors!r}"
    return "" if JOB in errors else f"names no file: {errors!r}"


def try_mutants(folder: Path, seed: int, count: int) -> list[tuple[Mutant, str]]:
    """Try some mutants; returns those that were handled wrongly."""
    good, bad, output = folder / "good", folder / "bad", folder / "output"
    write_small_job(good)
    found = []
    for number in range(count):
        rng = np.random.default_rng([seed, number])
        shutil.rmtree(bad, ignore_errors=True)
        shutil.rmtree(output, ignore_errors=True)
        shutil.copytree(good, bad)
        ending = sorted(COMMANDS)[rng.integers(len(COMMANDS))]
        choice = COMMANDS[ending]
        command = choice[rng.integers(len(choice))]
        if rng.random() < REPORTS:
            command = ["report", "--plain"]
        mutant = Mutant(ending, mutate(bad / f"{JOB}.{ending}", rng), tuple(command))
        name = {"report": "", "pvd": "", "numbers": "made.csv", "animate": "made.gif"}
        target = output / name.get(command[0], "made.png")
        code, _, errors, raised = run([command[0], str(bad / JOB), *command[1:], "-o", str(target)])
        wrong = fault(code, errors, raised)
        if wrong:
            found.append((mutant, f"seed {seed}, mutant {number}: {wrong}"))
    return found


def small_pictures() -> None:
    """Draw with few dots: nobody looks at these pictures."""
    style.LOOK.update({"figure.dpi": 30, "savefig.dpi": 30})


def main() -> None:
    """Try mutants and print those that were handled wrongly."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--mutants", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    small_pictures()
    with tempfile.TemporaryDirectory() as folder:
        found = try_mutants(Path(folder), asked.seed, asked.mutants)
    for mutant, wrong in found:
        sys.stdout.write(f"{mutant}\n    {wrong}\n")
    sys.stdout.write(f"{len(found)} of {asked.mutants} mutants were handled wrongly\n")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
