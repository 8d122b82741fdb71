"""The system of units of a deck: named, asked for, or found from its materials."""

from __future__ import annotations

from collections.abc import Mapping

from plydyn_pre.errors import PreError
from plydyn_pre.translate.block import TAKEN, Block
from plydyn_pre.translate.bodies import Bodies
from plydyn_pre.translate.model import Model
from plydyn_pre.units import unit_factor

#: Consistent systems of length, time and mass that decks are in
SYSTEMS = (
    ("mm", "s", "t"),
    ("mm", "ms", "kg"),
    ("m", "s", "kg"),
    ("mm", "ms", "g"),
    ("cm", "us", "g"),
    ("in", "s", "slinch"),
)
_KINDS = ("length", "time", "mass")
#: Spellings of LS-DYNA and of its users
_SPELLED = {
    "meter": "m", "sec": "s", "msec": "ms", "micro_s": "us", "ton": "t", "tonne": "t",
    "mtrc_ton": "t", "megagram": "t", "gram": "g",
    "kilogram": "kg", "inch": "in", "lbf-s2/in": "slinch", "lbf-s^2/in": "slinch",
}  # fmt: skip
#: Density and modulus of solids from foams to heavy metals, in mm, s and t
_DENSITIES, _MODULI = (5.0e-10, 2.0e-8), (2.0e3, 8.0e5)


def units_of(model: Model, bodies: Bodies, asked: str, needed: bool) -> Mapping[str, str]:
    """The units of a deck; empty where they are not known and nothing needs them."""
    block = model.first("CONTROL_UNITS")
    if asked:
        units = _named(tuple(asked.replace("-", ",").split(",")), "--units")
        if block is not None:
            block.mark(TAKEN, "instead of it --units", "LENGTH", "TIME", "MASS")
        return _compared(model, bodies, units)
    if block is not None:
        block.mark(TAKEN, "", "LENGTH", "TIME", "MASS")
        block.lose_filled("units of the user are not translated", "LFAC", "TFAC", "MFAC")
        names = tuple(str(block.raw(name)) for name in ("LENGTH", "TIME", "MASS"))
        return _compared(model, bodies, _named(names, f"*CONTROL_UNITS, line {block.line}"))
    fitting = [system for system in SYSTEMS if _fits(bodies, system)]
    if len(fitting) == 1:
        words = "-".join(fitting[0])
        model.notes.append(
            f"units {words}, found from the densities and moduli, as the deck names none; --units"
            " names others"
        )
        return dict(zip(_KINDS, fitting[0], strict=True))
    if needed:
        for mid in sorted(_used(bodies)):  # rather than what follows from a missing density
            bodies.laws[mid].positive("RO")
        words = "the units of the deck are not known, and --like has numbers to convert"
        raise PreError(f"{model.blocks[0].file}: {words}; name them, as in --units mm,s,t")
    model.notes.append("units are not named and not clear from the materials; --units names them")
    return {}


def _named(names: tuple[str, ...], where: str) -> dict[str, str]:
    """Units by their names."""
    words = [_SPELLED.get(name.strip().lower(), name.strip().lower()) for name in names]
    units = dict(zip(_KINDS, words, strict=False))
    if len(words) != 3:
        raise PreError(f"{where}: {','.join(names)!r}: length, time and mass are needed: mm,s,t")
    for kind, word in units.items():
        if unit_factor((1.0, 1.0, 1.0), {kind: word}) == 1.0 and word not in ("mm", "s", "t"):
            raise PreError(f"{where}: {word!r} is no unit of {kind} that plydyn has")
    return units


def _compared(model: Model, bodies: Bodies, units: dict[str, str]) -> dict[str, str]:
    """The units that are named; with a note where the plies would not be of a solid in them."""
    if _used(bodies) and not _fits(bodies, tuple(units.values())):
        others = ["-".join(system) for system in SYSTEMS if _fits(bodies, system)]
        words = f"those of {' or '.join(others)}" if others else "of no system that is known"
        model.notes.append(
            f"units {'-'.join(units.values())} are named, but densities and moduli of the plies"
            f" are {words}: numbers of the library are converted to the units that are named"
        )
    return units


def _used(bodies: Bodies) -> set[int]:
    """The materials of the plies that are there."""
    return {ply.material for body in bodies.plates for ply in body.plies} & bodies.laws.keys()


def _fits(bodies: Bodies, system: tuple[str, ...]) -> bool:
    """Whether the plies have densities and moduli of solids; rigid bodies are often made up."""
    units = dict(zip(_KINDS, system, strict=True))
    laws = [bodies.laws[mid] for mid in _used(bodies)]
    for name, powers, (low, high) in (
        ("RO", (-3.0, 0.0, 1.0), _DENSITIES),
        ("EA", (-1.0, -2.0, 1.0), _MODULI),
        ("E1", (-1.0, -2.0, 1.0), _MODULI),
        ("E", (-1.0, -2.0, 1.0), _MODULI),
    ):
        factor = unit_factor(powers, units)
        if any(
            not low <= _value(block, name) / factor <= high for block in laws if _value(block, name)
        ):
            return False
    return bool(laws)


def _value(block: Block, name: str) -> float:
    """A number of a field; 0 for none, and for a curve, which is refused elsewhere."""
    return max(0.0, float(block.raw(name, 0.0)))
