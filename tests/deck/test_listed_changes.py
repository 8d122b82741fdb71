"""The listing of a restart names what its deck changes, kind by kind."""

from __future__ import annotations

from pathlib import Path

import pytest

from broken import CYCLES, END, SIDE, impact, said
from decks import BOTTOM, TOP
from runs import Results

NORMAL = 0
#: A set of the deck of the impact, and two sets of a stage
HELD, BESIDE, MOVED = 1, 90, 91
MIDDLE = 0.5 * SIDE
STEP = 1.0e-8
BODIES = (
    "*DELETE_IMPACTOR\n1\n"
    "*IMPACTOR_SPHERE\n2,6.0,5.0e-6,3.0,3.0,90.0\n0.0,0.0,-1.0\n"
    f"*CONTACT_IMPACTOR\n2,2,1,{TOP}\n"
    f"*FIXTURE_PUNCH\n7,{BOTTOM},0.0\n2,{MIDDLE},{MIDDLE},0.0,0.0,5.0\n"
    f"*FIXTURE_BAR\n8,{TOP},0.0,1.0\n1.0,1.0,1.0,19.0\n"
)
CONDITIONS = (
    f"*SET_NODE_LIST\n{BESIDE}\n20,21\n*SET_NODE_LIST\n{MOVED}\n25\n"
    "*DEFINE_CURVE\n90\n0.0,0.0\n1.0,1.0\n"
    f"*BOUNDARY_SPC_SET\n{HELD},0,0,0,1\n{BESIDE},0,1,0,0\n"
    f"*BOUNDARY_PRESCRIBED_MOTION_SET\n{MOVED},1,2,90,0.0\n"
    f"*LOAD_NODE_SET\n{BESIDE},3,90,1.0\n{MOVED},3,90,1.0\n"
)
CONTROL = (
    f"*CONTROL_STAGE\n1\n*CONTROL_TERMINATION\n{2.0 * END}\n*TITLE\nafter the blow\n"
    f"*CONTROL_TIMESTEP\n0.0,0.8,0,0.0,{-STEP}\n*DAMPING_GLOBAL\n0,2.0e3\n"
    "*DAMPING_RELAXATION\n1.0e-30\n*CONTROL_QUASI_STATIC\n0.1,0.5\n"
)
INTERVALS = {
    "energy history": ("GLSTAT", 0.7e-6, 1.1e-6),
    "impactor histories": ("IMPACTOR", 0.0, 1.2e-6),
    "fixture histories": ("FIXTURE", None, 1.3e-6),
    "node histories": ("NODOUT", 1.1e-6, 1.4e-6),
    "support forces": ("SPCFORC", 0.9e-6, 1.5e-6),
    "fields": ("BINARY_D3PLOT", 3.7e-6, 4.0e-6),
}


def restart(dump: Path, body: str, job: str) -> tuple[dict[str, str], str]:
    """Go on with a deck: the section of the listing on its changes, kind by kind; all words."""
    deck = dump.parent / f"{job}.k"
    deck.write_text(f"*KEYWORD\n{body}*END\n")
    code, text = said("restart", dump, deck, "-j", dump.parent / job)
    assert code == NORMAL, text
    words = text
    if (listing := dump.parent / f"{job}.out").exists():
        words = listing.read_text()
    section = words.split(f"Changed by {deck}\n")[1].split("\n\n")[1]
    return {line[:24].strip(): line[24:] for line in section.splitlines()}, words


def changed_fields(line: str) -> dict[str, tuple[float | None, float]]:
    """Values of fields before and after; None for a keyword that no deck before has."""
    found = {}
    for part in line.split(", "):
        field, before, to, after = part.split()
        assert to == "to"
        found[field] = (None if before == "none" else float(before), float(after))
    return found


@pytest.fixture(scope="module")
def dump(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A restart file in the middle of an impact."""
    folder = tmp_path_factory.mktemp("impact")
    deck = impact(1)
    deck.add("DATABASE_BINARY_D3DUMP", (CYCLES,))
    code, text = said("run", deck.write(folder / "job.k"), "-o", folder)
    assert code == NORMAL, text
    return sorted(folder.glob("job.dump??"))[0]


def test_bodies_are_named(dump: Path) -> None:
    """Impactors, their contact faces and fixtures, removed and added."""
    found, words = restart(dump, BODIES, "bodies")
    word, time, unit = found.pop("the run ends at").split()
    assert (word, float(time), unit) == ("time", END, "s")
    assert found == {
        "impactors": "removed 1 (IMPACTOR_SPHERE 1), added 1 (IMPACTOR_SPHERE 2)",
        "contact faces": "removed 1 (CONTACT_IMPACTOR 1), added 1 (CONTACT_IMPACTOR 2)",
        "fixtures": "added 2 (FIXTURE_PUNCH 7; FIXTURE_BAR 8)",
    }
    assert words.index("continues from") < words.index("Changed by")


def test_conditions_are_named(dump: Path) -> None:
    """Supports, motions and loads by their sets; what both decks have is kept."""
    found, _ = restart(dump, CONDITIONS, "conditions")
    del found["the run ends at"]
    assert found == {
        "supports": "kept 1, added 1 (BOUNDARY_SPC_SET 90)",
        "prescribed motions": "added 1 (BOUNDARY_PRESCRIBED_MOTION_SET 91)",
        "loads": "added 2 (LOAD_NODE_SET 90, 91)",
        "sets, boxes, curves": "added 3 (SET_NODE_LIST 90, 91; DEFINE_CURVE 90)",
    }


def test_values_before_and_after_are_listed(dump: Path) -> None:
    """End, step, damping, relaxation and quasi-static control: fields whose values differ."""
    found, _ = restart(dump, CONTROL, "control")
    energy = Results(dump.parent, "control").table("energy")
    assert energy["time"][-1] == pytest.approx(
        float(found["the run ends at"].split()[1]), rel=1.0e-5
    )
    assert found["the run ends at"].endswith("s, or before")
    assert found["title"] == "after the blow"
    assert found["times count from"] == "the restart"
    assert changed_fields(found["end"]) == {"ENDTIM": (END, 2.0 * END)}
    assert changed_fields(found["time step"]) == {"TSSFAC": (None, 0.8), "DT2MS": (None, -STEP)}
    assert changed_fields(found["damping"]) == {"VALDMP": (100.0, 2.0e3)}
    assert changed_fields(found["dynamic relaxation"]) == {"DRTOL": (None, 1.0e-30)}
    assert changed_fields(found["quasi-static control"]) == {
        "SHARE": (None, 0.1),
        "FALL": (None, 0.5),
    }


def test_intervals_of_results_are_listed(dump: Path) -> None:
    """Of each history, of fields and of restart files."""
    body = "".join(f"*DATABASE_{name}\n{after}\n" for name, _, after in INTERVALS.values())
    body += "*DATABASE_BINARY_D3DUMP\n100\n*DATABASE_BINARY_RUNRSF\n50,2\n"
    body += f"*FIXTURE_PUNCH\n7,{BOTTOM},9.0\n2,{MIDDLE},{MIDDLE},0.0,0.0,5.0\n"
    found, _ = restart(dump, body, "outputs")
    for kind, (_, before, after) in INTERVALS.items():
        assert changed_fields(found[kind]) == {"DT": (before, after)}
    assert changed_fields(found["restart files kept"]) == {"CYCL": (CYCLES, 100)}
    assert changed_fields(found["restart files replaced"]) == {"CYCL": (None, 50), "NR": (None, 2)}


def test_second_stage_is_held_against_the_first(dump: Path) -> None:
    """Only what the first stage left is removed; the same values are called so."""
    restart(dump, BODIES + CONDITIONS + CONTROL + "*DATABASE_BINARY_D3DUMP\n999999\n", "stage_1")
    body = (
        "*DELETE_IMPACTOR\n2\n*DELETE_FIXTURE\n8\n*DAMPING_GLOBAL\n0,2.0e3\n"
        f"*BOUNDARY_FACE\n{HELD},{TOP},0.0,0,0,1\n*CONTROL_STAGE\n1\n*CONTROL_TERMINATION\n{END}\n"
    )
    found, _ = restart(sorted(dump.parent.glob("stage_1.dump??"))[-1], body, "stage_2")
    assert found["supports"] == "removed 2 (BOUNDARY_SPC_SET 1, 90), added 1 (BOUNDARY_FACE 1)"
    assert found["prescribed motions"] == "removed 1 (BOUNDARY_PRESCRIBED_MOTION_SET 91)"
    assert found["impactors"] == "removed 1 (IMPACTOR_SPHERE 2)"
    assert found["contact faces"] == "removed 1 (CONTACT_IMPACTOR 2)"
    assert found["fixtures"] == "removed 1 (FIXTURE_BAR 8)"
    assert found["damping"] == "as before"
    assert "loads" not in found


def test_restart_that_does_not_run_tells_as_well(dump: Path) -> None:
    """NOSOL 1 prints the changes, and no file is written; of many cards some are shown."""
    nodes = range(1, 31)
    cards = "".join(f"{node},3,1,1.0\n" for node in nodes)
    body = (
        f"*CONTROL_TERMINATION\n{2.0 * END},0,0.0,0,0,1\n*DEFINE_CURVE\n1\n0.0,0.0\n1.0,1.0\n"
        f"*LOAD_NODE_POINT\n{cards}"
    )
    found, _ = restart(dump, body, "printed")
    shown = ", ".join(str(node) for node in nodes[:12])
    assert found["loads"] == f"added 30 (LOAD_NODE_POINT {shown}, ...)"
    assert changed_fields(found["end"])["NOSOL"] == (0.0, 1.0)
    assert not list(dump.parent.glob("printed.*[!k]"))


def test_restart_without_a_deck_changes_nothing(dump: Path) -> None:
    """There is no such section."""
    job = dump.parent / "plain"
    code, text = said("restart", dump, "-j", job)
    assert code == NORMAL, text
    assert "Changed by" not in job.with_suffix(".out").read_text()
