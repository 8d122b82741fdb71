"""Materials of an Abaqus file as laws of plies and of bonds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from plydyn_pre.translate.abaqus.lines import Keyword
from plydyn_pre.translate.abaqus.mesh import Mesh
from plydyn_pre.translate.block import Value

_STRENGTHS = ("XT", "XC", "YT", "YC", "SL", "ST")
_ENERGIES = ("G1T", "G1C", "G2T", "G2C")
_EIGHT = ("E1", "E2", "E3", "NU12", "NU13", "NU23", "G12", "G13")
#: Keywords that belong to the material above them
_PARTS = (
    *("DENSITY", "ELASTIC", "DAMAGE INITIATION", "DAMAGE EVOLUTION", "DAMAGE STABILIZATION"),
    *("PLASTIC", "RATE DEPENDENT", "USER MATERIAL", "DEPVAR", "EXPANSION", "CONDUCTIVITY"),
    *("SPECIFIC HEAT", "FAIL STRESS", "FAIL STRAIN", "DAMPING", "VISCOELASTIC", "HYPERELASTIC"),
    *("SHEAR FAILURE", "TENSILE FAILURE", "EOS", "USER DEFINED FIELD", "FIELD"),
)
#: What messages call fields of the model
_NAMES = {"RO": "density", "E": "E", "EN": "Knn", "ET": "Kss", "XMU": "POWER"}
#: Poisson's ratios 23 that stand in where the shear moduli give none of a material
_LEAST_RATIO, _MOST_RATIO = 0.0, 0.5

#: Points of MAT_PIECEWISE_LINEAR_PLASTICITY
_MOST_POINTS = 8

Card = dict[str, Value]


@dataclass
class Material:
    """The keywords of a material by their names."""

    keyword: Keyword
    parts: dict[str, Keyword] = field(default_factory=dict)

    def part(self, name: str) -> Keyword:
        """A keyword that must be there."""
        if name not in self.parts:
            raise self.keyword.fail("NAME", f"it has no *{name}")
        return self.parts[name]

    def elastic(self) -> Keyword:
        """Its elastic constants; what else it has and is not translated is refused."""
        for each in self.parts.values():
            if each.block.entry.fate == "lost" and not each.block.losses:
                each.block.lose(each.block.entry.words)
        return self.part("ELASTIC")

    def numbers(self, name: str, count: int) -> list[float]:
        """The first row of a keyword; one of further rows is refused."""
        keyword = self.part(name)
        found = keyword.all_numbers("", count)
        if len(found) > count + 1:
            words = "constants that vary with temperature, rate or fields are not translated"
            raise keyword.fail("", words, keyword.data[-1][0])
        return found


@dataclass
class Materials:
    """The materials of a file; each becomes a law where a section uses it."""

    mesh: Mesh
    known: dict[str, Material]
    orientations: dict[tuple[str, str], Keyword]

    def find(self, keyword: Keyword, name: str, line: int) -> Material:
        """A material by its name."""
        if name.upper() not in self.known:
            raise keyword.fail("MATERIAL", f"there is no material {name}", line)
        return self.known[name.upper()]

    def ply(self, keyword: Keyword, name: str, orientation: str, line: int) -> int:
        """The number of a ply law whose axis is that of an orientation."""
        material = self.find(keyword, name, line)
        axis = self.axis(keyword, orientation, line)
        key = (name.upper(), *axis)
        source = self.mesh.source
        new = key not in source.numbers.get("MAT", {})
        mid = source.number("MAT", key)
        if new:
            law, card = _ply(material)
            if law.startswith("MAT_PLY"):
                card |= {"AOPT": 2.0, "A1": axis[0], "A2": axis[1]}
            block = material.keyword.block
            source.put(law, block, {"MID": mid} | _density(material) | card, names=_NAMES)
        return mid

    def bond(self, keyword: Keyword, name: str, thickness: float, line: int) -> int:
        """The number of the law of a cohesive layer."""
        material = self.find(keyword, name, line)
        source = self.mesh.source
        mid = source.number("MAT", ("bond", name.upper(), thickness))
        elastic = material.elastic()
        elastic.kind("TYPE", "ISOTROPIC", "TRACTION")
        stiff = [value / thickness for value in material.numbers("ELASTIC", 3)]
        if stiff[1] != stiff[2]:
            elastic.block.lose("Ktt that differs from Kss is not translated")
        card: Card = {"MID": mid, "EN": stiff[0], "ET": stiff[1]}
        if "DAMAGE INITIATION" not in material.parts:
            source.put("MAT_COHESIVE_ELASTIC", material.keyword.block, card, names=_NAMES)
            return mid
        strength = two_shears(material.part("DAMAGE INITIATION"))
        energy, power = energies(material.part("DAMAGE EVOLUTION"), strength, stiff[:2])
        card |= {"GIC": energy[0], "GIIC": energy[1], "XMU": power}
        last = {"T": strength[0], "S": strength[1]}
        block = material.keyword.block
        source.put("MAT_COHESIVE_MIXED_MODE", block, card | last, names=_NAMES)
        return mid

    def axis(self, keyword: Keyword, name: str, line: int) -> tuple[float, float]:
        """The first axis of an orientation, in the plane of the plate."""
        if not name:
            return (1.0, 0.0)
        for key in ((keyword.space, name.upper()), ("", name.upper())):
            if key in self.orientations:
                return _axis(self.mesh, self.orientations[key], keyword.space)
        raise keyword.fail("ORIENTATION", f"there is no orientation {name}", line)


def read_materials(mesh: Mesh) -> Materials:
    """The materials and orientations of a file."""
    known: dict[str, Material] = {}
    orientations: dict[tuple[str, str], Keyword] = {}
    last: Material | None = None
    for keyword in mesh.keywords:
        with mesh.source.gathered():
            if keyword.name == "MATERIAL":
                last = known[keyword.option("NAME").upper()] = Material(keyword)
            elif keyword.name == "ORIENTATION":
                orientations[keyword.space, keyword.option("NAME").upper()] = keyword
            elif last and keyword.name in _PARTS:
                once(keyword, last.parts)
                last.parts[keyword.name] = keyword
            else:
                last = None
    return Materials(mesh, known, orientations)


def once(keyword: Keyword, parts: Mapping[str, Keyword]) -> None:
    """Refuse a keyword that its material or interaction has already."""
    if keyword.name in parts:
        words = f"is there twice, in line {parts[keyword.name].block.line} too"
        keyword.block.lose(words)


def _density(material: Material) -> Card:
    """Its density; blank where it has none."""
    if "DENSITY" not in material.parts:
        return {}
    return {"RO": material.numbers("DENSITY", 1)[0]}


def _ply(material: Material) -> tuple[str, Card]:
    """The law of a ply and its constants."""
    elastic = material.elastic()
    kinds = ("ISOTROPIC", "LAMINA", "ENGINEERING CONSTANTS")
    kind = elastic.kind("TYPE", "ISOTROPIC", *kinds)
    if kind == "ISOTROPIC":
        young, poisson = material.numbers("ELASTIC", 2)[:2]
        card: Card = {"E": young, "PR": poisson}
        return _metal(material, card) if "PLASTIC" in material.parts else ("MAT_ELASTIC", card)
    card = _lamina(material) if kind == "LAMINA" else _engineering(material)
    if "DAMAGE INITIATION" not in material.parts:
        return "MAT_PLY_ELASTIC", card
    onset = material.part("DAMAGE INITIATION")
    onset.kind("CRITERION", "", "HASHIN")
    card |= dict(zip(_STRENGTHS, material.numbers("DAMAGE INITIATION", 6)[:6], strict=True))
    card["MCOMP"] = 1
    if "DAMAGE EVOLUTION" in material.parts:
        growth = material.part("DAMAGE EVOLUTION")
        growth.kind("TYPE", "ENERGY", "ENERGY")
        growth.kind("SOFTENING", "LINEAR", "LINEAR")
        card |= dict(zip(_ENERGIES, material.numbers("DAMAGE EVOLUTION", 4)[:4], strict=True))
    return "MAT_PLY_CODAM2", card


def _lamina(material: Material) -> Card:
    """A lamina, with the usual assumptions across its thickness."""
    e1, e2, nu12, g12, g13, g23 = material.numbers("ELASTIC", 6)[:6]
    nu23 = e2 / (2.0 * g23) - 1.0 if g23 > 0.0 else nu12
    nu23 = min(max(nu23, _LEAST_RATIO), _MOST_RATIO)
    words = f"a lamina has no constants across: E3 = E2, nu13 = nu12, nu23 = {nu23:.3g} of G23"
    material.parts["ELASTIC"].block.remarks.append(words)
    card: Card = {"E1": e1, "E2": e2, "E3": e2, "NU12": nu12, "NU13": nu12, "NU23": nu23}
    return card | {"G12": g12, "G13": g13, "G23": g23}


def _engineering(material: Material) -> Card:
    """Nine constants."""
    found = material.numbers("ELASTIC", 9)
    return dict(zip((*_EIGHT, "G23"), found, strict=False))


def _metal(material: Material, card: Card) -> tuple[str, Card]:
    """A metal that hardens along a line or between points, or by Johnson and Cook's law."""
    plastic = material.part("PLASTIC")
    kind = plastic.kind("HARDENING", "ISOTROPIC", "ISOTROPIC", "KINEMATIC", "JOHNSON COOK")
    rows = [plastic.numbers("", words, line) for line, words in plastic.data]
    if kind == "JOHNSON COOK" and len(rows) == 1 and len(rows[0]) >= 3:
        plastic.block.remarks.append("there is no temperature: the power of it has no effect")
        return "MAT_SIMPLIFIED_JOHNSON_COOK", card | dict(zip("ABN", rows[0][:3], strict=True))
    if kind == "JOHNSON COOK" or not rows or any(len(row) > 2 for row in rows):
        raise plastic.fail("", "stress and plastic strain are needed, or A, B and n")
    if len(rows) > 2:
        if kind == "KINEMATIC" or len(rows) > _MOST_POINTS:
            words = f"{len(rows)} points of {kind} hardening: not translated; 2 are, and of"
            raise plastic.fail("", f"{words} ISOTROPIC {_MOST_POINTS}")
        points = enumerate(((*row, 0.0)[:2] for row in rows), start=1)
        pairs = [(f"ES{n}", f"EPS{n}", point) for n, point in points]
        more: Card = {
            name: x for *names, point in pairs for name, x in zip(names, point, strict=True)
        }
        return "MAT_PIECEWISE_LINEAR_PLASTICITY", card | more
    slope = 0.0
    if len(rows) == 2 and rows[1][1] > 0.0:
        hardening = (rows[1][0] - rows[0][0]) / rows[1][1]
        slope = hardening * float(card["E"]) / (hardening + float(card["E"]))
    last = {"SIGY": rows[0][0], "ETAN": slope, "BETA": float(kind == "ISOTROPIC")}
    return "MAT_PLASTIC_KINEMATIC", card | last


def _axis(mesh: Mesh, keyword: Keyword, space: str) -> tuple[float, float]:
    """The first axis of an orientation."""
    keyword.kind("SYSTEM", "RECTANGULAR", "RECTANGULAR")
    keyword.kind("DEFINITION", "COORDINATES", "COORDINATES")
    rows = [keyword.numbers("", words, line) for line, words in keyword.data]
    if not rows or len(rows[0]) < 6:
        raise keyword.fail("", "two points of three coordinates are needed")
    if len(rows[0]) > 6 and any(rows[0][6:9]):
        raise keyword.fail("", "an origin of its own has no effect on directions: leave it out")
    if len(rows) < 2 or not rows[1] or rows[1][0] != 3.0:
        raise keyword.fail("", "the axis of its second line must be 3, across the plate")
    first = mesh.turned(space, rows[0][:3])
    third = np.cross(first, mesh.turned(space, rows[0][3:6]))
    size = float(np.linalg.norm(first) * np.linalg.norm(third))
    if (
        not size
        or abs(first[2]) > 1e-3 * np.linalg.norm(first)
        or abs(third[2]) < 0.999 * (np.linalg.norm(third))
    ):
        raise keyword.fail("", "axes 1 and 2 must lie in the plate, whose normal is z")
    angle = np.radians(rows[1][1] if len(rows[1]) > 1 else 0.0) * np.sign(third[2])
    x, y = first[:2] / np.linalg.norm(first[:2])
    c, s = np.cos(angle), np.sin(angle)
    return (round(float(c * x - s * y), 15) + 0.0, round(float(s * x + c * y), 15) + 0.0)


def two_shears(keyword: Keyword) -> list[float]:
    """Strengths of a bond: normal and shear."""
    keyword.kind("CRITERION", "", "QUADS", "MAXS")
    found = keyword.all_numbers("", 3)
    if found[1] != found[2]:
        keyword.block.lose("a second shear strength that differs is not translated")
    if keyword.options["CRITERION"].upper() == "MAXS":
        keyword.block.remarks.append("the onset is by the squares of both stresses, as QUADS")
    return found[:2]


def energies(
    keyword: Keyword, strength: list[float], stiffness: list[float]
) -> tuple[list[float], float]:
    """Energies of a bond, and the exponent of its mixing: below zero for that of BK."""
    keyword.kind("SOFTENING", "LINEAR", "LINEAR")
    if keyword.kind("TYPE", "ENERGY", "ENERGY", "DISPLACEMENT") == "DISPLACEMENT":
        keyword.kind("MIXED MODE BEHAVIOR", "NONE", "NONE")
        # the separation at failure counts from that at onset
        reach = keyword.all_numbers("", 1)[0]
        pairs = zip(strength, stiffness, strict=True)
        return [0.5 * most * (most / slope + reach) for most, slope in pairs], 1.0
    mixing = keyword.kind("MIXED MODE BEHAVIOR", "NONE", "NONE", "BK", "POWER LAW")
    if mixing == "NONE":
        energy = keyword.all_numbers("", 1)[0]
        return [energy, energy], 1.0
    found = keyword.all_numbers("", 3)
    if found[1] != found[2]:
        keyword.block.lose("an energy of tearing that differs from that of shear")
    power = keyword.numbers("POWER", [keyword.option("POWER")], keyword.block.line)[0]
    return found[:2], -power if mixing == "BK" else power
