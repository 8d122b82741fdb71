"""Studies as frozen dataclasses; the tables and keys of a recipe are their fields."""

from __future__ import annotations

from plydyn_pre.study.bricks import Bricks
from plydyn_pre.study.conditions import (
    Contact,
    Curve,
    Force,
    FrameAcceleration,
    InitialVelocity,
    Lever,
    LineForce,
    Load,
    Motion,
    Pressure,
    Support,
)
from plydyn_pre.study.control import Control, Outputs, Profile, Units
from plydyn_pre.study.cracks import ZONE_OF_CRACKS, Cracks
from plydyn_pre.study.delamination import InitialDelamination
from plydyn_pre.study.doubts import doubts
from plydyn_pre.study.fixtures import Bar, Clamp, Fixture, Plane, Punch, Ring
from plydyn_pre.study.impactor import Impactor
from plydyn_pre.study.in_situ import Cluster, DamagedPly, Strengths, clusters, in_situ
from plydyn_pre.study.joints import Cohesive, Joint, Springs
from plydyn_pre.study.laminate import Laminate, PlyRange, StackPly, runs
from plydyn_pre.study.levels import ProcessZone, process_zone
from plydyn_pre.study.materials import (
    Elastic,
    Material,
    PlasticKinematic,
    PlyCodam2,
    PlyElastic,
    PlyFracture3d,
)
from plydyn_pre.study.resolved import fitted_joints, resolved, strengths_of
from plydyn_pre.study.sets import REGIONS, PlaceSet
from plydyn_pre.study.stages import Stage
from plydyn_pre.study.study import Study
from plydyn_pre.study.unused import unused

__all__ = [
    "REGIONS",
    "ZONE_OF_CRACKS",
    "Bar",
    "Bricks",
    "Clamp",
    "Cluster",
    "Cohesive",
    "Contact",
    "Control",
    "Cracks",
    "Curve",
    "DamagedPly",
    "Elastic",
    "Fixture",
    "Force",
    "FrameAcceleration",
    "Impactor",
    "InitialDelamination",
    "InitialVelocity",
    "Joint",
    "Laminate",
    "Lever",
    "LineForce",
    "Load",
    "Material",
    "Motion",
    "Outputs",
    "PlaceSet",
    "Plane",
    "PlasticKinematic",
    "PlyCodam2",
    "PlyElastic",
    "PlyFracture3d",
    "PlyRange",
    "Pressure",
    "ProcessZone",
    "Profile",
    "Punch",
    "Ring",
    "Springs",
    "StackPly",
    "Stage",
    "Strengths",
    "Study",
    "Support",
    "Units",
    "clusters",
    "doubts",
    "fitted_joints",
    "in_situ",
    "process_zone",
    "resolved",
    "runs",
    "strengths_of",
    "unused",
]
