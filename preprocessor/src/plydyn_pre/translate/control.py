"""Title, units, end, step and outputs of a deck."""

from __future__ import annotations

from collections.abc import Iterator
from math import exp, inf, sqrt

from plydyn_pre.deck.cards import keyword, title_line
from plydyn_pre.errors import PreError
from plydyn_pre.translate.block import IDLE, REPLACED, TAKEN
from plydyn_pre.translate.bodies import Bodies
from plydyn_pre.translate.laws import modulus_across
from plydyn_pre.translate.model import Model
from plydyn_pre.translate.sets import Sets
from plydyn_pre.translate.stack import Stack

_OUTPUTS = {
    "DATABASE_GLSTAT": "DATABASE_GLSTAT",
    "DATABASE_NODOUT": "DATABASE_NODOUT",
    "DATABASE_SPCFORC": "DATABASE_SPCFORC",
    "DATABASE_RCFORC": "DATABASE_IMPACTOR",
    "DATABASE_BINARY_D3PLOT": "DATABASE_BINARY_D3PLOT",
}
#: Share of the stable step that plydyn takes with large displacement where a deck gives none
_USUAL_SHARE = 0.8
#: Stable step of a ply of order 2 over the time of a wave through it, with that share
_SHARE_OF_WAVE = 0.3
_MANY_STEPS = 1.0e5


def control_lines(model: Model, units: dict[str, str], impactor: bool) -> list[str]:
    """The keywords of control."""
    lines = []
    for block in model.find("TITLE"):
        block.mark(TAKEN, "", "TITLE")
        if block.has("TITLE"):
            lines.append(keyword("TITLE", title_line(str(block.raw("TITLE")))))
        break
    if units:
        lines.append(keyword("CONTROL_UNITS", units))
    end = model.first("CONTROL_TERMINATION")
    if end is None:
        raise PreError(f"{model.blocks[0].file}: *CONTROL_TERMINATION is missing")
    card = {"endtim": end.positive("ENDTIM"), "endcyc": end.whole("ENDCYC", 0)}
    lines += [keyword("CONTROL_TERMINATION", card), *_step(model)]
    return [*lines, *_damping(model, impactor), *_outputs(model, impactor)]


def _damping(model: Model, impactor: bool) -> Iterator[str]:
    """The keyword of damping, which is that of the plate alone."""
    for block in model.find("DAMPING_GLOBAL"):
        if block.raw("LCID", 0):
            block.lose("damping by a curve is not translated", "LCID")
        # zero in all three stands for one
        if {block.number(name, 0.0) for name in ("STX", "STY", "STZ")} not in ({0.0}, {1.0}):
            block.lose("damping of one direction is not translated", "STX")
        if (factor := block.number("VALDMP", 0.0)) > 0.0:
            yield keyword("DAMPING_GLOBAL", {"lcid": 0, "valdmp": factor})
            share = 1.0 - exp(-factor * model.end)
            if impactor:
                block.remarks.append(
                    "plydyn damps the plate alone; LS-DYNA also the impactor, which in free flight"
                    f" would lose {100.0 * share:.3g} % of its velocity by the end"
                )


def _outputs(model: Model, impactor: bool) -> list[str]:
    """The keywords of outputs."""
    lines = []
    for name, own in _OUTPUTS.items():
        for block in list(model.find(name))[:1]:
            interval = block.number("DT", 0.0)
            if own == "DATABASE_IMPACTOR" and not impactor:
                block.mark(IDLE, "there is no impactor", "DT")
            elif interval > 0.0:
                block.mark(TAKEN if own == name else REPLACED, f"*{own}", "DT")
                lines.append(keyword(own, {"dt": interval}))
    return lines


def step_of(model: Model) -> tuple[float, float]:
    """The share of the stable step, 0 for the usual one, and DT2MS."""
    share, scaled = 0.0, 0.0
    for block in model.find("CONTROL_TIMESTEP"):
        share = float(block.raw("TSSFAC", 0.0))
        share = share if 0.0 < share < _USUAL_SHARE else 0.0
        scaled = min(0.0, float(block.raw("DT2MS", 0.0)))
    return share, scaled


def _step(model: Model) -> list[str]:
    """The keyword of the step and of mass scaling, where they are not the usual ones."""
    share, scaled = step_of(model)
    for block in model.find("CONTROL_TIMESTEP"):
        block.lose_filled("mass scaling that grows over time is not translated", "DT2MSLC")
        if block.number("TSSFAC", 0.0) < 0.0:
            block.mark(REPLACED, f"a curve of it: {_USUAL_SHARE:g}", "TSSFAC")
        elif block.number("TSSFAC", 0.0) > _USUAL_SHARE:
            words = f"{_USUAL_SHARE:g}: with large displacement waves need room"
            block.mark(REPLACED, words, "TSSFAC")
        if float(block.raw("DT2MS", 0.0)) > 0.0:
            block.mark(IDLE, "elements with a larger step would lose mass", "DT2MS")
        elif scaled < 0.0:
            block.mark(TAKEN, "mass where the stable step of a ply over a quad is smaller", "DT2MS")
            model.notes.append(
                "DT2MS scales the mass of plies, whose stable step is smaller than that of shells: "
                "look at Mass scaling in the listing of plydyn check before a run"
            )
    card = {"dtinit": 0.0, "tssfac": share}
    if scaled < 0.0:
        card |= {"dt2ms": scaled}
    return [keyword("CONTROL_TIMESTEP", card)] if share or scaled else []


def read_history(model: Model, columns: dict[int, int], sets: Sets) -> list[int]:
    """Nodes with a history."""
    ids: set[int] = set()
    for block in model.find("DATABASE_HISTORY_NODE"):
        ids.update(block.ids("ID"))
        block.mark(TAKEN, "of the column of points that the node is in", "ID1")
    for block in model.find("DATABASE_HISTORY_NODE_SET"):
        with model.gathered():
            ids |= {n for sid in block.ids("ID") for n in sets.node_set(sid, block)}
    if lost := sorted(ids - columns.keys()):
        shown = ", ".join(map(str, lost[:8])) + (
            f" and {len(lost) - 8} more" if len(lost) > 8 else ""
        )
        model.notes.append(f"no history of nodes that are not of the plate: {shown}")
    return sorted({columns[n] for n in ids if n in columns})


def note_steps(model: Model, bodies: Bodies, stack: Stack) -> None:
    """Offer the implicit thickness where thin plies make the run long."""
    least = inf
    for ply in (ply for layer in stack.layers for zone in layer.zones for ply in zone.plies):
        law = bodies.laws.get(ply.material)
        if law is None:
            continue
        modulus, density = modulus_across(law), float(law.raw("RO", 0.0))
        if modulus > 0.0 and density > 0.0:
            least = min(least, ply.thickness * sqrt(density / modulus))
    steps = model.end / (_SHARE_OF_WAVE * least)
    if steps > _MANY_STEPS:
        model.notes.append(
            f"about {steps:.1g} steps, as waves cross the thinnest ply: *CONTROL_LAYERWISE with"
            " IMPL 2 (columns 21-30) makes the thickness implicit, for fewer; plydyn check counts"
        )
