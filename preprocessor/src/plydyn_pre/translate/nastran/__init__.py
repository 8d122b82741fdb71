"""Bulk data of Nastran."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from plydyn_pre.errors import PreError
from plydyn_pre.translate.nastran.bodies import put_rigid_bodies, read_rigid_bodies
from plydyn_pre.translate.nastran.conditions import (
    put_contacts,
    put_loads,
    put_supports,
    put_velocities,
)
from plydyn_pre.translate.nastran.lines import read_deck
from plydyn_pre.translate.nastran.mesh import Mesh, read_mesh
from plydyn_pre.translate.nastran.parts import put_parts
from plydyn_pre.translate.source import ONLY_A_MESH, Source, settle_shown

_HISTORY = 1000  # forces of the impactor over the run, where nothing asks for others


def read(path: Path) -> Source:
    """The model of a file of bulk data."""
    deck = read_deck(path)
    source = Source("Nastran", deck.shown, problems=deck.problems)
    mesh = read_mesh(source, deck)
    if not mesh.nodes:
        raise PreError(f"{path}: this deck of Nastran has no nodes")
    if not any(card.name.startswith("MAT") for card in deck.cards):
        raise PreError(f"{path}: this deck of Nastran has {ONLY_A_MESH}")
    if title := deck.case.get("TITLE"):
        source.put("TITLE", title.block, {"TITLE": title.at(0)})
    end = _end(mesh)
    bodies = read_rigid_bodies(mesh)
    put_supports(mesh, bodies)
    put_velocities(mesh, bodies)
    put_rigid_bodies(mesh, bodies)
    put_parts(mesh, {element.number for body in bodies for element in body.elements})
    put_contacts(mesh, bodies)
    put_loads(mesh, end)
    source.put_nodes(next(deck.each("GRID")).block, mesh.nodes.items())
    settle_shown(source)
    return source


def _end(mesh: Mesh) -> float:
    """Add the end of the run and the history of the force; its time."""
    wanted = mesh.deck.chosen("TSTEPNL") or mesh.deck.chosen("TSTEP")
    for card in mesh.deck.each("TSTEPNL", "TSTEP"):
        sid = "ID" if card.name == "TSTEPNL" else "SID"
        if wanted and card.whole(sid) != wanted:
            continue
        names = ("NDT", "DT") if card.name == "TSTEPNL" else ("N1", "DT1")
        with mesh.source.gathered():
            end = card.whole(names[0], None) * card.number(names[1], None)
            line: dict[str, Any] = {"line": card.line, "names": {"ENDTIM": " ".join(names)}}
            mesh.source.put("CONTROL_TERMINATION", card.block, {"ENDTIM": end}, **line)
            every = card.whole("NO" if card.name == "TSTEPNL" else "NO1")
            interval = every * card.number(names[1]) if every > 0 else end / _HISTORY
            mesh.source.put("DATABASE_RCFORC", card.block, {"DT": interval})
            return end
    return 0.0
