"""Decks of the stages of a chain, each for a restart from the end of the one before."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import fields, replace
from itertools import chain

from plydyn_pre.deck import conditions, control
from plydyn_pre.deck.cards import keyword, title_line
from plydyn_pre.deck.fixtures import fixture_keywords
from plydyn_pre.deck.names import Names
from plydyn_pre.deck.places import check_kept_levers, check_places
from plydyn_pre.errors import RecipeError
from plydyn_pre.mesh import Mesh
from plydyn_pre.study import Stage, Study
from plydyn_pre.version import VERSION

#: Numbers of sets, curves and fixtures that a stage may use
NUMBERS = 1000
#: Steps that no run makes: a restart file at the end alone
END_ALONE = 999_999_999
#: Keys of a stage
_KEYS = {each.name for each in fields(Stage)}


def end_keyword(study: Study) -> Iterator[str]:
    """The restart file at the end, where a stage follows."""
    if study.stages:
        yield keyword("DATABASE_BINARY_D3DUMP", {"cycl": END_ALONE})


def stage_text(study: Study, mesh: Mesh, number: int, deck_sum: str) -> Iterator[str]:
    """The deck of a stage, counted from 1; the sum is that of the first deck of the chain."""
    with _blaming(number):
        yield from _stage(study, mesh, number, deck_sum)


def _stage(study: Study, mesh: Mesh, number: int, deck_sum: str) -> Iterator[str]:
    """The deck of a stage; errors name keys within its table."""
    stage = study.stages[number - 1]
    names = Names(_part(study, stage), mesh, first=NUMBERS * number + 1)
    check_places(names)
    check_kept_levers(names, study.loads)
    yield f"*KEYWORD\n$ written by plydyn-pre {VERSION}\n$ stage {number} of {deck_sum}"
    yield keyword("TITLE", title_line(f"{study.title}: {stage.name}"))
    yield keyword("CONTROL_STAGE", {"time": 1})
    yield keyword("CONTROL_TERMINATION", {"endtim": stage.end_time, "endcyc": 0})
    if _waits(study):
        yield control.contact_end_keyword(stage.until_contact_ends)
    yield keyword("DAMPING_RELAXATION", {"drtol": stage.at_rest})
    if stage.damping is not None:
        yield keyword("DAMPING_GLOBAL", {"valdmp": stage.damping})
    if stage.mass_scaled_step is not None:
        scaled = replace(study.control, mass_scaled_step=stage.mass_scaled_step, first_step=0.0)
        yield control.step_keyword(scaled, names.curve(scaled.step_curve))
    watched = [study.control.quasi_static, *(run.quasi_static for run in study.stages[:number])]
    if any(share is not None for share in watched):
        yield control.quasi_static_keyword(stage)
    yield from _removed(study, number)
    yield keyword("DATABASE_BINARY_D3DUMP", {"cycl": END_ALONE})
    yield from chain(
        control.interval_keywords(names),
        conditions.impactor_keywords(names, number + 1),
        conditions.support_keywords(names) if stage.supports or stage.loads else (),
        fixture_keywords(names, NUMBERS * number + 1),
        conditions.load_keywords(names),
        conditions.curve_keywords(names),
        conditions.set_keywords(names),
    )
    yield "*END"


def _waits(study: Study) -> bool:
    """Whether any run of a chain ends after its contact."""
    waits = [study.control.until_contact_ends, *(run.until_contact_ends for run in study.stages)]
    return max(waits) > 0.0


@contextmanager
def _blaming(number: int) -> Iterator[None]:
    """Put the number of a stage before the keys of an error that are its own."""
    try:
        yield
    except RecipeError as error:
        of_stage = error.path.partition("[")[0].partition(".")[0] in _KEYS
        raise error.within(f"stages[{number}]" if of_stage else "") from error


def _part(study: Study, stage: Stage) -> Study:
    """A study that has the bodies, supports, loads and outputs of the stage alone."""
    return replace(
        study,
        supports=stage.supports,
        loads=stage.loads,
        fixtures=stage.fixtures,
        impactor=stage.impactor,
        contact=stage.contact,
        control=replace(study.control, until_contact_ends=0.0),
        outputs=replace(stage.outputs, fields=None),
        stages=(),
    )


def _removed(study: Study, number: int) -> Iterator[str]:
    """The bodies that the stage takes away."""
    impactor = 0
    fixtures: list[int] = []
    for k, part in enumerate(study.parts_of_chain[: number + 1]):
        gone = part.remove if isinstance(part, Stage) else ()
        if k == number and "impactor" in gone:
            yield keyword("DELETE_IMPACTOR", {"iid": impactor})
        if "fixtures" in gone:
            if k == number:
                yield keyword("DELETE_FIXTURE", *({"fid": fid} for fid in fixtures))
            fixtures = []
        if part.impactor is not None:
            impactor = k + 1
        first = NUMBERS * k + 1
        fixtures += range(first, first + len(part.fixtures))
