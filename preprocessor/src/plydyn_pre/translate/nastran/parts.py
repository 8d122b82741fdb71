"""Properties and materials of a file of bulk data as parts."""

from __future__ import annotations

from plydyn_pre.translate.block import Block, Row, Value
from plydyn_pre.translate.nastran.lines import Card
from plydyn_pre.translate.nastran.mesh import Element, Mesh, axis_of_part, vector

_NAMES = {"MID1": "MID", "THICK1": "T", "B1": "THETA", "N1": "G1", "N4": "G4", "RO": "RHO"}
_NAMES |= {"SL": "S", "PR": "NU", "T1": "T", "SECID": "PID", "TM": "mass"}
_LAWS = ("MAT1", "MAT8", "MATRIG")
#: First row of plies, and their fields of each; PCOMPG has a number in front of each
_FIRST, _EACH = 8, {"PCOMP": 4, "PCOMPG": 8}
_LEAST_RATIO, _MOST_RATIO = 0.0, 0.5
_ISOTROPIC = 0.01  # share of E by which 2 G (1 + NU) may miss it

CardOf = dict[str, Value]


def mass_factor(mesh: Mesh) -> float:
    """PARAM WTMASS, by which all masses are multiplied."""
    for card in mesh.deck.each("PARAM"):
        if card.word("N").upper() == "WTMASS":
            words = "all densities and masses are multiplied by WTMASS"
            if words not in card.block.remarks:
                card.block.remarks.append(words)
            return card.number("V1", None)
    return 1.0


def law_of(mesh: Mesh, card: Card, name: str, mid: int) -> Card:
    """The material of a property."""
    for law in mesh.deck.each(*_LAWS):
        if law.whole("MID") == mid:
            return law
    raise card.fail(name, f"there is no material {mid}: {', '.join(_LAWS)} are translated")


def put_parts(mesh: Mesh, rigid: set[int]) -> None:
    """Add the parts that are no rigid bodies."""
    used = {element.pid for element in mesh.elements.values()}
    for card in mesh.deck.each("PCOMP", "PCOMPG", "PSHELL", "PSOLID"):
        with mesh.source.gathered():
            pid = card.whole("PID", None)
            members = [element for element in mesh.of_part(pid) if element.number not in rigid]
            used.discard(pid)
            if members:
                _part(mesh, card, members, pid)
    for pid in used:
        first = mesh.of_part(pid)[0]
        first.card.lose(f"there is no PCOMP, PSHELL or PSOLID {pid}", "PID")


def _part(mesh: Mesh, card: Card, members: list[Element], pid: int) -> None:
    """Add a part with its elements."""
    if any(element.shell != (card.name != "PSOLID") for element in members):
        raise card.fail("PID", f"elements of property {pid} are of another kind")
    put = mesh.source.put
    if card.name == "PSOLID":
        if card.whole("CORDM"):
            raise card.fail("CORDM", "axes of bricks are not translated")
        law = law_of(mesh, card, "MID", card.whole("MID", None))
        if law.name != "MAT1":
            raise card.fail("MID", f"{law.name} of bricks is not translated: MAT1 is")
        put("PART", card.block, {"PID": pid, "MID": ply(mesh, law, 0.0)}, line=card.line)
    else:
        axis = axis_of_part(mesh, members)
        rows = _plies(mesh, card, axis)
        first = {"PID": pid, "NLOC": _reference(card, rows, members)}
        put("PART_COMPOSITE", card.block, first, *rows, line=card.line, names=_NAMES)
    put_elements(mesh, members, pid)


def put_elements(mesh: Mesh, members: list[Element], pid: int) -> None:
    """Add elements of a part, one keyword for each kind."""
    blocks: dict[int, Block] = {}
    for element in members:
        name = "ELEMENT_SHELL" if element.shell else "ELEMENT_SOLID"
        by = element.card.block
        if id(by) not in blocks:
            blocks[id(by)] = mesh.source.put(name, by, names=_NAMES)
        nodes = enumerate((*element.corners(), *element.middles), start=1)
        card: CardOf = {"EID": element.number, "PID": pid, **{f"N{n}": nid for n, nid in nodes}}
        blocks[id(by)].rows.append(Row(element.card.line, card))


def _plies(mesh: Mesh, card: Card, axis: float) -> list[Row]:
    """The plies of a property of shells."""
    if card.name == "PSHELL":
        mid = card.whole("MID1", None)
        for name in ("MID2", "MID3"):
            if card.whole(name) not in (0, mid):
                card.lose("another material for bending or shear", name)
        if not card.whole("MID2"):
            card.lose("a membrane, which does not bend, is not translated", "MID2")
        if card.number("12I/T3", 1.0) not in (0.0, 1.0):
            card.lose("another stiffness in bending than that of the ply", "12I/T3")
        law = law_of(mesh, card, "MID1", mid)
        thickness = card.number("T", None)
        return [Row(card.line, {"MID1": ply(mesh, law, axis), "THICK1": thickness})]
    rows, last = [], (0, 0.0)
    start = _FIRST + (card.name == "PCOMPG")
    for at in range(start, max(len(card.words), start), _EACH[card.name]):
        words = [card.at(at + n) for n in range(3)]
        if not any(words):
            continue
        mid = card.whole_of("MID", words[0], last[0])
        last = (mid, card.number_of("T", words[1], last[1]))
        turn = card.number_of("THETA", words[2], 0.0)
        law = law_of(mesh, card, "MID", mid)
        row: CardOf = {"MID1": ply(mesh, law, axis), "THICK1": last[1], "B1": turn}
        rows.append(Row(card.line, row))
    kind = card.word("LAM").upper() if card.name == "PCOMP" else ""
    if kind == "SYM":
        rows += rows[::-1]
    elif kind:
        card.lose(f"{kind} is not translated; SYM is", "LAM")
    if not rows:
        raise card.fail("MID", "it has no plies")
    return rows


def _reference(card: Card, rows: list[Row], members: list[Element]) -> float:
    """Where the nodes are: -1 bottom, 0 middle, 1 top; elements of a part have one offset."""
    thickness = sum(row.number("THICK1") for row in rows)
    shift = 0.0
    if card.name in _EACH and card.word("Z0"):
        shift = card.number("Z0") + 0.5 * thickness
    offsets = {element.card.number("ZOFFS") for element in members}
    if len(offsets) > 1:
        other = next(e for e in members if e.card.number("ZOFFS") != min(offsets))
        raise other.card.fail("ZOFFS", "elements of a part need one offset")
    shift += offsets.pop()
    return -2.0 * shift / thickness if thickness > 0.0 else 0.0


def ply(mesh: Mesh, law: Card, axis: float) -> int:
    """The number of the law of a ply whose axis is at an angle from x."""
    source, mid = mesh.source, law.whole("MID", None)
    key = (mid, axis)
    new = key not in source.numbers.get("MAT", {})
    number = source.number("MAT", key)
    if new:
        x, y = vector(axis)
        name, card = _law(mesh, law)
        aopt: CardOf = {"AOPT": 2.0, "A1": x, "A2": y} if name.startswith("MAT_PLY") else {}
        card = {"MID": number, **card, **aopt}
        source.put(name, law.block, card, line=law.line, names=_NAMES)
    return number


def _law(mesh: Mesh, law: Card) -> tuple[str, CardOf]:
    """The law of a ply and its constants."""
    density = law.number("RHO") * mass_factor(mesh) if law.name != "MATRIG" else 0.0
    if law.name == "MATRIG":
        raise law.fail("MID", "a rigid material of a ply")
    if law.name == "MAT1":
        young, shear, ratio = law.number("E"), law.number("G"), law.number("NU")
        if not young and shear:
            young = 2.0 * shear * (1.0 + ratio)
        if not law.word("NU") and shear:
            ratio = young / (2.0 * shear) - 1.0
        if shear and abs(2.0 * shear * (1.0 + ratio) - young) > _ISOTROPIC * young:
            law.lose("with E and NU it is of no isotropic material", "G")
        return "MAT_ELASTIC", {"RO": density, "E": young, "PR": ratio}
    card: CardOf = {name: law.number(name, None) for name in ("E1", "E2", "NU12", "G12")}
    card |= {"RO": density, "E3": card["E2"], "NU13": card["NU12"]}
    card |= _across(law, card)
    strengths: CardOf = {own: law.number(name) for own, name in _strengths(law).items()}
    if not any(strengths.values()):
        return "MAT_PLY_ELASTIC", card
    if law.number("STRN"):
        law.lose("allowable strains are not translated: strengths are", "STRN")
    return "MAT_PLY_CODAM2", card | strengths


def _strengths(law: Card) -> dict[str, str]:
    """Fields of strengths by the names of a ply; a blank one of compression is that of tension."""
    names = {"XT": "XT", "XC": "XC", "YT": "YT", "YC": "YC", "SL": "S"}
    for own, other in (("XC", "XT"), ("YC", "YT")):
        if not law.word(own):
            names[own] = other
    return names


def _across(law: Card, card: CardOf) -> CardOf:
    """Constants across the thickness, which MAT8 has not, with the usual assumptions."""
    g13 = law.number("G1Z") or float(card["G12"])
    g23 = law.number("G2Z")
    nu23 = float(card["E2"]) / (2.0 * g23) - 1.0 if g23 > 0.0 else float(card["NU12"])
    nu23 = min(max(nu23, _LEAST_RATIO), _MOST_RATIO)
    g23 = g23 or float(card["E2"]) / (2.0 * (1.0 + nu23))
    law.block.remarks.append(
        f"MAT8 has no constants across: E3 = E2, nu13 = nu12, nu23 = {nu23:.3g}, G13 = {g13:g},"
        f" G23 = {g23:g}"
    )
    return {"G13": g13, "G23": g23, "NU23": nu23}
