"""The loading rate of a compression test after impact, halved until the strength stays."""

from __future__ import annotations

from plydyn_post.compression import Compression, read_compression
from runner.cases import Case, Run, made_by
from runner.commands import Study, command
from runner.pages import Quantity, change, one_section, percent, table

#: Rates of the end, mm/s, each half of the one before; the second is that of the template
RATES = (125.0, 62.5, 31.25)
#: End shortening at the end of the test, mm, and half of the time in which the velocity rises, s
REACH, DELAY = 0.9, 0.5e-3
#: The compression in the recipe
STAGE = "stages[2]"
COLUMNS = (
    Quantity("strength [MPa]", lambda test: test.strength, ".1f"),
    Quantity("end shortening [mm]", lambda test: float(test.shortening[test.peak]), ".4f"),
    Quantity("kinetic / internal", lambda test: percent(test.kinetic_share())),
)


@command()
def rate() -> Study:
    """Compression after impact at a loading rate that is halved, for decks/validation/README.md."""
    return Study(rate_cases(), one_section("Loading rate", _text, "rate"))


def rate_cases() -> list[Case]:
    """The chain of the blind strength at each rate, up to the same end shortening."""
    return [
        Case(
            f"rate_{number}",
            "validation/t700gc_25J_cai",
            f"{value:g} mm/s",
            varied=(
                f"{STAGE}.loads[1].value={-value}",
                f"{STAGE}.end_time={REACH / value + DELAY:.6g}",
            ),
            stages=("settle", "compression"),
        )
        for number, value in enumerate(RATES, start=1)
    ]


def _text(runs: list[Run]) -> str:
    tests = [(run.case.label, read_compression(run.results)) for run in runs]
    return f"{rates_text(tests)}\n{made_by(runs)}"


def rates_text(tests: list[tuple[str, Compression]]) -> str:
    """A row for each rate, with the change of the strength from the rate before."""
    rows, before = [], None
    for label, test in tests:
        halved = "" if before is None else change(test.strength, before)
        rows.append([label, *(one.cell(test) for one in COLUMNS), halved])
        before = test.strength
    headings = [one.heading for one in COLUMNS]
    return table(["rate", *headings, "change by halving"], rows)
