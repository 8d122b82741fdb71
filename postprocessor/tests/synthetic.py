"""Results of a job that the solver could have written, with known numbers."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np

from plydyn_post.hexahedra import LINEAR, QUADRATIC, lattice

SIDE, PLY, RADIUS = 40.0, 0.5, 6.0
PEAK, DURATION, END = 1500.0, 2.0e-3, 3.0e-3
SPEED, REBOUND, DEPTH = 3000.0, 2000.0, 1.2
ANGLES = (0.0, 90.0)
STATES = (0.0, 1.0e-3, 2.0e-3)
SHAPE = (0.0, 1.0, 0.4)  # deflection at the states, share of DEPTH


def force(time: np.ndarray) -> np.ndarray:
    """Half a sine: peak PEAK at DURATION/2, impulse 2 PEAK DURATION/pi."""
    inside = (time > 0.0) & (time < DURATION)
    return np.where(inside, PEAK * np.sin(np.pi * time / DURATION), 0.0)


def write_csv(path: Path, names: list[str], rows: np.ndarray) -> None:
    """Write a history."""
    lines = [",".join(names)] + [",".join(f"{one:.9e}" for one in row) for row in rows]
    path.write_text("\n".join(lines) + "\n")


def write_impactor(folder: Path, job: str, factor: float = 1.0) -> None:
    """Write the history of an impactor whose force is half a sine."""
    time = np.linspace(0.0, END, 601)
    share = np.clip(time / DURATION, 0.0, 1.0)
    speed = -SPEED + (SPEED + REBOUND) * (1 - np.cos(np.pi * share)) / 2
    moved = -DEPTH * np.sin(np.pi * share) + REBOUND * np.maximum(time - DURATION, 0.0)
    mass = 1.0e-3
    kinetic = 0.5 * mass * speed**2
    names = [
        "time [s]", "force [N]", "displacement [mm]", "velocity [mm/s]", "kinetic [mJ]",
        "absorbed [mJ]", "force x [N]", "force y [N]", "contacts [-]",
    ]  # fmt: skip
    nothing = np.zeros_like(time)
    columns = [
        time, factor * force(time), moved, speed, kinetic, kinetic[0] - kinetic, nothing, nothing,
        np.where(force(time) > 0, 5, 0),
    ]  # fmt: skip
    write_csv(folder / f"{job}.impactor_1.csv", names, np.column_stack(columns))


def write_energy(folder: Path, job: str) -> None:
    """Write the energies of such an impact."""
    time = np.linspace(0.0, END, 301)
    share = np.clip(time / DURATION, 0.0, 1.0)
    whole = 4500.0
    internal = 0.7 * whole * np.sin(np.pi * share) ** 2
    kinetic = 0.25 * whole * np.sin(np.pi * share) ** 2
    error = 4e-4 * np.sin(7 * np.pi * share) * share
    nothing = np.zeros_like(time)
    columns = [
        np.arange(301.0), time, np.full_like(time, 1e-5), kinetic, internal,
        whole - internal - kinetic, nothing, nothing, nothing, np.full_like(time, whole), error,
        nothing, nothing, nothing,
    ]  # fmt: skip
    names = [
        "cycle", "time [s]", "step [s]", "kinetic [mJ]", "internal [mJ]", "impactor [mJ]",
        "damping [mJ]", "external [mJ]", "contact [mJ]", "total [mJ]", "error [-]",
        "momentum x [N.s]", "momentum y [N.s]", "momentum z [N.s]",
    ]  # fmt: skip
    write_csv(folder / f"{job}.energy.csv", names, np.column_stack(columns))


JUMP = 40.0  # of the stress along x between the plies, at the peak
STRESSES = ("sxx", "syy", "szz", "sxy", "sxz", "syz")


def stress_at(z: np.ndarray, ply: np.ndarray, size: float) -> dict[str, np.ndarray]:
    """Bending stresses with a jump between the plies, and parabolic shear."""
    high = PLY * len(ANGLES)
    far = 2 * z / high - 1
    stiff = np.where(ply % 2 == 1, 1.0, 0.15)
    return {
        "sxx": 800.0 * size * stiff * far + JUMP * size * (ply % 2 == 1),
        "syy": 800.0 * size * (1.15 - stiff) * far,
        "szz": -20.0 * size * (1 + far) ** 2,
        "sxy": 60.0 * size * far * stiff,
        "sxz": 45.0 * size * (1 - far**2),
        "syz": 30.0 * size * (1 - far**2),
    }


def write_profile(folder: Path, job: str, factor: float = 1.0) -> None:
    """Write the profile of a bent laminate."""
    z = np.concatenate([np.linspace(k * PLY, (k + 1) * PLY, 5) for k in range(len(ANGLES))])
    ply = np.repeat(np.arange(1, len(ANGLES) + 1), 5)
    rows = []
    for time in np.linspace(0.0, DURATION, 21):
        stress = stress_at(z, ply, factor * np.sin(np.pi * time / DURATION))
        rows.append(
            np.column_stack([np.full_like(z, time), z, ply, *(stress[name] for name in STRESSES)])
        )
    names = ["time [s]", "z [mm]", "ply [-]", *(f"{name} [MPa]" for name in STRESSES)]
    write_csv(folder / f"{job}.profile_1.csv", names, np.concatenate(rows))


def plate(quads: int, quadratic: bool) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points (points, 3), cells (cells, nodes) and ply of each, faces between plies doubled."""
    n = 3 if quadratic else 2
    table = lattice(QUADRATIC if quadratic else LINEAR)
    points, cells, plies = [], [], []
    lines = np.linspace(0.0, SIDE, (n - 1) * quads + 1)
    count = 0
    for k in range(len(ANGLES)):
        heights = np.linspace(k * PLY, (k + 1) * PLY, n)
        x, y, z = np.meshgrid(lines, lines, heights, indexing="ij")
        points.append(np.column_stack([x.ravel(), y.ravel(), z.ravel()]))
        number = count + np.arange(x.size).reshape(x.shape)
        count += x.size
        for i in range(0, len(lines) - 1, n - 1):
            for j in range(0, len(lines) - 1, n - 1):
                cell = np.empty(n**3, dtype=int)
                cell[table.ravel()] = number[i : i + n, j : j + n].ravel()
                cells.append(cell)
                plies.append(k + 1)
    return np.concatenate(points), np.array(cells), np.array(plies)


def write_fields(folder: Path, job: str, quads: int = 6, quadratic: bool = True) -> None:
    """Write fields of a plate that is bent and recovers."""
    points, cells, ply = plate(quads, quadratic)
    bump = np.prod(np.sin(np.pi * points[:, :2] / SIDE) ** 2, axis=1)
    ply_of_point = np.repeat(np.arange(1, len(ANGLES) + 1), len(points) // len(ANGLES))
    displacement, stress = [], []
    for share in SHAPE:
        displacement.append(np.outer(-DEPTH * share * bump, [0.0, 0.0, 1.0]))
        parts = stress_at(points[:, 2], ply_of_point, share)
        order = ("sxx", "syy", "szz", "sxy", "syz", "sxz")
        stress.append(np.column_stack([bump * parts[name] for name in order]))
    with h5py.File(folder / f"{job}.vtkhdf", "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = [2, 0]
        kind = b"UnstructuredGrid"
        root.attrs.create("Type", kind, dtype=h5py.string_dtype("ascii", len(kind)))
        root["NumberOfPoints"] = [len(points)]
        root["NumberOfCells"] = [len(cells)]
        root["NumberOfConnectivityIds"] = [cells.size]
        root["Points"] = points
        root["Connectivity"] = cells.ravel()
        root["Offsets"] = np.arange(len(cells) + 1) * cells.shape[1]
        root["Types"] = np.full(len(cells), QUADRATIC if quadratic else LINEAR, dtype="u1")
        root["CellData/ply"] = ply
        root["CellData/angle"] = np.array(ANGLES)[ply - 1]
        root["PointData/displacement"] = np.concatenate(displacement).astype("f4")
        root["PointData/stress"] = np.concatenate(stress).astype("f4")
        write_steps(root, len(points))
        _write_own(file)


def write_steps(root: h5py.Group, points: int) -> None:
    """States of the fields that a file has, all on one mesh."""
    steps = root.create_group("Steps")
    steps.attrs["NSteps"] = len(STATES)
    steps["Values"] = np.array(STATES)
    nothing = np.zeros(len(STATES), dtype=int)
    for name in ("PartOffsets", "PointOffsets"):
        steps[name] = nothing
    for name in ("CellOffsets", "ConnectivityIdOffsets"):
        steps[name] = nothing[:, None]
    steps["NumberOfParts"] = nothing + 1
    for name in root["PointData"]:
        steps[f"PointDataOffsets/{name}"] = np.arange(len(STATES)) * points
    for name in root["CellData"]:
        steps[f"CellDataOffsets/{name}"] = nothing


def _write_own(file: h5py.File) -> None:
    own = file.create_group("plydyn")
    own.attrs["version"] = "0.1.0"
    own.attrs["title"] = "Two plies under a <sphere>"
    own.attrs["deck"] = "plate.k"
    units = {"length": "mm", "time": "s", "mass": "t", "force": "N", "stress": "MPa"}
    for kind, unit in units.items():
        own.attrs[kind] = unit
    rows = [[1, k + 1, k + 11, angle, k * PLY, (k + 1) * PLY] for k, angle in enumerate(ANGLES)]
    own["plies"] = np.array(rows)
    own["plies"].attrs["columns"] = "part,ply,ply_id,angle,bottom,top"
    top = PLY * len(ANGLES)
    own["impactors"] = np.array([[1.0, RADIUS, 1e-3, SIDE / 2, SIDE / 2, top + RADIUS]])
    own["impactors"].attrs["columns"] = "id,radius,mass,x,y,z"


def write_job(folder: Path, job: str = "plate", factor: float = 1.0) -> Path:
    """All files of a job; its name without an ending."""
    folder.mkdir(parents=True, exist_ok=True)
    write_fields(folder, job)
    write_impactor(folder, job, factor)
    write_energy(folder, job)
    write_profile(folder, job, factor)
    (folder / f"{job}.out").write_text("normal end\n")
    return folder / job
