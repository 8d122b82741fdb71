"""Mutants of decks of others: each is refused with a line, or every field is on the page."""

from __future__ import annotations

import random
import re
import sys
from collections.abc import Iterator
from pathlib import Path

import abaqus_decks
import nastran_decks
from foreign_decks import translate
from foreign_forms import LAYUPS, tiebreak, tied
from test_abaqus import stacked
from test_abaqus import thick as bricks
from test_nastran import plate
from user_decks import cohesive, composite, thick

from plydyn_pre.errors import PreError
from plydyn_pre.translate import Choices

_WORDS = ("", "0", "-1", "1e30", "1.5", "abc", "&x", "99999999", "-0.0", "1-", "<1/0>", "*", "7,7")
#: Share of changes that are not of nodes and elements
_BESIDE = 0.85
_LSDYNA = (
    "*LOAD_BLAST\n1,2,3",
    "*ELEMENT_BEAM\n1,1,1,2,3",
    "*MAT_999\n1,2.0",
    "*CONTACT_TIED_NODES_TO_SURFACE\n1,2,4,3\n,\n,",
    "*RIGIDWALL_PLANAR\n0\n0,0,-5,0,0,-4,0.1",
    "*SET_NODE_GENERAL\n77\nBOX,3",
    "*DEFINE_CURVE\n5\n0,0\n1,1",
    "*BOUNDARY_PRESCRIBED_MOTION_SET\n7,3,2,5,-1.0",
    "*INITIAL_VELOCITY\n\n1,2,3",
    "*PARAMETER_EXPRESSION\nR y,1/0",
    "*SECTION_SHELL\n77,2,1,4,,,1\n1,1,1,1",
    "*INCLUDE\nnone.k",
    "*DEFINE_COORDINATE_SYSTEM\n1,0,0,0,1,0,0\n0,1,0\n*BOUNDARY_SPC_SET\n7,1,1,0,1",
    "*DEFINE_COORDINATE_NODES\n2,1,1,2\n*INITIAL_VELOCITY\n7,,,,2\n1,2,3",
    "*DEFINE_VECTOR\n3,0,0,0,0,1,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n7,4,2,5,-1.0,3",
    "*CONSTRAINED_RIGID_BODIES\n20,1",
    "*MAT_024\n1,2.7e-9,7e4,0.3,,,1e21\n0,0,5",
)
_ABAQUS = (
    "*Static",
    "*Element, type=B31, elset=Beams\n900, 1, 2",
    "*Elastic, type=LAMINA\n1.0, 2.0",
    "*Density\n1e-9,",
    "*Boundary, type=VELOCITY, amplitude=None\n1, 3, 3, 1.",
    "*Boundary\nPlate, 1, 9",
    "*Initial Conditions, type=STRESS\n1, 2.",
    "*Nset, nset=Edge, generate\n1, 5, 0",
    "*Instance, name=Copy, part=None",
    "*Amplitude, name=A\n0., 0., 1.",
    "*Dload\n, GRAV, 9.81, 0., 0., -1.",
    "*Include, input=none.inp",
    "*Tie, name=T\nTop, Ball",
    "*Rigid Body, ref node=1, elset=Plate",
)
_NASTRAN = (
    "CBAR,900,1,1,2",
    "SPC,1,1,123,0.5",
    "SPC1,1,78,1,THRU,3",
    "PCOMP,1,,,,,,,,1,0.1",
    "PCOMPG,1\n,7,1,0.1,45.",
    "RBE2,900,1,123456,2,3",
    "FORCE,4,41,0,1.,0.,0.,1.",
    "TIC,2,41,3,0.,1.",
    "MAT8,1,1.,2.,.3,4.",
    "TSTEPNL,3,0,1.",
    "CORD2R,5,0,0.,0.,0.,0.,0.,0.",
    "PARAM,WTMASS,x",
    "INCLUDE 'none.bdf'",
)
_KEYWORDS = {"k": _LSDYNA, "inp": _ABAQUS, "bdf": _NASTRAN}
#: How keywords begin of which a deck has many
_MESH = ("*NODE", "*ELEMENT", "*SET_SEGMENT", "*Node", "*Element", "GRID", "CQUAD")


def originals() -> list[tuple[str, str]]:
    """The decks that are changed, with the ends of their names."""
    own = [composite("comma"), cohesive("comma"), thick("comma"), composite(), thick()]
    lsdyna = [*own, *LAYUPS.values(), tiebreak("segments"), tied("nodes")]
    joints = [stacked(joint) for joint in ("elements", "contact", "general", "tie")]
    abaqus = [abaqus_decks.standard(), abaqus_decks.standard(meshed=True), bricks("C3D8R"), *joints]
    nastran = [nastran_decks.standard(layout) for layout in ("comma", "fixed", "comma")]
    nastran += [plate((0.0, 90.0), 5, lam="SYM"), plate((0.0, 45.0), 30.0, z0=0.0)]
    every = {"k": lsdyna, "inp": abaqus, "bdf": nastran}
    return [(suffix, text) for suffix, texts in every.items() for text in texts]


def mutant(suffix: str, text: str, dice: random.Random) -> str:
    """A deck with a few changes."""
    lines = text.splitlines()
    for _ in range(dice.randint(1, 3)):
        at = dice.choice(_beside_the_mesh(lines) if dice.random() < _BESIDE else range(len(lines)))
        match dice.randrange(6):
            case 0:
                del lines[at]
            case 1:
                lines.insert(at, lines[dice.randrange(len(lines))])
            case 2:
                lines[at] = _changed(lines[at], dice)
            case 3:
                lines.insert(at, dice.choice(_KEYWORDS[suffix]))
            case 4:
                lines[at] = lines[at][: dice.randrange(len(lines[at]) + 1)]
            case _:
                lines[at] = _changed(lines[at], dice)
    return "\n".join(lines) + "\n"


def _beside_the_mesh(lines: list[str]) -> list[int]:
    """Lines of other keywords than nodes and elements."""
    name, found = "", [0]
    for at, line in enumerate(lines):
        name = line if line.startswith("*") or line[:1].isalpha() else name
        if not name.startswith(_MESH):
            found.append(at)
    return found


def _changed(line: str, dice: random.Random) -> str:
    """A line with another field."""
    word = dice.choice(_WORDS)
    if line.startswith("*"):
        return line + dice.choice(("_MPP", "_TITLE", "X", "_SET", " LONG=Y", ", type=X", ","))
    if "," in line:
        words = line.split(",")
        words[dice.randrange(len(words))] = word
        return ",".join(words)
    at = 10 * dice.randrange(max(1, len(line) // 10))
    return f"{line[:at]}{word[:10]:>10}{line[at + 10 :]}"


def look_at(suffix: str, text: str, folder: Path, allow_lost: bool) -> str:
    """What is wrong with the translation of a deck; empty if nothing is."""
    source = folder / f"user.{suffix}"
    source.write_text(text, encoding="utf-8")
    try:
        choices = Choices("HTS40/977-2", "mm,s,t", allow_lost)
        lines, page, _ = translate(source, folder / "job.k", choices)
        deck = "\n".join(lines)
    except PreError as error:
        said = str(error)
        placed = re.search(r"user\.\w+:\d+: \S|none\.\w+: there is no such file", said)
        known = placed or "no plate" in said or "is missing" in said or "no keyword" in said
        known = known or "has no nodes" in said or "has no material" in said
        return "" if known else f"refused without a line: {said[:300]}"
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    if "nan" in deck or "inf" in deck.replace("interface", "").replace("INTERFACE", ""):
        return "a number of the deck is not finite"
    return "; ".join(_unsaid(suffix, text, page))


def _unsaid(suffix: str, text: str, page: str) -> Iterator[str]:
    """Keywords that are not on the page."""
    told = page.count("### ")
    end = "\nENDDATA" if suffix == "bdf" else "\n*END\n"
    sign = {"k": r"(\*[A-Za-z_0-9]+)", "inp": r"(\*[A-Za-z][^,\n]*)", "bdf": r"([A-Z][A-Z0-9]*)"}
    for name in re.findall(f"(?m)^{sign[suffix]}", text.split(end)[0])[1:]:
        silent = name.upper().strip("*").startswith(("PARAMETER", "INCLUDE", "KEYWORD", "END"))
        silent = silent or name == "BEGIN"
        if not silent and f"### {name.upper().strip()}," not in page:
            yield f"{name} is not on the page ({told} are)"
    if rows := re.findall(r"(?m)^\| (?!field|---).*\|$", page):
        for row in rows:
            if not re.search(r"\| (taken|replaced|no effect here|lost)[^|]*\|$", row):
                yield f"no fate: {row}"


def main(count: int, seed: int, folder: Path) -> int:
    """Look at so many mutants; the number of those that are not as they should be."""
    wrong = 0
    decks = originals()
    for number in range(count):
        dice = random.Random(f"{seed}-{number}")
        suffix = dice.choice(tuple(_KEYWORDS))
        original = dice.choice([deck for ending, deck in decks if ending == suffix])
        text = mutant(suffix, original, dice)
        said = look_at(suffix, text, folder, dice.random() < 0.3)
        if said:
            wrong += 1
            (folder / f"mutant_{number}.{suffix}").write_text(text, encoding="utf-8")
            sys.stdout.write(f"{number} {said}\n")
    return wrong


if __name__ == "__main__":
    import tempfile

    sys.exit(min(1, main(int(sys.argv[1]), int(sys.argv[2]), Path(tempfile.mkdtemp()))))
