"""What a picture can be coloured by: ``uz``, ``sxx``, ``s13``, ``plastic_strain`` and the like."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pyvista as pv
from matplotlib.colors import Colormap

from plydyn_post.errors import ResultsError
from plydyn_post.grid import PLY_TENSOR, TENSOR
from plydyn_post.header import Header
from plydyn_post.style import DAMAGE_MAP, PLAIN_MAP, SIGNED_MAP

# Letter of a quantity -> (field of global components, of ply components, symbol, kind of unit)
TENSORS = {
    "s": ("stress", "stress_ply", r"\sigma", "stress"),
    "e": ("strain", "strain_ply", r"\varepsilon", ""),
}
VECTORS = {"u": ("displacement", "length"), "v": ("velocity", "length/time")}
# Name of a field of one number -> label, kind of unit, colours, their ends where always the same
SCALARS = {
    "plastic_strain": ("Plastic\nstrain", "", PLAIN_MAP, None),
    "damage_fibre": ("Fibre\ndamage", "", DAMAGE_MAP, (0.0, 1.0)),
    "damage_matrix": ("Matrix\ndamage", "", DAMAGE_MAP, (0.0, 1.0)),
    "damage_shear": ("Shear\ndamage", "", DAMAGE_MAP, (0.0, 1.0)),
    "dissipated": ("Dissipated\nenergy", "stress", PLAIN_MAP, None),
}


@dataclass(frozen=True)
class Shown:
    """A component of a field."""

    field: str
    component: int | None  # None is the length of a vector, or the number of a scalar
    label: str
    kind: str  # of its unit
    colours: Colormap
    limits: tuple[float, float] | None = None  # of the colours, where always the same
    bounded: bool = False  # between points it stays within the range of the points

    @property
    def signed(self) -> bool:
        """Whether colours are centred at zero."""
        return self.colours is SIGNED_MAP

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
        return Shown(name, None, *SCALARS[name], bounded=True)
    letter, place = name[:1], name[1:]
    if letter in VECTORS and place in ("", "x", "y", "z"):
        field, kind = VECTORS[letter]
        if not place:
            return Shown(field, None, rf"$|\mathbf{{{letter}}}|$", kind, PLAIN_MAP)
        colours = SIGNED_MAP if letter == "v" else PLAIN_MAP
        return Shown(field, "xyz".index(place), f"${letter}_{place}$", kind, colours)
    if letter in TENSORS:
        whole, ply, symbol, kind = TENSORS[letter]
        for field, components in ((whole, TENSOR), (ply, PLY_TENSOR)):
            if place in components:
                label = rf"${symbol}_{{{place}}}$"
                return Shown(field, components.index(place), label, kind, SIGNED_MAP)
    raise ResultsError(
        f"{name!r} is no quantity to show; expected u, ux, uy, uz, v, vx, vy, vz,"
        " sxx, syy, szz, sxy, syz, sxz, s11, s22, s33, s12, s23, s13, or e for strains,"
        f" {', '.join(SCALARS)}"
    )
