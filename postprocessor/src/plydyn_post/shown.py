"""What a picture can be coloured by: ``uz``, ``sxx``, ``s13``, ``plastic_strain`` and the like."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pyvista as pv

from plydyn_post.errors import ResultsError
from plydyn_post.grid import PLY_TENSOR, TENSOR, Header

# Letter of a quantity -> (field of global components, of ply components, symbol, kind of unit)
TENSORS = {
    "s": ("stress", "stress_ply", r"\sigma", "stress"),
    "e": ("strain", "strain_ply", r"\varepsilon", ""),
}
VECTORS = {"u": ("displacement", "length"), "v": ("velocity", "length/time")}
# Name of a field of one number -> symbol, kind of unit
SCALARS = {
    "plastic_strain": (r"\bar{\varepsilon}^{p}", ""),
    "damage_fibre": (r"\omega_1", ""),
    "damage_matrix": (r"\omega_2", ""),
    "damage_shear": (r"\omega_{12}", ""),
    "dissipated": ("w", "stress"),
}


@dataclass(frozen=True)
class Shown:
    """A component of a field."""

    field: str
    component: int | None  # None is the length of a vector, or the number of a scalar
    symbol: str
    kind: str  # of its unit
    signed: bool  # colours are centred at zero

    def values(self, grid: pv.UnstructuredGrid, where: object) -> np.ndarray:
        """The component at the points, (points,)."""
        known = sorted(grid.point_data.keys())
        if self.field not in known:
            raise ResultsError(
                f"{where} has no field {self.field!r}; it has {', '.join(known) or 'none'}."
                " Fields are asked for in the deck with *DATABASE_FIELD"
            )
        data = np.asarray(grid.point_data[self.field], dtype=float)
        if data.ndim == 1:
            return data
        return np.linalg.norm(data, axis=1) if self.component is None else data[:, self.component]

    def unit(self, header: Header) -> str:
        """Unit of the numbers in the file, empty if the solver names none."""
        parts = [header.units.get(part, "") for part in self.kind.split("/") if part]
        return "/".join(parts) if all(parts) else ""


def shown(name: str) -> Shown:
    """The component of a name; strains are tensor components."""
    if name in SCALARS:
        symbol, kind = SCALARS[name]
        return Shown(name, None, symbol, kind, False)
    letter, place = name[:1], name[1:]
    if letter in VECTORS and place in ("", "x", "y", "z"):
        field, kind = VECTORS[letter]
        if not place:
            return Shown(field, None, rf"|\mathbf{{{letter}}}|", kind, False)
        return Shown(field, "xyz".index(place), f"{letter}_{place}", kind, letter == "v")
    if letter in TENSORS:
        whole, ply, symbol, kind = TENSORS[letter]
        for field, components in ((whole, TENSOR), (ply, PLY_TENSOR)):
            if place in components:
                text = rf"{symbol}_{{{place}}}"
                return Shown(field, components.index(place), text, kind, True)
    raise ResultsError(
        f"{name!r} is no quantity to show; expected u, ux, uy, uz, v, vx, vy, vz,"
        " sxx, syy, szz, sxy, syz, sxz, s11, s22, s33, s12, s23, s13, or e for strains,"
        f" {', '.join(SCALARS)}"
    )
