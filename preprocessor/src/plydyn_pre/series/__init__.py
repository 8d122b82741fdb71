"""Parameter studies: one recipe with lists of values, a folder for each case."""

from plydyn_pre.series.folders import Written, write_cases, written_cases
from plydyn_pre.series.plan import Case, Series, read_series
from plydyn_pre.series.pool import last_line, run_cases

__all__ = [
    "Case",
    "Series",
    "Written",
    "last_line",
    "read_series",
    "run_cases",
    "write_cases",
    "written_cases",
]
