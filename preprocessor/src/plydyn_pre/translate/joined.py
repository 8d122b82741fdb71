"""Rigid parts that move as one body."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from plydyn_pre.translate.block import IDLE, TAKEN, Block
from plydyn_pre.translate.elements import Body
from plydyn_pre.translate.model import Model

_OF_FIRST = "the first part of *CONSTRAINED_RIGID_BODIES has it"


def join_rigid(model: Model, rigid: list[Body], laws: Mapping[int, Block]) -> None:
    """Give the elements of parts to the part that they follow; its keywords hold for all."""
    for block in model.find("CONSTRAINED_RIGID_BODIES"):
        block.mark(TAKEN, "one body", "PIDM", "PIDS")
        for row in block.rows:
            with model.gathered():
                pair = []
                for name in ("PIDM", "PIDS"):
                    pid = row.whole(name)
                    found = next((body for body in rigid if body.pid == pid), None)
                    if found is None:
                        raise block.fail(name, f"there is no rigid part {pid}", row.line)
                    pair.append(found)
                first, other = pair
                if first is other or first.kind != other.kind:
                    words = "one part, or parts of shells and of bricks: not translated"
                    raise block.fail("PIDS", words, row.line)
                _join(first, other, laws)
                rigid.remove(other)


def _join(first: Body, other: Body, laws: Mapping[int, Block]) -> None:
    """Give a part the elements of another one."""
    first.shares = (first.shares or [replace(first)]) + (other.shares or [replace(other)])
    first.elements = first.elements + other.elements
    law = laws[other.material]
    if law is not laws[first.material]:
        law.mark(IDLE, _OF_FIRST, "MID", "RO", "CMO", "CON1", "CON2")
    if other.block.name.startswith("PART_INERTIA"):
        other.block.lose_filled("a velocity of a part that follows another", "VTX", "VTY", "VTZ")
        other.block.mark(IDLE, _OF_FIRST, "TM", "VRX", "VRY", "VRZ")
