"""Numbers and names of a deck that are given twice: neither is known to be the one meant."""

from __future__ import annotations

from collections.abc import Hashable, Iterable

from plydyn_pre.errors import PreError
from plydyn_pre.translate.block import Block

#: Fields with the number of a keyword, by how the keyword begins; laws, nodes and elements are
#: checked where they are read
_NUMBERS = {
    "PART": "PID",
    "SECTION_SHELL": "SECID",
    "SECTION_TSHELL": "SECID",
    "INTEGRATION_SHELL": "IRID",
    "DEFINE_CURVE": "LCID",
    "DEFINE_VECTOR": "VID",
    "DEFINE_BOX": "BOXID",
    "DEFINE_COORDINATE": "CID",
    "SET_NODE": "SID",
    "SET_PART": "SID",
    "SET_SHELL": "SID",
    "SET_SEGMENT": "SID",
}


def twice(found: Iterable[tuple[Block, Hashable, str, int]]) -> list[PreError]:
    """What is wrong with keywords of the same key, by the field that holds it and its line."""
    first: dict[Hashable, int] = {}
    problems: list[PreError] = []
    for block, key, name, line in found:
        if key in first:
            words = f"defined twice, in line {first[key]} too"
            problems.append(block.fail(name, words, line))
        first.setdefault(key, line)
    return problems


def numbered_twice(blocks: Iterable[Block]) -> list[PreError]:
    """What is wrong with keywords of LS-DYNA of the same number."""
    return twice(
        (block, (start, block.raw(name)), name, block.line_of(name))
        for block in blocks
        for start, name in _NUMBERS.items()
        if block.name.startswith(start) and block.has(name)
    )
