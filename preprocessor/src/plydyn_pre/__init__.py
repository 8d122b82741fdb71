"""plydyn-pre: recipes of impacts on laminates, made into plydyn decks.

```python
from pathlib import Path
import plydyn_pre as pre

study = pre.load_recipe(Path("le2.toml"), ["mesh.n=6"])
mesh = pre.make_mesh(study.mesh)
print(pre.count(study, mesh))
pre.write_deck(pre.deck_text(study, mesh), Path("le2.k"))
job = pre.run(study, "results", threads=2, progress=True)
print(job.code, job.results, job.listing)
```
"""

from __future__ import annotations

from plydyn_pre.counts import Counts, count
from plydyn_pre.deck import deck_text, write_deck
from plydyn_pre.errors import LayupError, MeshError, PreError, RecipeError
from plydyn_pre.layup import Ply, is_balanced, is_symmetric, parse
from plydyn_pre.library import Entry, LibraryCard, find_card, library, sources
from plydyn_pre.mesh import (
    Coupon,
    GmshFile,
    Mesh,
    OgridDisc,
    OgridSquare,
    Quality,
    Rectangle,
    Zone,
    make_mesh,
    quality,
)
from plydyn_pre.recipe import example_recipe, load_recipe
from plydyn_pre.runs.chain import Job, run
from plydyn_pre.study import (
    Bar,
    Bricks,
    Clamp,
    Cluster,
    Cohesive,
    Contact,
    Control,
    Cracks,
    Curve,
    Elastic,
    Force,
    FrameAcceleration,
    Impactor,
    InitialDelamination,
    InitialVelocity,
    Laminate,
    Lever,
    LineForce,
    Motion,
    Outputs,
    PlaceSet,
    Plane,
    PlasticKinematic,
    PlyCodam2,
    PlyElastic,
    PlyFracture3d,
    PlyRange,
    Pressure,
    ProcessZone,
    Profile,
    Punch,
    Ring,
    Springs,
    Strengths,
    Study,
    Support,
    Units,
    clusters,
    in_situ,
    process_zone,
    strengths_of,
    unused,
)
from plydyn_pre.version import VERSION

__version__ = VERSION

__all__ = [
    "Bar",
    "Bricks",
    "Clamp",
    "Cluster",
    "Cohesive",
    "Contact",
    "Control",
    "Counts",
    "Coupon",
    "Cracks",
    "Curve",
    "Elastic",
    "Entry",
    "Force",
    "FrameAcceleration",
    "GmshFile",
    "Impactor",
    "InitialDelamination",
    "InitialVelocity",
    "Job",
    "Laminate",
    "LayupError",
    "Lever",
    "LibraryCard",
    "LineForce",
    "Mesh",
    "MeshError",
    "Motion",
    "OgridDisc",
    "OgridSquare",
    "Outputs",
    "PlaceSet",
    "Plane",
    "PlasticKinematic",
    "Ply",
    "PlyCodam2",
    "PlyElastic",
    "PlyFracture3d",
    "PlyRange",
    "PreError",
    "Pressure",
    "ProcessZone",
    "Profile",
    "Punch",
    "Quality",
    "RecipeError",
    "Rectangle",
    "Ring",
    "Springs",
    "Strengths",
    "Study",
    "Support",
    "Units",
    "Zone",
    "clusters",
    "count",
    "deck_text",
    "example_recipe",
    "find_card",
    "in_situ",
    "is_balanced",
    "is_symmetric",
    "library",
    "load_recipe",
    "make_mesh",
    "parse",
    "process_zone",
    "quality",
    "run",
    "sources",
    "strengths_of",
    "unused",
    "write_deck",
]
