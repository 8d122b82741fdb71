"""Supports, velocities, loads and contacts of a file of bulk data."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from plydyn_pre.translate.nastran.bodies import RigidBody
from plydyn_pre.translate.nastran.lines import Card
from plydyn_pre.translate.nastran.mesh import Mesh

_NAMES = {"NSID": "G1", "NID": "G", "PID": "G", "DOFRX": "C", "DOFRY": "C"}
_LAST_ROW = 8  # fields of a row
_LOADS = ("FORCE", "GRAV", "PLOAD2", "PLOAD4")


def put_supports(mesh: Mesh, bodies: list[RigidBody]) -> None:
    """Add what holds nodes, and tell the rigid bodies what holds them."""
    wanted = _sets(mesh, "SPCADD", mesh.deck.chosen("SPC"))
    held: dict[str, set[int]] = {}
    by: dict[str, Card] = {}
    for card in mesh.deck.each("SPC", "SPC1"):
        if not wanted or card.whole("SID") in wanted:
            with mesh.source.gathered():
                for directions, nid in _held(mesh, card):
                    held.setdefault(directions, set()).add(nid)
                    by.setdefault(directions, card)
    grid = next(mesh.deck.each("GRID"))
    for nid, directions in mesh.held.items():
        held.setdefault(directions, set()).add(nid)
        by.setdefault(directions, grid)
    for directions, nodes in held.items():
        with mesh.source.gathered():
            _put_support(mesh, bodies, by[directions], directions, nodes)


def _put_support(
    mesh: Mesh, bodies: list[RigidBody], card: Card, directions: str, nodes: set[int]
) -> None:
    """Add nodes that are held in the same directions."""
    if not set(directions) <= set("123456"):
        raise card.fail("C", f"{directions} are no directions from 1 to 6")
    numbers = {int(each) for each in directions}
    for body in bodies:
        if body.reference & nodes:
            body.held |= numbers
    others = nodes - {n for body in bodies for n in body.reference | body.nodes}
    if others:
        mesh.source.put_support(card.block, others, numbers, card.line, _NAMES)


def _held(mesh: Mesh, card: Card) -> Iterator[tuple[str, int]]:
    """Directions and nodes of an entry."""
    if card.name == "SPC1":
        for nid in card.ids(2):
            yield card.word("C"), mesh.check(card, "G1", nid)
        return
    for n in (1, 2):
        if nid := card.whole(f"G{n}"):
            if card.number(f"D{n}"):
                card.lose("an enforced displacement is not translated", f"D{n}")
            yield card.word(f"C{n}"), mesh.check(card, f"G{n}", nid)


def _sets(mesh: Mesh, name: str, chosen: int) -> set[int]:
    """The sets that the case control chooses; empty for all."""
    if not chosen:
        return set()
    for card in mesh.deck.each(name):
        if card.whole("SID") == chosen:
            return set(card.ids(1))
    return {chosen}


def put_velocities(mesh: Mesh, bodies: list[RigidBody]) -> None:
    """Add velocities at time zero, which are given direction by direction."""
    wanted = mesh.deck.chosen("IC")
    found: dict[int, list[float]] = {}
    by: dict[int, Card] = {}
    for card in mesh.deck.each("TIC"):
        if wanted and card.whole("SID") != wanted:
            continue
        with mesh.source.gathered():
            nid = mesh.check(card, "G", card.whole("G", None))
            if card.number("U0"):
                card.lose("a displacement at time zero is not translated", "U0")
            if card.whole("C") not in (1, 2, 3):
                card.lose("a rotation at time zero is not translated", "C")
                continue
            found.setdefault(nid, [0.0, 0.0, 0.0])[card.whole("C") - 1] = card.number("V0")
            by[nid] = card
    for body in bodies:
        for nid in sorted(body.reference & found.keys()) if body.card.name == "RBE2" else ():
            own, card = {"PID": body.pid}, by[nid]
            mesh.source.put_velocity(card.block, own, found.pop(nid), card.line, _NAMES)
    for nid, velocity in found.items():
        mesh.source.put_velocity(by[nid].block, {"NID": nid}, velocity, by[nid].line, _NAMES)


def put_loads(mesh: Mesh, end: float) -> None:
    """Add forces, pressures and gravity, which are steady."""
    factors: dict[int, float] = {}
    chosen = mesh.deck.chosen("LOAD")
    for card in mesh.deck.each("LOAD"):
        if card.whole("SID") == chosen:
            words = card.words[2:]
            for factor, of in zip(words[::2], words[1::2], strict=False):
                number = card.whole_of("L", of)
                factors[number] = card.number("S", 1.0) * card.number_of("S", factor, 1.0)
    factors = factors or {chosen: 1.0}
    for card in mesh.deck.each(*_LOADS):
        with mesh.source.gathered():
            sid = card.whole("SID")
            if sid not in factors:
                card.lose(f"LOAD of the case control does not choose set {sid}", "SID")
                continue
            points = [(0.0, 1.0), (end or 1.0, 1.0)]
            lcid = mesh.source.put_curve("steady", card.block, points)
            _put_load(mesh, card, factors[sid], lcid)


def _put_load(mesh: Mesh, card: Card, factor: float, lcid: int) -> None:
    """Add a load."""
    source = mesh.source
    by: dict[str, Any] = {"line": card.line, "names": _NAMES}
    if card.name in ("FORCE", "GRAV"):
        if card.whole("CID"):
            card.lose("a direction of its own is not translated", "CID")
        size = factor * card.number("F" if card.name == "FORCE" else "A")
        for n, axis in enumerate("XYZ", start=1):
            value = size * card.number(f"N{n}")
            if value and card.name == "FORCE":
                row = {"NID": card.whole("G"), "DOF": n, "LCID": lcid, "SF": value}
                source.put("LOAD_NODE_POINT", card.block, row, **by)
            elif value:
                source.put(f"LOAD_BODY_{axis}", card.block, {"LCID": lcid, "SF": -value}, **by)
        return
    if card.name == "PLOAD4":
        if len({card.word(f"P{n}") or card.word("P1") for n in (1, 2, 3, 4)}) > 1:
            card.lose("a pressure that varies over an element is not translated", "P2")
        ids, pressure = [card.whole("EID", None)], card.number("P1")
        if card.at(6).upper() == "THRU":
            ids = list(range(ids[0], card.whole_of("THRU", card.at(7), None) + 1))
    else:
        ids, pressure = card.ids(2), card.number("P")
    for eid in ids:
        if eid not in mesh.elements or not mesh.elements[eid].shell:
            raise card.fail("EID", f"there is no shell {eid}")
        # along the normal: onto the other face
        nodes = mesh.elements[eid].corners()[::-1]
        row = {"LCID": lcid, "SF": factor * pressure}
        row |= {f"N{n}": nid for n, nid in enumerate(nodes, start=1)}
        source.put("LOAD_SEGMENT", card.block, row, **by)


def put_contacts(mesh: Mesh, bodies: list[RigidBody]) -> None:
    """Add the contacts."""
    sides = {card.whole("BID"): card for card in mesh.deck.each("BCBODY")}
    for card in mesh.deck.each("BCTABLE"):
        with mesh.source.gathered():
            _table(mesh, card, sides)
    command = mesh.deck.case.get("BCONTACT")
    if command and command.at(0).upper() == "ALLBODY":
        friction = max((card.number("FRIC") for card in sides.values()), default=0.0)
        row = {"SSID": 0, "FS": friction, "FD": friction}
        mesh.source.put("CONTACT", command.block, row, written="CONTACT_AUTOMATIC_GENERAL")


def _table(mesh: Mesh, card: Card, sides: dict[int, Card]) -> None:
    """Add the pairs of a table of contacts."""
    slave, friction = 0, 0.0
    rows = [card.words[at : at + _LAST_ROW] for at in range(0, len(card.words), _LAST_ROW)]
    kind = ""
    for row in rows[1:]:
        kind = row[0].upper() or kind
        if kind == "SLAVE" and row[0]:
            slave = card.whole_of("SLAVE", row[1], None)
            friction = card.number_of("FRIC", (*row, *[""] * 8)[4])
        elif kind == "MASTERS":
            for word in filter(None, row[1:]):
                pair = slave, card.whole_of("MASTERS", word, None)
                pids = [_part_set(mesh, card, sides, number) for number in pair]
                side = dict(zip(("SSID", "MSID"), pids, strict=True))
                values = side | {"SSTYP": 2, "MSTYP": 2, "FS": friction, "FD": friction}
                mesh.source.put("CONTACT", card.block, values, line=card.line)


def _part_set(mesh: Mesh, card: Card, sides: dict[int, Card], number: int) -> int:
    """A set of the parts of a body in contact."""
    if number not in sides:
        raise card.fail("SLAVE", f"there is no BCBODY {number}")
    body = sides[number]
    for surface in mesh.deck.each("BSURF"):
        if surface.whole("ID") == body.whole("BSID", None):
            ids = surface.ids(1)
            pids = {mesh.elements[eid].pid for eid in ids if eid in mesh.elements}
            if not pids:
                raise surface.fail("ID", "none of its elements is there")
            return mesh.source.put_set("SET_PART_LIST", surface.block, pids, surface.line)
    raise body.fail("BSID", f"there is no BSURF {body.whole('BSID')}")
