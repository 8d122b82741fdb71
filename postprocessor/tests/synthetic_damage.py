"""Results of a job with damage that the solver could have written, with known areas."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import synthetic
from synthetic import ANGLES, PLY, SIDE, STATES, write_steps

#: Interfaces from the bottom up: half axes of the delaminated ellipse along x and y at the end
ELLIPSES = ((6.0, 3.0), (3.0, 6.0), (4.0, 4.0))
#: Width of the rim over which the damage falls from 1 to 0, share of the half axes
RIM = 0.3
SHARES = (0.0, 0.6, 1.0)  # of the half axes, at the states
MECHANISMS = ("fibre damage", "matrix damage", "ply plasticity", "metal plasticity")
TAKEN = (20.0, 700.0, 300.0, 0.0, 900.0, 0.0)  # mJ at the end, delamination and friction last


def areas(share: float = 1.0) -> list[float]:
    """Areas of the ellipses inside which the damage is 1."""
    return [np.pi * a * b * share**2 for a, b in ELLIPSES]


def damage(x: np.ndarray, y: np.ndarray, half_axes: tuple[float, float], share: float) -> object:
    """1 inside an ellipse around the middle, falling to 0 outside, (points,)."""
    if share == 0.0:
        return np.zeros_like(x)
    a, b = (share * one for one in half_axes)
    radius = np.hypot((x - SIDE / 2) / a, (y - SIDE / 2) / b)
    return np.clip(1.0 - (radius - 1.0) / RIM, 0.0, 1.0)


def write_interfaces(folder: Path, job: str, quads: int = 24, nodes: int = 9) -> None:
    """One quad per element and interface, the interfaces not merged."""
    lines = np.linspace(0.0, SIDE, 2 * quads + 1 if nodes == 9 else quads + 1)
    x, y = (one.ravel() for one in np.meshgrid(lines, lines, indexing="ij"))
    cells = _quads(len(lines), nodes)
    count, each = len(ELLIPSES), len(x)
    points = [np.column_stack([x, y, np.full(each, (k + 1) * PLY)]) for k in range(count)]
    connectivity = np.concatenate([cells + k * each for k in range(count)])
    values = [
        np.concatenate([damage(x, y, half_axes, share) for half_axes in ELLIPSES])
        for share in SHARES
    ]
    with h5py.File(folder / f"{job}.interfaces.vtkhdf", "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = [2, 0]
        kind = b"UnstructuredGrid"
        root.attrs.create("Type", kind, dtype=h5py.string_dtype("ascii", len(kind)))
        root["NumberOfPoints"] = [count * each]
        root["NumberOfCells"] = [len(connectivity)]
        root["NumberOfConnectivityIds"] = [connectivity.size]
        root["Points"] = np.concatenate(points)
        root["Connectivity"] = connectivity.ravel()
        root["Offsets"] = np.arange(len(connectivity) + 1) * nodes
        root["Types"] = np.full(len(connectivity), 28 if nodes == 9 else 9, dtype="u1")
        number = np.repeat(np.arange(1, count + 1), len(cells))
        root["CellData/interface"] = number
        root["CellData/element"] = np.tile(np.arange(1, len(cells) + 1), count)
        root["CellData/angle_below"] = np.where(number % 2 == 1, 0.0, 90.0)
        root["CellData/angle_above"] = np.where(number % 2 == 1, 90.0, 0.0)
        root["PointData/damage"] = np.concatenate(values).astype("f4")
        write_steps(root, count * each)


def _quads(line: int, nodes: int) -> np.ndarray:
    """Quads of 4 or 9 nodes on a lattice of points, counter-clockwise, (quads, nodes)."""
    number = np.arange(line * line).reshape(line, line)
    if nodes == 4:
        at = ((0, 0), (1, 0), (1, 1), (0, 1))
    else:
        at = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1))
    step = 1 if nodes == 4 else 2
    places = range(0, line - step, step)
    return np.array([[number[i + a, j + b] for a, b in at] for i in places for j in places])


def add_energy_share(folder: Path, job: str) -> None:
    """Give the interfaces of a job a share of the fracture energy equal to the damage."""
    with h5py.File(folder / f"{job}.interfaces.vtkhdf", "r+") as file:
        root = file["VTKHDF"]
        root["PointData/energy_share"] = root["PointData/damage"][...]
        root["Steps/PointDataOffsets/energy_share"] = root["Steps/PointDataOffsets/damage"][...]


def add_opening(folder: Path, job: str, gaps: tuple[float, ...]) -> None:
    """Give the interfaces of a job gaps where they are damaged; those of the end are given."""
    with h5py.File(folder / f"{job}.interfaces.vtkhdf", "r+") as file:
        root = file["VTKHDF"]
        damage_now = root["PointData/damage"][...].reshape(len(STATES), len(gaps), -1)
        gap = damage_now * np.array(gaps)[None, :, None] * np.array(SHARES)[:, None, None]
        root["PointData/opening"] = np.outer(gap.ravel(), [0.0, 0.0, 1.0]).astype("f4")
        root["Steps/PointDataOffsets/opening"] = root["Steps/PointDataOffsets/damage"][...]


def add_ply_damage(folder: Path, job: str) -> None:
    """Give the fields of a job damage of fibres, matrix and shear, along the fibres of each ply."""
    with h5py.File(folder / f"{job}.vtkhdf", "r+") as file:
        root = file["VTKHDF"]
        points = root["Points"][:]
        ply = np.repeat(np.arange(len(ANGLES)), len(points) // len(ANGLES))
        x, y = points[:, 0], points[:, 1]
        for name, size in (("fibre", 0.2), ("matrix", 1.0), ("shear", 0.7)):
            values = []
            for share in SHARES:
                along = damage(x, y, (9.0, 2.0), share)
                across = damage(x, y, (2.0, 9.0), share)
                values.append(size * np.where(ply % 2 == 0, along, across))
            root[f"PointData/damage_{name}"] = np.concatenate(values).astype("f4")
            offsets = np.arange(len(STATES)) * len(points)
            root[f"Steps/PointDataOffsets/damage_{name}"] = offsets


def write_delamination(folder: Path, job: str) -> None:
    """Areas that grow with the states."""
    time = np.linspace(0.0, synthetic.END, 31)
    share = np.clip(time / STATES[-1], 0.0, 1.0)
    each = [share**2 * area for area in areas()]
    projected = share**2 * 90.0
    names = [f"interface {k + 1} area [mm2]" for k in range(len(each))]
    energies = [f"interface {k + 1} energy [mJ]" for k in range(len(each))]
    columns = [time, *each, np.sum(each, axis=0), projected, *(one * 0.79 for one in each)]
    synthetic.write_csv(
        folder / f"{job}.delamination.csv",
        ["time [s]", *names, "sum [mm2]", "projected area [mm2]", *energies],
        np.column_stack(columns),
    )


def add_dissipation(folder: Path, job: str) -> None:
    """Give the energies of a job one column for each mechanism."""
    path = folder / f"{job}.energy.csv"
    lines = path.read_text().splitlines()
    names = (*MECHANISMS, "delamination", "friction")
    head = lines[0].split(",")
    place = head.index("contact [mJ]") if "contact [mJ]" in head else 8
    head[place + 1 : place + 1] = [f"{name} [mJ]" for name in names]
    rows = [",".join(head)]
    for number, line in enumerate(lines[1:]):
        share = number / (len(lines) - 2)
        cells = line.split(",")
        cells[place + 1 : place + 1] = [f"{share * one:.9e}" for one in TAKEN]
        rows.append(",".join(cells))
    path.write_text("\n".join(rows) + "\n")


def write_job(folder: Path, job: str = "plate") -> Path:
    """All files of a job with damage; its name without an ending."""
    name = synthetic.write_job(folder, job)
    write_interfaces(folder, job)
    add_ply_damage(folder, job)
    write_delamination(folder, job)
    add_dissipation(folder, job)
    return name


#: Cracks from the bottom ply up: ends of the line, and how many pieces it has
CRACKS = {1: ((2.0, 10.0), (18.0, 10.0), 16), 2: ((10.0, 4.0), (10.0, 16.0), 6)}


def write_cracks(folder: Path, job: str) -> None:
    """A line in each of two plies; at each state the first half, then all of it has cracked."""
    points, cells, plies, shares = [], [], [], []
    for ply, (start, end, pieces) in CRACKS.items():
        share = np.linspace(0.0, 1.0, pieces + 1)[:, None]
        first = sum(len(each) for each in points)
        line = np.array(start) + share * (np.array(end) - start)
        points.append(np.column_stack([line, np.full(len(line), (ply - 0.5) * PLY)]))
        cells += [(first + i, first + i + 1) for i in range(pieces)]
        plies += [ply] * pieces
        shares.append(share[:, 0])
    every, along = np.concatenate(points), np.concatenate(shares)
    started = np.concatenate([along <= reach for reach in (-1.0, 0.5, 1.0)]).astype("f4")
    with h5py.File(folder / f"{job}.cracks.vtkhdf", "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = [2, 0]
        kind = b"UnstructuredGrid"
        root.attrs.create("Type", kind, dtype=h5py.string_dtype("ascii", len(kind)))
        root["NumberOfPoints"] = [len(every)]
        root["NumberOfCells"] = [len(cells)]
        root["NumberOfConnectivityIds"] = [2 * len(cells)]
        root["Points"] = every
        root["Connectivity"] = np.array(cells).ravel()
        root["Offsets"] = np.arange(len(cells) + 1) * 2
        root["Types"] = np.full(len(cells), 3, dtype="u1")
        root["CellData/ply"] = plies
        root["CellData/angle"] = np.where(np.array(plies) == 1, 0.0, 90.0)
        root["PointData/damage"] = started
        root["PointData/start"] = 1.0e-3 * started
        root["PointData/mode"] = 0.25 * started
        root["PointData/opening"] = np.outer(started, [0.0, 0.03, 0.04])
        write_steps(root, len(every))
