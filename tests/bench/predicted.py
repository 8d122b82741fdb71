"""The time that plydyn predicts for a run, beside the time that the run takes.

    .venv/bin/python tests/bench/predicted.py [--print]

Takes a minute or two on a quiet machine; needs build/release and the preprocessor. Puts a table
into manual/performance.md between its marks. No test: nothing is compared.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import tempfile
from pathlib import Path

from run import BUILD, PAGE, ROOT, machine, publish, table

MARKS = ("<!-- predicted -->", "<!-- /predicted -->")
RECIPES = (
    "elastic_impact/le1",
    "elastic_impact_ladder/n4_points",
    "bimetal_impact/le1",
    "damage_impact/quarter_elastic",
    "damage_impact/quarter",
)


def times(recipe: str, folder: Path) -> tuple[float, float]:
    """Seconds predicted by the check, and processor seconds of the whole run, on one thread."""
    deck = folder / "job.k"
    pre = ROOT / ".venv/bin/plydyn-pre"
    subprocess.run(
        [pre, "deck", ROOT / f"decks/{recipe}.toml", "-o", deck], check=True, capture_output=True
    )
    alone = {**os.environ, "OMP_NUM_THREADS": "1"}
    told = subprocess.run(
        [BUILD / "plydyn", "check", deck], check=True, capture_output=True, text=True, env=alone
    ).stdout
    predicted = re.search(r"time to come, predicted .*\(([\d.]+) s\)", told)
    if predicted is None:
        raise SystemExit(f"the check of {recipe} predicts no time")
    run = subprocess.Popen(
        [BUILD / "plydyn", "run", deck, "-o", folder], stdout=subprocess.DEVNULL, env=alone
    )
    _, status, usage = os.wait4(run.pid, 0)
    run.returncode = os.waitstatus_to_exitcode(status)
    if run.returncode != 0:
        raise SystemExit(f"{recipe} ended with code {run.returncode}")
    return float(predicted[1]), usage.ru_utime + usage.ru_stime


def row(recipe: str) -> list[str]:
    """A row of the table."""
    with tempfile.TemporaryDirectory() as folder:
        predicted, taken = times(recipe, Path(folder))
    return [f"`{recipe}`", f"{predicted:.1f}", f"{taken:.1f}", f"{predicted / taken:.2f}"]


def main() -> None:
    """Measure, and print or write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--print", action="store_true", help="leave the page alone")
    page = None if parser.parse_args().print else PAGE
    heads = ["recipe", "predicted [s]", "taken [s]", "predicted over taken"]
    publish(f"{machine()}\n\n{table(heads, [row(recipe) for recipe in RECIPES])}", page, MARKS)


if __name__ == "__main__":
    main()
