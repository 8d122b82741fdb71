"""What a strength stands on, from listings, decks and fields that are known."""

from __future__ import annotations

from pathlib import Path

import h5py
import pytest
import synthetic
import synthetic_damage
from test_ending import write_ending

from plydyn_post.case import read_case
from plydyn_post.ending import read_ending
from plydyn_post.interfaces import read_interfaces
from plydyn_post.results import Results, open_results
from plydyn_post.strength import strength_lights
from plydyn_post.strength_assumed import assumed_table, begins_closed, quads_over

#: The table of mass scaling as the listing of the solver has it
SCALED = """
Mass scaling
------------

stable step asked for         1.00000E-07 s, DT2MS
stable step without it        5.00000E-08 s

    part        mass [t]       added [t]   added [%]   elements  with more  most times
--------  --------------  --------------  ----------  ---------  ---------  ----------
       1   1.0000000E-05   2.0000000E-06     20.0000        100         50      2.0000
     all   1.0000000E-05   2.0000000E-06     20.0000        100         50      2.0000

Stable step
-----------
"""
AT_REST = "at rest: the kinetic energy is 9.1E-05 of its largest value; the motion that is left"


def write_settled(folder: Path) -> Results:
    """A stage that damping brings to rest: it takes 30 mJ, and 5 mJ break."""
    synthetic.write_fields(folder, "settle")
    names = ["time [s]", "damping [mJ]", "dissipated [mJ]", "total [mJ]", "kinetic [mJ]"]
    names += ["internal [mJ]", "error [-]"]
    rows = [[0.0, 2.0, 10.0, 50.0, 1.0, 1.0, 0.0], [1.0e-3, 32.0, 15.0, 50.0, 0.0, 1.0, 0.0]]
    synthetic.write_csv(folder / "settle.energy.csv", names, rows)
    (folder / "settle.out").write_text(f"{SCALED}\n{AT_REST}\nEnd\n---\nnormal end\n")
    return open_results(folder / "settle")


def rows_of(folder: Path, *jobs: Results) -> dict[str, str]:
    """What the page says of a test after some stages."""
    test = write_ending(folder)
    every = (*jobs, test.job)
    cases = [read_case(job, job.job) for job in every]
    return dict(assumed_table(every, test, read_ending(test), cases).rows)


def test_mass_and_relaxation_are_those_of_the_stage(tmp_path: Path) -> None:
    rows = rows_of(tmp_path, write_settled(tmp_path))
    assert rows["mass scaling"] == "20 % added in settle"
    assert "damping took 30 mJ, 5 mJ broke meanwhile" in rows["relaxation"]
    assert "9.1e-05 of the largest kinetic energy left" in rows["relaxation"]


def test_without_them_nothing_is_told(tmp_path: Path) -> None:
    rows = rows_of(tmp_path)
    assert rows["mass scaling"] == "none"
    assert "relaxation" not in rows
    assert rows["materials"].startswith("constants of the deck")


def test_the_speed_is_that_of_the_end(tmp_path: Path) -> None:
    """0.4 mm in 2 ms."""
    assert "the end moves at 200 mm/s" in rows_of(tmp_path)["rate"]


def test_origins_of_materials_are_told(tmp_path: Path) -> None:
    test = write_ending(tmp_path)
    (tmp_path / "plate.k").write_text(
        "$ origin of ply: from IM7/8552 of the library: XC 1000\n*END\n"
    )
    cases = [read_case(test.job, "pressed")]
    rows = dict(assumed_table((test.job,), test, read_ending(test), cases).rows)
    assert rows["origin of ply"] == "from IM7/8552 of the library: XC 1000"


def test_gaps_at_the_start_say_whether_delaminations_are_closed(tmp_path: Path) -> None:
    """The second interface begins with 0.01 of a side of 1 mm, which is not less than its share."""
    name = "gaps at the start, from the bottom up"
    assert rows_of(tmp_path)[name].startswith("0, 0.01, 0 mm; the largest")


@pytest.mark.parametrize(("damage", "closed"), [(1.0, True), (0.0, False)])
def test_only_what_is_delaminated_can_begin_closed(
    damage: float, closed: bool, tmp_path: Path
) -> None:
    test = write_ending(tmp_path, ((0.0, 0.2, 0.3),) * 3)
    with h5py.File(test.job.interface_fields, "r+") as file:
        file["VTKHDF/PointData/damage"][...] = damage
    ending = read_ending(test)
    assert begins_closed(test, ending) == closed
    told = [light.words for light in strength_lights(test, ending, ())]
    assert any("begin closed" in words for words in told) == closed


@pytest.mark.parametrize(("nodes", "apart"), [(9, 2), (4, 1)])
def test_quads_over_the_delaminations_have_a_size(nodes: int, apart: int, tmp_path: Path) -> None:
    """Ellipses of the last state lie on quads of 40 mm over 24."""
    job = synthetic_damage.write_job(tmp_path)
    synthetic_damage.write_interfaces(tmp_path, "plate", nodes=nodes)
    found = quads_over(read_interfaces(open_results(job)))
    assert found is not None
    assert found[0] == pytest.approx(synthetic.SIDE / 24)
    assert found[1] - 1 == apart
    assert quads_over(read_interfaces(open_results(job), 0.0)) is None
