"""Names that the newer build has changed on purpose, and what is not compared: the only table.

Names of restart files and fields are paths in the file, `group/dataset`; an attribute is
`group/dataset@attribute`. All of them are regular expressions that match the whole name. What is
applied is reported, each time.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

#: Cases whose numbers the newer build changes on purpose, and why: they are not compared
CHANGED_CASES: dict[str, str] = {
    "deck/crushed": "a barrier keeps the layer from being pressed inside out",
    "made/planes_of_fracture": "shear 13 and 23 harden as 12 does, at stresses in a ratio",
    "deck/fracture_dent": "shear 13 and 23 harden as 12 does, at stresses in a ratio",
    "made/failing_plies_that_close": "points without growth take a path of their own: round-off",
    "made/averages_over_neighbours": "energies differ in their last bit: sums are rounded",
    "made/averages_in_two_parts": "energies differ in their last bit: sums are rounded",
}

#: Cases with keywords that the older build refuses, and what they are: then they are not compared
NEW_CASES: dict[str, str] = {
    r"recipe/damage_impact/ring(_pair)?(_fast)?": "rigid fixtures",
    r"recipe/validation/t700.*": "fixtures of the test, and a tup",
    r"deck/lever": "linear constraints",
    r"(made/planes_of_fracture|deck/fracture_(dent|tension))": "plies with planes of fracture",
}

#: Columns of a case that differ by round-off, `case ending: header`: by no more than this, and why
ROUNDED_COLUMNS: dict[str, tuple[float, str]] = {
    r".*\.energy\.csv: least volume.*": (
        1.0,
        "volumes are looked at with every line, no longer every 200 steps alone; the step follows "
        "those of every 200th step as before",
    ),
    r"deck/implicit_supports .*\.energy\.csv: error.*": (
        1.0e-14,
        "a product is no longer rounded before it is added: 2**-53 in each of 9 columns, of a free "
        "motion with 10 times the reference energy; no step uses the kinetic energy",
    ),
    r".*\.energy\.csv: error.*": (
        1.0e-13,
        "contact and damping are sums of other numbers than before: 2**-53 of the largest for each "
        "of some hundred steps in contact",
    ),
}

_DAMPED = (
    "damping works along the motion after contact, which so gives no energy to what lies still"
)

#: Two columns and two values whose sum is that of before, to this share of it: what the newer build
#: counts in one of them it counts no longer in the other, and why
SHIFTED_COLUMNS: dict[str, tuple[str, str, str]] = {
    r".*\.energy\.csv": ("damping", "contact", _DAMPED),
}
SHIFTED_DATA: dict[str, tuple[int, int, str]] = {
    r"state/energies": (6, 7, _DAMPED),
}
SHIFTED_SHARE = 1.0e-8

#: Files of a job whose ending is another one in the newer build: old ending, new ending
RENAMED_FILES: dict[str, str] = {}

#: Files that only one of the builds writes, and why
ADDED_FILES: dict[str, str] = {
    r"job\.contact\.csv": "area, pressure and centre of pressure of the contact",
}
DROPPED_FILES: dict[str, str] = {}

#: Columns of histories, `ending: header`, that only one of the builds writes, and why
ADDED_COLUMNS: dict[str, str] = {
    r".*\.energy\.csv: stored( error)? \[.*\]": "energy stored, from strains and stresses",
    r".*energy.csv: least volume.*": "least ratio of volumes, of every 200th step",
    r".*\.energy\.csv: contact friction \[.*\]": "work of friction",
    r".*\.delamination\.csv: (interface \d+ area|sum|projected area) \[.*\]": (
        "area with half of the toughness spent; the failed area has columns of its own"
    ),
    r".*\.impactor_\d+\.csv: ((displacement|velocity|impulse|angular velocity) [xyz]|friction).*": (
        "lateral motion, rotation, impulse and work of friction"
    ),
}
DROPPED_COLUMNS: dict[str, str] = {}

#: Columns whose values are in one of another header, `ending: header`: old, new as in `re.sub`.
#: What only has another header in its place needs no line here
RENAMED_COLUMNS: dict[str, str] = {
    r"(.*\.delamination\.csv: )(|projected |interface \d+ )(area|sum)( \[.*\])": (
        r"\1\2failed \3\4"
    ),
}

#: Old name, new name as in `re.sub`. A new name of the same content needs no line here
RENAMED_DATA: dict[str, str] = {}

#: Arrays that the newer build keeps in several: old name, new names whose values follow each other
SPLIT_DATA: dict[str, tuple[str, ...]] = {
    r"state/clock": ("state/time", "state/clock"),
}

#: Arrays that hold the same values in another order or in other pieces, and why; the first group of
#: the pattern is whose they are
REARRANGED_DATA: dict[str, str] = {
    r"(state/impactor_\d+)(_work|_motion)?": "what all bodies have comes first",
    r"(state/fixture_\d+)(_rows)?": "what all bodies have comes first",
}

#: Arrays that the newer build keeps without their last values, which were zero, and why
SHORTENED_DATA: dict[str, str] = {
    r"state/sums": "the last was a bound on speeds, which no restart file kept: always zero",
}

#: Arrays that the newer build keeps with more values at their end, which are zero, and why
LENGTHENED_DATA: dict[str, str] = {
    r"state/energies": "the last is the work of friction on fixtures",
}

#: Arrays with new values between the old ones, which follow each other as before, and why
WIDENED_DATA: dict[str, str] = {
    r"state/history": "share of the toughness that is spent at points of interfaces",
}

#: Arrays that are not compared where they have another size in the newer build, and why
RESIZED_DATA: dict[str, str] = {
    r"state/contact_\d+_(places|numbers)": (
        "search data: contact nodes are made as far up the body as the plate has come, no longer "
        "all at once; forces, motion and the restarted run are compared"
    ),
}

#: Arrays and attributes that only one of the builds writes, and why
ADDED_DATA: dict[str, str] = {
    r"state/least_volume": "the step follows it with large displacement",
    r"run/ends": "last bytes of the result files, by which a restart knows them",
    r"run/starts": "time at which each stage of a chain of restarts began",
    r"state/relaxation": "dynamic relaxation",
    r"state/loading": "largest load of a quasi-static run, and since when it is loaded so",
    r"plydyn/impactor_outlines(@columns)?": "outlines of impactors, for pictures",
    r"VTKHDF/(PointData|Steps/PointDataOffsets)/energy_share": (
        "share of the toughness that is spent at points of interfaces"
    ),
}
DROPPED_DATA: dict[str, str] = {}

#: What is no number of the model, and why
NOT_COMPARED: dict[str, str] = {
    r"run/places": "lengths of result files in bytes, which change with the words of their headers",
    r"run@format": "number of the layout of restart files",
    r"run/ends": "last bytes of the tables, which are compared themselves",
    r".*@check sum": "sum of what is compared itself; that of run/places changes with it",
}


def reason(table: Mapping[str, str], name: str) -> str | None:
    """What a table says of a name."""
    return next((why for key, why in table.items() if re.fullmatch(key, name)), None)


def renamed(table: Mapping[str, str], name: str) -> str:
    """The new name of an old one."""
    for old, new in table.items():
        if re.fullmatch(old, name):
            return re.sub(old, new, name)
    return name
