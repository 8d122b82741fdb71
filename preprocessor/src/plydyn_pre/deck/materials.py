"""Keywords of materials."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from textwrap import wrap

from plydyn_pre.deck.cards import Card, keyword, titled
from plydyn_pre.deck.names import Names
from plydyn_pre.study import (
    Cohesive,
    Elastic,
    Material,
    PlasticKinematic,
    PlyCodam2,
    PlyElastic,
    PlyFracture3d,
    Springs,
)

#: What comments begin with that say what a material has from the library, and their width
ORIGIN = "origin of "
_COMMENT = 98
_SHEARS = {"linear": 0, "exponential": 1, "curve": 2, "ramberg_osgood": 3}
_PERMANENT_SHEARS = {"linear": 0, "curve": 2, "ramberg_osgood": 3, "hardening": 4}
_WIDTHS = {"band": 0, "gauss_point": 1, "root_point": 2, "root_quad": 3}
_SNAPS = {"reduce": 0, "refuse": 1, "drop": 2}
_COMPRESSIONS = {"quadratic": 0, "hashin": 1}


def material_keywords(names: Names) -> Iterator[str]:
    """The materials that are used."""
    for name, mid in names.materials.items():
        yield material_keyword(names, name, mid)


def material_keyword(names: Names, name: str, mid: int) -> str:
    """The keyword of a material."""
    material: Material = names.study.materials[name]
    text = material_text(material, material.title or name, mid, names.curve)
    origin = names.study.origins.get(name)
    if origin is None:
        return text
    words = wrap(f"{ORIGIN}{material.title or name}: {origin.words}", _COMMENT)
    return "\n".join([*(f"$ {line}" for line in words), text])


def material_text(material: Material, title: str, mid: int, curve: Callable[[str], int]) -> str:
    """The keyword of a material; `curve` gives the number of a curve by its name."""
    match material:
        case PlyElastic():
            return titled("MAT_PLY_ELASTIC", title, *_elastic_cards(material, mid))
        case PlyCodam2():
            return titled("MAT_PLY_CODAM2", title, *_codam2_cards(material, mid, curve))
        case PlyFracture3d():
            return titled("MAT_PLY_FRACTURE_3D", title, *_fracture_cards(material, mid, curve))
        case Elastic():
            card = {"mid": mid, "ro": material.density, "e": material.E, "pr": material.nu}
            return titled("MAT_ELASTIC", title, card)
        case PlasticKinematic():
            return titled("MAT_PLASTIC_KINEMATIC", title, *_plastic_kinematic(material, mid))
        case Springs():
            stiffness = {"et": material.shear, "en": material.normal}
            return titled("MAT_COHESIVE_ELASTIC", title, {**_joint_head(mid), **stiffness})
        case Cohesive():
            cards = _cohesive_cards(material, mid)
            return "\n".join(
                [titled("MAT_COHESIVE_MIXED_MODE", title, *cards), *_laws(material, mid)]
            )


def _laws(material: Cohesive, mid: int) -> Iterator[str]:
    """How a bond fails where modes change and under pressure, and the scatter of its strengths."""
    if material.mode_mix == "work" or material.pressure_gain:
        mix = int(material.mode_mix == "work")
        yield keyword("INTERFACE_LAW", {"mid": mid, "mix": mix, "eta": material.pressure_gain})
    if material.scatter:
        size = {"m": material.scatter, "length": material.scatter_length}
        yield keyword("INTERFACE_SCATTER", {"mid": mid, "seed": material.seed, **size})


def _joint_head(mid: int) -> Card:
    """The first fields of what joins plies: it has no mass and is never deleted."""
    return {"mid": mid, "ro": 0.0}


def _cohesive_cards(material: Cohesive, mid: int) -> tuple[Card, Card]:
    """The cards of a bond that softens."""
    stiffness = {"en": material.normal, "et": material.shear}
    toughness = {"gic": material.GIC, "giic": material.GIIC}
    sign = -1.0 if material.mixing == "benzeggagh_kenane" else 1.0
    strength = {"xmu": sign * material.exponent, "t": material.N, "s": material.S}
    unused = {"und": 0.0, "utd": 0.0}
    return {**_joint_head(mid), **stiffness, **toughness}, strength | unused


def _plastic_kinematic(material: PlasticKinematic, mid: int) -> tuple[Card, Card]:
    """The cards of a metal with linear hardening."""
    elastic = {"mid": mid, "ro": material.density, "e": material.young, "pr": material.poisson}
    hardening = {"sigy": material.yield_stress, "etan": material.tangent, "beta": material.beta}
    rate = {"src": material.rate, "srp": material.power, "vp": 0.0}
    return elastic | hardening, rate


def _elastic_cards(material: PlyElastic | PlyCodam2 | PlyFracture3d, mid: int) -> tuple[Card, Card]:
    """The cards of an orthotropic ply."""
    young = {name.lower(): getattr(material, name) for name in ("E1", "E2", "E3")}
    poisson = {name: getattr(material, name) for name in ("nu12", "nu13", "nu23")}
    shear = {name.lower(): getattr(material, name) for name in ("G12", "G13", "G23")}
    return {"mid": mid, "ro": material.density} | young | poisson, shear


def _codam2_cards(ply: PlyCodam2, mid: int, number: Callable[[str], int]) -> tuple[Card, ...]:
    """The cards of a ply that is damaged."""
    strengths = ("XT", "XC", "YT", "YC", "SL", "ST")
    energies = {name.lower(): getattr(ply, name) for name in ("G1T", "G1C", "G2T", "G2C")}
    band = {"lstar": ply.width, "dmax": ply.largest_damage, "g2s": ply.G2S}
    power = ply.shear == "ramberg_osgood"
    curve = {
        "shear": _SHEARS[ply.shear],
        "lcid": number(ply.shear_curve),
        "gamu": ply.shear_strain if ply.shear == "exponential" else 0.0,
        "alpha": ply.shear_coefficient if power else 0.0,
        "n": ply.shear_exponent if power else 0.0,
    }
    choices = {
        "lrule": 0 if ply.width > 0.0 else _WIDTHS[ply.width_rule],
        "snap": _SNAPS[ply.snap_back],
        "rsnap": ply.snap_ratio,
        "mcomp": _COMPRESSIONS[ply.matrix_compression],
        "trial": 0,
        "close": int(ply.closes),
        "plateau": ply.plateau,
        "gz": int(not ply.weakens_across),
    }
    averages = {"brittle": 0.0, "r1": ply.average_along, "r2": ply.average_across}
    lines = _line_shares(ply)
    strong = {name.lower(): getattr(ply, name) for name in strengths}
    return *_elastic_cards(ply, mid), strong, energies | band, curve, choices, {**averages, **lines}


def _fracture_cards(ply: PlyFracture3d, mid: int, number: Callable[[str], int]) -> tuple[Card, ...]:
    """The cards of a ply that cracks on planes of fracture."""
    strengths = {name.lower(): getattr(ply, name) for name in ("XT", "XC", "YT", "YC", "SL")}
    energies = {name.lower(): getattr(ply, name) for name in ("G1T", "G1C", "G2T", "G2S")}
    band = {"lstar": ply.width, "dmax": ply.largest_damage, "bk": ply.mode_exponent}
    power, hardens = ply.shear == "ramberg_osgood", ply.shear == "hardening"
    shear = {
        "shear": _PERMANENT_SHEARS[ply.shear],
        "alpha": ply.shear_coefficient if power else 0.0,
        "n": ply.shear_exponent if power else 0.0,
        "sp": ply.shear_yield if hardens else 0.0,
        "kp": ply.shear_hardening if hardens else 0.0,
        "lcid": number(ply.shear_curve),
    }
    contact = {
        "fric": ply.friction,
        "plateau": ply.plateau,
        "lrule": 0 if ply.width > 0.0 else _WIDTHS[ply.width_rule],
        "pcrush": ply.crush_stress,
        "debris": ply.debris_limit,
        "share": ply.debris_share,
    }
    head = strengths | {"alpha0": ply.fracture_angle}, energies | band
    lines = _line_shares(ply)
    return *_elastic_cards(ply, mid), *head, shear, contact, *((lines,) if lines else ())


def _line_shares(ply: PlyCodam2 | PlyFracture3d) -> Card:
    """Shares of strength and of energy of one of the laws by which fibres soften, if of two."""
    shares = {name.lower(): getattr(ply, name) for name in ("FXT", "FGXT", "FXC", "FGXC")}
    return shares if min(shares.values()) < 1.0 else {}
