"""A model of another program, restated in the keywords of LS-DYNA."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

from plydyn_pre.errors import PreError
from plydyn_pre.translate.block import Block, Row, Value
from plydyn_pre.translate.entry import FATES, IDLE, LOST, Entry, raw_table
from plydyn_pre.translate.schema import table as lsdyna_table

#: Numbers on a row of a set
_WIDE = 8


#: What is said of a file without materials
ONLY_A_MESH = "no material; a file that is a mesh alone can be that of a recipe (mesh of kind gmsh)"


@dataclass
class Source:
    """What a reader found: the keywords of the file, the model that they state, and problems."""

    program: str
    shown: list[Block]  # as the file has them
    blocks: list[Block] = field(default_factory=list)  # the model, in keywords of LS-DYNA
    problems: list[PreError] = field(default_factory=list)
    numbers: dict[str, dict[object, int]] = field(default_factory=dict)

    @contextmanager
    def gathered(self) -> Iterator[None]:
        """Keep what is refused inside, and go on."""
        try:
            yield
        except PreError as error:
            self.problems.append(error)

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
        names = ("N1", "N2", "N3", "N4")
        rows = (dict(zip(names, (*face, *face[-1:])[:4], strict=True)) for face in faces)
        self.put("SET_SEGMENT", by, {"SID": sid}, *rows, line=line)
        return sid

    def put_curve(self, key: object, by: Block, points: Iterable[tuple[float, float]]) -> int:
        """Add a curve, once for each key; its number."""
        new = key not in self.numbers.get("DEFINE_CURVE", {})
        lcid = self.number("DEFINE_CURVE", key)
        if new:
            rows = ({"A1": time, "O1": value} for time, value in points)
            self.put("DEFINE_CURVE", by, {"LCID": lcid}, *rows)
        return lcid


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
    if name in known:
        return known[name]
    starts = [key for key in known if key[-1] == "*" and name.startswith(key[:-1])]
    return known[max(starts, key=len)] if starts else Entry(LOST, "this keyword is not translated")


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
