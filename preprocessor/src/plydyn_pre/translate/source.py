"""A model of another program, restated in the keywords of LS-DYNA."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

from plydyn_pre.errors import PreError
from plydyn_pre.translate.block import (
    FATES,
    IDLE,
    LOST,
    Block,
    Entry,
    Gathering,
    Row,
    Value,
    by_start,
    raw_table,
)
from plydyn_pre.translate.model import Place
from plydyn_pre.translate.schema import table as lsdyna_table

#: Numbers on a row of a set
_WIDE = 8
_LOOKED_AT = 20_000  # characters
LSDYNA = "LS-DYNA"
#: Programs whose decks are translated
TRANSLATED = (LSDYNA, "Abaqus", "Nastran")
#: What a line of a deck looks like that only this program has
_SIGNS = {
    "Radioss": r"^#RADIOSS|^/BEGIN\b|^/NODE\b|^/SHELL/",
    "Nastran": r"^BEGIN BULK|^CEND\b|^SOL +\d+|^(GRID|CQUAD4|PCOMP|MAT8)[ *,]",
    "Abaqus": r"^\*(Heading|Part, *name|Assembly|Instance|Step|Material, *name|Shell Section|"
    r"Element, *type|Solid Section|Surface Interaction|Include, *input|Nset, *nset|Elset, *elset)",
    "Ansys": r"^/PREP7|^/COM,|^NBLOCK,|^ET,\d",
    "PAM-CRASH": r"^INPUTVERSION|^ANALYSIS +EXPLICIT|^SHELL +/",
    "Marc": r"^(extended|sizing|alloc) +\d|^elements +\d|^connectivity *$",
    "SU2": r"^NDIME *=",
    "a mesh of gmsh": r"^\$MeshFormat",
    "a mesh of VTK": r"\A# vtk DataFile|<VTKFile ",
    "a universal file (.unv)": r"\A *-1 *\r?\n *(15|151|164|2411|2412|2420|2467|2477) *$",
    "a file of HDF5, as .med is": r"\A.HDF\r?\n",
    "a recipe of plydyn-pre": r"^\[(impactor|laminate|mesh|control)\]",
}
#: Of these, files that a recipe may name as its mesh
MESHES = tuple(name for name in _SIGNS if re.match("a (mesh|universal|file)", name))
#: What is said of a file without materials
ONLY_A_MESH = "no material; a file that is a mesh alone can be that of a recipe (mesh of kind gmsh)"


@dataclass
class Source(Gathering):
    """What a reader found: the keywords of the file, the model that they state, and problems."""

    program: str
    shown: list[Block]  # as the file has them
    blocks: list[Block] = field(default_factory=list)  # the model, in keywords of LS-DYNA
    problems: list[PreError] = field(default_factory=list)
    numbers: dict[str, dict[object, int]] = field(default_factory=dict)

    def number(self, kind: str, key: object) -> int:
        """The number of something that has a name."""
        known = self.numbers.setdefault(kind, {})
        return known.setdefault(key, len(known) + 1)

    def put(
        self,
        name: str,
        by: Block,
        *rows: Mapping[str, Value] | Row,
        line: int = 0,
        names: Mapping[str, str] | None = None,
        written: str = "",
    ) -> Block:
        """Add a keyword of the model, which a keyword of the file states."""
        entry = lsdyna_table()[name]
        block = Block(name, written or name, by.file, line or by.line, entry, label=by.title)
        block.names = names or {}
        for row in rows:
            block.rows.append(row if isinstance(row, Row) else Row(line or by.line, dict(row)))
        self.blocks.append(block)
        return block

    def put_set(self, name: str, by: Block, ids: Iterable[int], line: int = 0) -> int:
        """Add a set of numbers; its number."""
        sid = self.number(name, len(self.numbers.get(name, ())))
        key = {"SET_NODE_LIST": "NID", "SET_PART_LIST": "PID"}[name]
        members = sorted(set(ids))
        rows = [
            {f"{key}{n}": each for n, each in enumerate(members[at : at + _WIDE], start=1)}
            for at in range(0, len(members), _WIDE)
        ]
        self.put(name, by, {"SID": sid}, *rows, line=line)
        return sid

    def put_segments(self, by: Block, faces: Iterable[tuple[int, ...]], line: int = 0) -> int:
        """Add a set of faces; its number."""
        sid = self.number("SET_SEGMENT", len(self.numbers.get("SET_SEGMENT", ())))
        self.put("SET_SEGMENT", by, {"SID": sid}, *map(corner_fields, faces), line=line)
        return sid

    def put_nodes(self, by: Block, nodes: Iterable[tuple[int, Place]]) -> None:
        """Add all nodes."""
        rows = (Row(by.line, {"NID": nid, "X": x, "Y": y, "Z": z}) for nid, (x, y, z) in nodes)
        self.put("NODE", by, *rows)

    def put_support(
        self,
        by: Block,
        nodes: Iterable[int],
        directions: Collection[int],
        line: int,
        names: Mapping[str, str],
    ) -> None:
        """Add nodes that are held along and about axes, by the numbers 1 to 6 of these."""
        sid = self.put_set("SET_NODE_LIST", by, nodes, line)
        axes = enumerate(("X", "Y", "Z", "RX", "RY", "RZ"), start=1)
        held = {f"DOF{axis}": int(n in directions) for n, axis in axes}
        row = {"NSID": sid, "CID": 0} | held
        self.put("BOUNDARY_SPC_SET", by, row, line=line, names=names)

    def put_velocity(
        self,
        by: Block,
        what: Mapping[str, int],
        velocity: Iterable[float],
        line: int,
        names: Mapping[str, str],
    ) -> None:
        """Add the velocity at time zero of a node, by its NID, or of a rigid part, by its PID."""
        name = f"INITIAL_VELOCITY_{'NODE' if 'NID' in what else 'RIGID_BODY'}"
        row = {**what, **dict(zip(("VX", "VY", "VZ"), velocity, strict=True))}
        self.put(name, by, row, line=line, names=names)

    def put_curve(self, key: object, by: Block, points: Iterable[tuple[float, float]]) -> int:
        """Add a curve, once for each key; its number."""
        new = key not in self.numbers.get("DEFINE_CURVE", {})
        lcid = self.number("DEFINE_CURVE", key)
        if new:
            rows = ({"A1": time, "O1": value} for time, value in points)
            self.put("DEFINE_CURVE", by, {"LCID": lcid}, *rows)
        return lcid


def corner_fields(face: tuple[int, ...]) -> dict[str, int]:
    """The corners of a quad or a triangle, whose last one stands twice."""
    return dict(zip(("N1", "N2", "N3", "N4"), (*face, *face[-1:])[:4], strict=True))


def corners_of(nodes: tuple[int, ...], shell: bool) -> tuple[int, ...]:
    """Four corners of a shell or eight of a brick, some of which may be the same node."""
    last = nodes[-1:]
    match shell, len(nodes):
        case True, 3:
            return (*nodes, *last)
        case False, 6:
            return (*nodes[:3], nodes[2], *nodes[3:], *last)
        case False, 4:
            return (*nodes[:3], nodes[2], *last * 4)
    return nodes


def program_of(path: Path) -> str:
    """The program of a deck; an error for one that is not translated."""
    with path.open(encoding="utf-8", errors="replace") as stream:
        text = stream.read(_LOOKED_AT)
    if re.search(r"(?m)^\*KEYWORD\b", text, re.IGNORECASE):
        return LSDYNA
    for name, sign in _SIGNS.items():
        if re.search(f"(?m){sign}", text, re.IGNORECASE):
            if name in TRANSLATED:
                return name
            deck = name if name.startswith("a ") else f"a deck of {name}"
            known = f"{', '.join(TRANSLATED[:-1])} and {TRANSLATED[-1]}"
            mesh = "" if deck not in MESHES else "; a recipe takes it as a mesh of kind gmsh"
            raise PreError(f"{path}: this is {deck}; decks of {known} are translated{mesh}")
    return LSDYNA


@cache
def dialect(name: str) -> dict[str, Entry]:
    """The table of the keywords of a program."""
    rest = name != "nastran"
    return {key: _entry(data, rest) for key, data in raw_table(f"{name}.toml").items()}


def _entry(data: Mapping[str, Any], rest: bool) -> Entry:
    """An entry of a table."""
    return Entry(
        FATES[str(data["fate"])],
        str(data.get("words", "")),
        tuple(str(data.get("fields", "")).split()),
        idle=data.get("idle", {}),
        options=frozenset(str(data.get("options", "")).split(", ")) - {""},
        refused=data["refused"],
        rest=bool(data.get("rest", rest)),
    )


def entry_of(known: Mapping[str, Entry], name: str) -> Entry:
    """What is known of a keyword, by its name or by how it begins."""
    return known[name] if name in known else by_start(known, name)


def settle_shown(source: Source) -> None:
    """Give every field of the file that no reader has marked its fate by the table."""
    for block in source.shown:
        if block.entry.fate == LOST and not block.losses:
            block.lose(block.entry.words)
        for row in block.rows:
            for name, value in row.values.items():
                if name not in block.fates and value != 0.0:
                    _settle(block, name, row.line)


def _settle(block: Block, name: str, line: int) -> None:
    """Give a field its fate."""
    entry = block.entry
    if words := entry.why_idle(name):
        block.mark(IDLE, words, name)
    elif entry.fate in (IDLE, LOST) or name in entry.options:
        block.mark(entry.fate, entry.words, name)
    elif name.isupper() or (name.startswith("field ") and not entry.rest):
        block.lose("is not translated", name, line=line)
    else:
        block.mark(entry.fate, entry.words, name)


def source_path(path: Path, line: str, near: Path) -> Path:
    """A file that another one names."""
    given = Path(line.strip().strip("\"'"))
    return given if given.is_absolute() else near / given
