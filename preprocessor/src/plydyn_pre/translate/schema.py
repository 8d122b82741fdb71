"""The table of LS-DYNA's keywords, lsdyna.toml, and what the parts of their names mean."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache

from plydyn_pre.keywords import Card, keywords
from plydyn_pre.translate.block import FATES, IDLE, LOST, Entry, by_start, raw_table

_CONTACT_CARDS = tuple(
    "?" + " ".join(f"{card}{n}" for n in range(1, 9)).replace("B7", "SLDTHK") for card in "ABCDEF"
)
_MPP = " ".join(f"MPP{n}" for n in range(1, 9))
#: Parts of the names of contacts that say nothing that is not translated
_CONTACT_WORDS = {
    *("CONTACT", "AUTOMATIC", "ONE", "WAY", "SURFACE", "TO", "NODES", "SINGLE", "GENERAL"),
    *("ERODING", "FORMING", "TIED", "TIEBREAK", "SHELL", "EDGE", "INTERIOR"),
    *("MPP", "MORTAR", "SMOOTH", "OFFSET", "CONSTRAINED", "BEAM"),
}
#: Contacts whose first three cards are those of all others, by a part of their names
_PLAIN = ("TO_SURFACE", "SINGLE_SURFACE", "GENERAL")
_WALLS = {
    "FLAT": "XHEV YHEV ZHEV LENL LENM",
    "CYLINDER": "RADCYL LENCYL NSEGS",
    "SPHERE": "RADSPH",
}
#: Marks of kinds of fields
_KINDS = {"integer": "i:", "real": "", "word": "w:", "text": "t:", "words": "t:"}
_NUMBERS = {
    "020": "RIGID",
    "022": "COMPOSITE_DAMAGE",
    "054": "ENHANCED_COMPOSITE_DAMAGE",
    "055": "ENHANCED_COMPOSITE_DAMAGE",
    "054-055": "ENHANCED_COMPOSITE_DAMAGE",
    "058": "LAMINATED_COMPOSITE_FABRIC",
    "059": "COMPOSITE_FAILURE_SHELL_MODEL",
    "185": "COHESIVE_TH",
    "240": "COHESIVE_MIXED_MODE_ELASTOPLASTIC_RATE",
    "261": "LAMINATED_FRACTURE_DAIMLER_PINHO",
    "262": "LAMINATED_FRACTURE_DAIMLER_CAMANHO",
}
ALIASES = {
    **{f"MAT_{number}": f"MAT_{name}" for number, name in _NUMBERS.items()},
    **{known.alias: name for name, known in keywords().items() if known.alias},
    "SET_PART": "SET_PART_LIST",
    "ELEMENT_SHELL_THICKNESS_BETA": "ELEMENT_SHELL_THICKNESS",
    "ELEMENT_SHELL_THICKNESS_OFFSET": "ELEMENT_SHELL_BETA_OFFSET",
}


@cache
def table() -> dict[str, Entry]:
    """All entries by their names."""
    found = {}
    for name, data in raw_table("lsdyna.toml").items():
        cards = tuple(data["cards"]) if "cards" in data else _cards_of_solver(name, data)
        cards = (*cards, *data["more"]) if cards and "more" in data else cards
        found[name] = Entry(
            FATES[data["fate"]],
            data.get("words", ""),
            cards,
            data.get("sets", False),
            data.get("idle", {}),
            refused=data.get("refused", {}),
        )
    return found


def _cards_of_solver(name: str, entry: Mapping[str, str]) -> tuple[str, ...] | None:
    """The cards of a keyword that the solver has, too, or has the like of; None for others."""
    known = keywords().get(name) or keywords().get(entry.get("like", ""))
    return tuple(map(_card_text, known.cards)) if known else None


def _card_text(card: Card) -> str:
    """A card as the table has it."""
    widths = [str(each.width) for each in card.fields if each.kind != "text"]
    width = f"{','.join(widths if len(set(widths)) > 1 else widths[:1])} "
    width = "" if width in ("10 ", " ") else width
    mark = "*" if card.repeated else "?" if card.optional else ""
    return f"{width}{mark}{' '.join(_KINDS[each.kind] + each.name for each in card.fields)}"


def find(written: str) -> tuple[str, Entry]:
    """The full name of a keyword without its options, and what is known of it."""
    base, titles = written, []
    if base.endswith(("_ID_MPP", "_ID_MORTAR", "_ID_SMOOTH")):
        base = f"{base.replace('_ID', '')}_ID"
    for suffix in ("_TITLE", "_ID"):
        if base.endswith(suffix) and base != "TITLE":
            base, titles = base.removesuffix(suffix), ["t:NAME"]
    if base.startswith("SET_"):
        base = base.removesuffix("_COLLECT")  # sets of one number are united
    base = ALIASES.get(base, base)
    if base.startswith("CONTACT_"):
        return _contact(base, titles)
    if base.startswith("RIGIDWALL_GEOMETRIC_"):
        return _wall(base, titles)
    if base.startswith("RIGIDWALL_PLANAR_"):
        return _plane(base, titles)
    if base in table() and table()[base].cards is not None:
        each = base.startswith(("BOUNDARY_", "LOAD_"))
        return base, replace(table()[base], titles=tuple(titles), each=each)
    return base, replace(by_start(table(), base), titles=tuple(titles))


def _contact(base: str, titles: list[str]) -> tuple[str, Entry]:
    """A contact by the parts of its name."""
    words = base
    for option in ("_MPP", "_MORTAR", "_SMOOTH", "_OFFSET", "_CONSTRAINED", "_BEAM"):
        words = words.replace(option, "")
    if "FORCE_TRANSDUCER" in base:
        return base, Entry(IDLE, "output: the force of the impactor is written", None)
    if base.startswith(("CONTACT_INTERIOR", "CONTACT_2D", "CONTACT_1D")) or "THERMAL" in base:
        inside = "INTERIOR" in base
        known = by_start(table(), base) if inside else Entry(LOST, "not translated")
        return base, known
    if not any(plain in words for plain in _PLAIN):
        return base, Entry(LOST, "this kind of contact is not translated")
    if others := set(base.split("_")) - _CONTACT_WORDS:
        return base, Entry(LOST, f"{min(others)} of a contact is not translated")
    name = "CONTACT"
    if "TIEBREAK" in words:
        name += "_TIEBREAK_CLASSIC" if words.startswith("CONTACT_TIEBREAK") else "_TIEBREAK"
    elif "TIED" in words:
        name += "_TIED"
    entry = table()[name]
    eroding = ("ISYM EROSOP IADJ",) if "ERODING" in words else ()
    cards = (*(entry.cards or ())[:-1], *eroding, *_CONTACT_CARDS)
    mpp = [_MPP, f"&{_MPP}"] if "_MPP" in base else []
    return name, replace(entry, cards=cards, titles=(*titles, *mpp))


def _plane(base: str, titles: list[str]) -> tuple[str, Entry]:
    """A planar rigid wall by the parts of its name."""
    parts = base.split("_")[2:]
    if not set(parts) <= {"FINITE", "FORCES", "DISPLAY"}:
        return base, by_start(table(), base)
    entry = table()["RIGIDWALL_PLANAR"]
    cards = [*(entry.cards or ())]
    cards += [_WALLS["FLAT"]] if "FINITE" in parts else []
    cards += ["?i:SOFT i:SSID i:F1 i:F2 i:F3 i:F4"] if "FORCES" in parts else []
    idle = {**entry.idle, "output: forces of the wall are written": "SOFT SSID F[1-4]"}
    return "RIGIDWALL_PLANAR", replace(entry, cards=tuple(cards), titles=tuple(titles), idle=idle)


def _wall(base: str, titles: list[str]) -> tuple[str, Entry]:
    """A rigid wall by the parts of its name."""
    parts = base.split("_")
    entry = table()["RIGIDWALL_GEOMETRIC"]
    if parts[2] not in _WALLS or not set(parts[3:]) <= {"MOTION", "DISPLAY"}:
        return base, by_start(table(), base)
    cards = [*(entry.cards or ())[:2], _WALLS[parts[2]]]
    cards += ["i:LCID i:OPT VX VY VZ"] if "MOTION" in parts else []
    cards += ["?i:PID DRO DE DPR"] if "DISPLAY" in parts else []
    idle = {"for pictures": "PID DRO DE DPR", "a cylinder is exact": "NSEGS"}
    return f"RIGIDWALL_{parts[2]}", replace(
        entry, cards=tuple(cards), titles=tuple(titles), idle=idle
    )
