"""Decks of other programs, known by their first lines."""

from __future__ import annotations

import re
from pathlib import Path

from plydyn_pre.errors import PreError

_LOOKED_AT = 20_000  # characters
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


def refuse_others(path: Path) -> None:
    """Refuse a deck of another program by its name."""
    with path.open(encoding="utf-8", errors="replace") as stream:
        text = stream.read(_LOOKED_AT)
    if re.search(r"(?m)^\*KEYWORD\b", text, re.IGNORECASE):
        return
    for name, sign in _SIGNS.items():
        if re.search(f"(?m){sign}", text, re.IGNORECASE):
            deck = name if name.startswith("a ") else f"a deck of {name}"
            more = (
                "; its mesh can be that of a recipe (mesh of kind gmsh)" if name == "Abaqus" else ""
            )
            raise PreError(f"{path}: this is {deck}; decks of LS-DYNA are translated{more}")
