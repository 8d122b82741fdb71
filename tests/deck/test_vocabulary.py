"""Identifiers of the solver are words of the field, not of a private language."""

from __future__ import annotations

import re
from collections.abc import Iterator

from runs import ROOT

#: Names that were replaced, each with the words of the field that stand for it
REPLACED = {
    "abreast": "nodes_per_column, neighbours_at_once",
    "add_hold": "add_stiffness_forces",
    "add_borders": "add_shared_forces",
    "add_loans": "add_halo",
    "add_up": "sum",
    "awake": "due",
    "books": "energy balance",
    "borders": "shared_nodes",
    "borrowed": "receive",
    "brake": "damping",
    "build_share": "build_subdomain",
    "crew": "thread_team",
    "culprit": "worst_point",
    "declare_known": "unsupported_keywords",
    "delivery": "owner_reduction",
    "fate": "status",
    "fibre_gate": "growth_threshold",
    "find_awake": "find_due",
    "firm": "g_intact",
    "foot": "closest",
    "goes_ahead": "predicted",
    "grip": "friction_stiffness",
    "ground": "active_facets",
    "guest": "ghost",
    "guests": "ghost_columns",
    "halts": "output_next_step",
    "hand_over": "take",
    "has_opened": "signal",
    "health": "stability_monitor",
    "hold_type": "support_type",
    "hopeless": "redundant",
    "idle_push": "compression_tolerance",
    "is_ahead": "predicted",
    "journal": "output_manager, observers",
    "judge": "detect_growth",
    "keeper": "owner",
    "least_led": "min_path_ratio",
    "lend": "send",
    "lent": "sent",
    "let_go": "penalty_release",
    "let_wait": "wait",
    "life_line": "progress_monitor",
    "loans": "strain_halo",
    "maker": "force_chunk",
    "makers": "force_queue",
    "mover": "update_chunk, motion",
    "movers": "update_queue",
    "name_kind": "register_kind",
    "pull_column": "add_column_correction",
    "pulse": "progress_monitor",
    "quiet": "elastic_path",
    "recall": "stress_at",
    "reckon": "compute",
    "resist": "find_point_forces",
    "rim": "edge, free_edge",
    "ripple": "half_step_correction",
    "rub": "add_friction",
    "settle": "solve_active_set",
    "site": "output_node",
    "sites": "output nodes",
    "slab": "hyperslab",
    "slant": "inplane_gradient",
    "sleepers": "search_timers",
    "spot": "location",
    "stages_of_plate": "model_readers",
    "stages_of_run": "run_readers",
    "steady": "no_growth_path",
    "step_back": "output_next_step",
    "suspect": "worst_point",
    "tally": "global_reduction",
    "tell": "broadcast",
    "told": "reported",
    "told_card": "shown_card",
    "travel": "approach_bound",
    "turning": "moment_force",
    "turns": "work_queue",
    "unfelt": "mode_shape",
    "unite": "merge",
    "wake": "due_at",
    "watch": "run_control",
}

#: Words that no text of the solver or of its pages uses, with those of the field
REPLACED_WORDS = {
    "abreast": "side by side, at once",
    "borrows": "receives",
    "crew": "threads",
    "culprit": "what is at fault, by name",
    "guests": "ghosts",
    "keepers": "owners",
    "lends": "sends",
    "lent": "sent",
    "loans": "halo",
    "reckon": "compute",
    "reckoned": "computed",
    "reckons": "computes",
    "ripple": "half-step correction",
    "sleepers": "timers",
    "tally": "counts, sums",
    "told": "reported, prescribed",
    "whoever": "the module or routine, by name",
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
    """No identifier of the solver and of its unit tests is one of the words that were replaced."""
    sources = [*(ROOT / "src").rglob("*.f90"), *(ROOT / "src").rglob("*.f90.in")]
    sources += (ROOT / "tests" / "unit").glob("*.f90")
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


def words(text: str) -> set[str]:
    """Replaced words of comments, messages and pages."""
    return set(re.findall(r"[a-z]+", text.lower())) & set(REPLACED_WORDS)


def test_no_replaced_word_comes_back() -> None:
    """Neither the sources, their comments and messages among them, nor a page has one.

    The page about the time before the first release names what was called so then.
    """
    texts = [
        *(ROOT / "src").rglob("*.f90"),
        *(ROOT / "src").rglob("*.f90.in"),
        *(ROOT / "tests" / "unit").glob("*.f90"),
        *(page for page in (ROOT / "manual").rglob("*.md") if page.name != "development.md"),
        *(ROOT / "decks").rglob("*.md"),
    ]
    wrong = [
        f"{path.relative_to(ROOT)}: {word} (say {REPLACED_WORDS[word]})"
        for path in texts
        for word in sorted(words(path.read_text()))
    ]
    assert not wrong, "\n".join(wrong)
