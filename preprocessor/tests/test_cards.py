"""Numbers and cards of fixed columns."""

from __future__ import annotations

import pytest

from plydyn_pre import PreError
from plydyn_pre.deck.cards import coordinate_text, id_cards, keyword, number_text, title_line


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0.0"),
        (1, "1"),
        (0.125, "0.125"),
        (-5000.0, "-5000.0"),
        (1.7e-9, "1.7e-09"),
        (1.65e11, "1.65e11"),
        (-1.234e-10, "-1.234e-10"),
        (0.1 + 0.2, "0.3"),
        (1.0 / 3.0, None),
        (1.23456789, None),
    ],
)
def test_ten_columns_hold_a_number_whole_or_not_at_all(value: float, text: str | None) -> None:
    if text is not None and len(text) == 10:
        text = None  # no column would be left between it and its neighbour
    assert number_text(value, 10) == text


@pytest.mark.parametrize("value", [1 / 3, -1e5 / 3, -1.23456789012345e-101, 4e300 / 3, 2**0.5])
def test_twenty_columns_hold_thirteen_digits_of_any_number(value: float) -> None:
    text = number_text(value, 20)
    if text is None:
        assert abs(value) < 1e-99  # exponents of three digits and a sign do not fit
    else:
        assert float(text) == pytest.approx(value, rel=1e-12)


def test_a_number_that_needs_more_columns_makes_the_keyword_long() -> None:
    short = keyword("LOAD_BODY_Z", {"lcid": 1, "sf": 2.5})
    long = keyword("FIXTURE_BAR", {"fid": 1, "face": 1, "gap": 10.0 / 3.0}, {"x1": 1.0})
    assert short.splitlines() == ["*LOAD_BODY_Z", "$#    lcid        sf", "         1       2.5"]
    name, _, first, _, second = long.splitlines()
    assert name == "*FIXTURE_BAR+"
    assert first.split() == ["1", "1", "3.333333333333"]
    assert len(first) == 60
    assert second == f"{'1.0':>20}"


def test_what_fits_no_columns_is_refused() -> None:
    with pytest.raises(PreError, match=r"\*TITLE"):
        keyword("TITLE", {"title": "a word of more than twenty letters"})


def test_fields_are_where_the_solver_has_them() -> None:
    """In its order, with zeros where it uses none; a field that it has not is refused."""
    text = keyword("CONTROL_TIMESTEP", {"lctm": 3, "dtinit": 0.0, "tssfac": 0.8, "dt2ms": -1e-6})
    head, values = (line[2:].split() for line in text.splitlines()[1:])
    assert head == ["dtinit", "tssfac", "isdo", "tslimt", "dt2ms", "lctm"]
    assert list(map(float, values)) == [0.0, 0.8, 0.0, 0.0, -1e-6, 3.0]
    with pytest.raises(PreError, match=r"no card dtinit step of \*CONTROL_TIMESTEP"):
        keyword("CONTROL_TIMESTEP", {"dtinit": 0.0, "step": 1.0})
    with pytest.raises(PreError, match=r"no card dt2ms"):
        keyword("CONTROL_TIMESTEP", {"dt2ms": 0.0})


def test_a_number_that_stands_for_no_choice_of_the_solver_is_refused() -> None:
    with pytest.raises(PreError, match=r"face of \*FIXTURE_BAR is 2; the solver has \(-1, 1\)"):
        keyword("FIXTURE_BAR", {"fid": 1, "face": 2})


def test_a_header_stands_above_each_new_kind_of_card() -> None:
    rows = [{"nid": 1}, {"nid": 2}, "text", {"nid": 3}]
    text = keyword("CONSTRAINED_LINEAR_GLOBAL", {"lcid": 1}, *rows)
    heads = [line.split()[-1] for line in text.splitlines() if line.startswith("$#")]
    assert heads == ["lcid", "nid", "nid"]


@pytest.mark.parametrize(
    "value", [0.0, 50.0, -46.66666666666667, 1e-5 / 3, -1e-5 / 3, -123456.789012345, -1e-12 / 3]
)
def test_coordinates_keep_nine_digits_in_sixteen_columns(value: float) -> None:
    text = coordinate_text(value)
    assert len(text) <= 16
    assert float(text) == pytest.approx(value, rel=1e-9, abs=0.0)


def test_numbers_of_nodes_are_eight_to_a_line() -> None:
    lines = id_cards(range(1, 18))
    assert [len(line) for line in lines] == [80, 80, 10]
    assert lines[2].split() == ["17"]


@pytest.mark.parametrize(
    ("title", "line"),
    [
        ("plain", "plain"),
        ("two,  parts\nhere", "two; parts here"),
        ("*star", "'*star"),
        ("$ 5", "'$ 5"),
        ("x" * 99, "x" * 80),
    ],
)
def test_titles_are_lines_that_are_neither_keywords_nor_comments(title: str, line: str) -> None:
    assert title_line(title) == line
