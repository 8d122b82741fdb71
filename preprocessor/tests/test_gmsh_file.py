"""Meshes from gmsh's files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from plydyn_pre import GmshFile, Mesh, MeshError, make_mesh, quality
from plydyn_pre.mesh.session import session

#: Two rectangles side by side; the words in capitals are replaced
GEOMETRY = """
Point(1) = {0, 0, Z}; Point(2) = {2, 0, Z}; Point(3) = {3, 0, Z};
Point(4) = {0, 1, Z}; Point(5) = {2, 1, Z}; Point(6) = {3, 1, Z};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {4, 5}; Line(4) = {5, 6};
Line(5) = {1, 4}; Line(6) = {2, 5}; Line(7) = {3, 6};
Curve Loop(1) = {1, 6, -3, -5}; Plane Surface(1) = {1};
Curve Loop(2) = {2, 7, -4, -6}; Plane Surface(2) = {2};
Transfinite Curve{1, 3} = 5; Transfinite Curve{2, 4} = 3; Transfinite Curve{5, 6, 7} = 3;
Transfinite Surface{1, 2};
RECOMBINE
Physical Surface("wide") = {1}; Physical Surface("narrow") = {2};
Physical Curve("held") = {5}; Physical Point("tip") = {6};
Mesh.ElementOrder = ORDER; Mesh.SecondOrderIncomplete = INCOMPLETE;
"""


def geometry(folder: Path, **values: object) -> Path:
    """A file of the geometry above."""
    words = {"Z": 0.5, "RECOMBINE": "Recombine Surface{1, 2};", "ORDER": 2, "INCOMPLETE": 0}
    text = GEOMETRY
    for name, value in (words | values).items():
        text = text.replace(name, str(value))
    path = folder / "plate.geo"
    path.write_text(text)
    return path


def as_msh(path: Path, version: float) -> Path:
    """The mesh of a geometry as a file."""
    import gmsh

    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(str(path))
    gmsh.model.mesh.generate(2)
    gmsh.option.setNumber("Mesh.MshFileVersion", version)
    gmsh.write(str(path.with_suffix(".msh")))
    gmsh.finalize()
    return path.with_suffix(".msh")


def check_plate(mesh: Mesh, order: int) -> None:
    """Everything that holds for the geometry above."""
    assert mesh.order == order
    assert {name: len(quads) for name, quads in mesh.parts.items()} == {"wide": 8, "narrow": 4}
    assert quality(mesh).area == pytest.approx(3.0)
    assert quality(mesh).smallest_jacobian > 0.99
    held = mesh.nodes[mesh.node_sets["held"]]
    assert sorted(held[:, 1].tolist()) == pytest.approx(np.linspace(0, 1, 2 * order + 1))
    assert held[:, 0].tolist() == [0.0] * (2 * order + 1)
    assert mesh.nodes[mesh.node_sets["tip"]].tolist() == [[3.0, 1.0]]
    assert mesh.height == 0.5


@pytest.mark.parametrize("order", [1, 2])
def test_a_geometry_is_meshed_with_its_groups(tmp_path: Path, order: int) -> None:
    check_plate(make_mesh(GmshFile(geometry(tmp_path, ORDER=order))), order)


@pytest.mark.parametrize("version", [2.2, 4.1])
def test_a_mesh_is_read_with_its_groups(tmp_path: Path, version: float) -> None:
    mesh = make_mesh(GmshFile(as_msh(geometry(tmp_path), version)))
    check_plate(mesh, 2)


def test_numbers_of_the_file_are_kept(tmp_path: Path) -> None:
    mesh = make_mesh(GmshFile(as_msh(geometry(tmp_path), 2.2)))
    assert mesh.quad_ids.min() > 1  # elements of curves come first in the file
    assert len(np.unique(mesh.quad_ids)) == len(mesh.quads)


def test_quads_that_run_clockwise_are_turned(tmp_path: Path) -> None:
    path = geometry(tmp_path)
    text = path.read_text().replace("{1, 6, -3, -5}", "{5, 3, -6, -1}")
    path.write_text(text)
    check_plate(make_mesh(GmshFile(path)), 2)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"RECOMBINE": "", "ORDER": 1}, "'wide' is a triangle"),
        ({"RECOMBINE": "Recombine Surface{1};"}, "'narrow' is a triangle of second order"),
        ({"ORDER": 3}, "third order"),
    ],
)
def test_other_elements_are_refused_by_name(tmp_path: Path, values: dict, words: str) -> None:
    path = as_msh(geometry(tmp_path, **values), 4.1)
    with pytest.raises(MeshError, match=words) as caught:
        make_mesh(GmshFile(path))
    assert str(path) in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('Physical Surface("wide") = {1}; Physical Surface("narrow") = {2};', "", "no physical"),
        ('("narrow") = {2}', '("narrow") = {1, 2}', "two surface groups"),
        ("{3, 1, 0.5}", "{3, 1, 0.6}", "between z = 0.5 and 0.6"),
        ('("narrow") = {2}', '("other") = {1}', "two surface groups"),
        ('Physical Surface("narrow") = {2};', 'Physical Curve("far") = {7};', "not on a meshed"),
        ("Physical Point", "oops", "gmsh cannot use"),
    ],
)
def test_files_that_cannot_be_used_are_refused(
    tmp_path: Path, old: str, new: str, words: str
) -> None:
    path = geometry(tmp_path)
    path.write_text(path.read_text().replace(old, new))
    with pytest.raises(MeshError, match=words):
        make_mesh(GmshFile(path))


def test_a_missing_file_is_told(tmp_path: Path) -> None:
    with pytest.raises(MeshError, match="there is no file"):
        make_mesh(GmshFile(tmp_path / "none.msh"))


FORMS = (".msh", ".unv", ".med", ".inp", ".bdf", ".key", ".vtk")


def plate_in(folder: Path, suffix: str, order: int = 1, incomplete: int = 0) -> Path:
    """A plate of 8 x 8 quads of gmsh in a format, with a group of its edges."""
    with session() as gmsh:
        geo = gmsh.model.geo
        corners = [geo.addPoint(x, y, 0.0) for x, y in ((0, 0), (40, 0), (40, 40), (0, 40))]
        lines = [geo.addLine(corners[i], corners[(i + 1) % 4]) for i in range(4)]
        surface = geo.addPlaneSurface([geo.addCurveLoop(lines)])
        geo.synchronize()
        for line in lines:
            gmsh.model.mesh.setTransfiniteCurve(line, 9)
        gmsh.model.mesh.setTransfiniteSurface(surface)
        gmsh.model.mesh.setRecombine(2, surface)
        gmsh.model.addPhysicalGroup(2, [surface], name="plate")
        gmsh.model.addPhysicalGroup(1, lines, name="boundary")
        gmsh.option.setNumber("Mesh.SecondOrderIncomplete", incomplete)
        gmsh.model.mesh.generate(2)
        gmsh.model.mesh.setOrder(order)
        path = folder / f"plate{suffix}"
        gmsh.write(str(path))
    return path


@pytest.mark.parametrize("suffix", FORMS)
def test_one_plate_in_every_format(suffix: str, tmp_path: Path) -> None:
    mesh = make_mesh(GmshFile(plate_in(tmp_path, suffix)))
    assert mesh.quads.shape == (64, 4) and len(mesh.nodes) == 81
    assert np.ptp(mesh.nodes, axis=0) == pytest.approx([40.0, 40.0])
    if suffix in (".msh", ".unv", ".med", ".inp"):
        assert list(mesh.parts) == ["plate"]
        edge = mesh.nodes[mesh.node_sets["boundary"]]
        assert len(edge) == 32 and np.all((edge % 40.0 < 1e-6).any(axis=1))


@pytest.mark.parametrize("suffix", [".msh", ".inp"])
def test_quads_of_eight_nodes_get_a_ninth_in_their_middle(suffix: str, tmp_path: Path) -> None:
    mesh = make_mesh(GmshFile(plate_in(tmp_path, suffix, order=2, incomplete=1)))
    assert mesh.quads.shape == (64, 9)
    corners = mesh.nodes[mesh.quads[:, :4]].mean(axis=1)
    assert mesh.nodes[mesh.quads[:, 8]] == pytest.approx(corners)
    assert len(mesh.node_sets["boundary"]) == 64
    assert len(set(mesh.node_ids.tolist())) == len(mesh.nodes) == 17**2


def test_a_deck_of_abaqus_as_a_mesh(tmp_path: Path) -> None:
    path = tmp_path / "plate.inp"
    path.write_text(
        "*Heading\n** a comment\n*Node, nset=all\n1,0,0\n2,1,0\n3,2,0\n4,0,1\n5,1,1\n6,2,1\n"
        "*Element, type=S4R, elset=left\n11,1,2,5,4\n*Element, type=S4R, elset=right\n12,2,3,6,5\n"
        "*Nset, nset=edge, generate\n1,4,3\n*Nset, nset=more\nedge,6\n*Elset, elset=both\n11,12\n"
    )
    mesh = make_mesh(GmshFile(path))
    assert list(mesh.parts) == ["left", "right"]
    assert mesh.node_ids[mesh.node_sets["more"]].tolist() == [1, 4, 6]
    assert mesh.quad_ids[mesh.quad_sets["both"]].tolist() == [11, 12]
    path.write_text(
        path.read_text().replace(
            "type=S4R, elset=right\n12,2,3,6,5", "type=S3, elset=right\n12,2,3,6"
        )
    )
    with pytest.raises(MeshError, match="element 12 is of type S3: only quads can be used"):
        make_mesh(GmshFile(path))


def test_a_format_that_is_not_read_is_refused_with_those_that_are(tmp_path: Path) -> None:
    with pytest.raises(MeshError, match=r"meshes are read from \.bdf, \.inp"):
        make_mesh(GmshFile(plate_in(tmp_path, ".su2")))
