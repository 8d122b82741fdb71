"""Values of fields that the page of the manual calls refused are refused, with its words."""

from __future__ import annotations

from pathlib import Path

import abaqus_decks
import nastran_decks
import pytest
from foreign_decks import standard, translate
from foreign_forms import LAYUPS, refused, tiebreak
from user_decks import cohesive

from plydyn_pre.errors import PreError
from plydyn_pre.translate import Choices
from plydyn_pre.translate.schema import table
from plydyn_pre.translate.source import dialect

TEXT = standard()[0].text()
CONTACT = "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n"
CURVE = "*DEFINE_CURVE\n7\n0,0\n1,1\n"
GLUED = cohesive("comma")


def put(text: str) -> str:
    """The plain deck with more keywords."""
    return TEXT.replace("*END", f"{text}*END")


def swap(old: str, new: str, text: str = TEXT) -> str:
    """A deck with another line or field."""
    assert old in text
    return text.replace(old, new, 1)


def without(keyword: str, new: str, text: str = TEXT) -> str:
    """A deck with another keyword in place of one."""
    start = text.index(f"*{keyword}")
    end = text.index("\n*", start) + 1
    return text[:start] + new + text[end:]


def metal(name: str, *cards: str) -> str:
    """The plate of one metal."""
    return without("MAT_ENHANCED", "\n".join((name, *cards, "")))


def wall(card: str, more: str = "20,20,-5,20,20,-4", name: str = "PLANAR") -> str:
    """The plain deck over a rigid wall."""
    return put(f"*RIGIDWALL_{name}\n{card}\n{more}\n")


RATES = "*MAT_240\n11,1e-9,0,1,4000,2000,.004,{}\n.28,,,62.3,,,,{}\n.79,,,92.3\n" + CURVE
CLASSIC = "CONTACT_TIEBREAK_SURFACE_TO_SURFACE"
VELOCITY = "INITIAL_VELOCITY_RIGID_BODY"
DECKS = {
    ("NODE", "TC"): swap(
        f"{1:8d}{0.0:16.8f}{0.0:16.8f}{0.0:16.8f}", f"{1:8d}{0.0:16.8f}{0.0:16.8f}{0.0:16.8f}{9:8d}"
    ),
    ("NODE", "RC"): swap(
        f"{1:8d}{0.0:16.8f}{0.0:16.8f}{0.0:16.8f}",
        f"{1:8d}{0.0:16.8f}{0.0:16.8f}{0.0:16.8f}{3:8d}{7:8d}",
        without("BOUNDARY_SPC_SET", ""),
    ),
    ("ELEMENT_SHELL", "N4"): swap("       2      11      10", "       2      11      11"),
    ("ELEMENT_SHELL_THICKNESS", "THIC2"): swap(f"{0.5:>16}", f"{0.6:>16}", LAYUPS["thickness"]),
    ("ELEMENT_SHELL_OFFSET", "OFFSET"): swap(f"{0.25:>16}", f"{0.35:>16}", LAYUPS["offset"]),
    ("ELEMENT_MASS", "NID"): put("*ELEMENT_MASS\n900,41,1.0e-6\n"),
    ("ELEMENT_MASS_PART", "PID"): put("*ELEMENT_MASS_PART\n1,1.0e-6\n"),
    ("ELEMENT_MASS_PART", "LCID"): swap(
        "*END",
        "*ELEMENT_MASS_PART\n9,1.0e-6,,7\n*END",
        without("PART_INERTIA", "*PART\nball\n9,9,9\n"),
    ),
    ("PART_INERTIA", "VRX"): without(
        VELOCITY, "", swap("       0.0       0.0       0.0\n*CON", ",,-2000.,1.\n*CON")
    ),
    ("PART_COMPOSITE", "MAREA"): swap("     0.833       0.0", "     0.833       0.0       1.0"),
    ("SECTION_SHELL", "T2"): swap("       0.5       0.5", "       0.5       0.6", LAYUPS["icomp"]),
    ("SECTION_SHELL", "MAREA"): swap(
        "       0.5       0.5       0.5       0.5", ".5,.5,.5,.5,0,1.", LAYUPS["icomp"]
    ),
    ("INTEGRATION_SHELL", "S"): swap("     -0.75", "      0.85", LAYUPS["rule"]),
    ("MAT_ENHANCED_COMPOSITE_DAMAGE", "AOPT"): swap(
        "                 2.0\n", "                 4.0\n"
    ),
    ("MAT_ENHANCED_COMPOSITE_DAMAGE", "EA"): swap("  153000.0", "      -7.0"),
    ("MAT_ENHANCED_COMPOSITE_DAMAGE", "TWOWAY"): swap(
        "                 2.0\n", "                 2.0       1.0\n"
    ),
    ("MAT_ENHANCED_COMPOSITE_DAMAGE", "LCXC"): swap(
        "      90.0      54.0\n", "      90.0      54.0\n,\n,\n7\n"
    ),
    ("MAT_LAMINATED_FRACTURE_DAIMLER_CAMANHO", "GXC"): swap("79.9", "-7.0", GLUED),
    ("MAT_LAMINATED_FRACTURE_DAIMLER_CAMANHO", "ETAN"): swap("53.0,60.0", "53.0,60.0,-7.0", GLUED),
    ("MAT_COHESIVE_MIXED_MODE_ELASTOPLASTIC_RATE", "LCG1C"): without(
        "MAT_COHESIVE", RATES.format(0, 7), GLUED
    ),
    ("MAT_COHESIVE_MIXED_MODE_ELASTOPLASTIC_RATE", "INICRT"): without(
        "MAT_COHESIVE", RATES.format(1, 0), GLUED
    ),
    ("ELEMENT_SHELL_BETA", "BETA"): swap(
        f"       1.0       0.0       0.0\n{'':10}\n",
        ",,,,,,5.0\n,1.0\n",
        swap("                 2.0\n", "                 3.0\n", LAYUPS["beta"]),
    ),
    ("SECTION_SHELL", "ELFORM"): swap(
        "         1         2     0.833", "         1         5     0.833", LAYUPS["icomp"]
    ),
    ("SECTION_SHELL", "NIP"): swap(
        "         4         0       1.0         1",
        "         1         0       1.0         0",
        LAYUPS["icomp"],
    ),
    ("SET_NODE_LIST", "NID1"): swap(
        "*SET_NODE_LIST\n         1\n         1", "*SET_NODE_LIST\n         1\n      9999"
    ),
    ("CONTACT", "VC"): swap("       0.2       0.2\n", ".2,.2,,50.\n"),
    ("MAT_COHESIVE_ELASTIC", "FN_FAIL"): without(
        "MAT_COHESIVE", "*MAT_184\n11,1e-9,0,1,5e5,1e6,60.\n", GLUED
    ),
    ("MAT_COHESIVE_MIXED_MODE", "GAMMA"): swap("-1.634,62.3,92.3", "-1.634,62.3,92.3,,,2.", GLUED),
    ("MAT_LAMINATED_FRACTURE_DAIMLER_CAMANHO", "YC"): swap("236.0", "-7.0", GLUED),
    ("MAT_COHESIVE_GENERAL", "TES"): without(
        "MAT_COHESIVE", f"*MAT_186\n11,,,,3,7,0.3,0.8\n1,60.,90.\n{CURVE}", GLUED
    ),
    ("MAT_PIECEWISE_LINEAR_PLASTICITY", "VP"): metal(
        "*MAT_024", "1,2.7e-9,7e4,0.3,200.,500.", "40.,5.,,,0"
    ),
    ("MAT_PIECEWISE_LINEAR_PLASTICITY", "FAIL"): metal(
        "*MAT_024", "1,2.7e-9,7e4,0.3,200.,500.,0.2", ","
    ),
    ("MAT_PLASTIC_KINEMATIC", "FS"): metal("*MAT_003", "1,2.7e-9,7e4,0.3,200.,500.,0", "0,0,0.2"),
    ("MAT_RIGID", "CON1"): swap("       1.0       4.0       7.0", "1,5,7"),
    ("MAT_RIGID", "CMO"): swap("       1.0       4.0       7.0", "2,4,7"),
    ("CONTACT", "BT"): swap("       0.2       0.2\n", ".2,.2,,,,,1.0e-4\n"),
    ("CONTACT", "DT"): swap("       0.2       0.2\n", ".2,.2,,,,,0,1.0e-4\n"),
    ("CONTACT", "SBOXID"): swap(f"{CONTACT}         1         9", f"{CONTACT}1,9,3,3,4\n$"),
    ("CONTACT", "FS"): swap("       0.2       0.2\n", ".1,.2\n"),
    ("CONTACT_TIEBREAK", "OPTION"): tiebreak(
        "parts", "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK", (12, 60.0, 90.0)
    ),
    ("CONTACT_TIEBREAK", "PARAM"): tiebreak(
        "parts", "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK", (7, 60.0, 90.0, 0.1, 0.3, 0.8)
    ),
    ("CONTACT_TIEBREAK_CLASSIC", "NEN"): tiebreak("parts", CLASSIC, (60.0, 90.0, 1.0, 1.0)),
    ("CONTACT_TIEBREAK_CLASSIC", "TBLCID"): tiebreak("parts", CLASSIC, (60.0, 90.0, 2.0, 2.0, 7)),
    ("CONTROL_UNITS", "LFAC"): put("*CONTROL_UNITS\nmm,s,t\n2.0\n"),
    ("DAMPING_GLOBAL", "LCID"): put(f"{CURVE}*DAMPING_GLOBAL\n7,10.\n"),
    ("DAMPING_GLOBAL", "STX"): put("*DAMPING_GLOBAL\n0,10.,0.5\n"),
    ("BOUNDARY_SPC_SET", "CID"): swap(
        "*END",
        "*DEFINE_COORDINATE_SYSTEM\n5,0,0,0,1,1,0\n-1,1,0\n*END",
        without("BOUNDARY_SPC_SET", "*BOUNDARY_SPC_SET\n1,5,1,0,1\n"),
    ),
    ("BOUNDARY_SPC_SET", "DOFRX"): without("BOUNDARY_SPC_SET", "*BOUNDARY_SPC_SET\n1,,0,0,1,1\n"),
    ("BOUNDARY_PRESCRIBED_MOTION_SET", "DOF VAD"): put(
        f"{CURVE}*BOUNDARY_PRESCRIBED_MOTION_SET\n1,5,2,7\n"
    ),
    ("BOUNDARY_PRESCRIBED_MOTION_RIGID", "BIRTH DEATH"): without(
        VELOCITY, f"{CURVE}*BOUNDARY_PRESCRIBED_MOTION_RIGID\n9,3,2,7,-1.,,1e-4\n"
    ),
    ("INITIAL_VELOCITY", "VXR"): put("*INITIAL_VELOCITY\n1\n1.,0,0,1.\n"),
    ("INITIAL_VELOCITY_RIGID_BODY", "VXR"): without(VELOCITY, f"*{VELOCITY}\n9,0,0,-2e3,1.\n"),
    ("INITIAL_VELOCITY_GENERATION", "OMEGA"): put(
        "*INITIAL_VELOCITY_GENERATION\n9,2,1.0,0,0,-2e3\n,\n"
    ),
    ("INITIAL_VELOCITY_GENERATION", "PHASE"): put(
        "*INITIAL_VELOCITY_GENERATION\n9,2,0,0,0,-2e3\n,,,,,,1\n"
    ),
    ("INITIAL_VELOCITY_GENERATION", "STYP"): put(
        "*INITIAL_VELOCITY_GENERATION\n9,4,0,0,0,-2e3\n,\n"
    ),
    ("LOAD_NODE_POINT", "DOF"): put(f"{CURVE}*LOAD_NODE_POINT\n41,5,7,1.\n"),
    ("LOAD_NODE_POINT", "CID"): put(f"{CURVE}*LOAD_NODE_POINT\n41,3,7,1.,2\n"),
    ("LOAD_SEGMENT", "AT"): put(f"{CURVE}*LOAD_SEGMENT\n7,1.,1e-4,1,2,11,10\n"),
    ("LOAD_BODY_Z", "LCID"): put(f"{CURVE}*LOAD_BODY_Z\n7,9810.\n"),
    ("LOAD_BODY_Z", "CID"): put(f"{CURVE}*LOAD_BODY_Z\n7,9810.,,,,,3\n"),
    ("RIGIDWALL_PLANAR", "FRIC"): wall("0", "20,20,-5,20,20,-4,2.0"),
    ("RIGIDWALL_PLANAR", "OFFSET"): wall("0,0,0,1.0"),
    ("RIGIDWALL_PLANAR", "BOXID"): wall("0,0,3"),
    ("RIGIDWALL_PLANAR", "ZH"): wall("0", "20,20,-5,21,20,-4"),
    ("RIGIDWALL_GEOMETRIC", "BIRTH DEATH"): wall(
        "0,0,0,1e-4", "20,20,-9,20,20,-8,0.1\n8.0", "GEOMETRIC_SPHERE"
    ),
    ("RIGIDWALL_GEOMETRIC", "OPT"): wall(
        "0", f"20,20,-5,20,20,-4,0.1\n25,20,-5,5.,5.\n7,0,0,0,1.\n{CURVE}", "GEOMETRIC_FLAT_MOTION"
    ),
    ("SET_NODE_GENERAL", "OPTION"): without("SET_NODE_LIST", "*SET_NODE_GENERAL\n1\nVOLUME,1\n"),
    ("DEFINE_COORDINATE_NODES", "DIR"): swap(
        "*END",
        "*DEFINE_COORDINATE_NODES\n5,1,2,10,0,Y\n*END",
        without("BOUNDARY_SPC_SET", "*BOUNDARY_SPC_SET\n1,5,1,1,1\n"),
    ),
}


@pytest.mark.parametrize(("name", "field"), DECKS)
def test_a_value_that_is_refused_is_told_with_its_cause(
    name: str, field: str, tmp_path: Path
) -> None:
    said = refused(tmp_path, DECKS[name, field], table()[name].refused[field])
    line = next(each for each in said.splitlines() if table()[name].refused[field] in each)
    assert field in line and "user.k:" in line, said


def test_every_value_that_the_page_calls_refused_has_a_deck() -> None:
    named = {(name, field) for name, entry in table().items() for field in entry.refused}
    assert named == set(DECKS)


SYSTEM = "CORD2R,5,{},0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
#: Keyword and parameter of Abaqus: what stands in the plain file, and what in its place
ABAQUS = {
    ("BOUNDARY", "OP"): ("*Boundary\nEdge", "*Boundary, op=NEW\nEdge"),
    ("BOUNDARY", "data"): ("Edge, ENCASTRE", "Edge, 7"),
    ("BOUNDARY", "first"): ("Edge, ENCASTRE", "Edge, 3, 6"),
    ("INITIAL CONDITIONS", "TYPE"): ("type=VELOCITY", "type=STRESS"),
    ("INITIAL CONDITIONS", "data"): ("RP, 3, -4000.0", "RP, 6, 3.0"),
    ("STEP", "NLGEOM"): ("nlgeom=YES", "nlgeom=NO"),
    ("STEP", "data"): ("*End Step", "*End Step\n*Step\n*Dynamic, Explicit\n, 1.0\n*End Step"),
    ("DYNAMIC", "data"): ("*Dynamic, Explicit", "*Dynamic"),
    ("DLOAD", "data"): ("*End Step", "*Dload\nPlate, BX, 1.0\n*End Step"),
    ("ELEMENT", "TYPE"): ("type=S4R", "type=B31"),
    ("NODE", "SYSTEM"): ("*Node\n", "*Node, system=C\n"),
    ("FRICTION", "ROUGH"): ("*Friction\n", "*Friction, rough\n"),
    ("FRICTION", "data"): ("*Friction\n0.2,", "*Friction\n0.2, 10.0"),
    ("SURFACE BEHAVIOR", "NO SEPARATION"): (
        "0.2,\n*Step",
        "0.2,\n*Surface Behavior, no separation\n*Step",
    ),
    ("CONTACT PAIR", "OP"): ("*Contact Pair, ", "*Contact Pair, op=DELETE, "),
    ("SURFACE", "FILLET RADIUS"): ("type=REVOLUTION", "type=REVOLUTION, fillet radius=0.5"),
    ("ELASTIC", "TYPE"): ("type=ENGINEERING CONSTANTS", "type=ORTHOTROPIC"),
    ("SURFACE", "data"): ("CIRCL, 8., 0., 0., 0.", "PARAB, 8., 0., 0., 0."),
}
PLIES = "PCOMP,1,,,,,,,\n,1,0.125,0.,YES,1,0.125,90.,YES\n,1,0.125,90.,YES,1,0.125,0.,YES\n"
#: Entry and field of Nastran
NASTRAN = {
    ("SPC", "D1"): ("TSTEPNL,3", "SPC,1,1,3,0.5\nTSTEPNL,3"),
    ("SPC1", "C"): ("SPC1,1,123456", "SPC1,1,7"),
    ("TIC", "U0"): ("TIC,2,166,3,0.", "TIC,2,166,3,1."),
    ("TIC", "C"): ("TIC,2,166,3", "TIC,2,166,6"),
    ("FORCE", "CID"): ("IC = 2", "IC = 2\nLOAD = 4"),
    ("PLOAD4", "P2"): ("IC = 2", "IC = 2\nLOAD = 4"),
    ("RBE2", "CM"): ("RBE2,5001,166,123456", "RBE2,5001,166,123"),
    ("GRID", "CP"): ("GRID,1,,0.", "GRID,1,5,0."),
    ("CQUAD4", "THETA"): ("CQUAD4,1,1,1,2,11,10", "CQUAD4,1,1,1,2,11,10,20."),
    ("PCOMP", "LAM"): ("PCOMP,1,,,,,,,\n", "PCOMP,1,,,,,,,MEM\n"),
    ("PCOMP", "NSM"): ("PCOMP,1,,,,", "PCOMP,1,,0.1,,"),
    ("PSHELL", "MID2"): (PLIES, "PSHELL,1,1,0.5,9\n"),
    ("PSHELL", "12I/T3"): (PLIES, "PSHELL,1,1,0.5,1,2.0\n"),
    ("GRID", "CD"): ("GRID,1,,0.,0.,0.", "GRID,1,,0.,0.,0.,5"),
    ("CORD2R", "RID"): ("CQUAD4,1,1,1,2,11,10", "CQUAD4,1,1,1,2,11,10,5"),
    ("MAT8", "STRN"): ("80.,230.,90.\n", "80.,230.,90.\n,,,1.\n"),
    ("case SUBCASE", "data"): ("IC = 2", "IC = 2\nSUBCASE 1\nSPC = 1\nSUBCASE 2\nSPC = 1"),
}
#: What else the file of Nastran has then
BESIDE = {
    ("FORCE", "CID"): "FORCE,4,41,3,1.,0.,0.,1.",
    ("PLOAD4", "P2"): "PLOAD4,4,1,1.,2.,1.,1.",
    ("CORD2R", "RID"): SYSTEM.format(7),
}


def told(folder: Path, suffix: str, text: str, words: str, field: str) -> None:
    """Check that a file is refused with some words, with its line, and by its field."""
    path = folder / f"user.{suffix}"
    path.write_text(text)
    with pytest.raises(PreError) as caught:
        translate(path, folder / "job.k", Choices("IM7/8552", "mm,s,t"))
    line = next(each for each in str(caught.value).splitlines() if words in each)
    assert f"{path}:" in line and (field in line or field == "data"), str(caught.value)


@pytest.mark.parametrize(("name", "field"), ABAQUS)
def test_a_value_of_abaqus_that_is_refused_is_told(name: str, field: str, tmp_path: Path) -> None:
    text = abaqus_decks.standard()
    old, new = ABAQUS[name, field]
    told(tmp_path, "inp", swap(old, new, text), dialect("abaqus")[name].refused[field], field)


@pytest.mark.parametrize(("name", "field"), NASTRAN)
def test_a_value_of_nastran_that_is_refused_is_told(name: str, field: str, tmp_path: Path) -> None:
    strengths = (2500.0, 1500.0, 80.0, 230.0, 90.0) if name == "MAT8" else ()
    text = nastran_decks.standard("comma", *strengths)
    old, new = NASTRAN[name, field]
    text = swap(old, new, text).replace("ENDDATA", f"{BESIDE.get((name, field), '$')}\nENDDATA")
    told(tmp_path, "bdf", text, dialect("nastran")[name].refused[field], field)


@pytest.mark.parametrize(("program", "decks"), [("abaqus", ABAQUS), ("nastran", NASTRAN)])
def test_every_refused_value_of_a_program_has_a_file(program: str, decks: dict) -> None:
    entries = dialect(program).items()
    assert {(name, field) for name, entry in entries for field in entry.refused} == set(decks)
