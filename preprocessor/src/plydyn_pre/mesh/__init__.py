"""Plane meshes of quads with four or nine nodes."""

from __future__ import annotations

from plydyn_pre.mesh.coupon import Coupon, mesh_coupon
from plydyn_pre.mesh.gmsh_file import GmshFile, mesh_gmsh_file
from plydyn_pre.mesh.grid import Mesh, node_near
from plydyn_pre.mesh.limits import refuse_slivers
from plydyn_pre.mesh.ogrid import OgridDisc, OgridSquare, mesh_ogrid_disc, mesh_ogrid_square
from plydyn_pre.mesh.quality import Quality, quality
from plydyn_pre.mesh.rectangle import Rectangle, mesh_rectangle
from plydyn_pre.mesh.zones import Zone

#: What a study can say about its mesh
Shape = Rectangle | OgridSquare | OgridDisc | Coupon | GmshFile

__all__ = [
    "Coupon",
    "GmshFile",
    "Mesh",
    "OgridDisc",
    "OgridSquare",
    "Quality",
    "Rectangle",
    "Shape",
    "Zone",
    "make_mesh",
    "node_near",
    "quality",
]


def make_mesh(shape: Shape) -> Mesh:
    """Mesh a shape."""
    return refuse_slivers(_mesh(shape))


def _mesh(shape: Shape) -> Mesh:
    """Mesh a shape, whatever its quads."""
    match shape:
        case Rectangle():
            return mesh_rectangle(shape)
        case OgridSquare():
            return mesh_ogrid_square(shape)
        case OgridDisc():
            return mesh_ogrid_disc(shape)
        case Coupon():
            return mesh_coupon(shape)
        case GmshFile():
            return mesh_gmsh_file(shape)
