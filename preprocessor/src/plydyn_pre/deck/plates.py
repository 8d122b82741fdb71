"""Keywords of materials and laminates."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

from plydyn_pre.deck.cards import Card, keyword, title_line, titled
from plydyn_pre.deck.names import Names
from plydyn_pre.study import Elastic, Laminate, Material, PlasticKinematic, PlyElastic, Springs

_REFERENCES = {"bottom": -1, "middle": 0, "top": 1}
_BASES = {"equispaced": 0, "gauss_lobatto": 1}


def part_keywords(names: Names) -> Iterator[str]:
    """Laminate, expansion and joints of every part."""
    for part, pid in names.parts.items():
        laminate = names.study.laminate_of(part)
        title = laminate.title or f"{part} {laminate.layup}"
        yield keyword(
            "PART_COMPOSITE_LONG", title_line(title), _part(laminate, pid), *_plies(names, laminate)
        )
        yield keyword("SECTION_LAYERWISE", _section(laminate, pid), *_expansions(laminate))
        if not laminate.tied:
            apart = laminate.interfaces == "apart"
            mid = -1 if apart else names.material(laminate.interfaces)
            card = {"pid": pid, "ifac1": 0, "ifac2": 0, "mid": mid, "nq": 0}
            yield keyword("INTERFACE_COHESIVE", card)


def material_keywords(names: Names) -> Iterator[str]:
    """The materials that are used."""
    for name, mid in names.materials.items():
        yield _material(names.study.materials[name], name, mid)


def _part(laminate: Laminate, pid: int) -> Card:
    """The first card of a laminate."""
    return {
        "pid": pid,
        "elform": 0,
        "shrf": 1.0,
        "nloc": _REFERENCES[laminate.reference],
        "marea": 0.0,
        "hgid": 0,
        "adpopt": 0,
        "thshel": 0,
    }


def _plies(names: Names, laminate: Laminate) -> Iterator[Card]:
    """A card for every ply, from the bottom up."""
    for plyid, ply in enumerate(laminate.stack, start=1):
        yield {
            "mid": names.material(ply.material),
            "thick": ply.thickness,
            "b": ply.angle,
            "tmid": 0,
            "plyid": plyid,
            "shrfac": 0.0,
        }


def _section(laminate: Laminate, pid: int) -> Card:
    """The expansion of a laminate."""
    return {
        "pid": pid,
        "theory": 0,
        "order": laminate.order,
        "basis": _BASES[laminate.basis],
        "nqplan": 0,
        "nqthk": 0,
        "lump": 0,
    }


def _expansions(laminate: Laminate) -> Iterator[Card]:
    """Ranges of plies whose expansion is not the usual one of a single layer."""
    numbered = enumerate(laminate.stack, start=1)
    for (order, layers), plies in groupby(numbered, lambda item: (item[1].order, item[1].layers)):
        places = [place for place, _ in plies]
        if (order, layers) != (laminate.order, 1):
            yield {"plyid1": places[0], "plyid2": places[-1], "order": order, "nsub": layers}


def _material(material: Material, name: str, mid: int) -> str:
    """The keyword of a material."""
    title = material.title or name
    match material:
        case PlyElastic():
            return titled("MAT_PLY_ELASTIC", title, *_ply_elastic(material, mid))
        case Elastic():
            card = {"mid": mid, "ro": material.density, "e": material.E, "pr": material.nu}
            return titled("MAT_ELASTIC", title, card | {"da": 0.0, "db": 0.0, "k": 0.0})
        case PlasticKinematic():
            return titled("MAT_PLASTIC_KINEMATIC", title, *_plastic_kinematic(material, mid))
        case Springs():
            card = {"mid": mid, "ro": 0.0, "roflg": 0, "intfail": 0.0}
            stiffness = {"et": material.shear, "en": material.normal, "fn_fail": 0.0}
            return titled("MAT_COHESIVE_ELASTIC", title, card | stiffness)


def _plastic_kinematic(material: PlasticKinematic, mid: int) -> tuple[Card, Card]:
    """The cards of a metal with linear hardening."""
    elastic = {"mid": mid, "ro": material.density, "e": material.young, "pr": material.poisson}
    hardening = {"sigy": material.yield_stress, "etan": material.tangent, "beta": material.beta}
    rate = {"src": material.rate, "srp": material.power, "fs": 0.0, "vp": 0.0}
    return elastic | hardening, rate


def _ply_elastic(material: PlyElastic, mid: int) -> tuple[Card, Card]:
    """The cards of an orthotropic ply."""
    young = {name.lower(): getattr(material, name) for name in ("E1", "E2", "E3")}
    poisson = {name: getattr(material, name) for name in ("nu12", "nu13", "nu23")}
    shear = {name.lower(): getattr(material, name) for name in ("G12", "G13", "G23")}
    return {"mid": mid, "ro": material.density} | young | poisson, shear
