"""Pictures of meshes: every quad, set and delamination is in them."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from programs import plydyn_pre
from test_sets import BOX, CIRCLE, PLATE, RING, plate

import plydyn_pre as pre
from plydyn_pre.deck.names import Names
from plydyn_pre.mesh_picture import picture_lines

SVG = "{http://www.w3.org/2000/svg}"
STUDY = plate(
    mesh=replace(PLATE, quads=(12, 8)),
    sets={"patch <a>": pre.PlaceSet(box=BOX), "gauge": pre.PlaceSet(at=(0.0, 0.0))},
    initial_delamination=(
        pre.InitialDelamination((1, 2), circle=CIRCLE),
        pre.InitialDelamination(3, ring=RING),
    ),
    impactor=pre.Impactor(4.0, 1.0e-5, (0.0, 0.0, -1000.0), position=(1.0, 2.0)),
)


def test_all_that_the_recipe_places_is_drawn() -> None:
    """Quads as paths, circles with their radius, and a line of the legend for each."""
    mesh = pre.make_mesh(STUDY.mesh)
    names = Names(STUDY, mesh)
    root = ElementTree.fromstring("\n".join(picture_lines(STUDY, mesh)))
    names.region(pre.PlaceSet(ring=RING), next(iter(mesh.parts)), "ring")
    counts = [len(names.quads_of(name, "")) for name in ("patch <a>", "ring")]
    paths = [path.get("d") for path in root.iter(f"{SVG}path")]
    assert [path.count("M") for path in paths] == [*counts, len(mesh.quads)]
    places = np.array(re.findall(r"[-\d.]+", paths[-1]), float).reshape(-1, 2)
    assert places.min(axis=0).tolist() == [-30.0, -20.0]
    assert places.max(axis=0).tolist() == [30.0, 20.0]
    circles = [
        [float(each.get(key)) for key in ("cx", "cy", "r")] for each in root.iter(f"{SVG}circle")
    ]
    assert circles[0][:2] == [0.0, 0.0]
    assert circles[1:] == [list(CIRCLE), [1.0, 2.0, 4.0]]
    assert [text.text for text in root.iter(f"{SVG}text")] == [
        f"set patch <a>: {counts[0]} quads",
        "set gauge: 1 nodes",
        "initial delamination 1: interfaces 1, 2",
        "initial delamination 2: interfaces 3",
    ]


def test_names_with_control_characters_leave_the_picture_readable() -> None:
    """XML has no place for them, not even escaped."""
    odd = plate(mesh=STUDY.mesh, sets={"a\x01\n<b>": pre.PlaceSet(box=BOX)}, title="\x1b[31m&")
    root = ElementTree.fromstring("\n".join(picture_lines(odd, pre.make_mesh(odd.mesh))))
    assert root.find(f"{SVG}title").text == " [31m&"
    assert next(root.iter(f"{SVG}text")).text.startswith("set a  <b>: ")


@pytest.mark.parametrize("order", [1, 2])
def test_sides_of_a_disc_are_bent_as_its_quads_are(order: int) -> None:
    """The middle of a parabola is the node in the middle of the side."""
    mesh = pre.make_mesh(pre.OgridDisc(20.0, 8.0, 4, 2, order=order))
    root = ElementTree.fromstring("\n".join(picture_lines(plate(mesh=STUDY.mesh), mesh)))
    (path,) = (each.get("d") for each in root.iter(f"{SVG}path"))
    first, bend, end = (
        np.array(re.findall(r"[-\d.e]+", path)[i : i + 2], float) for i in (0, 2, 4)
    )
    if order == 1:
        assert "Q" not in path
        return
    middle = 0.25 * first + 0.5 * bend + 0.25 * end
    assert middle == pytest.approx(mesh.nodes[mesh.quads[0, 4]], abs=1.0e-6)


def test_a_picture_is_asked_for_by_its_name(tmp_path: Path) -> None:
    """The command writes an SVG file, and nothing else."""
    assert plydyn_pre(tmp_path, "new", "beam.toml", "--template", "dcb").returncode == 0
    result = plydyn_pre(tmp_path, "mesh", "beam.toml", "-o", "beam.svg")
    assert result.returncode == 0, result.stderr
    assert "picture          beam.svg" in result.stdout
    assert (tmp_path / "beam.svg").read_text().startswith("<svg ")
    result = plydyn_pre(tmp_path, "mesh", "beam.toml", "-o", "new/folder/beam.svg")
    assert result.returncode == 0, result.stderr
    assert (tmp_path / "new" / "folder" / "beam.svg").exists()
    result = plydyn_pre(tmp_path, "mesh", "beam.toml", "-o", "beam.png")
    assert result.returncode == 2
    assert "beam.png is no name of a picture; beam.svg would be" in result.stderr
    assert not (tmp_path / "beam.png").exists()
