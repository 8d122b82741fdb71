"""Input files of Abaqus."""

from __future__ import annotations

from pathlib import Path

from plydyn_pre.errors import PreError
from plydyn_pre.translate.abaqus.bodies import put_rigid_bodies, read_rigid_bodies
from plydyn_pre.translate.abaqus.conditions import put_loads, put_supports, put_velocities
from plydyn_pre.translate.abaqus.contacts import put_contacts
from plydyn_pre.translate.abaqus.lines import Keyword, read_keywords
from plydyn_pre.translate.abaqus.materials import read_materials
from plydyn_pre.translate.abaqus.mesh import Mesh, read_mesh
from plydyn_pre.translate.abaqus.sections import put_parts
from plydyn_pre.translate.source import ONLY_A_MESH, Source, settle_shown
from plydyn_pre.translate.twice import twice

_NAMED = ("MATERIAL", "ORIENTATION", "SURFACE", "SURFACE INTERACTION", "AMPLITUDE")
_HISTORY = 1000  # forces of the impactor over the run, where nothing asks for others


def read(path: Path) -> Source:
    """The model of an input file."""
    keywords, problems = read_keywords(path)
    source = Source("Abaqus", [keyword.block for keyword in keywords], problems=problems)
    mesh = read_mesh(source, keywords)
    source.problems += twice(
        (each.block, (each.name, each.space, each.options["NAME"].upper()), "NAME", each.block.line)
        for each in mesh.each(*_NAMED)
        if "NAME" in each.options
    )
    if not mesh.nodes:
        raise PreError(f"{path}: this deck of Abaqus has no nodes")
    if not any(keyword.name == "MATERIAL" for keyword in keywords):
        raise PreError(f"{path}: this deck of Abaqus has {ONLY_A_MESH}")
    _title(mesh)
    end = _step(mesh)
    materials = read_materials(mesh)
    bodies = read_rigid_bodies(mesh)
    put_supports(mesh, bodies, end)
    put_velocities(mesh, bodies)
    put_rigid_bodies(mesh, materials, bodies)
    put_parts(mesh, materials, {e.number for body in bodies for e in body.elements})
    put_contacts(mesh, bodies)
    put_loads(mesh, end)
    # sorted, for an analytical surface has nodes of its own
    source.put_nodes(next(mesh.each("NODE")).block, sorted(mesh.nodes.items()))
    settle_shown(source)
    return source


def _title(mesh: Mesh) -> None:
    """Add the title."""
    for keyword in mesh.each("HEADING"):
        if keyword.data:
            text = ", ".join(keyword.data[0][1])
            mesh.source.put("TITLE", keyword.block, {"TITLE": text}, line=keyword.data[0][0])
        return


def _step(mesh: Mesh) -> float:
    """Add the end of the only step and the outputs; its time."""
    steps = list(mesh.each("STEP"))
    for keyword in steps[1:]:
        keyword.block.lose("a second step is not translated: one of *DYNAMIC, EXPLICIT is")
    for keyword in steps[:1]:
        if keyword.options.get("NLGEOM", "YES").upper() == "NO":
            keyword.block.lose("small displacement is not translated", "NLGEOM")
    end = 0.0
    for keyword in list(mesh.each("DYNAMIC"))[:1]:
        with mesh.source.gathered():
            end = _end(mesh, keyword)
    if end > 0.0:
        _put_outputs(mesh, end)
    return end


def _put_outputs(mesh: Mesh, end: float) -> None:
    """Add the intervals of states and of the force of the impactor."""
    intervals: dict[str, tuple[Keyword, float]] = {}
    for keyword in mesh.each("OUTPUT"):
        with mesh.source.gathered():
            kind = "FIELD" if "FIELD" in keyword.options else "HISTORY"
            if interval := _interval(keyword, end):
                intervals.setdefault(kind, (keyword, interval))
    intervals.setdefault("HISTORY", (next(mesh.each("DYNAMIC")), end / _HISTORY))
    for kind, name in (("FIELD", "DATABASE_BINARY_D3PLOT"), ("HISTORY", "DATABASE_RCFORC")):
        if kind in intervals:
            keyword, interval = intervals[kind]
            mesh.source.put(name, keyword.block, {"DT": interval})


def _end(mesh: Mesh, keyword: Keyword) -> float:
    """Add the end and the share of the stable step."""
    if "EXPLICIT" not in keyword.options:
        raise keyword.fail("", "an implicit step is not translated; *DYNAMIC, EXPLICIT is")
    numbers = keyword.all_numbers("time", 1)
    end = numbers[1] if len(numbers) > 1 else 0.0
    names = {"ENDTIM": "time"}
    mesh.source.put("CONTROL_TERMINATION", keyword.block, {"ENDTIM": end}, names=names)
    if factor := keyword.options.get("SCALE FACTOR"):
        share = keyword.numbers("SCALE FACTOR", [factor], keyword.block.line)[0]
        mesh.source.put("CONTROL_TIMESTEP", keyword.block, {"TSSFAC": share})
    return end


def _interval(keyword: Keyword, end: float) -> float:
    """The interval of an output; 0 where it names none."""
    for name in ("TIME INTERVAL", "NUMBER INTERVAL"):
        if word := keyword.options.get(name):
            value = keyword.numbers(name, [word], keyword.block.line)[0]
            if value > 0.0:
                return value if name == "TIME INTERVAL" else end / value
    return 0.0
