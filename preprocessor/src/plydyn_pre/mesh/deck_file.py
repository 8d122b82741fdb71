"""Meshes of the user, from decks of Abaqus (.inp) and LS-DYNA (.k, .key)."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from plydyn_pre.errors import MeshError
from plydyn_pre.mesh.grid import Mesh, counter_clockwise

#: How names of shells, membranes and plane elements begin
_SURFACES = ("S", "CPS", "CPE", "M3D", "DS")


@dataclass
class Parsed:
    """What a deck has of a mesh; elements by part."""

    nodes: dict[int, tuple[float, float, float]] = field(default_factory=dict)
    quads: dict[str, dict[int, tuple[int, ...]]] = field(default_factory=dict)
    node_sets: dict[str, set[int]] = field(default_factory=dict)
    quad_sets: dict[str, set[int]] = field(default_factory=dict)
    element_sets: dict[str, set[int]] = field(default_factory=dict)
    lines: dict[int, tuple[int, ...]] = field(default_factory=dict)


def mesh_of_deck(path: Path) -> Mesh:
    """The quads of a deck with its sets."""
    parsed = _abaqus(path) if path.suffix.lower() == ".inp" else _lsdyna(path)
    parts = {name: quads for name, quads in parsed.quads.items() if quads}
    if not parts:
        raise MeshError("there are no quads")
    elements = {e: quad for quads in parts.values() for e, quad in quads.items()}
    sizes = {len(quad) for quad in elements.values()}
    if len(sizes) > 1:
        raise MeshError(f"quads of {' and '.join(map(str, sorted(sizes)))} nodes: choose one order")
    missing = {n for quad in elements.values() for n in quad} - parsed.nodes.keys()
    if missing:
        raise MeshError(f"there is no node {min(missing)}")
    if sizes == {8}:
        elements = _with_centres(parsed.nodes, elements)
    node_ids = np.array(sorted({n for quad in elements.values() for n in quad}))
    places = np.array([parsed.nodes[n] for n in node_ids])
    low, high = places[:, 2].min(), places[:, 2].max()
    if high - low > 1e-9 * np.ptp(places, axis=0).max():
        raise MeshError(f"the nodes lie between z = {low:g} and {high:g}: all need the same z")
    quad_ids = np.array(list(elements))
    quads = np.searchsorted(node_ids, np.array(list(elements.values())))
    at = {e: i for i, e in enumerate(elements)}
    return Mesh(
        nodes=places[:, :2].copy(),
        quads=counter_clockwise(places[:, :2], quads),
        parts={name: np.array([at[e] for e in some]) for name, some in parts.items()},
        node_sets=_indices(parsed.node_sets, node_ids),
        quad_sets={
            name: np.array(sorted(at[e] for e in some if e in at))
            for name, some in parsed.quad_sets.items()
            if some & at.keys() and name not in parts
        },
        node_ids=node_ids,
        quad_ids=quad_ids,
        height=float(low),
    )


def _indices(sets: dict[str, set[int]], node_ids: np.ndarray) -> dict[str, np.ndarray]:
    """Sets of nodes of the quads as indices."""
    found = {}
    for name, ids in sets.items():
        inside = np.flatnonzero(np.isin(node_ids, list(ids)))
        if len(inside):
            found[name] = inside
    return found


def _with_centres(
    nodes: dict[int, tuple[float, float, float]], elements: dict[int, tuple[int, ...]]
) -> dict[int, tuple[int, ...]]:
    """Quads of eight nodes with a ninth in the middle, where their own shapes have it."""
    found = {}
    next_id = max(nodes) + 1
    for number, quad in elements.items():
        p = np.array([nodes[n] for n in quad])
        nodes[next_id] = tuple(0.5 * p[4:].sum(axis=0) - 0.25 * p[:4].sum(axis=0))
        found[number] = (*quad, next_id)
        next_id += 1
    return found


def _lsdyna(path: Path) -> Parsed:
    """Shells and sets of nodes of a deck of LS-DYNA."""
    from plydyn_pre.translate.bodies import nodes_and_elements
    from plydyn_pre.translate.model import Model
    from plydyn_pre.translate.reader import read_deck

    blocks, problems = read_deck(path)
    if problems:
        raise MeshError(str(problems[0]))
    nodes, by_part = nodes_and_elements(Model(blocks, problems))
    if problems:
        raise MeshError(str(problems[0]))
    parsed = Parsed(nodes)
    for pid, (kind, elements) in by_part.items():
        if kind == "shell":
            quads = {e.number: e.nodes for e in elements}
            parsed.quads[f"part_{pid}"] = quads
            if flat := next((e for e in elements if e.triangle), None):
                raise MeshError(f"element {flat.number} is a triangle: only quads can be used")
    for block in blocks:
        if block.name == "SET_NODE_LIST":
            name = str(block.raw("NAME", "")) or f"set_{block.raw('SID', 0)}"
            parsed.node_sets.setdefault(name, set()).update(block.ids("NID"))
    return parsed


def _abaqus(path: Path) -> Parsed:
    """Nodes, quads and sets of a deck of Abaqus."""
    parsed = Parsed()
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    keyword: dict[str, str] = {}
    rows: list[list[str]] = []
    for line in [*lines, "*END"]:
        if line.startswith("**") or not line.strip():
            continue
        if not line.startswith("*"):
            words = [word.strip() for word in line.split(",")]
            if rows and rows[-1][-1] == "" and keyword.get("", "") == "ELEMENT":
                rows[-1] = [*rows[-1][:-1], *words]
            else:
                rows.append(words)
            continue
        try:
            _put(parsed, keyword, rows)
        except (ValueError, IndexError) as error:
            raise MeshError(f"*{keyword.get('', '')}: a number is wrong: {error}") from error
        keyword, rows = _options(line), []
    _named(parsed)
    return parsed


def _options(line: str) -> dict[str, str]:
    """The name (of no key) and the parameters of a keyword."""
    name, *words = line[1:].split(",")
    pairs = [word.partition("=") for word in words]
    options = {key.strip().upper(): value.strip().strip('"') for key, _, value in pairs}
    return options | {"": name.strip().upper()}


def _put(parsed: Parsed, keyword: dict[str, str], rows: list[list[str]]) -> None:
    """Keep what a keyword has."""
    match keyword.get("", ""):
        case "NODE":
            for row in rows:
                x, y, z = (float(word) if word else 0.0 for word in [*row[1:4], "", ""][:3])
                parsed.nodes[int(row[0])] = (x, y, z)
            if "NSET" in keyword:
                parsed.node_sets.setdefault(keyword["NSET"], set()).update(int(r[0]) for r in rows)
        case "ELEMENT":
            _elements(parsed, keyword, rows)
        case "NSET":
            _members(parsed.node_sets, keyword.get("NSET", "set"), keyword, rows)
        case "ELSET":
            _members(parsed.element_sets, keyword.get("ELSET", "set"), keyword, rows)


def _members(
    sets: dict[str, set[int]], name: str, keyword: dict[str, str], rows: list[list[str]]
) -> None:
    """Put the numbers, and the members of other sets, into a set."""
    found = sets.setdefault(name, set())
    for row in rows:
        words = [word for word in row if word]
        if "GENERATE" in keyword:
            first, last, *step = map(int, words)
            found.update(range(first, last + 1, *step))
            continue
        for word in words:
            found |= {int(word)} if word.lstrip("-").isdigit() else sets.get(word, set())


def _elements(parsed: Parsed, keyword: dict[str, str], rows: list[list[str]]) -> None:
    """Keep quads by their part, and lines."""
    kind, name = keyword.get("TYPE", "").upper(), keyword.get("ELSET", "part")
    size = next((n for n in map(int, re.findall(r"\d", kind[::-1]))), 0)
    for row in rows:
        number, *ids = (int(word) for word in row if word)
        if len(ids) in (2, 3) and not kind.startswith(_SURFACES):
            parsed.lines[number] = tuple(ids)
        elif size in (4, 8, 9) and len(ids) == size and kind.startswith(_SURFACES):
            parsed.quads.setdefault(name, {})[number] = tuple(ids)
        else:
            raise MeshError(f"element {number} is of type {kind}: only quads can be used")


def _named(parsed: Parsed) -> None:
    """Sets of elements as parts, as sets of quads, or as sets of the nodes of lines."""
    for name, chosen in parsed.element_sets.items():
        same = [part for part, quads in parsed.quads.items() if quads.keys() == chosen]
        if same:
            parsed.quads = {name if p == same[0] else p: q for p, q in parsed.quads.items()}
        elif lines := chosen & parsed.lines.keys():
            ids = {n for e in lines for n in parsed.lines[e]}
            parsed.node_sets.setdefault(name, set()).update(ids)
        else:
            parsed.quad_sets[name] = chosen
