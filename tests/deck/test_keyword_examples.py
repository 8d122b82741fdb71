"""Examples of the keyword pages: a deck with each of them is checked without an error.

The deck is the one of manual/decks.md, with what the example needs around it.
"""

from __future__ import annotations

import re
import subprocess
from collections.abc import Mapping
from pathlib import Path

import pytest

from runs import ROOT, SOLVER

Cards = dict[str, list[str]]


def blocks(text: str) -> Cards:
    """Lines of each keyword of a deck without comments; keywords that repeat are joined."""
    found: Cards = {}
    for line in text.splitlines():
        if line.startswith("*"):
            lines = found.setdefault(line[1:], [])
        elif not line.startswith("$"):
            lines.append(line)
    return found


PAGES = subprocess.run(
    [SOLVER, "--keywords"], check=True, capture_output=True, text=True
).stdout.partition("\n# Keywords that are known")[0]
NAMES = re.findall(r"^## \*(\w+)$", PAGES, re.MULTILINE)
EXAMPLES = {
    name: lines.splitlines()
    for name, lines in re.findall(r"\nExample\n\n```\n\*(\w+)\n(.*?)```", PAGES, re.DOTALL)
}
PLATE = blocks((ROOT / "manual/decks.md").read_text().split("```\n")[1])
YIELD = ["1", "0.0, 210.0", "0.1, 300.0"]
EXAMPLES_OF_CURVES = {"DEFINE_CURVE": EXAMPLES["DEFINE_CURVE"]}
MOVED = {"SET_NODE_LIST": [*PLATE["SET_NODE_LIST"], "*SET_NODE_LIST", "2", "13, 14"]}
BOND = {name: EXAMPLES[name] for name in ("INTERFACE_COHESIVE", "MAT_COHESIVE_MIXED_MODE")}
PRESSED = {"LOAD_FACE_PRESSURE": EXAMPLES["LOAD_FACE_PRESSURE"], **EXAMPLES_OF_CURVES}
TABLE = {
    "MAT_PIECEWISE_LINEAR_PLASTICITY": ["1, 7.8e-9, 210.0e3, 0.3", "0, 0, 1, 0, 1.0"],
    "MAT_PLY_ELASTIC": [],
    "DEFINE_CURVE": ["2", *YIELD[1:], "*DEFINE_CURVE", "3", "0.0, 310.0", "0.1, 400.0"],
}
BY_NAME = {"IMPACTOR_SPHERE": [PLATE["IMPACTOR_SPHERE"][0], "0.0, 0.0, &speed"]}
QUADS = [
    f"{1 + i + 4 * j}, 1, {n}, {n + 1}, {n + 6}, {n + 5}"
    for j in range(4)
    for i in range(4)
    for n in [1 + i + 5 * j]
]
#: What an example needs besides the plate; no lines take a keyword out
NEEDS: Mapping[str, Mapping[str, list[str]]] = {
    "PARAMETER": BY_NAME,
    "PARAMETER_EXPRESSION": BY_NAME,
    "ELEMENT_SHELL": {"ELEMENT_PLATE_Q9": [], "ELEMENT_SHELL": QUADS},
    "SET_NODE_GENERAL": {"SET_NODE_LIST": [], "DEFINE_BOX": EXAMPLES["DEFINE_BOX"]},
    "DEFINE_BOX": {"SET_NODE_LIST": [], "SET_NODE_GENERAL": EXAMPLES["SET_NODE_GENERAL"]},
    "SET_SHELL_LIST": {"LOAD_SHELL_SET": EXAMPLES["LOAD_SHELL_SET"], **EXAMPLES_OF_CURVES},
    "DEFINE_CURVE": PRESSED,
    "PART_COMPOSITE": {"PART_COMPOSITE_LONG": []},
    "MAT_PIECEWISE_LINEAR_PLASTICITY": {"DEFINE_CURVE": YIELD},
    "DEFINE_TABLE": TABLE,
    "DEFINE_TABLE_2D": TABLE,
    "CRACK_LINES": {
        **BOND,
        "ELEMENT_PLATE_Q9": [],
        "ELEMENT_SHELL": QUADS,
        "SECTION_LAYERWISE": ["1, 0, 1"],
        "CONTACT_IMPACTOR": ["1, 1, 1, 1, 2"],
        "BOUNDARY_SPC_SET": [],
        "SET_NODE_LIST": [],
    },
    "INTERFACE_COHESIVE": BOND,
    "INTERFACE_LAW": BOND,
    "INTERFACE_SCATTER": BOND,
    "MAT_COHESIVE_ELASTIC": {"INTERFACE_COHESIVE": BOND["INTERFACE_COHESIVE"]},
    "MAT_COHESIVE_MIXED_MODE": BOND,
    "MAT_COHESIVE_GENERAL": {
        "INTERFACE_COHESIVE": BOND["INTERFACE_COHESIVE"],
        "DEFINE_CURVE": ["1", "0.0, 0.0", "0.001, 1.0", "1.0, 0.0"],
    },
    "INITIAL_DELAMINATION": BOND,
    "INITIAL_DAMAGE": BOND,
    "PLY_SCATTER": {"MAT_PLY_ELASTIC": [], "MAT_PLY_CODAM2": EXAMPLES["MAT_PLY_CODAM2"]},
    "BOUNDARY_FACE": {"BOUNDARY_SPC_SET": []},
    "BOUNDARY_PRESCRIBED_MOTION_SET": {**MOVED, **EXAMPLES_OF_CURVES},
    "BOUNDARY_FACE_MOTION": {**MOVED, **EXAMPLES_OF_CURVES},
    "CONSTRAINED_LINEAR_GLOBAL": {
        "IMPACTOR_SPHERE": [],
        "CONTACT_IMPACTOR": [],
        "INITIAL_VELOCITY_NODE": ["7, 0.0, 0.0, 200.0", "8, 0.0, 0.0, 100.0"],
    },
    "CONSTRAINED_FACE_LINEAR": EXAMPLES_OF_CURVES,
    "INITIAL_VELOCITY": MOVED,
    "LOAD_NODE_SET": {**MOVED, **EXAMPLES_OF_CURVES},
    "LOAD_NODE_POINT": EXAMPLES_OF_CURVES,
    "LOAD_FACE_POINT": EXAMPLES_OF_CURVES,
    "LOAD_FACE_LINE": {
        "SET_NODE_LIST": [*PLATE["SET_NODE_LIST"], "*SET_NODE_LIST", "2", "3, 8, 13"],
        **EXAMPLES_OF_CURVES,
    },
    "LOAD_SHELL_SET": {"SET_SHELL_LIST": EXAMPLES["SET_SHELL_LIST"], **EXAMPLES_OF_CURVES},
    "LOAD_FACE_PRESSURE": EXAMPLES_OF_CURVES,
    "LOAD_BODY_X": EXAMPLES_OF_CURVES,
    "LOAD_BODY_Y": EXAMPLES_OF_CURVES,
    "LOAD_BODY_Z": EXAMPLES_OF_CURVES,
    "DAMPING_RELAXATION": {"IMPACTOR_SPHERE": [], "CONTACT_IMPACTOR": []},
    "IMPACTOR_TUP": {"IMPACTOR_SPHERE": []},
    "IMPACTOR_CYLINDER": {"IMPACTOR_SPHERE": []},
    "IMPACTOR_CONE": {"IMPACTOR_SPHERE": []},
    "FIXTURE_PUNCH": {
        "DEFINE_CURVE": ["1", "0.0, 0.0", "1.0e-4, 0.1"],
        "IMPACTOR_SPHERE": [],
        "CONTACT_IMPACTOR": [],
    },
    "DATABASE_NODOUT": {"DATABASE_HISTORY_NODE": EXAMPLES["DATABASE_HISTORY_NODE"]},
    "DATABASE_FIXTURE": {"FIXTURE_PLANE": EXAMPLES["FIXTURE_PLANE"]},
    "DATABASE_HISTORY_NODE_SET": MOVED,
    "DATABASE_DELAM": BOND,
}
#: A brick instead of the plate
BRICK: Mapping[str, list[str]] = {
    "CONTROL_TERMINATION": ["1.0e-5"],
    "NODE": [
        f"{n}, {x}, {y}, {z}"
        for n, (x, y, z) in enumerate(
            [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], 1
        )
    ],
    "MAT_ELASTIC": EXAMPLES["MAT_ELASTIC"],
    **{name: EXAMPLES[name] for name in ("ELEMENT_SOLID", "PART", "SECTION_SOLID")},
}
FIBRES = {"ELEMENT_SOLID": [], "MAT_ELASTIC": [], "MAT_PLY_ELASTIC": EXAMPLES["MAT_PLY_ELASTIC"]}
NEEDS_OF_BRICKS: Mapping[str, Mapping[str, list[str]]] = {
    "ELEMENT_SOLID": {},
    "ELEMENT_SOLID_ORTHO": FIBRES,
    "PART": {},
    "SECTION_SOLID": {},
    "HOURGLASS": {"PART": ["block", "1, 1, 1, 0, 1"]},
    "CONTROL_HOURGLASS": {},
    "LOAD_SEGMENT": EXAMPLES_OF_CURVES,
}

#: Keywords of a deck that changes a run, and the body of the run that they need
STAGES = {
    "CONTROL_STAGE": "IMPACTOR_SPHERE",
    "DELETE_IMPACTOR": "IMPACTOR_SPHERE",
    "DELETE_FIXTURE": "FIXTURE_PLANE",
}


def deck_with(name: str) -> str:
    """A deck with the example of a keyword, complete and without anything that is unused."""
    if name in NEEDS_OF_BRICKS:
        cards = {**BRICK, **NEEDS_OF_BRICKS[name]}
    else:
        cards = {**PLATE, **NEEDS.get(name, {})}
        if name.startswith("MAT_") and not name.startswith("MAT_COHESIVE"):
            cards["MAT_PLY_ELASTIC"] = []
    example, others = EXAMPLES[name], cards.pop(name, [])
    # lines of nodes and elements that the example has are not repeated
    rest = [line for line in others if line not in example]
    lines = ["*KEYWORD", f"*{name}", *example]
    if name in ("NODE", "ELEMENT_SHELL", "ELEMENT_PLATE_Q9", "SET_NODE_LIST"):
        lines += rest
    for keyword, own in cards.items():
        if own:
            lines += [f"*{keyword}", *own]
    return "\n".join([*lines, "*END", ""])


def test_every_keyword_has_an_example() -> None:
    """Each page of a keyword shows one."""
    assert list(EXAMPLES) == NAMES


@pytest.mark.parametrize(
    "name", [name for name in NAMES if name not in {"KEYWORD", "END", *STAGES}]
)
def test_example_is_right(name: str, tmp_path: Path) -> None:
    """The deck is checked without an error and without a warning about the keyword."""
    if name == "INCLUDE":
        (tmp_path / "mesh.k").write_text("*COMMENT\nno mesh\n*END\n")
    if name == "INCLUDE_PATH":
        (tmp_path / "meshes").mkdir()
    path = tmp_path / "example.k"
    path.write_text(deck_with(name))
    checked = subprocess.run(
        [SOLVER, "check", path], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert checked.returncode == 0, checked.stdout + checked.stderr
    assert f"*{name} " not in checked.stdout + checked.stderr


def test_links_of_the_pages_lead_somewhere() -> None:
    """Each link to the theory is a heading there, each row of the index a page."""
    theory = (ROOT / "manual/theory.md").read_text()
    headings = re.findall(r"^#+ (.*)$", theory, re.MULTILINE)
    known = {re.sub(r"[^\w -]", "", text).lower().replace(" ", "-") for text in headings}
    assert set(re.findall(r"theory\.md#([\w-]+)", PAGES)) <= known
    assert re.findall(r"^\| \[\*(\w+)\]\(#\w+\)", PAGES, re.MULTILINE) == NAMES


@pytest.mark.parametrize("name", STAGES)
def test_example_changes_a_run(name: str, tmp_path: Path) -> None:
    """A keyword for restarts, in a deck that goes on with the plate and its bodies."""
    first = deck_with(STAGES[name]).replace("4.0e-4", "1.0e-6")
    (tmp_path / "first.k").write_text(first.replace("*END", "*DATABASE_BINARY_D3DUMP\n1\n*END"))
    stage = ["*KEYWORD", f"*{name}", *EXAMPLES[name], "*CONTROL_TERMINATION", "1.5e-6", "*END", ""]
    (tmp_path / "stage.k").write_text("\n".join(stage))
    for words in (("run", "first.k"), ("restart", "first.dump01", "stage.k", "-j", "stage")):
        ended = subprocess.run(
            [SOLVER, *words], cwd=tmp_path, capture_output=True, text=True, check=False
        )
        assert ended.returncode == 0, ended.stdout + ended.stderr
