"""The sets of a recipe on its mesh, in words."""

from __future__ import annotations

from collections.abc import Iterator

from plydyn_pre.deck.names import Names
from plydyn_pre.mesh import Mesh
from plydyn_pre.mesh.quality import quad_areas
from plydyn_pre.study import REGIONS, Study


def set_lines(study: Study, mesh: Mesh) -> Iterator[str]:
    """Each set with its nodes, and with its quads and their area where it can have quads."""
    names, areas = Names(study, mesh), quad_areas(mesh)
    for name, rule in study.sets.items():
        nodes, quads = names.members_of(name)
        line = f"{name}: {len(nodes)} nodes"
        if rule.key in REGIONS:
            line += f", {len(quads)} quads, {areas[quads].sum():.6g} {study.units.length}2"
        yield line
