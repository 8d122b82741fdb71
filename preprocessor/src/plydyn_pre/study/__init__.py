"""Studies as frozen dataclasses; the tables and keys of a recipe are their fields."""

from __future__ import annotations

from plydyn_pre.study.bricks import Bricks
from plydyn_pre.study.conditions import (
    Contact,
    Curve,
    Force,
    FrameAcceleration,
    Impactor,
    InitialVelocity,
    LineForce,
    Load,
    Motion,
    NodeSet,
    Pressure,
    Support,
)
from plydyn_pre.study.control import Control, Outputs, Profile, Units
from plydyn_pre.study.in_situ import Cluster, Strengths, clusters, in_situ
from plydyn_pre.study.joints import Cohesive, Joint, Springs
from plydyn_pre.study.laminate import Laminate, PlyRange, StackPly
from plydyn_pre.study.materials import (
    Elastic,
    Material,
    PlasticKinematic,
    PlyCodam2,
    PlyElastic,
)
from plydyn_pre.study.resolved import strengths_of, with_in_situ
from plydyn_pre.study.study import Study
from plydyn_pre.study.unused import unused

__all__ = [
    "Bricks",
    "Cluster",
    "Cohesive",
    "Contact",
    "Control",
    "Curve",
    "Elastic",
    "Force",
    "FrameAcceleration",
    "Impactor",
    "InitialVelocity",
    "Joint",
    "Laminate",
    "LineForce",
    "Load",
    "Material",
    "Motion",
    "NodeSet",
    "Outputs",
    "PlasticKinematic",
    "PlyCodam2",
    "PlyElastic",
    "PlyRange",
    "Pressure",
    "Profile",
    "Springs",
    "StackPly",
    "Strengths",
    "Study",
    "Support",
    "Units",
    "clusters",
    "in_situ",
    "strengths_of",
    "unused",
    "with_in_situ",
]
