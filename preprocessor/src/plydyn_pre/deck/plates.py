"""Keywords of laminates and of what joins their plies."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

from plydyn_pre.deck.cards import Card, keyword, title_line
from plydyn_pre.deck.names import Names
from plydyn_pre.study import ZONE_OF_CRACKS, Cohesive, Cracks, Laminate, runs

_REFERENCES = {"bottom": -1, "middle": 0, "top": 1}
_BASES = {"equispaced": 0, "gauss_lobatto": 1}
_PLACES = {"gauss": 0, "nodes": 1}
_CLOSINGS = {"falling": 0, "whole": 1}
_FITS = {"none": 0, "stiffness": 1, "strengths": 2, "both": 3}


def part_keywords(names: Names) -> Iterator[str]:
    """Laminate, expansion and joints of every part."""
    for part, pid in names.parts.items():
        laminate = names.study.laminate_of(part)
        title = laminate.title or f"{part} {laminate.layup}"
        yield keyword(
            "PART_COMPOSITE_LONG", title_line(title), _part(laminate, pid), *_plies(names, laminate)
        )
        yield keyword("SECTION_LAYERWISE", _section(laminate, pid), *_expansions(laminate))
        if not laminate.tied:
            joint = _joint(names, laminate, pid)
            yield keyword(
                "INTERFACE_COHESIVE", *({**joint, **place} for place in _ranges(laminate))
            )
    if names.study.cracks is not None:
        yield _crack_lines(names, names.study.cracks)


def _crack_lines(names: Names, cracks: Cracks) -> str:
    """The lines of the zone of cracks, their strengths, and their debris."""
    (whole, *_) = names.parts.values()
    lines = {
        "pid": names.parts.get(ZONE_OF_CRACKS, whole),
        "spacing": cracks.spacing,
        "gc": cracks.toughness(names.study.units),
        "fs": cracks.friction,
        "stiff": cracks.stiffness,
    }
    strengths = {"yt": cracks.YT, "sl": cracks.SL, "st": cracks.ST, "debris": cracks.debris}
    return keyword("CRACK_LINES", lines, strengths)


def _part(laminate: Laminate, pid: int) -> Card:
    """The first card of a laminate."""
    return {
        "pid": pid,
        "elform": 0,
        "shrf": 1.0,
        "nloc": _REFERENCES[laminate.reference],
    }


def _plies(names: Names, laminate: Laminate) -> Iterator[Card]:
    """A card for every ply, from the bottom up."""
    for plyid, ply in enumerate(laminate.stack, start=1):
        yield {
            "mid": names.material(ply.material),
            "thick": ply.thickness,
            "b": ply.angle,
            "plyid": plyid,
        }


def _section(laminate: Laminate, pid: int) -> Card:
    """The expansion of a laminate."""
    return {
        "pid": pid,
        "theory": 0,
        "order": laminate.order,
        "basis": _BASES[laminate.basis],
        "nqplan": 0,
        "nqthk": 0,
        "lump": 0,
    }


def _ranges(laminate: Laminate) -> Iterator[Card]:
    """Ranges of the interfaces that are not tied; zeros where none is."""
    opened = laminate.opened
    if len(opened) == len(laminate.stack) - 1:
        yield {"ifac1": 0, "ifac2": 0}
        return
    for group in runs(opened):
        yield {"ifac1": group[0], "ifac2": group[-1]}


def _joint(names: Names, laminate: Laminate, pid: int) -> Card:
    """What lies between plies of a laminate."""
    card = {"pid": pid, "ifac1": 0, "ifac2": 0}
    if laminate.joint == "apart":
        return card | {"mid": -1, "nq": 0}
    joint = names.study.joint_of(laminate)
    card |= {"mid": names.material(laminate.joint), "nq": _PLACES[joint.quadrature]}
    if not isinstance(joint, Cohesive):
        return card
    fit = _FITS[joint.fit]
    return {**card, "close": _CLOSINGS[joint.closing], "fric": joint.friction, "fit": fit}


def _expansions(laminate: Laminate) -> Iterator[Card]:
    """Ranges of plies whose expansion is not the usual one of a single layer."""
    numbered = enumerate(laminate.stack, start=1)
    for (order, layers), plies in groupby(numbered, lambda item: (item[1].order, item[1].layers)):
        places = [place for place, _ in plies]
        if (order, layers) != (laminate.order, 1):
            yield {"plyid1": places[0], "plyid2": places[-1], "plyorder": order, "nsub": layers}
