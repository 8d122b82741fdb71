"""Control, outputs, supports and contacts of a deck."""

from __future__ import annotations

from plydyn_pre.deck.cards import keyword, title_line
from plydyn_pre.errors import PreError
from plydyn_pre.translate.bodies import find
from plydyn_pre.translate.deck import Plate
from plydyn_pre.translate.reader import LOST, REPLACED, TAKEN, Block
from plydyn_pre.translate.stack import with_mid_sides

_OUTPUTS = {
    "DATABASE_GLSTAT": "DATABASE_GLSTAT",
    "DATABASE_NODOUT": "DATABASE_NODOUT",
    "DATABASE_SPCFORC": "DATABASE_SPCFORC",
    "DATABASE_RCFORC": "DATABASE_IMPACTOR",
    "DATABASE_BINARY_D3PLOT": "DATABASE_BINARY_D3PLOT",
}
_MOST_SHARE = 0.8
_UNITS = ("LENGTH", "TIME", "MASS")
#: FS from which on it means a table
_FRICTION_OF_TABLE = 2.0


def read_control(plate: Plate) -> None:
    """Title, units, end, step and outputs."""
    lines = plate.control
    for block in find(plate.blocks, "TITLE"):
        block.mark(TAKEN, "", "TITLE")
        if block.has("TITLE"):
            lines.append(keyword("TITLE", title_line(str(block.raw("TITLE")))))
        break
    for block in find(plate.blocks, "CONTROL_UNITS"):
        block.mark(TAKEN, "", *_UNITS)
        lines.append(keyword("CONTROL_UNITS", {n.lower(): str(block.raw(n)) for n in _UNITS}))
    ends = list(find(plate.blocks, "CONTROL_TERMINATION"))
    if not ends:
        raise PreError(f"{plate.blocks[0].file}: *CONTROL_TERMINATION is missing")
    card = {"endtim": ends[0].positive("ENDTIM"), "endcyc": ends[0].whole("ENDCYC", 0)}
    lines.append(keyword("CONTROL_TERMINATION", card))
    _read_step(plate)
    for block in find(plate.blocks, "DAMPING_GLOBAL"):
        if block.raw("LCID", 0) == 0 and block.number("VALDMP", 0.0) > 0.0:
            lines.append(keyword("DAMPING_GLOBAL", {"lcid": 0, "valdmp": block.number("VALDMP")}))
    for name, own in _OUTPUTS.items():
        for block in find(plate.blocks, name):
            interval = block.number("DT", 0.0)
            needs = own != "DATABASE_IMPACTOR" or plate.sphere is not None
            if interval > 0.0 and needs:
                block.mark(TAKEN if own == name else REPLACED, f"*{own}", "DT")
                lines.append(keyword(own, {"dt": interval}))


def _read_step(plate: Plate) -> None:
    """The share of the stable step, as waves need room with large displacement; mass scaling."""
    share, scaled = _MOST_SHARE, 0.0
    for block in find(plate.blocks, "CONTROL_TIMESTEP"):
        given = block.number("TSSFAC", 0.0) or 0.9
        share = min(given, _MOST_SHARE)
        if share < given:
            block.mark(REPLACED, f"{share:g}: with large displacement waves need room", "TSSFAC")
        scaled = block.number("DT2MS", 0.0)
        if scaled > 0.0:
            block.mark(LOST, "elements with a larger step would lose mass", "DT2MS")
            scaled = 0.0
        elif scaled < 0.0:
            block.mark(TAKEN, "mass where the stable step of a ply over a quad is smaller", "DT2MS")
            plate.notes.append(
                "DT2MS scales the mass of plies, whose stable step is smaller than that of shells: "
                "look at Mass scaling in the listing of plydyn check before a run"
            )
    card = {"dtinit": 0.0, "tssfac": share}
    if scaled < 0.0:
        card |= {"isdo": 0.0, "tslimt": 0.0, "dt2ms": scaled}
    plate.control.append(keyword("CONTROL_TIMESTEP", card))


def read_supports(plate: Plate) -> None:
    """Held nodes of the plate."""
    sets = _node_sets(plate.blocks)
    single: dict[tuple[int, int, int], set[int]] = {}
    for block in find(plate.blocks, "BOUNDARY_SPC_SET", "BOUNDARY_SPC_NODE"):
        block.mark(REPLACED, "numbered anew", "NSID")
        block.mark(TAKEN, "over the whole thickness", "NID", "DOFX", "DOFY", "DOFZ")
        words = "the points of the plate have no rotations; a clamp holds x, y and z"
        block.mark(REPLACED, words, "DOFRX", "DOFRY", "DOFRZ")
        for row in block.rows:
            values = row.values
            if "NAME" in values:
                continue
            held = tuple(int(values.get(name, 0)) for name in ("DOFX", "DOFY", "DOFZ"))
            if not set(held) <= {0, 1}:
                raise block.fail("DOFX", "0 or 1 is needed", row.line)
            if values.get("CID"):
                raise block.fail("CID", "directions of their own are not translated", row.line)
            if not any(held):
                plate.notes.append(f"*{block.written}, line {row.line}, holds rotations only: lost")
                continue
            if block.name == "BOUNDARY_SPC_NODE":
                single.setdefault(held, set()).add(int(values.get("NID", 0)))
                continue
            sid = int(values.get("NSID", 0))
            if sid not in sets:
                raise block.fail("NSID", f"there is no set of nodes {sid}", row.line)
            _hold(plate, f"set {sid}", sets[sid], held)
    for held, ids in single.items():
        _hold(plate, "single nodes", ids, held)
    _read_history(plate)


def _hold(plate: Plate, title: str, ids: set[int], held: tuple[int, int, int]) -> None:
    """Hold what is of the plate among some nodes."""
    found = with_mid_sides(plate.stack, ids)
    others = ids - plate.stack.column_of.keys()
    if others:
        plate.notes.append(f"{title}: {len(others)} nodes that are not of the plate are lost")
    if found:
        plate.supports.append((title, found, held))


def _node_sets(blocks: list[Block]) -> dict[int, set[int]]:
    """Nodes of the sets."""
    sets: dict[int, set[int]] = {}
    for block in find(blocks, "SET_NODE_LIST"):
        names = [f"NID{n}" for n in range(1, 9)]
        block.mark(TAKEN, "with the mid-side nodes between them", *names)
        block.mark(REPLACED, "numbered anew", "SID")
        ids = {int(row.values[n]) for row in block.rows for n in names if n in row.values}
        sets[block.whole("SID")] = ids - {0}
    for block in find(blocks, "SET_NODE_LIST_GENERATE"):
        block.mark(TAKEN, "with the mid-side nodes between them", "SID")
        ids = set()
        for n in range(1, 5):
            block.mark(TAKEN, "", f"B{n}BEG", f"B{n}END")
            for row in block.rows:
                first = int(row.values.get(f"B{n}BEG", 0))
                last = int(row.values.get(f"B{n}END", first))
                if last - first > 10_000_000:
                    raise block.fail(f"B{n}END", f"{last} is too many nodes", row.line)
                ids |= set(range(first, last + 1)) - {0}
        sets[block.whole("SID")] = ids
    return sets


def _read_history(plate: Plate) -> None:
    """Nodes with a history."""
    ids = set()
    for block in find(plate.blocks, "DATABASE_HISTORY_NODE"):
        names = [f"ID{n}" for n in range(1, 9)]
        block.mark(TAKEN, "of the column of points that the node is in", *names)
        ids |= {int(row.values[n]) for row in block.rows for n in names if n in row.values} - {0}
    column_of = plate.stack.column_of
    plate.history = sorted({column_of[n] for n in ids if n in column_of})
    if lost := sorted(ids - column_of.keys()):
        plate.notes.append(f"no history of nodes that are not of the plate: {lost}")


def read_contacts(plate: Plate) -> None:
    """Contacts with the impactor are one *CONTACT_IMPACTOR now, with the largest friction."""
    if plate.sphere is None:
        return
    for block in find(plate.blocks, "CONTACT"):
        if block.written.startswith("CONTACT_TIED"):
            continue
        words = "*CONTACT_IMPACTOR, by Lagrange multipliers"
        block.mark(REPLACED, words, "SSID", "MSID", "SSTYP", "MSTYP")
        _read_friction(plate, block)
        words = "there is no penalty to scale"
        block.mark(LOST, words, "SFS", "SFM", "VDC", "SFST", "SFMT")


def _read_friction(plate: Plate, block: Block) -> None:
    """Static and dynamic coefficient and decay, where they are numbers and not tables or parts."""
    names = ("FS", "FD", "DC")
    values = tuple(float(block.raw(name, 0.0)) for name in names)
    static, dynamic, _ = values
    if static < 0.0 or static >= _FRICTION_OF_TABLE or dynamic > static:
        words = "a table, the friction of parts, or more at speed than at rest: not translated"
        block.mark(LOST, words, *names)
        return
    block.mark(TAKEN, "friction of the impactor; the largest of all its contacts", *names)
    plate.friction = max(plate.friction, values)
