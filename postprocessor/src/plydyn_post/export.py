"""States as single files with a list of their times, for ParaView 5.11 and older."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from xml.sax.saxutils import quoteattr

from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from plydyn_post.errors import ResultsError
from plydyn_post.grid import read_state, read_times
from plydyn_post.results import Results


def write_pvd(results: Results, folder: Path, tick: Callable[[str], None] = lambda _: None) -> Path:
    """Write a .pvd with one .vtu per state beside it; returns the .pvd."""
    times = read_times(results.fields)
    folder.mkdir(parents=True, exist_ok=True)
    digits = max(4, len(str(len(times))))
    entries = []
    for step, time in enumerate(times):
        name = f"{results.job}_{step:0{digits}d}.vtu"
        _write_state(results, step, folder / name)
        entries.append(f'    <DataSet timestep="{time:.9g}" part="0" file={quoteattr(name)}/>')
        tick(name)
    path = folder / f"{results.job}.pvd"
    lines = [
        '<?xml version="1.0"?>',
        '<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">',
        "  <Collection>",
        *entries,
        "  </Collection>",
        "</VTKFile>",
    ]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def _write_state(results: Results, step: int, path: Path) -> None:
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(read_state(results.fields, step))
    if not writer.Write():
        raise ResultsError(f"{path} cannot be written")
