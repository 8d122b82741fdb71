"""Keywords of nodes and quads, some lines at a time."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from plydyn_pre.deck.cards import coordinate_text
from plydyn_pre.deck.names import Names
from plydyn_pre.errors import MeshError

_CHUNK = 1000
_LARGEST_ID = 99_999_999  # of eight columns
_NODE_HEADER = "$#   nid               x               y               z      tc      rc"
_QUAD_HEADER = "$#   eid     pid"


def node_keyword(names: Names) -> Iterator[str]:
    """The nodes: the keyword, then lines in chunks."""
    mesh = names.mesh
    _check_ids(mesh.node_ids, "node")
    yield f"*NODE\n{_NODE_HEADER}"
    height = f"{coordinate_text(mesh.height):>16}{0:8d}{0:8d}"
    for start in range(0, len(mesh.nodes), _CHUNK):
        part = slice(start, start + _CHUNK)
        rows = zip(mesh.node_ids[part].tolist(), mesh.nodes[part].tolist(), strict=True)
        yield "\n".join(
            f"{nid:8d}{coordinate_text(x):>16}{coordinate_text(y):>16}{height}"
            for nid, (x, y) in rows
        )


def quad_keyword(names: Names) -> Iterator[str]:
    """The quads: the keyword, then lines in chunks."""
    mesh = names.mesh
    _check_ids(mesh.quad_ids, "quad")
    part_of = np.empty(len(mesh.quads), np.int64)
    for name, quads in mesh.parts.items():
        part_of[quads] = names.parts[name]
    fields = [f"n{i}" for i in range(1, mesh.quads.shape[1] + 1)]
    header = "".join(f"{name:>8}" for name in fields)
    if mesh.order == 1:
        yield f"*ELEMENT_SHELL\n{_QUAD_HEADER}{header}"
    else:
        yield f"*ELEMENT_PLATE_Q9\n{_QUAD_HEADER}\n$#{header[2:]}"
    between = "" if mesh.order == 1 else "\n"
    ids = mesh.node_ids[mesh.quads]
    for start in range(0, len(mesh.quads), _CHUNK):
        part = slice(start, start + _CHUNK)
        columns = (mesh.quad_ids[part].tolist(), part_of[part].tolist(), ids[part].tolist())
        yield "\n".join(
            f"{eid:8d}{pid:8d}{between}{''.join(f'{nid:8d}' for nid in nodes)}"
            for eid, pid, nodes in zip(*columns, strict=True)
        )


def _check_ids(ids: np.ndarray, what: str) -> None:
    """Refuse numbers that do not fit their columns."""
    if ids.max() > _LARGEST_ID:
        raise MeshError(f"{what} {ids.max()} does not fit eight columns: number from 1")
