"""Keywords of one number or name: neither is known to be the one meant, so that both are told."""

from __future__ import annotations

import re
from pathlib import Path

import abaqus_decks
import nastran_decks
import pytest
from foreign_decks import standard
from foreign_forms import refused, translated
from models_of_others import refused_model
from user_decks import cohesive

KINDS = "SHELL", "SOLID"
TEXT = standard()[0].text()
CURVE = "*DEFINE_CURVE\n5\n0.,0.\n1.,{}\n"
#: A second keyword of a number that the plain deck has already, and its field
SECOND = {
    "PART_COMPOSITE PID": "*PART_COMPOSITE\nplate\n1,16\n1,0.5,45.\n",
    "PART_INERTIA PID": "*PART_INERTIA\nball\n9,9,9\n,,,4e-4\n1,0,0,1,0,1\n,\n",
    "ELEMENT_SHELL EID": "*ELEMENT_SHELL\n1,1,2,3,12,11\n",
    "SET_NODE_LIST SID": "*SET_NODE_LIST\n1\n41\n",
    "SET_NODE_COLUMN SID": "*SET_NODE_COLUMN\n1\n41\n",
    "DEFINE_CURVE LCID": CURVE.format(1.0) + CURVE.format(2.0),
    "SECTION_SHELL SECID": "*SECTION_SHELL\n9,2\n2.,2.,2.,2.\n",
    "MAT_RIGID MID": "*MAT_RIGID\n9,7.8e-9,2e5,0.3\n1,4,7\n,\n",
    "DEFINE_COORDINATE_VECTOR CID": "*DEFINE_COORDINATE_VECTOR\n5,1,0,0,0,1,0\n" * 2,
}


@pytest.mark.parametrize("field", SECOND)
def test_a_number_of_lsdyna_is_there_once(field: str, tmp_path: Path) -> None:
    said = refused(tmp_path, TEXT.replace("*END", f"{SECOND[field]}*END"), "defined twice")
    assert re.search(rf"user\.k:\d+: \*{field}: ", said)


def test_shells_and_bricks_may_have_the_same_number(tmp_path: Path) -> None:
    """LS-DYNA counts them apart."""
    text = cohesive("comma")
    shell, brick = (re.search(rf"\*ELEMENT_{kind}.*\n\$.*\n(\d+),", text) for kind in KINDS)
    assert shell and brick
    apart = text[: brick.start(1)] + shell[1] + text[brick.end(1) :]
    assert translated(tmp_path, apart)[0] == translated(tmp_path, text)[0]


#: The same of Abaqus
NAMED = {
    "MATERIAL NAME": "*Material, name=cfrp\n*Density\n1.6e-9,\n*Elastic\n1e5, 0.3\n",
    "DENSITY": "*Density\n3.2e-9,\n",
    "SURFACE NAME": "*Surface, type=ELEMENT, name=Top\nPlate, SNEG\n",
    "SHELL SECTION ELSET": "*Shell Section, elset=Plate\n0.5\n",
}


@pytest.mark.parametrize("field", NAMED)
def test_a_name_of_abaqus_is_there_once(field: str, tmp_path: Path) -> None:
    text = abaqus_decks.standard()
    more = NAMED[field].replace("elset=Plate", "elset=Plate, material=CFRP")
    at = text.index("*Elastic") if field == "DENSITY" else text.index("*Step")
    said = refused_model("user.inp", tmp_path, text[:at] + more + text[at:])
    assert re.search(rf"user\.inp:\d+: \*{field}: .*(twice|in two sections)", said)


@pytest.mark.parametrize(
    ("field", "more"),
    [
        ("MAT8 MID", "MAT8,1,1e5,1e4,0.3,5e3,5e3,3e3,1.6-9\n"),
        ("PSHELL PID", "PSHELL,1,1,0.5\n"),
    ],
)
def test_a_number_of_nastran_is_there_once(field: str, more: str, tmp_path: Path) -> None:
    text = nastran_decks.standard("comma").replace("ENDDATA", f"{more}ENDDATA")
    said = refused_model("user.bdf", tmp_path, text, "defined twice")
    assert re.search(rf"user\.bdf:\d+: {field}: ", said)
