"""Interfaces between plies: states of JOB.interfaces.vtkhdf, and delaminated areas over time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pyvista as pv

from plydyn_post.errors import ResultsError
from plydyn_post.grid import nearest, read_times
from plydyn_post.header import Header, read_header
from plydyn_post.results import Results
from plydyn_post.sheets import LATTICES
from plydyn_post.symmetry import read_whole
from plydyn_post.table import Table
from plydyn_post.vtkhdf import nodes_of

#: Share of the fracture energy from which on an interface counts as delaminated
DELAMINATED = 0.5
#: The field of that share
ENERGY = "energy_share"
#: Damage is complete but for the round-off of means over quads
COMPLETE = 1.0 - 1e-6
#: The column of the projected area over which the damage is complete
FAILED_AREA = "projected failed area"
FIELDS = ("damage", "mode_mixity", "dissipated", ENERGY, "opening")


@dataclass(frozen=True)
class Interface:
    """What lies between two plies, at an instant; quads in the order of their elements."""

    number: int  # from the bottom, from 1
    angles: tuple[float, float]  # of the ply below and of the one above, degrees
    height: float  # z at time zero
    places: np.ndarray  # (quads, n, n, 2) at time zero
    elements: np.ndarray  # (quads,) of the deck
    fields: dict[str, np.ndarray]  # (quads, n, n) each, (quads, n, n, 3) the opening

    @property
    def damage(self) -> np.ndarray:
        """Damage at the nodes, 0 to 1, (quads, n, n)."""
        return np.clip(self.fields["damage"], 0.0, 1.0)

    @property
    def failed(self) -> np.ndarray:
        """1 at the nodes where the damage is complete, 0 elsewhere, (quads, n, n)."""
        return (self.damage >= COMPLETE).astype(float)

    @property
    def spent(self) -> np.ndarray:
        """Share of the fracture energy that is spent at the nodes, (quads, n, n).

        Results without that field tell complete damage only. `DELAMINATED` bounds both: halfway
        between nodes that failed and others the area is that of the solver's Gauss points.
        """
        if ENERGY in self.fields:
            return np.clip(self.fields[ENERGY], 0.0, 1.0)
        return self.failed

    @property
    def gap(self) -> np.ndarray | None:
        """How far the upper face is above the lower one at the nodes, (quads, n, n).

        Nothing where the results do not tell it.
        """
        return self.fields["opening"][..., 2] if "opening" in self.fields else None

    @property
    def words(self) -> str:
        """The angles in print, from the bottom up."""
        below, above = (f"{angle:g}°".replace("-", "−") for angle in self.angles)
        return f"{below} / {above}"


@dataclass(frozen=True)
class Interfaces:
    """All interfaces at an instant, from the bottom up."""

    time: float
    header: Header
    each: tuple[Interface, ...]

    @property
    def criterion(self) -> str:
        """What delaminated means in these results, for print."""
        if ENERGY in self.each[0].fields:
            return "half of the fracture energy spent"
        return "completely failed"


def read_interfaces(results: Results, time: float | None = None) -> Interfaces:
    """The interfaces at the state nearest to a time, at the last one without."""
    path = results.interface_fields
    times = read_times(path)
    step = len(times) - 1 if time is None else nearest(times, time, path)
    grid = read_whole(results, path, step)
    for name, data in (("damage", grid.point_data), ("interface", grid.cell_data)):
        if name not in data:
            raise ResultsError(f"{path} has no field {name!r}")
    kinds = set(map(int, grid.celltypes))
    if len(kinds) != 1 or not kinds <= LATTICES.keys():
        raise ResultsError(f"{path} holds no quads of 4 or 9 nodes to draw")
    nodes = nodes_of(grid, kinds.pop())
    numbers = np.asarray(grid.cell_data["interface"]).astype(int)
    each = [_interface(grid, nodes, numbers == one, one) for one in np.unique(numbers)]
    return Interfaces(float(times[step]), read_header(results.fields), tuple(each))


def _interface(
    grid: pv.UnstructuredGrid, nodes: np.ndarray, own: np.ndarray, number: int
) -> Interface:
    """One of the interfaces of a state."""
    cells = np.flatnonzero(own)
    data = grid.cell_data
    elements = np.asarray(data["element"]) if "element" in data else _elements(grid, nodes)
    cells = cells[np.argsort(elements[cells], kind="stable")]
    lattice = nodes[cells][:, LATTICES[_kind(nodes)]]
    points = np.asarray(grid.points, dtype=float)[lattice]
    fields = {
        name: np.asarray(grid.point_data[name], dtype=float)[lattice]
        for name in FIELDS
        if name in grid.point_data
    }
    below, above = (
        float(np.asarray(grid.cell_data[name])[cells[0]]) if name in grid.cell_data else np.nan
        for name in ("angle_below", "angle_above")
    )
    height = float(points[..., 2].mean())
    return Interface(number, (below, above), height, points[..., :2], elements[cells], fields)


def _elements(grid: pv.UnstructuredGrid, nodes: np.ndarray) -> np.ndarray:
    """Numbers that quads above each other share, (quads,), for files without those of the deck."""
    middle = np.asarray(grid.points)[nodes][..., :2].mean(axis=1)
    return np.unique(np.round(middle, 6), axis=0, return_inverse=True)[1].ravel()


def _kind(nodes: np.ndarray) -> int:
    """VTK's type of quads of 4 or 9 nodes, (quads, nodes)."""
    return 9 if nodes.shape[1] == 4 else 28


@dataclass(frozen=True)
class Areas:
    """Delaminated areas of what is drawn at an instant."""

    each: dict[int, float]  # by the number of the interface
    projected: float
    unit: str
    failed: float | None  # projected, where the damage is complete; nothing if not told apart

    @property
    def total(self) -> float:
        """The areas of all interfaces together."""
        return sum(self.each.values())


def read_areas(results: Results, time: float) -> Areas:
    """The areas of JOB.delamination.csv at a time, which the solver counts at its Gauss points."""
    table = results.delamination()
    row = int(np.argmin(np.abs(table["time"] - time)))
    each = {number: float(table[name][row]) for number, name in area_columns(table).items()}
    projected = float(table["projected area"][row])
    failed = table.get(FAILED_AREA)
    complete = None if failed is None else float(failed[row])
    return Areas(each, projected, table.unit("projected area"), complete)


def area_columns(table: Table) -> dict[int, str]:
    """Columns of the areas of single interfaces, by their numbers."""
    parts = ((name, name.split()) for name in table.names)
    return {
        int(words[1]): name
        for name, words in parts
        if len(words) == 3 and words[0] == "interface" and words[2] == "area"
    }
