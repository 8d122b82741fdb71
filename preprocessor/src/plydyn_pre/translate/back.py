"""Materials of plydyn as cards of LS-DYNA, with what these cards do not hold."""

from __future__ import annotations

from collections.abc import Iterator

from plydyn_pre.deck.cards import Card, written
from plydyn_pre.deck.materials import material_text
from plydyn_pre.errors import PreError
from plydyn_pre.study import Cohesive, Elastic, PlasticKinematic, PlyCodam2, PlyElastic, Springs
from plydyn_pre.study.materials import Material

#: Fields that have no value of plydyn's
_AXES = ("xp", "yp", "zp")


def lsdyna_lines(material: Material) -> Iterator[str]:
    """Its cards; axes along x of the plate (AOPT 2)."""
    match material:
        case PlyCodam2():
            yield from _enhanced(material, 1)
            yield from _pinho(material, 2)
        case PlyElastic():
            cards = [_first(material, 1), _shear(material) | {"aopt": 2.0}, *_vectors()]
            yield written("MAT_ORTHOTROPIC_ELASTIC", *cards)
        case Elastic() | PlasticKinematic() | Cohesive() | Springs():
            yield material_text(material, material.title, 1, lambda _: 0)
        case _:
            raise PreError(f"a material of kind {material.kind} has no card of LS-DYNA")


def _first(ply: PlyElastic | PlyCodam2, mid: int) -> Card:
    """Density, moduli and minor Poisson's ratios."""
    moduli = {"mid": mid, "ro": ply.density, "ea": ply.E1, "eb": ply.E2, "ec": ply.E3}
    minor = {
        "prba": ply.nu12 * ply.E2 / ply.E1,
        "prca": ply.nu13 * ply.E3 / ply.E1,
        "prcb": ply.nu23 * ply.E3 / ply.E2,
    }
    return {**moduli, **minor}


def _shear(ply: PlyElastic | PlyCodam2) -> dict[str, float]:
    """Shear moduli in LS-DYNA's order."""
    return {"gab": ply.G12, "gbc": ply.G23, "gca": ply.G13}


def _vectors() -> tuple[Card, Card]:
    """The axes: a along x, d along y."""
    zeros = dict.fromkeys(_AXES, 0.0)
    return zeros | {"a1": 1.0, "a2": 0.0, "a3": 0.0}, {
        **{"v1": 0.0, "v2": 0.0, "v3": 0.0},
        **{"d1": 0.0, "d2": 1.0, "d3": 0.0},
    }


def _enhanced(ply: PlyCodam2, mid: int) -> Iterator[str]:
    """MAT_054: strengths without fracture energies."""
    yield "$ MAT_054 loses the fracture energies: elements are deleted by failure strains, which"
    yield "$ depend on the mesh; shear is ALPH only. DFAILT is 2 G1T/XT over a crack band of 1"
    axes, vectors = _vectors()
    strong = {"xc": ply.XC, "xt": ply.XT, "yc": ply.YC, "yt": ply.YT, "sc": ply.SL}
    fibres = {"dfailt": 2.0 * ply.G1T / ply.XT, "dfailc": -2.0 * ply.G1C / ply.XC}
    soft = {"tfail": 0.0, "alph": 0.0, "soft": 1.0, "fbrt": 0.0, "ycfac": 2.0} | fibres
    shear = {**_shear(ply), "kf": 0.0, "aopt": 2.0}
    cards = [_first(ply, mid), shear, {**axes, "mangle": 0.0}, vectors, soft, strong]
    yield written("MAT_ENHANCED_COMPOSITE_DAMAGE", *cards)


def _pinho(ply: PlyCodam2, mid: int) -> Iterator[str]:
    """MAT_261: strengths and fracture energies."""
    yield "$ MAT_261 takes ENT, of shear across the matrix, for G2C, and has planes of fracture"
    yield "$ (FIO, degrees) where CODAM2 has quadratic onset; shear is linear up to SL without LCSS"
    axes, vectors = _vectors()
    shear = {**_shear(ply), "aopt": 2.0, "daf": 0.0, "dkf": 0.0, "dmf": 0.0, "efs": 0.0}
    energies = {"enkink": ply.G1C, "ena": ply.G1T, "enb": ply.G2T, "ent": ply.G2C}
    energies["enl"] = ply.G2S or ply.G2C
    strong = {"xc": ply.XC, "xt": ply.XT, "yc": ply.YC, "yt": ply.YT, "sl": ply.SL}
    last = {"fio": 53.0, "sigy": ply.SL, "lcss": 0, "beta": 0.0}
    cards = [_first(ply, mid), shear, axes, {**vectors, "mangle": 0.0}, energies, strong, last]
    yield written("MAT_LAMINATED_FRACTURE_DAIMLER_PINHO", *cards)
