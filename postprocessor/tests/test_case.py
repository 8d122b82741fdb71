"""A page begins with the case and with what the listing notes, as traffic lights."""

from pathlib import Path

import h5py
import numpy as np
import pytest

from plydyn_post.case import read_case
from plydyn_post.report import Plan, make_report
from plydyn_post.results import open_results

LISTING = """plydyn 0.1.0 (abc)
built as Release
flags -O3

deck   {deck}
title  plate

Damage of material 3 mine, like IM7/8552
----------------------------------------

largest damage                0.99

of 1728 Gauss points; where the band is too wide damage starts below the strength

Interface material 4 bond
-------------------------

note: the process zone of opening, 0.6 mm, spans 1.2 distances; smaller quads help
{more}
Size and mass
-------------

quads                         12 of 9 nodes
mass of the plate             1.4E-05 t
impactor 1                    1.0E-03 t, energy  1.0E+04 mJ
   body                       sphere, radius 7.5 mm
fixture 1                     plane below the bottom face

Stable step
-----------

largest step taken            3.0E-08 s, TSSFAC 0.9

quad  step
   1  2.0E-8

End
---

{end}
"""
DECK = """*KEYWORD
$ origin of mine, like IM7/8552: from IM7/8552 of the library: XT 2326.2, XC
$ 1200.1; E3 = E2
*MAT_PLY_CODAM2_TITLE
$ another comment
*MAT_COHESIVE_MIXED_MODE_TITLE
$ origin of bond: all constants are those of IM7/8552 interface of the library
*END
"""


def write_listing(job: Path, more: str = "", end: str = "normal end") -> None:
    """A listing and the deck that the fields name, beside the results."""
    (job.parent / "plate.k").write_text(DECK)
    job.with_name("plate.out").write_text(LISTING.format(deck="plate.k", more=more, end=end))


def test_a_case_is_told_from_listing_fields_and_deck(own_job: Path) -> None:
    write_listing(own_job)
    rows = dict(read_case(open_results(own_job), "plate").rows)
    assert rows["laminate"].startswith("[") and "plies" in rows["laminate"]
    assert rows["material 3"] == "mine, like IM7/8552 (ply)"
    assert rows["material 4"] == "bond (interface)"
    filled = "from IM7/8552 of the library: XT 2326.2, XC 1200.1; E3 = E2"
    assert rows["origin of mine, like IM7/8552"] == filled
    assert rows["origin of bond"].startswith("all constants are those of IM7/8552 interface")
    assert rows["impactor 1"] == "1.0E-03 t, energy 1.0E+04 mJ"
    assert rows["body"] == "sphere, radius 7.5 mm"
    assert rows["fixture 1"] == "plane below the bottom face"
    assert rows["quads"] == "12 of 9 nodes"
    assert rows["largest step taken"] == "3.0E-08 s, TSSFAC 0.9"
    assert rows["version"] == "plydyn 0.1.0 (abc); built as Release; flags -O3"
    assert "quad" not in rows


def test_a_laminate_that_two_parts_share_is_told_once(own_job: Path) -> None:
    with h5py.File(open_results(own_job).fields, "r+") as file:
        own = file["plydyn"]
        plies, columns = own["plies"][...], own["plies"].attrs["columns"]
        del own["plies"]
        second = plies.copy()
        second[:, 0] += 1.0
        own["plies"] = np.concatenate([plies, second])
        own["plies"].attrs["columns"] = columns
    assert dict(read_case(open_results(own_job), "plate").rows)["laminate"].count("[") == 1


@pytest.mark.parametrize(
    ("more", "end", "colours"),
    [
        ("", "normal end", ["amber", "amber", "green"]),
        ("warning: a corner of quad 3", "normal end", ["red", "amber", "amber", "green"]),
        ("", "out of balance", ["red", "amber", "amber", "green"]),
    ],
)
def test_notes_of_the_listing_are_lights(
    own_job: Path, more: str, end: str, colours: list[str]
) -> None:
    write_listing(own_job, more, end)
    lights = read_case(open_results(own_job), "plate").lights
    assert [light.colour for light in lights] == colours
    words = " ".join(light.words for light in lights)
    assert "spans 1.2 distances; smaller quads help" in words
    assert "crack bands are too wide at some points; smaller quads help" in words


@pytest.mark.parametrize(("peak", "colour"), [(None, "red"), (6.7e-3, "red"), (6.6e-3, "green")])
def test_a_plate_that_collapses_may_be_fast(own_job: Path, peak: float | None, colour: str) -> None:
    more = "warning: the kinetic energy is 0.05 of the internal one at time 0.00663 s, more than"
    write_listing(own_job, f"{more} SHARE of *CONTROL_QUASI_STATIC: load more slowly")
    lights = read_case(open_results(own_job), "plate", peak).lights
    assert [each.colour for each in lights if "kinetic energy" in each.words] == [colour]


def test_the_build_of_a_stage_is_told(own_job: Path) -> None:
    """Its listing begins with a heading."""
    listing = own_job.with_name("plate.out")
    listing.write_text("\nRestart\n-------\n\nplydyn 0.1.0 (abc)\nbuilt as Release\nflags -O3\n")
    rows = dict(read_case(open_results(own_job), "plate").rows)
    assert rows["version"] == "plydyn 0.1.0 (abc); built as Release; flags -O3"


@pytest.mark.parametrize(("error", "colour"), [(0.009, "green"), (0.011, "amber"), (0.06, "red")])
def test_the_energy_balance_is_a_light(own_job: Path, error: float, colour: str) -> None:
    path = own_job.with_name("plate.energy.csv")
    head, *rows = path.read_text().splitlines()
    place = head.split(",").index("error [-]")
    last = rows[-1].split(",")
    last[place] = f"{-error}"
    path.write_text("\n".join([head, *rows[:-1], ",".join(last)]) + "\n")
    lights = read_case(open_results(own_job), "plate").lights
    assert [each.colour for each in lights if "energy balance" in each.words] == [colour]


def test_a_page_begins_with_case_and_checks(own_job: Path, tmp_path: Path) -> None:
    write_listing(own_job)
    page = make_report(Plan((open_results(own_job),), tmp_path), []).page.read_text()
    places = [page.index(f"<h2>{heading}</h2>") for heading in ("Case", "Checks", "Numbers")]
    assert places == sorted(places)
    assert '<li class="amber">' in page
