"""Decks of bricks: a plate drawn through its plies."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from math import cos, radians, sin

import numpy as np

from plydyn_pre.deck import conditions, control
from plydyn_pre.deck.cards import Card, coordinate_text, id_cards, keyword, titled
from plydyn_pre.deck.fixtures import fixture_keywords
from plydyn_pre.deck.materials import material_keyword
from plydyn_pre.deck.names import Names
from plydyn_pre.errors import RecipeError
from plydyn_pre.extrude import Extrusion, extrude, laminate_of_all
from plydyn_pre.mesh.grid import Integers
from plydyn_pre.study import (
    Bricks,
    FrameAcceleration,
    InitialVelocity,
    Load,
    Motion,
    PlyCodam2,
    PlyElastic,
    PlyFracture3d,
    StackPly,
)

_CHUNK = 1000
_LARGEST_ID = 99_999_999  # of eight columns
_CONTROLS = {"viscous": 3, "stiffness": 6}
#: Sets of nodes on some levels: their names and faces, to their numbers
Sets = dict[tuple[str, str], int]


def brick_keywords(names: Names) -> Iterator[str]:
    """All keywords of a deck of bricks."""
    study = names.study
    bricks, plate = study.bricks or Bricks(), extrude(study, names.mesh)
    names.mesh = plate.plane
    if study.outputs.profiles:
        raise RecipeError("outputs.profiles", "bricks have none; set it to []")
    parts = _parts(names)
    sets: Sets = {}
    yield from chain(
        control.control_keywords(names),
        _outputs(names, sets),
        _section(bricks),
        _part_keywords(names, parts),
        _impactor(names, parts),
        _supports(names, sets),
        fixture_keywords(names),
        _loads(names, sets),
        conditions.curve_keywords(names),
        _set_keywords(names, plate, sets),
        _nodes(plate),
        _elements(names, plate, parts),
    )


def _parts(names: Names) -> Integers:
    """Part of each ply, from 1: plies of one material and angle are one part."""
    stack = laminate_of_all(names.study, names.mesh).stack
    known: dict[tuple[str, float], int] = {}
    return np.array([known.setdefault(_kind(names, ply), len(known) + 1) for ply in stack])


def _kind(names: Names, ply: StackPly) -> tuple[str, float]:
    """Material of a ply, and its angle where that matters."""
    material = names.study.materials[ply.material]
    has_fibres = isinstance(material, PlyElastic | PlyCodam2 | PlyFracture3d)
    return ply.material, ply.angle % 180.0 if has_fibres else 0.0


def _section(bricks: Bricks) -> Iterator[str]:
    """Integration and hourglass control."""
    one = bricks.points == "one"
    yield keyword("SECTION_SOLID", {"secid": 1, "elform": 1 if one else 2})
    if one:
        yield keyword(
            "CONTROL_HOURGLASS", {"ihq": _CONTROLS[bricks.hourglass], "qh": bricks.coefficient}
        )


def _part_keywords(names: Names, parts: Integers) -> Iterator[str]:
    """A part and a material for each material and angle."""
    stack = laminate_of_all(names.study, names.mesh).stack
    for pid in range(1, parts.max() + 1):
        ply = stack[int(np.argmax(parts == pid))]
        name, angle = _kind(names, ply)
        others = {"eosid": 0, "hgid": 0, "grav": 0, "adpopt": 0, "tmid": 0}
        yield keyword("PART", f"{name} {angle:g}", {"pid": pid, "secid": 1, "mid": pid, **others})
        material = names.study.materials[name]
        if isinstance(material, PlyElastic):
            yield titled(
                "MAT_ORTHOTROPIC_ELASTIC", material.title or name, *_turned(material, pid, angle)
            )
        else:
            yield material_keyword(names, name, pid)


def _turned(material: PlyElastic, mid: int, angle: float) -> tuple[Card, ...]:
    """A ply by its axes a, along the fibres, and d, across in the plane."""
    minor = {
        "prba": material.nu12 * material.E2 / material.E1,
        "prca": material.nu13 * material.E3 / material.E1,
        "prcb": material.nu23 * material.E3 / material.E2,
    }
    young = {"ea": material.E1, "eb": material.E2, "ec": material.E3}
    c, s = cos(radians(angle)), sin(radians(angle))
    return (
        {"mid": mid, "ro": material.density} | young | minor,
        {"gab": material.G12, "gbc": material.G23, "gca": material.G13, "aopt": 2.0},
        {"a1": c, "a2": s, "a3": 0.0, "macf": 1},
        {"d1": -s, "d2": c, "d3": 0.0},
    )


def _outputs(names: Names, sets: Sets) -> Iterator[str]:
    """Intervals, fields, and nodes with a history."""
    yield from control.interval_keywords(names)
    ids = [_set_number(sets, name, "all") for name in names.study.outputs.nodes]
    if ids:
        yield keyword("DATABASE_HISTORY_NODE_SET", *id_cards(ids))


def _impactor(names: Names, parts: Integers) -> Iterator[str]:
    """The impactor, against the part of the outermost ply."""
    if names.study.impactor is None:
        return
    outer = parts[-1] if names.study.touch.face == "top" else parts[0]
    laminate = laminate_of_all(names.study, names.mesh)
    yield from conditions.impactor_on(names, laminate, int(outer))


def _supports(names: Names, sets: Sets) -> Iterator[str]:
    """What holds the plate."""
    for support in names.study.held:
        if support.face == "plane":
            raise RecipeError("supports", "bricks are held on a face or on all levels")
        yield conditions.held_set(support, _set_number(sets, support.set, support.face))


def _loads(names: Names, sets: Sets) -> Iterator[str]:
    """What drives the plate: motions, velocities and accelerated frames."""
    for number, load in enumerate(names.study.loads, start=1):
        yield _load(names, load, sets, f"loads[{number}]")


def _load(names: Names, load: Load, sets: Sets, path: str) -> str:
    """The keyword of a load."""
    match load:
        case Motion():
            nsid = _set_number(sets, load.set, load.face)
            place = {"nsid": nsid, "dof": conditions.DIRECTIONS[load.direction]}
            place |= {"vad": conditions.QUANTITIES[load.quantity]}
            factor = {"lcid": names.written_curve(load.curve), "sf": load.value}
            times = {"death": 1.0e28, "birth": 0.0}
            return keyword("BOUNDARY_PRESCRIBED_MOTION_SET", place | factor | times)
        case InitialVelocity():
            nsid = 0 if load.set == "all" else _set_number(sets, load.set, "all")
            return conditions.initial_velocity(load, nsid)
        case FrameAcceleration():
            return conditions.frame_acceleration(names, load)
        case _:
            raise RecipeError(path, "bricks take motions, velocities and accelerated frames only")


def _set_number(sets: Sets, name: str, face: str) -> int:
    """Number of the nodes of a set on a face, or on all levels."""
    return sets.setdefault((name, face), len(sets) + 1)


def _set_keywords(names: Names, plate: Extrusion, sets: Sets) -> Iterator[str]:
    """The sets that are used."""
    levels = np.arange(len(plate.heights))
    chosen = {"all": levels, "bottom": levels[:1], "top": levels[-1:]}
    for (name, face), sid in sets.items():
        ids = plate.node_ids(names.nodes_of(name, f"set {name}"), chosen[face])
        yield titled("SET_NODE_LIST", f"{name} {face}", conditions.set_card(sid), *id_cards(ids))


def _nodes(plate: Extrusion) -> Iterator[str]:
    """The nodes, level by level from the bottom up."""
    if plate.nodes > _LARGEST_ID:
        raise RecipeError("bricks", f"{plate.nodes} nodes do not fit the eight columns of a number")
    yield "*NODE\n$#   nid               x               y               z      tc      rc"
    places = [[coordinate_text(x) for x in place] for place in plate.plane.nodes.tolist()]
    for level, height in enumerate(plate.heights.tolist()):
        first = level * len(places) + 1
        z = f"{coordinate_text(height + plate.plane.height):>16}{0:8d}{0:8d}"
        lines = [f"{first + i:8d}{x:>16}{y:>16}{z}" for i, (x, y) in enumerate(places)]
        for start in range(0, len(lines), _CHUNK):
            yield "\n".join(lines[start : start + _CHUNK])


def _elements(names: Names, plate: Extrusion, parts: Integers) -> Iterator[str]:
    """The bricks, layer by layer from the bottom up."""
    fields = "".join(f"{f'n{i}':>8}" for i in range(1, 9))
    quads = len(plate.plane.quads)
    stack = laminate_of_all(names.study, names.mesh).stack
    before = ""
    for layer, ply in enumerate(plate.plies.tolist()):
        axes = _axes(names, stack[ply])
        element = "ELEMENT_SOLID_ORTHO" if axes else "ELEMENT_SOLID"
        if element != before:
            yield f"*{element}\n$#   eid     pid{fields}"
        before = element
        rows = plate.brick_nodes(layer).tolist()
        head = layer * quads + 1
        part = f"{parts[ply]:8d}"
        lines = [
            f"{head + i:8d}{part}{''.join(f'{node:8d}' for node in row)}{axes}"
            for i, row in enumerate(rows)
        ]
        for start in range(0, quads, _CHUNK):
            yield "\n".join(lines[start : start + _CHUNK])


def _axes(names: Names, ply: StackPly) -> str:
    """Lines with the axes of a brick, where its material does not tell them."""
    if not isinstance(names.study.materials[ply.material], PlyCodam2 | PlyFracture3d):
        return ""
    c, s = (coordinate_text(f(radians(ply.angle))) for f in (cos, sin))
    minus, zero = coordinate_text(-sin(radians(ply.angle))), coordinate_text(0.0)
    return f"\n{c:>16}{s:>16}{zero:>16}\n{minus:>16}{c:>16}{zero:>16}"
