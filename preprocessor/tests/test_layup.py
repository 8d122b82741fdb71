"""Stacking sequences."""

from __future__ import annotations

import pytest

from plydyn_pre import LayupError, Ply, is_balanced, is_symmetric, parse


@pytest.mark.parametrize(
    ("notation", "angles"),
    [
        ("[0]", [0]),
        ("[45/0/-45/90]s", [45, 0, -45, 90, 90, -45, 0, 45]),
        ("[0/90]2s", [0, 90, 0, 90, 90, 0, 90, 0]),
        ("[0/90]_{2s}", [0, 90, 0, 90, 90, 0, 90, 0]),
        ("[0/90]_2s", [0, 90, 0, 90, 90, 0, 90, 0]),
        ("[0/90]_{2}", [0, 90, 0, 90]),
        ("[0/90]3", [0, 90] * 3),
        ("[0/90]_s", [0, 90, 90, 0]),
        ("[0/90]S", [0, 90, 90, 0]),
        ("[±45/0]s", [45, -45, 0, 0, -45, 45]),
        ("[+-45/0]s", [45, -45, 0, 0, -45, 45]),
        ("[∓45]", [-45, 45]),
        ("[±45_2]", [45, -45, 45, -45]),
        ("[±0]", [0, 0]),
        ("[0_2/90_2]s", [0, 0, 90, 90, 90, 90, 0, 0]),
        ("[0_{3}/90]", [0, 0, 0, 90]),
        ("[(45/-45)2/0~]s", [45, -45, 45, -45, 0, -45, 45, -45, 45]),
        ("[(45/-45)_2/0]", [45, -45, 45, -45, 0]),
        ("[((0/90)2/45)2]", [0, 90, 0, 90, 45] * 2),
        ("[0/90~]2s", [0, 90, 0, 90, 0, 90, 0]),
        ("[0~]s", [0]),
        ("[90/45/0/-45]2s", [90, 45, 0, -45, 90, 45, 0, -45, -45, 0, 45, 90, -45, 0, 45, 90]),
        (" [ 22.5 / -.5 / +7. ] ", [22.5, -0.5, 7.0]),
        ("[−45/45]", [-45, 45]),
    ],
)
def test_repeats_come_before_the_mirror(notation: str, angles: list[float]) -> None:
    assert [ply.angle for ply in parse(notation)] == angles


def test_the_first_ply_of_the_notation_is_the_first_from_the_bottom() -> None:
    assert parse("[10/20/30]")[0] == Ply(10.0)


def test_names_are_materials_at_zero_degrees() -> None:
    plies = parse("[M1/M2]4s")
    assert len(plies) == 16
    assert plies[:2] == (Ply(0.0, "M1"), Ply(0.0, "M2"))
    assert plies[7:9] == (Ply(0.0, "M2"), Ply(0.0, "M2"))


def test_a_name_before_an_angle_is_its_material() -> None:
    plies = parse("[Al/glass:±45/Al_2/Al-2024~]s")
    glass, metal = [Ply(45.0, "glass"), Ply(-45.0, "glass")], Ply(0.0, "Al")
    half = [metal, *glass, metal, metal]
    assert list(plies) == [*half, Ply(0.0, "Al-2024"), *reversed(half)]


@pytest.mark.parametrize(
    ("notation", "column", "words"),
    [
        ("", 1, "starts with ["),
        ("[]", 2, "angle"),
        ("[0/]", 4, "angle"),
        ("[0//90]", 4, "angle"),
        ("[7O/0]", 3, "a / or a ]"),
        ("[0/90", 1, "not closed by ]"),
        ("[0/(45/-45", 4, "not closed by )"),
        ("[0/(45/-45]", 11, "a / or a )"),
        ("[4590/0]", 2, "Or is a / missing?"),
        ("[0/-4590]", 5, "Or is a / missing?"),
        ("[0/90]2s3", 9, "only a repeat and an s"),
        ("[0/90]_{2s", 7, "only a repeat and an s"),
        ("[0/90]_", 7, "only a repeat and an s"),
        ("[0/90]_{}", 7, "only a repeat and an s"),
        ("[0/90] s s", 10, "only a repeat and an s"),
        ("[0/90]0s", 7, "from 1 to"),
        ("[0_0/90]", 3, "from 1 to"),
        ("[0/90~]", 6, "must end with s"),
        ("[0~/90]s", 3, "must be the last"),
        ("[(0/90~)2/45]s", 7, "cannot be in a group"),
        ("[0/±45~]s", 7, "a single ply"),
        ("[0/90_2~]s", 8, "a single ply"),
        ("[glass:/0]", 8, "angle"),
        ("[0/90]99999999999", 7, "from 1 to"),
        ("[(0_9999)9999]", 0, "more than"),
    ],
)
def test_errors_point_at_the_column(notation: str, column: int, words: str) -> None:
    with pytest.raises(LayupError) as caught:
        parse(notation)
    message, quoted, caret = str(caught.value).split("\n")
    assert words in message
    if column:
        assert caught.value.column == column
        assert message.startswith(f"column {column}: ")
        assert caret == " " * (column + 1) + "^"
    assert quoted == f"  {notation}"


def test_symmetry_and_balance_are_seen() -> None:
    assert is_symmetric(parse("[0/90]s"))
    assert not is_symmetric(parse("[0/90]2"))
    assert is_balanced(parse("[±45/0/90]"))
    assert is_balanced(parse("[90/-90]"))
    assert not is_balanced(parse("[45/0]s"))


@pytest.mark.parametrize(
    ("notation", "plain"),
    [
        ("[0₂/90₂]s", "[0_2/90_2]s"),
        ("[0²/90²]s", "[0_2/90_2]s"),
        ("[0/90]₂ₛ", "[0/90]2s"),
        ("[0/90]₂s", "[0/90]2s"),
        ("[±45]$_{2s}$", "[±45]2s"),
        ("[0/90/0̅]s", "[0/90/0~]s"),
        (r"[0/90/\bar{0}]_s", "[0/90/0~]s"),
        ("[0/90]_T", "[0/90]"),
        ("[0]_{16T}", "[0]16"),
        ("0/90/90/0", "[0/90/90/0]"),
        ("[0, 90; 90|0]", "[0/90/90/0]"),
        ("[0 90 -45]", "[0/90/-45]"),
        ("[0°/90°/±45°]s", "[0/90/±45]s"),
        ("[0deg/90 deg]s", "[0/90]s"),
        ("[+45/–45]s", "[45/-45]s"),
        ("(45/0/-45/90)3s", "[45/0/-45/90]3s"),
        ("{0/90}s", "[0/90]s"),
        ("[[0/90]2/45]s", "[(0/90)2/45]s"),
        ("［0／90］s", "[0/90]s"),
        ("[(0/90)_s]_2", "[0/90/90/0]2"),
        ("[0/45]as", "[0/45/-45/0]"),
        ("[0/45]2as", "[0/45/0/45/-45/0/-45/0]"),
    ],
)
def test_other_spellings_of_papers_and_drawings(notation: str, plain: str) -> None:
    assert parse(notation) == parse(plain)


@pytest.mark.parametrize(
    ("notation", "column", "words"),
    [
        ("[04]", 2, "04 is no angle: 0_4 for 4 plies of 0?"),
        ("[06/90]s", 2, "0_6"),
        ("[45/05/-45/90]s", 5, "0_5"),
        ("[90/010/90]", 5, "0_10"),
        ("[0/902/0]", 4, "90_2"),
        ("[±452/0]s", 3, "45_2"),
        ("[45f/0f]s", 4, "mark a fabric: write its material, as in fabric:45"),
        ("[#45/#0]s", 2, "fabric:45"),
        ("[0W/90W]s", 3, "fabric:45"),
        ("[(0/90)f]2s", 8, "fabric:45"),
        ("[0x2/90x2]s", 3, "0_2 stands for two plies of 0"),
        ("[0^2]", 3, "0_2 stands for two plies of 0"),
        ("[0/90/0_{1/2}]s", 8, "half a ply on the mid-plane is 0~"),
        ("[0/90]s2", 8, "only a repeat and an s"),
        ("[0/90]2.5s", 8, "only a repeat and an s"),
        ("[0/90]2s / [45]", 10, "only a repeat and an s"),
        ("[(0,90)]4", 4, "a / or a )"),
        ("QI", 1, "starts with ["),
    ],
)
def test_what_cannot_be_read_is_asked_for(notation: str, column: int, words: str) -> None:
    with pytest.raises(LayupError) as caught:
        parse(notation)
    assert caught.value.column == column
    assert words in str(caught.value)
