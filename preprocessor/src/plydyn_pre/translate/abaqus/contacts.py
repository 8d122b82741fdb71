"""Contacts and ties of an Abaqus file."""

from __future__ import annotations

from dataclasses import dataclass, field

from plydyn_pre.translate.abaqus.bodies import RigidBody
from plydyn_pre.translate.abaqus.lines import Keyword
from plydyn_pre.translate.abaqus.materials import energies, once, two_shears
from plydyn_pre.translate.abaqus.mesh import Mesh
from plydyn_pre.translate.block import Value

_PROPERTIES = (
    *("FRICTION", "COHESIVE BEHAVIOR", "DAMAGE INITIATION", "DAMAGE EVOLUTION"),
    *("SURFACE BEHAVIOR", "CONTACT DAMPING", "DAMAGE STABILIZATION"),
)
_NAMES = {"SSID": "surface 1", "MSID": "surface 2", "CN": "Knn", "NFLS": "normal strength"}
_NAMES |= {"SFLS": "shear strength", "ERATEN": "GIC", "ERATES": "GIIC", "FS": "*FRICTION"}
#: Option of a tiebreak contact with energies of its own
_BY_ENERGY = 9

Card = dict[str, Value]


@dataclass
class Property:
    """The keywords of a surface interaction by their names."""

    parts: dict[str, Keyword] = field(default_factory=dict)

    def friction(self) -> Card:
        """Static and dynamic coefficient, and decay."""
        keyword = self.parts.get("FRICTION")
        if keyword is None:
            return {}
        numbers = keyword.all_numbers("", 0)
        if "EXPONENTIAL DECAY" in keyword.options:
            return dict(zip(("FS", "FD", "DC"), numbers, strict=False))
        if len(keyword.data) > 1 or any(numbers[1:]):
            keyword.block.lose("friction that depends on rate, pressure or temperature")
        value = numbers[0] if numbers else 0.0
        return {"FS": value, "FD": value}

    def bond(self) -> Card:
        """What joins the two surfaces until it breaks; empty for a contact that only touches."""
        keyword = self.parts.get("COHESIVE BEHAVIOR")
        if keyword is None:
            return {}
        onset, growth = self.parts.get("DAMAGE INITIATION"), self.parts.get("DAMAGE EVOLUTION")
        if onset is None or growth is None:
            words = "without damage it never breaks: *TIE says so"
            raise keyword.fail("", f"{words}; *DAMAGE INITIATION and EVOLUTION let it break")
        stiff = keyword.all_numbers("", 0)
        if any(stiff[3:6]):
            keyword.block.lose("a stiffness that couples opening and sliding is not translated")
        normal, shear, other = (stiff + stiff[-1:] * 3 + [0.0] * 3)[:3]
        if other != shear:
            keyword.block.lose("Ktt that differs from Kss is not translated")
        if not normal and growth.options.get("TYPE", "").upper() == "DISPLACEMENT":
            words = "a separation that counts from the onset needs the stiffness"
            raise keyword.fail("", f"{words}: Knn, Kss and Ktt in its line")
        strength = two_shears(onset)
        energy, power = energies(growth, strength, [normal, shear])
        card: Card = {"OPTION": _BY_ENERGY, "NFLS": strength[0], "SFLS": strength[1]}
        card |= {"PARAM": power, "ERATEN": energy[0], "ERATES": energy[1]}
        if normal > 0.0:
            card |= {"CN": normal, "CT2CN": shear / normal}
        return card


def _properties(mesh: Mesh) -> dict[str, Property]:
    """Surface interactions by their names."""
    found: dict[str, Property] = {}
    last: Property | None = None
    for keyword in mesh.keywords:
        if keyword.name == "SURFACE INTERACTION":
            with mesh.source.gathered():
                last = found[keyword.option("NAME").upper()] = Property()
        elif last is not None and keyword.name in _PROPERTIES:
            once(keyword, last.parts)
            last.parts[keyword.name] = keyword
            if keyword.name == "SURFACE BEHAVIOR":
                _check_hard(keyword)
        else:
            last = None
    return found


def _check_hard(keyword: Keyword) -> None:
    """Refuse faces that stay together, and tell of a contact that was soft."""
    if "NO SEPARATION" in keyword.options:
        keyword.block.lose("contact opens freely: *TIE joins plies for good", "NO SEPARATION")
    kind = keyword.options.get("PRESSURE-OVERCLOSURE", "HARD").upper()
    if kind != "HARD":
        keyword.block.remarks.append(f"contact is hard, by Lagrange multipliers, and not {kind}")


def put_contacts(mesh: Mesh, bodies: list[RigidBody]) -> None:
    """Add the contacts and ties."""
    properties = _properties(mesh)
    for keyword in mesh.each("TIE", "CONTACT PAIR", "CONTACT PROPERTY ASSIGNMENT"):
        with mesh.source.gathered():
            _pairs(mesh, bodies, keyword, properties)
    for keyword in mesh.each("CONTACT INCLUSIONS"):
        with mesh.source.gathered():
            _inclusions(mesh, bodies, keyword, properties)
    for keyword in mesh.each("CONTACT EXCLUSIONS"):
        rigid = {nid for body in bodies for nid in body.nodes}
        for line, words in keyword.data:
            with mesh.source.gathered():
                _exclusion(mesh, keyword, words, line, rigid)


def _exclusion(mesh: Mesh, keyword: Keyword, words: list[str], line: int, rigid: set[int]) -> None:
    """Refuse to leave out what would touch an impactor."""
    one, other = (*words, "", "")[:2]
    for word in filter(None, (one, other)):
        surface = mesh.surface(keyword, word, line)
        nodes = {n for face in surface.faces for n in face} | surface.nodes
        if nodes & rigid or surface.analytical:
            keyword.block.lose("a body without its contact is not translated", line=line)


def _pairs(
    mesh: Mesh, bodies: list[RigidBody], keyword: Keyword, properties: dict[str, Property]
) -> None:
    """Add pairs of surfaces."""
    if keyword.options.get("OP", "ADD").upper() == "DELETE":
        raise keyword.fail("OP", "a contact that ends is not translated")
    for line, words in keyword.data:
        one, other, name = (*words, "", "", "")[:3]
        name = name if keyword.name == "CONTACT PROPERTY ASSIGNMENT" else ""
        name = name or keyword.options.get("INTERACTION", "")
        if keyword.name == "TIE":
            _put(mesh, bodies, keyword, (one, other, line), "CONTACT_TIED", {})
            continue
        if not one and keyword.name == "CONTACT PROPERTY ASSIGNMENT":
            continue  # of all that touches
        used = _property(keyword, properties, name, line)
        bond = used.bond()
        name = "CONTACT_TIEBREAK" if bond else "CONTACT"
        _put(mesh, bodies, keyword, (one, other or one, line), name, used.friction() | bond)


def _property(keyword: Keyword, properties: dict[str, Property], name: str, line: int) -> Property:
    """A surface interaction by its name."""
    if name.upper() not in properties:
        raise keyword.fail("INTERACTION", f"there is no interaction {name}", line)
    return properties[name.upper()]


def _inclusions(
    mesh: Mesh, bodies: list[RigidBody], keyword: Keyword, properties: dict[str, Property]
) -> None:
    """Add a general contact."""
    card: Card = {}
    for each in mesh.each("CONTACT PROPERTY ASSIGNMENT"):
        for line, words in each.data:
            if len(words) > 2 and not words[0] and not words[1]:
                used = _property(each, properties, words[2], line)
                if used.bond():
                    each.block.lose("a bond of all surfaces: name both surfaces", line=line)
                card = used.friction()
    if "ALL EXTERIOR" in keyword.options:
        written = "CONTACT_AUTOMATIC_GENERAL"
        mesh.source.put("CONTACT", keyword.block, {"SSID": 0} | card, written=written)
        return
    for line, words in keyword.data:
        one, other = (*words, "", "")[:2]
        _put(mesh, bodies, keyword, (one, other or one, line), "CONTACT", card)


def _put(
    mesh: Mesh,
    bodies: list[RigidBody],
    keyword: Keyword,
    pair: tuple[str, str, int],
    name: str,
    card: Card,
) -> None:
    """Add a contact of two surfaces."""
    one, other, line = pair
    sides: Card = {}
    for word, ids in ((one, ("SSID", "SSTYP")), (other, ("MSID", "MSTYP"))):
        sides |= dict(zip(ids, _side(mesh, bodies, keyword, word, line), strict=True))
    mesh.source.put(name, keyword.block, sides | card, line=line, names=_NAMES)


def _side(
    mesh: Mesh, bodies: list[RigidBody], keyword: Keyword, word: str, line: int
) -> tuple[int, int]:
    """The number and the kind of a side."""
    if not word:
        return 0, 5
    surface = mesh.surface(keyword, word, line)
    last = word.upper().rpartition(".")[2]
    for body in bodies:
        if (surface.analytical and last in {each.rpartition(".")[2] for each in body.surfaces}) or (
            surface.elements and surface.elements <= {e.number for e in body.elements}
        ):
            return body.pid, 3
    if surface.nodes:
        return mesh.source.put_set("SET_NODE_LIST", keyword.block, surface.nodes, line), 4
    if not surface.faces:
        raise keyword.fail(word, "the surface has no faces that are translated", line)
    return mesh.source.put_segments(keyword.block, surface.faces, line), 0
