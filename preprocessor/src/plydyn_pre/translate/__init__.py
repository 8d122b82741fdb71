"""Decks of other programs as decks of plydyn, with a page that tells of every field."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from re import sub

from plydyn_pre.errors import PreError
from plydyn_pre.files import is_file
from plydyn_pre.study import Study
from plydyn_pre.translate import abaqus, nastran
from plydyn_pre.translate.block import TranslateError
from plydyn_pre.translate.bodies import Bodies, NoPlateError, read_bodies
from plydyn_pre.translate.contacts import read_contacts
from plydyn_pre.translate.control import control_lines, note_steps, read_history
from plydyn_pre.translate.coupon import Coupon
from plydyn_pre.translate.deck import Curves, Plate, condition_lines, laminate_lines, mesh_lines
from plydyn_pre.translate.joints import read_joints
from plydyn_pre.translate.layups import layup_notes
from plydyn_pre.translate.loads import Gravity, read_forces, read_gravity, read_pressures
from plydyn_pre.translate.model import Model, Place, settle
from plydyn_pre.translate.page import page_text
from plydyn_pre.translate.plies import Like
from plydyn_pre.translate.reader import read_deck
from plydyn_pre.translate.rigid import read_rigid
from plydyn_pre.translate.rigid_text import rigid_lines
from plydyn_pre.translate.source import LSDYNA, ONLY_A_MESH, Source, program_of
from plydyn_pre.translate.stack import Stack, read_stack, with_mid_sides
from plydyn_pre.translate.supports import read_supports
from plydyn_pre.translate.systems import units_of
from plydyn_pre.translate.twice import numbered_twice
from plydyn_pre.translate.velocities import Velocities, read_velocities
from plydyn_pre.translate.walls import read_walls

__all__ = ["Choices", "TranslateError", "Translation", "translation"]

_NO_DELAMINATION = (
    "no delamination, as in the deck that was translated: all plies are tied; *INTERFACE_COHESIVE"
    " and *MAT_COHESIVE_MIXED_MODE let them fail"
)
_MOST = 5  # problems of a kind that are told
#: What a program calls keywords that messages about a whole deck name
_CALLED = {
    "Abaqus": {
        "*CONTROL_TERMINATION is missing": "*DYNAMIC, EXPLICIT is missing",
        "*PART_COMPOSITE with shells": "*SHELL SECTION, COMPOSITE",
        "CON1 7 and CON2 7 make": "*BOUNDARY of its reference node in all directions makes",
    },
    "Nastran": {
        "*CONTROL_TERMINATION is missing": "TSTEPNL or TSTEP is missing",
        "*PART_COMPOSITE with shells": "PCOMP with CQUAD4",
        "CON1 7 and CON2 7 make": "SPC of its node GN in all directions makes",
    },
}


@dataclass(frozen=True)
class Choices:
    """What the user says beside the deck."""

    like: str = ""  # a ply of the library, whose toughnesses stand in for those of a card
    units: str = ""  # of the deck: length, time and mass with commas between
    allow_lost: bool = False  # whether what changes the result may be lost


@dataclass
class Translation:
    """A deck of plydyn, and what there is to say of it."""

    lines: list[str]
    page: str  # in Markdown
    notes: list[str]  # what to look at first
    study: Study | None  # of a standard coupon
    causes: list[str]  # why it is none


def translation(source: Path, deck: Path, choices: Choices = Choices()) -> Translation:
    """A deck of another program as one of plydyn."""
    read = _read(source)
    inputs = {block.file.resolve() for block in read.shown} | {source.resolve()}
    for path in (deck, deck.with_suffix(".md")):
        if path.resolve() in inputs:
            raise PreError(f"{path} is a file of the deck that is read; give another name")
    model = Model(read.blocks, read.problems)
    made = Translation([], "", [], None, [])
    with model.gathered():
        _fill(made, model, choices)
    settle(model, whole=bool(made.lines))
    blocks = dict.fromkeys((*read.shown, *read.blocks))
    losses = [loss for block in blocks for loss in block.losses]
    if not choices.allow_lost:
        model.problems += losses
    if losses and not made.lines:  # a missing plate has its cause in what is lost
        model.problems = [each for each in model.problems if not isinstance(each, NoPlateError)]
        model.problems += [loss for loss in losses if loss not in model.problems]
    if model.problems:
        may_lose = bool(losses) and not choices.allow_lost
        raise PreError(_told(source, read.program, model.problems, may_lose=may_lose))
    made.notes = [f"LOST: {loss}" for loss in losses] + model.notes
    # what stands in for constants of plies, and other remarks of keywords
    made.notes += [
        f"{b.title}, line {b.line}: {words}" for b in blocks for words in dict.fromkeys(b.remarks)
    ]
    made.page = page_text(source, deck, read, made.notes)
    return made


def _read(source: Path) -> Source:
    """The model of a deck of any program."""
    program = program_of(source) if is_file(source) else LSDYNA
    if program != LSDYNA:
        return (abaqus if program == "Abaqus" else nastran).read(source)
    blocks, problems = read_deck(source)
    kinds = {block.name.split("_")[0] for block in blocks}
    if not problems and "ELEMENT" in kinds and "MAT" not in kinds:
        raise PreError(f"{source}: this deck has {ONLY_A_MESH}")
    return Source(program, blocks, blocks, problems + numbered_twice(blocks))


def _told(source: Path, program: str, problems: list[PreError], *, may_lose: bool) -> str:
    """All that is wrong; of each kind the first few."""
    kinds: dict[str, list[str]] = {}
    for text in dict.fromkeys(map(str, problems)):
        for ours, theirs in _CALLED.get(program, {}).items():
            text = text.replace(ours, theirs)  # noqa: PLW2901
        kinds.setdefault(sub(r"[\d.]+", "", text), []).append(text)
    lines = [f"{source} is a deck of {program}"] if program != LSDYNA else []
    for texts in kinds.values():
        lines += texts[:_MOST]
        lines += [f"... and {len(texts) - _MOST} more of this kind"] if len(texts) > _MOST else []
    if may_lose:
        lines.append("what is not translated changes the result; --allow-lost makes it a note")
    return "\n".join(lines)


def _fill(made: Translation, model: Model, choices: Choices) -> None:
    """Make the lines of the deck, and the study of a coupon."""
    before = len(model.problems)
    bodies = read_bodies(model)
    whole = len(model.problems) == before and bool(bodies.plates)
    contacts = read_contacts(model, bodies)
    velocities = read_velocities(model, bodies)
    stack = read_stack(model, bodies) if whole else Stack([])
    if not stack.quads:
        _read_rest(model, bodies)
        return
    joints = read_joints(model, bodies, stack, contacts)
    rigid = read_rigid(model, bodies, stack, contacts, velocities)
    rigid += read_walls(model, bodies, stack)
    units = units_of(model, bodies, choices.units, needed=bool(choices.like))
    gravity = read_gravity(model)
    plate = Plate(
        model,
        bodies,
        stack,
        joints,
        rigid,
        read_supports(model, bodies, stack),
        read_forces(model, bodies, stack),
        read_pressures(model, bodies, stack),
        gravity,
        _plate_velocities(model, bodies, stack, velocities),
        read_history(model, stack.column_of, bodies.sets),
        Like(choices.like, units),
    )
    if sum(len(layer.plies) for layer in stack.layers) > 1 and not joints:
        model.notes.append(_NO_DELAMINATION)
    note_steps(model, bodies, stack)
    curves = Curves(model)
    impactor = any(each.moves for each in rigid)
    _check_weight(model, gravity if impactor else [])
    laminate = list(laminate_lines(plate, curves))
    model.notes += (note for plies in plate.laminates for note in layup_notes(plies))
    body = [*laminate, *rigid_lines(plate, curves), *condition_lines(plate, curves)]
    control = control_lines(model, dict(units), impactor)
    made.lines = ["*KEYWORD", *control, *body, *curves.lines(), *mesh_lines(plate), "*END"]
    if not model.problems:
        coupon = Coupon(plate)
        title = model.first("TITLE")
        words = str(title.raw("TITLE", "")) if title else ""
        made.study = coupon.study(words or model.blocks[0].file.stem, dict(units))
        made.causes = coupon.causes


def _check_weight(model: Model, gravity: list[Gravity]) -> None:
    """Refuse an impactor whose weight varies."""
    for each in gravity:
        block = model.first(f"LOAD_BODY_{each.axis.upper()}")
        if block is not None and not each.steady():
            block.lose("the weight of an impactor that varies over time is not translated", "LCID")


def _read_rest(model: Model, bodies: Bodies) -> None:
    """Look at what does not need the plate, where there is none, for what is wrong with it."""
    anywhere = Stack([], column_of={nid: nid for nid in bodies.nodes})
    read_supports(model, bodies, anywhere)
    read_forces(model, bodies, anywhere)
    read_gravity(model)
    control_lines(model, {}, impactor=False)


def _plate_velocities(
    model: Model, bodies: Bodies, stack: Stack, velocities: Velocities
) -> dict[Place, list[int]]:
    """Nodes of the plane by their velocity at time zero."""
    found: dict[Place, set[int]] = {}
    rigid = {n for body in bodies.rigid for n in body.nodes}
    for node, velocity in velocities.nodes.items():
        if node in stack.column_of and any(velocity):
            found.setdefault(velocity, set()).add(node)
        elif node not in rigid and node not in stack.column_of and node not in bodies.nodes:
            block, line = velocities.where[node]
            model.problems.append(block.fail("NID", f"there is no node {node}", line))
    return {velocity: with_mid_sides(stack, ids) for velocity, ids in found.items()}
