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
    "a mesh of gmsh": r"^\$MeshFormat",
    "a mesh of VTK": r"\A# vtk DataFile|<VTKFile ",
    "a universal file (.unv)": r"\A *-1 *\r?\n *(15|151|164|2411|2412|2420|2467|2477) *$",
    "a file of HDF5, as .med is": r"\A.HDF\r?\n",
    "a recipe of plydyn-pre": r"^\[(impactor|laminate|mesh|control)\]",
}
#: Of these, files that a recipe may name as its mesh
MESHES = tuple(name for name in _SIGNS if re.match("a (mesh|universal|file)", name))


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
            mesh = "" if deck not in MESHES else "; a recipe takes it as a mesh of kind gmsh"
            raise PreError(f"{path}: this is {deck}; decks of {known} are translated{mesh}")
    return LSDYNA
