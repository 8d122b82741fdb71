"""An input file as the pre-processor of Abaqus exports it: parts, instances, internal sets."""

from __future__ import annotations

_HEAD = """*Heading
** Job name: LVI Model name: Model-1
*Preprint, echo=NO, model=NO, history=NO, contact=NO
**
** PARTS
**
*Part, name=Impactor
*Node
      1,           0.,           0.,           0.
*Nset, nset=Impactor-RefPt_, internal
 1,
*Nset, nset=RP
 1,
*Surface, type=REVOLUTION, name=RigidSurface_, internal
         0.,          0.,          0.,          0.,         1.,          0.
START,           0.,          -8.
CIRCL,           8.,           0.,           0.,           0.
LINE,           8.,          20.
*Rigid Body, ref node=Impactor-RefPt_, analytical surface=RigidSurface_
*Element, type=MASS, elset=RP_Inertia-1_
1, 1
*Mass, elset=RP_Inertia-1_
2e-4,
*Element, type=ROTARYI, elset=RP_Rot_
2, 1
*Rotary Inertia, elset=RP_Rot_
1., 1., 1., 0., 0., 0.
*End Part
**
*Part, name=Plate
*Node
"""
_TAIL = """*Nset, nset=Set-All, generate
  1,  81,   1
*Elset, elset=Set-All, generate
 1, 64, 1
*Elset, elset=CompositeLayup-1-1, generate
1, 64, 1
*Orientation, name=Ori-1
          1.,           0.,           0.,           0.,           1.,           0.
3, 0.
** Section: CompositeLayup-1-1
*Shell Section, elset=CompositeLayup-1-1, composite, orientation=Ori-1, controls=EC-1,
layup=CompositeLayup-1
0.125, 3, CFRP, 0., Ply-1
0.125, 3, CFRP, 90., Ply-2
0.125, 3, CFRP, 90., Ply-3
0.125, 3, CFRP, 0., Ply-4
*End Part
**
** ASSEMBLY
**
*Assembly, name=Assembly
**
*Instance, name=Plate-1, part=Plate
*End Instance
**
*Instance, name=Impactor-1, part=Impactor
         20.,        8.27,         -20.
         0.,        0.,         0.,         1.,        0.,         0., 90.
*End Instance
**
*Nset, nset=Set-Edge, instance=Plate-1
1,2,3,4,5,6,7,8,9,10,18,19,27,28,36,37,
45,46,54,55,63,64,72,73,74,75,76,77,78,79,80,81
*Elset, elset=_Surf-1_SPOS, internal, instance=Plate-1, generate
  1,  64,   1
*Surface, type=ELEMENT, name=Surf-1
_Surf-1_SPOS, SPOS
*End Assembly
**
** ELEMENT CONTROLS
*Section Controls, name=EC-1, ELEMENT DELETION=YES, hourglass=ENHANCED
1., 1., 1.
*Amplitude, name=Amp-1
0., 1., 1., 1.
** MATERIALS
*Material, name=CFRP
*Damage Initiation, criterion=HASHIN
2500.,1500.,  80., 230.,  90.,  90.
*Damage Evolution, type=ENERGY
205., 61., 0.277, 1.309
*Density
 1.6e-09,
*Elastic, type=LAMINA
153000., 10300.,    0.3,  6000.,  6000.,  3700.
**
*Surface Interaction, name=IntProp-1
*Friction, slip tolerance=0.005
 0.2,
*Surface Behavior, pressure-overclosure=HARD
**
** BOUNDARY CONDITIONS
*Boundary
Set-Edge, 1, 1
Set-Edge, 2, 2
Set-Edge, 3, 3
*Boundary
Impactor-1.RP, 1, 1
Impactor-1.RP, 2, 2
Impactor-1.RP, 4, 4
Impactor-1.RP, 5, 5
Impactor-1.RP, 6, 6
** PREDEFINED FIELDS
*Initial Conditions, type=VELOCITY
Impactor-1.RP, 1, 0.
Impactor-1.RP, 2, 0.
Impactor-1.RP, 3, -4000.
** INTERACTIONS
*Contact, op=NEW
*Contact Inclusions, ALL EXTERIOR
*Contact Property Assignment
 ,  , IntProp-1
** -----
*Step, name=Step-1, nlgeom=YES
*Dynamic, Explicit
, 0.00012
*Bulk Viscosity
0.06, 1.2
*Restart, write, number interval=1, time marks=NO
*Output, field
*Node Output
A, RF, U, V
*Element Output, directions=YES
LE, S
*Contact Output
CSTRESS,
*Output, history, variable=PRESELECT
*Output, history, time interval=1e-06
*Node Output, nset=Impactor-1.RP
A3, U3, V3
*End Step
"""


def cae() -> str:
    """A plate of 8 x 8 shells below a tup, with Hashin's criterion."""
    nodes = [
        f"{9 * j + i + 1:7d}, {5.0 * i:12.4f}, {5.0 * j:12.4f}, 0."
        for j in range(9)
        for i in range(9)
    ]
    corners = [9 * j + i + 1 for j in range(8) for i in range(8)]
    quads = [f"{n}, {a}, {a + 1}, {a + 10}, {a + 9}" for n, a in enumerate(corners, start=1)]
    return _HEAD + "\n".join([*nodes, "*Element, type=S4R", *quads, _TAIL])
