"""The quick start: what the impact on a small coupon comes to, for the README."""

from __future__ import annotations

from pathlib import Path

from plydyn_post.cscan import draw_cscan
from plydyn_post.delamination import draw_delamination
from readings import damage
from runner.cases import Case, Run, made_by
from runner.commands import Study, command
from runner.pages import Page, Section, draw_all

QUICK = Case("quickstart", "small_coupon/quickstart", "`quickstart`")
PICTURES = {"quickstart_interfaces.png": draw_delamination, "quickstart_cscan.png": draw_cscan}


@command()
def quick() -> Study:
    """The impact of the quick start, and its pictures; some minutes of one core."""
    return Study((QUICK,), _report)


def _report(runs: list[Run], folder: Path) -> list[Page]:
    impacts = [damage.read_impact(run) for run in runs]
    text = f"{damage.impacts_text(impacts)}\n{damage.areas_text(impacts)}\n{made_by(runs)}"
    drawn = draw_all(PICTURES, runs[0].results, folder)
    return [Page("quick", [Section("The quick start", text, "quick")], [*drawn.values()], drawn)]
