"""Runs: from a recipe or a study to results, by the solver of this machine."""

from plydyn_pre.runs.chain import Job, make_report, print_line, put_decks, run
from plydyn_pre.runs.pristine import without_blow
from plydyn_pre.runs.process import Ended, follow, passing_on, share_done
from plydyn_pre.runs.programs import chain_of, find_program

__all__ = [
    "Ended",
    "Job",
    "chain_of",
    "find_program",
    "follow",
    "make_report",
    "passing_on",
    "print_line",
    "put_decks",
    "run",
    "share_done",
    "without_blow",
]
