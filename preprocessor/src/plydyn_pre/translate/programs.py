"""Decks by the program that they are of, known by their first lines."""

from __future__ import annotations

import re
from pathlib import Path

from plydyn_pre.errors import PreError

_LOOKED_AT = 20_000  # characters
LSDYNA = "LS-DYNA"
#: Programs whose decks are translated
TRANSLATED = (LSDYNA, "Abaqus", "Nastran")
#: What a line of a deck looks like that only this program has
_SIGNS = {
    "Radioss": r"^#RADIOSS|^/BEGIN\b|^/NODE\b|^/SHELL/",
    "Nastran": r"^BEGIN BULK|^CEND\b|^SOL +\d+|^(GRID|CQUAD4|PCOMP|MAT8)[ *,]",
    "Abaqus": r"^\*(Heading|Part, *name|Assembly|Instance|Step|Material, *name|Shell Section|"
    r"Element, *type|Solid Section|Surface Interaction|Include, *input|Nset, *nset|Elset, *elset)",
    "Ansys": r"^/PREP7|^/COM,|^NBLOCK,|^ET,\d",
    "PAM-CRASH": r"^INPUTVERSION|^ANALYSIS +EXPLICIT|^SHELL +/",
    "Marc": r"^(extended|sizing|alloc) +\d|^elements +\d|^connectivity *$",
    "SU2": r"^NDIME *=",
    "a gmsh mesh": r"^\$MeshFormat",
    "a recipe of plydyn-pre": r"^\[(impactor|laminate|mesh|control)\]",
}


def program_of(path: Path) -> str:
    """The program of a deck; an error for one that is not translated."""
    with path.open(encoding="utf-8", errors="replace") as stream:
        text = stream.read(_LOOKED_AT)
    if re.search(r"(?m)^\*KEYWORD\b", text, re.IGNORECASE):
        return LSDYNA
    for name, sign in _SIGNS.items():
        if re.search(f"(?m){sign}", text, re.IGNORECASE):
            if name in TRANSLATED:
                return name
            deck = name if name.startswith("a ") else f"a deck of {name}"
            known = f"{', '.join(TRANSLATED[:-1])} and {TRANSLATED[-1]}"
            raise PreError(f"{path}: this is {deck}; decks of {known} are translated")
    return LSDYNA
