"""Plies of parts: on their own cards, in a section, by a rule of integration, or by elements."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

from plydyn_pre import layup
from plydyn_pre.translate.block import REPLACED, TAKEN, Block, Row
from plydyn_pre.translate.model import Model

#: ELFORM of membranes, and of elements in a plane or around an axis
_FLAT = (5, 9, 12, 13, 14, 15)


@dataclass(frozen=True)
class Ply:
    """A ply of a part."""

    material: int
    thickness: float
    angle: float  # from the axis of its material, about the normal of its part

    def turned(self, angle: float, share: float) -> Ply:
        """The ply with another angle on top, and a share of its thickness."""
        return replace(self, angle=self.angle + angle, thickness=self.thickness * share)


def layup_notes(plies: Iterable[tuple[int, float, float]]) -> Iterator[str]:
    """What couples pulling with bending or shear in a laminate of laws, thicknesses and angles."""
    stack = tuple(layup.Ply(angle, f"{mid} {size:.9g}") for mid, size, angle in plies)
    words = f"the laminate [{'/'.join(f'{ply.angle:g}' for ply in stack)}] is not"
    if not layup.is_symmetric(stack):
        yield f"{words} symmetric about the middle, so that pulling bends it"
    if not layup.is_balanced(stack):
        yield f"{words} balanced: its angles have no opposites, so that pulling shears it"


def part_plies(block: Block) -> list[Ply]:
    """Plies of the cards of a composite part."""
    plies = []
    for row in block.rows:
        plies += _plies(block, row, ("",) if block.name == "PART_COMPOSITE_LONG" else ("1", "2"))
    if not plies:
        raise block.fail("MID1", "the part has no plies")
    return plies


def element_plies(block: Block, row: Row) -> list[Ply]:
    """Plies of the cards of an element."""
    names = [name for name in row.values if name.startswith("MID")]
    return _plies(block, row, tuple(sorted((name[3:] for name in names), key=int)))


def _plies(block: Block, row: Row, numbers: tuple[str, ...]) -> list[Ply]:
    """Plies of some columns."""
    plies = []
    for n in numbers:
        names = (f"MID{n}", f"THICK{n}", f"B{n}")
        block.mark(TAKEN, "", *names[1:], f"PLYID{n}")
        block.mark(REPLACED, "numbered anew", names[0])
        mid, thickness = row.whole(names[0]), row.number(names[1])
        if not mid and not thickness:
            continue
        if not mid:
            words = f"MID{n} cannot be 0: the ply of thickness {thickness:g} needs a material"
            raise block.fail(names[0], words, row.line)
        if thickness <= 0.0:
            raise block.fail(names[1], f"{thickness:g} must be above zero", row.line)
        plies.append(Ply(mid, thickness, row.number(names[2])))
    return plies


def section_plies(model: Model, part: Block, kind: str, material: int) -> tuple[list[Ply], float]:
    """Plies of a part that is no composite, and where its nodes are; of thickness 1 for bricks."""
    if kind == "solid":
        return [Ply(material, 1.0, 0.0)], 0.0
    name = "SECTION_SHELL" if kind == "shell" else "SECTION_TSHELL"
    secid = part.whole("SECID")
    section = next((b for b in model.find(name) if b.raw("SECID", 0) == secid), None)
    if section is None:
        raise part.fail("SECID", f"there is no *{name} {secid}")
    section.mark(TAKEN, "", "SECID")
    thickness, reference = 1.0, 0.0
    if kind == "shell":
        check_shells(section)
        thickness = section.positive("T1")
        for other in ("T2", "T3", "T4"):
            if section.number(other, 0.0) not in (0.0, thickness):
                words = f"{section.raw(other):g} where T1 is {thickness:g}; one thickness is needed"
                raise section.fail(other, words, section.line_of(other))
        reference = section.number("NLOC", 0.0)
        section.lose_filled("shells have no mass of their own", "MAREA")
    shares = _shares(model, section)
    angles = _angles(section, len(shares))
    return [
        Ply(mid or material, thickness * share, angle)
        for (mid, share), angle in zip(shares, angles, strict=True)
    ], reference


def check_shells(block: Block) -> None:
    """Refuse shells that do not bend, or are of a plane."""
    if int(block.raw("ELFORM", 0)) in _FLAT:
        words = f"{block.raw('ELFORM')}: membranes and elements of a plane are not translated"
        block.lose(words, "ELFORM", line=block.line_of("ELFORM"))
    if block.raw("NIP", 0) == 1:
        words = "1: a shell of one point through its thickness does not bend: not translated"
        block.lose(words, "NIP", line=block.line_of("NIP"))


def _shares(model: Model, section: Block) -> list[tuple[int, float]]:
    """Material (0 for that of the part) and share of the thickness of each ply."""
    rule = section.number("QR", 0.0)
    if rule < 0.0:
        for block in model.find("INTEGRATION_SHELL"):
            if block.raw("IRID", 0) == round(-rule):
                return _integration(model, block)
        raise section.fail("QR", f"there is no *INTEGRATION_SHELL {-rule:g}")
    if section.raw("ICOMP", 0) != 1:
        return [(0, 1.0)]
    count = max(1, section.whole("NIP", 2) or 2)
    if count > 1 and rule != 1.0:
        model.notes.append(
            f"{section.title}, line {section.line}: {count} plies of one thickness, where"
            " LS-DYNA weighs its points by Gauss; *PART_COMPOSITE gives each ply its own"
        )
    return [(0, 1.0 / count)] * count


def _integration(model: Model, block: Block) -> list[tuple[int, float]]:
    """Plies of a rule of integration."""
    block.mark(TAKEN, "", "IRID", "NIP", "ESOP", "S", "WF", "PID")
    count = block.whole("NIP")
    if block.raw("ESOP", 0) == 1:
        return [(0, 1.0 / max(1, count))] * max(1, count)
    rows = [row for row in block.rows if "WF" in row.values or "S" in row.values]
    if len(rows) != count:
        raise block.fail("NIP", f"{count} points, but {len(rows)} cards follow")
    if any(a.number("S") > b.number("S") for a, b in pairwise(rows)):
        raise block.fail("S", "points must go from the bottom up")
    if any(row.number("WF") <= 0.0 for row in rows):
        raise block.fail("WF", "must be above zero")
    total = sum(row.number("WF") for row in rows)
    return [(_material(model, block, row), row.number("WF") / total) for row in rows]


def _material(model: Model, block: Block, row: Row) -> int:
    """The material of the part that a point names; 0 where it names none."""
    pid = row.whole("PID")
    for part in model.find("PART"):
        if pid and part.raw("PID", 0) == pid:
            part.mark(TAKEN, "the material of a ply", "PID", "MID", "SECID", "TITLE")
            return part.whole("MID")
    if pid:
        raise block.fail("PID", f"there is no *PART {pid}", row.line)
    return 0


def _angles(section: Block, count: int) -> list[float]:
    """Angles of the plies of a section."""
    section.mark(TAKEN, "", "ICOMP", "NIP", "QR", *(f"B{n}" for n in range(1, 9)))
    if section.raw("ICOMP", 0) != 1:
        return [0.0] * count
    rows = [row for row in section.rows if any(name in row.values for name in ("B1", "B2"))]
    angles = [row.number(f"B{n}") for row in rows for n in range(1, 9)][:count]
    if len(angles) < count:
        raise section.fail("B1", f"{count} angles are needed (NIP), {len(angles)} are there")
    return angles
