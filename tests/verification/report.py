"""Verification report: run the tests of some folders, and print what they compare into the page.

    .venv/bin/python tests/verification/report.py              # all folders
    .venv/bin/python tests/verification/report.py hertz waves  # some of them
    .venv/bin/python tests/verification/report.py --studies    # with the expensive tables

The tests compute and assert. Of each test the row that is nearest to its tolerance goes between the
marks of manual/verification.md, with figures in manual/pictures; all rows go into
verification_tables.md beside it, and the expensive tables into verification_studies.md. Other pages
are made with --page, in the folder of that one.
"""

from __future__ import annotations

import argparse
import re
import resource
import sys
from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
for _folder in ("tests/support", "decks"):
    sys.path.insert(0, str(ROOT / _folder))


from comparison import CURVES, NUMBER, Curves, Number  # noqa: E402
from plydyn_post.style import COLOURS, DASHES, MEASURED, figure, save  # noqa: E402
from runner.pages import insert, table  # noqa: E402
from worst_rows import Row, overview, worst  # noqa: E402

HERE = Path(__file__).parent
PAGE = ROOT / "manual/verification.md"
HEADINGS = ("test", "quantity", "computed", "reference", "error [%]", "allowed [%]")
OF_PROBLEMS = ("problem", "tests", "row nearest to its tolerance", "error [%]", "allowed [%]")
#: Expensive tables: their marks, folders and modules
STUDIES = (
    ("delamination", "delamination", "study"),
    ("thin_arms", "delamination", "thin_arms"),
    ("reclosing", "reclosing", "study"),
    ("ply_damage", "ply_damage", "study"),
    ("bending_crack", "bending_crack", "study"),
)
#: Rows of one quantity in one test; more become the one that is off most
MOST_ROWS = 8
#: Panels of a figure, and how many stand side by side
MOST_PANELS, COLUMNS = 6, 2


class Collector:
    """Takes what tests compare from the reports of pytest."""

    def __init__(self) -> None:
        """Begin with nothing."""
        self.numbers: dict[str, dict[tuple[str, str], list[tuple[str, Number]]]] = {}
        self.curves: dict[str, list[Curves]] = defaultdict(list)
        self.tests: dict[str, int] = defaultdict(int)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Keep the comparisons of a test that has run."""
        if report.when != "call":
            return
        path, _, name = report.nodeid.partition("::")
        folder = Path(path).parent.name
        self.tests[folder] += 1
        test, _, choice = name.partition("[")
        rows = self.numbers.setdefault(folder, {})
        for key, value in report.user_properties:
            if key == NUMBER:
                number = Number(**value)
                rows.setdefault((test, number.name), []).append((choice.rstrip("]"), number))
            elif key == CURVES:
                self.curves[folder].append(Curves(**value))

    def rows(self, folder: str) -> list[list[str]]:
        """Cells of all numbers of a folder."""
        rows = []
        for (test, _), found in self.numbers.get(folder, {}).items():
            words = test.removeprefix("test_").replace("_", " ")
            shown = found
            if len(found) > MOST_ROWS:
                choice, number = max(found, key=lambda row: abs(row[1].error))
                shown = [(f"worst of {len(found)}: {choice}", number)]
            rows += [_row(words, choice, number) for choice, number in shown]
        return rows

    def section(self, folder: str, pictures: Path) -> str:
        """The worst rows and the figure of a folder."""
        text = summary(folder, self.tests[folder], self.rows(folder))
        if self.curves[folder]:
            picture = _draw(self.curves[folder], pictures / f"verification_{folder}.png")
            text += f"\n![Curves of {folder} beside their references](pictures/{picture.name})\n"
        return text


def summary(folder: str, tests: int, rows: Sequence[Row]) -> str:
    """How many tests there are, and the row of each that is nearest to its tolerance."""
    count = f"{tests} test{'' if tests == 1 else 's'}; [all rows](verification_tables.md#{folder})."
    return f"{count}\n\n{table(HEADINGS, worst(rows))}"


def _row(test: str, choice: str, number: Number) -> list[str]:
    """Cells of a number."""
    allowed = f"{_share(number.least)} to {_share(number.most)}"
    if number.least == -number.most:
        allowed = f"±{_share(number.most)}"
    name = f"{number.name} [{number.unit}]" if number.unit else number.name
    name = re.sub(r"\|", "/", f"{name} ({choice})" if choice else name)
    digits = (f"{value:.6g}" for value in (number.computed, number.reference))
    return [test, name, *digits, _share(number.error), allowed]


def _share(share: float) -> str:
    """A share in percent; round-off as its power of ten."""
    percent = 100.0 * share
    return f"{percent:.2g}" if abs(percent) < 0.1 else f"{percent:.2f}"


def _draw(drawn: Sequence[Curves], path: Path) -> Path:
    """Computed curves in colour over their references in black, a panel each."""
    panels = drawn[:MOST_PANELS]
    columns = min(COLUMNS, len(panels))
    rows = -(-len(panels) // columns)
    with figure(rows, columns, size=(3.3 * columns, 2.5 * rows), squeeze=False) as (made, grid):
        for axes in grid.flat[len(panels) :]:
            axes.axis("off")
        for axes, own in zip(grid.flat, panels, strict=False):
            for place, (name, curve) in enumerate(own.computed.items()):
                axes.plot(*curve, color=COLOURS[place], label=name, linewidth=2.2, alpha=0.8)
            for place, (name, curve) in enumerate(own.reference.items()):
                dash = DASHES[(place + 1) % len(DASHES)]
                axes.plot(*curve, color=MEASURED, linestyle=dash, label=name, linewidth=1.0)
            axes.set(xlabel=own.across, ylabel=own.up)
            axes.set_title(own.title, fontsize=8.5, loc="left")
            axes.legend(fontsize=7)
        return save(made, path)


def studies(folder: Path) -> dict[str, str]:
    """The expensive tables by their marks: beams, thin arms, closing faces, cracks."""
    tables = {}
    for mark, name, module in STUDIES:
        sys.path.insert(0, str(HERE / name))
        tables[f"{mark} study"] = "\n".join(__import__(module).rows(folder / mark))
        sys.path.pop(0)
        del sys.modules[module]
    return tables


def beside(page: Path, what: str) -> Path:
    """A page of the same verification that has more of it."""
    return page.with_name(f"{page.stem}_{what}{page.suffix}")


def main() -> int:
    """Run, and write the page; gives the exit code of pytest."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("folders", nargs="*", help="folders of tests/verification; all if none")
    parser.add_argument("--studies", action="store_true", help="with the expensive tables")
    parser.add_argument("--page", type=Path, default=PAGE, help="the page that gets the tables")
    parser.add_argument("--parallel", type=int, default=0, help="tests at a time")
    options = parser.parse_args()
    pictures = options.page.parent / "pictures"
    pictures.mkdir(exist_ok=True)
    codes = []
    for folder in options.folders or sorted(
        {path.parent.name for path in HERE.glob("*/test_*.py")}
    ):
        collector = Collector()
        words = ["-q", "-p", "no:cacheprovider", "-n", str(options.parallel), str(HERE / folder)]
        codes.append(int(pytest.main(words, plugins=[collector])))
        insert(options.page, folder, collector.section(folder, pictures))
        insert(beside(options.page, "tables"), folder, table(HEADINGS, collector.rows(folder)))
    text = options.page.read_text(encoding="utf-8")
    insert(options.page, "overview", table(OF_PROBLEMS, list(overview(text))))
    if options.studies:
        for mark, text in studies(ROOT / "results/study").items():
            insert(beside(options.page, "studies"), mark, text)
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    minutes = sum(one.ru_utime + one.ru_stime for one in used) / 60.0
    sys.stdout.write(f"{minutes:.1f} minutes of processor time\n")
    return max(codes)


if __name__ == "__main__":
    raise SystemExit(main())
