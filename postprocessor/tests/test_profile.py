"""Profiles are those of the right instant, with both sides of every face."""

from pathlib import Path

import numpy as np
import pytest
import synthetic

from plydyn_post.errors import ResultsError
from plydyn_post.profile import draw_profiles, read_profile, read_profiles, symbol
from plydyn_post.results import open_results


def test_the_profile_at_the_peak_force(job: Path) -> None:
    profile = read_profile(open_results(job), "plate")
    assert profile.time == pytest.approx(synthetic.DURATION / 2)
    assert len(profile.z) == 10
    stress = synthetic.stress_at(profile.z, profile.table["ply"], 1.0)
    assert profile.table["syz"] == pytest.approx(stress["syz"])
    assert profile.angles == synthetic.ANGLES


def test_the_profile_nearest_to_a_time(job: Path) -> None:
    profile = read_profile(open_results(job), "plate", time=0.31e-3)
    assert profile.time == pytest.approx(0.3e-3)


def test_without_an_impactor_the_last_instant_is_taken(own_job: Path) -> None:
    own_job.with_name("plate.impactor_1.csv").unlink()
    profile = read_profile(open_results(own_job), "plate")
    assert profile.time == pytest.approx(synthetic.DURATION)


def test_both_sides_of_a_face_are_kept(job: Path) -> None:
    profile = read_profile(open_results(job), "plate")
    assert profile.faces() == pytest.approx([0.0, synthetic.PLY, 2 * synthetic.PLY])
    at_face = np.flatnonzero(profile.z == synthetic.PLY)
    assert profile.table["ply"][at_face].tolist() == [1.0, 2.0]
    below, above = profile.table["sxx"][at_face]
    assert below - above == pytest.approx(synthetic.JUMP)


def test_an_instant_cut_short_is_left_out(own_job: Path) -> None:
    path = own_job.with_name("plate.profile_1.csv")
    path.write_text("\n".join(path.read_text().splitlines()[:-3]) + "\n")
    last = 0.95 * synthetic.DURATION
    profile = read_profile(open_results(own_job), "plate", time=last)
    assert profile.time == pytest.approx(last)
    with pytest.raises(ResultsError, match="not between 0 and"):
        read_profile(open_results(own_job), "plate", time=synthetic.DURATION)
    assert len(profile.z) == 10


def test_an_unknown_component_is_told_with_the_known_ones(job: Path, tmp_path: Path) -> None:
    profiles = read_profiles([open_results(job)])
    with pytest.raises(ResultsError, match=r"plate\.profile_1\.csv has no column 'sqq'"):
        draw_profiles(profiles, ["sqq"], tmp_path / "a.png")


def test_components_in_print() -> None:
    assert symbol("syz") == r"$\sigma_{yz}$"
    assert symbol("gxz") == r"$\gamma_{xz}$"
    assert symbol("uz") == "$u_{z}$"
