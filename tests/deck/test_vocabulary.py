"""Identifiers of the solver are words of the field, not of a private language."""

from __future__ import annotations

import re
from collections.abc import Iterator

from runs import ROOT

#: Names that were replaced, each with the words of the field that stand for it
REPLACED = {
    "add_up": "sum",
    "awake": "due",
    "books": "energy balance",
    "borrowed": "receive",
    "brake": "damping",
    "crew": "thread_team",
    "culprit": "worst_point",
    "declare_known": "unsupported_keywords",
    "fate": "status",
    "find_awake": "find_due",
    "foot": "closest",
    "goes_ahead": "predicted",
    "ground": "active_facets",
    "guests": "ghost_columns",
    "halts": "output_next_step",
    "has_opened": "signal",
    "hopeless": "redundant",
    "is_ahead": "predicted",
    "journal": "output_manager, observers",
    "let_wait": "wait",
    "life_line": "progress_monitor",
    "loans": "strain_halo",
    "makers": "force_queue",
    "movers": "update_queue",
    "pull_column": "add_column_correction",
    "pulse": "progress_monitor",
    "reckon": "compute",
    "rim": "free_edge",
    "ripple": "half_step_correction",
    "slant": "inplane_gradient",
    "sleepers": "search_timers",
    "stages_of_plate": "model_readers",
    "stages_of_run": "run_readers",
    "step_back": "output_next_step",
    "suspect": "worst_point",
    "tally": "global_reduction",
    "tell": "broadcast",
    "told_card": "shown_card",
    "travel": "approach_bound",
    "turns": "work_queue",
    "unite": "merge",
    "wake": "due_at",
    "watch": "run_control",
}


def code(source: str) -> str:
    """Fortran without comments and texts, except for directives of OpenMP."""
    lines = (line for line in source.splitlines() if not re.match(r"\s*!(?!\$omp)", line))
    without_texts = re.sub(r'"[^"\n]*"', '""', "\n".join(lines))
    return re.sub(r"!(?!\$omp).*", "", without_texts)


def found(source: str) -> Iterator[str]:
    """Replaced names among the identifiers of a source."""
    names = set(re.findall(r"[a-z]\w*", code(source).lower()))
    yield from sorted(names & set(REPLACED))


def test_no_replaced_name_comes_back() -> None:
    """No identifier in ``src`` is one of the words that were replaced."""
    sources = [*(ROOT / "src").rglob("*.f90"), *(ROOT / "src").rglob("*.f90.in")]
    wrong = [
        f"{path.relative_to(ROOT)}: {name} (say {REPLACED[name]})"
        for path in sources
        for name in found(path.read_text())
    ]
    assert not wrong, "\n".join(wrong)


def test_a_replaced_name_is_found() -> None:
    """An identifier counts, a word of a comment or of a text does not."""
    source = 'call crew%take(n)  ! the journal\n! a watch\nwrite (*, *) "tally"\n'
    assert list(found(source)) == ["crew"]
