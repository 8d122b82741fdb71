"""Layups on cards, in sections, on elements and as bricks."""

from __future__ import annotations

import subprocess
from itertools import pairwise
from pathlib import Path

import pytest
from deck_cards import cards_of
from foreign_decks import (
    Foreign,
    ball,
    composite,
    contact,
    control,
    ply_law,
    rigid,
    sphere_profile,
    standard,
)
from foreign_forms import (
    LAYUPS,
    angles,
    plain,
    refused,
    tiebreak,
    translated,
)


@pytest.mark.parametrize("form", LAYUPS)
def test_layups_in_every_form(form: str, tmp_path: Path) -> None:
    own, other = (translated(tmp_path, LAYUPS[name])[0] for name in (form, "cards"))
    if form == "turned":  # the nodes between corners have other numbers
        own, other = (deck.split("*SET_NODE")[0] for deck in (own, other))
    assert plain(own) == plain(other)


def test_a_section_without_a_number_of_points_has_two(tmp_path: Path) -> None:
    """LS-DYNA's own default, and its zero."""
    four = "         1         2     0.833         4         0       1.0         1"
    assert four in LAYUPS["icomp"]
    for points in ("         0", f"{'':10}"):
        text = LAYUPS["icomp"].replace(four, four.replace("         4", points))
        deck, _ = translated(tmp_path, text)
        assert angles(deck) == [0.0, 90.0]


def test_clockwise_quads_have_their_plies_from_the_top_and_mirrored(tmp_path: Path) -> None:
    deck = Foreign()
    plate = deck.layer()
    deck.quads(1, plate, turned=True)
    composite(deck, 1, (30.0, 0.0, 0.0, -45.0))
    ply_law(deck, axis=((0.0, 1.0, 0.0),))
    ball(deck)
    control(deck)
    # from the top down, about the normal that points down, from the axis a along y
    assert angles(translated(tmp_path, deck.text())[0]) == [-45.0, 90.0, 90.0, 60.0]


def zones(text: str) -> dict[tuple[float, float], list[float]]:
    """Angles of the plies of each quad of a deck, by its middle."""
    cards = cards_of(text)
    parts: dict[int, list[float]] = {}
    last: list[float] | None = None
    for row in cards["PART_COMPOSITE_LONG"]:
        words = row.split()
        if not words[0].isdigit():
            last = None
        elif last is None:
            last = parts.setdefault(int(words[0]), [])
        else:
            last.append(float(words[2]))
    places = {int(row[:8]): (float(row[8:24]), float(row[24:40])) for row in cards["NODE"]}
    rows = cards["ELEMENT_PLATE_Q9"]
    found = {}
    for head, nodes in zip(rows[::2], rows[1::2], strict=True):
        x, y = places[int(nodes[64:72])]
        found[round(x, 6), round(y, 6)] = parts[int(head[8:16])]
    return found


def test_angles_that_differ_in_a_part_make_parts_of_it(tmp_path: Path) -> None:
    text = LAYUPS["beta"]
    turned, other = f"{'':>64}{90.0:>16}", f"{'':>64}{30.0:>16}"
    at = text.index(turned)
    for _ in range(32):
        at = text.index(turned, at + 1)
    two, _ = translated(tmp_path, text[:at] + text[at:].replace(turned, other))
    # BETA 90 and 30 on the plies [-90/0]s
    lower, upper = [0.0, 90.0, 90.0, 0.0], [-60.0, 30.0, 30.0, -60.0]
    found = zones(two)
    assert len(found) == 64
    assert all(found[x, y] == (lower if y < 20.0 else upper) for x, y in found)
    assert numbers_of(two, "CONTACT_IMPACTOR")[0][:3] == [1.0, 1.0, 0.0]


def numbers_of(text: str, name: str) -> list[list[float]]:
    """The numbers of a keyword."""
    return [[float(word) for word in row.split()] for row in cards_of(text)[name]]


def test_parts_of_other_angles_have_the_same_interfaces(solver: str, tmp_path: Path) -> None:
    text = tiebreak("parts")
    part = text[text.index("*PART_COMPOSITE") : text.index("*MAT_ENHANCED")].split("*PART_COMP")[1]
    third = f"*PART_COMP{part}".replace("\n         1        16", "\n         3        16")
    third = third.replace("      90.0", "      45.0")
    lines = text.replace("*MAT_ENHANCED", f"{third}*MAT_ENHANCED", 1).splitlines()
    first = lines.index("*ELEMENT_SHELL") + 1
    for at in range(first, first + 16):
        lines[at] = f"{lines[at][:8]}{3:8d}{lines[at][16:]}"
    two, _ = translated(tmp_path, "\n".join(lines))
    assert {tuple(plies) for plies in zones(two).values()} == {
        (0.0, 90.0, 90.0, 0.0),
        (0.0, 45.0, 90.0, 0.0),
    }
    joints = numbers_of(two, "INTERFACE_COHESIVE")
    assert [row[:3] for row in joints] == [[1.0, 2.0, 2.0], [2.0, 2.0, 2.0]]
    (tmp_path / "two.k").write_text(two + "\n")
    command = [solver, "check", "two.k"]
    result = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr


def test_thicknesses_and_offsets_that_differ_in_a_part_are_refused(tmp_path: Path) -> None:
    said = "a plate of plydyn has one thickness and one middle"
    for form, old, new, name in (
        ("thickness", f"{0.5:>16}", f"{0.6:>16}", "THIC4"),
        ("offset", f"{0.25:>16}", f"{0.3:>16}", "OFFSET"),
    ):
        head, _, tail = LAYUPS[form].rpartition(old)
        line = head.count("\n") + 1
        words = f"user.k:{line - 1}: *ELEMENT_SHELL_{form.upper()} {name}: {new.strip()} at element"
        refused(tmp_path, head + new + tail, words, said)


def test_quads_of_both_senses_in_a_part_have_their_plies_from_their_own_bottom(
    tmp_path: Path,
) -> None:
    lines = standard()[0].text().replace("      90.0", "      30.0", 1).splitlines()
    first = lines.index("*ELEMENT_SHELL") + 1
    for at in range(first, first + 8):
        n = [lines[at][k : k + 8] for k in range(16, 48, 8)]
        lines[at] = lines[at][:16] + n[0] + n[3] + n[2] + n[1]
    found = zones(translated(tmp_path, "\n".join(lines))[0])
    # clockwise ones from the top down and mirrored
    lower, upper = [0.0, 90.0, -30.0, 0.0], [0.0, 30.0, 90.0, 0.0]
    assert all(found[x, y] == (lower if y < 5.0 else upper) for x, y in found)


@pytest.mark.parametrize("count", [1, 2])
def test_bricks_are_plies(count: int, tmp_path: Path) -> None:
    deck = Foreign()
    steps = [0.25 * k / count for k in range(2 * count + 1)]
    layers = [deck.layer(z) for z in steps]
    for k in range(2 * count):
        deck.quads(1 + k // count, layers[k], layers[k + 1], name="ELEMENT_SOLID")
    deck.put("SECTION_SOLID", (1, 1))
    deck.put("PART", "ply 1", (1, 1, 1), "ply 2", (2, 1, 2))
    ply_law(deck, 1)
    ply_law(deck, 2, ((0.0, 1.0, 0.0),))
    deck.revolved(9, sphere_profile(0.5))
    rigid(deck)
    contact(deck, 2, 9)
    control(deck)
    text, _ = translated(tmp_path, deck.text())
    part = text.split("*PART_COMPOSITE_LONG")[1].split("*")[0].splitlines()[5:]
    plies = [(float(line.split()[1]), float(line.split()[2])) for line in part]
    assert sum(t for t, _ in plies) == pytest.approx(0.5)
    assert [a for _, a in plies] == [0.0] * count + [90.0] * count
    assert "0.25" in text.split("*NODE\n")[1].splitlines()[0]


def test_thick_shells_over_each_other_have_the_plies_of_their_part_each(tmp_path: Path) -> None:
    deck = Foreign()
    layers = [deck.layer(z) for z in (0.0, 0.25, 0.75)]
    for low, high in pairwise(layers):
        deck.quads(1, low, high, name="ELEMENT_TSHELL")
    deck.put("PART_COMPOSITE_TSHELL", "plate", (1, 1), (1, 0.1, 0.0, 0, 1, 0.3, 90.0))
    ply_law(deck)
    ball(deck, 0.75)
    control(deck)
    part = translated(tmp_path, deck.text())[0].split("*PART_COMPOSITE_LONG")[1].split("*")[0]
    plies = [tuple(map(float, line.split()[1:3])) for line in part.splitlines()[5:]]
    sizes = [0.0625, 0.1875, 0.125, 0.375]
    assert [size for size, _ in plies] == pytest.approx(sizes)
    assert [angle for _, angle in plies] == [0.0, 90.0, 0.0, 90.0]


def test_parts_side_by_side_of_one_layup_are_one_plate(tmp_path: Path) -> None:
    reference, _, _ = standard()
    text = reference.text()
    lines = text.splitlines()
    first = lines.index("*ELEMENT_SHELL") + 1
    for at in range(first, first + 16):
        lines[at] = f"{lines[at][:8]}{3:8d}{lines[at][16:]}"
    second = "\n".join(lines)
    part = second[second.index("*PART_COMPOSITE") : second.index("*MAT_ENHANCED")]
    twin = part.replace("\n         1        16", "\n         3        16")
    both = second.replace("*MAT_ENHANCED", twin + "*MAT_ENHANCED")
    new, _ = translated(tmp_path, both)
    old, _ = translated(tmp_path, text)
    assert new.split("*NODE")[0] == old.split("*NODE")[0]
    uneven = twin.replace("     0.125", "      0.15", 1).replace("     0.125", "       0.1", 1)
    refused(tmp_path, both.replace(twin, uneven), "lies beside part", "plies of other thicknesses")
    thick = both.replace(twin, twin.replace("     0.125", "      0.15", 1))
    refused(tmp_path, thick, "do not lie over", "one stack of parts, of one thickness, is transl")


def test_several_parts_below_one_keyword(tmp_path: Path) -> None:
    text = LAYUPS["icomp"]
    part = "*PART\nplate\n         1         1         1\n"
    assert part in text
    two = text.replace(part, part + "spare\n         7         1         1\n")
    new, notes = translated(tmp_path, two)
    assert new == translated(tmp_path, text)[0]
    assert any(note.startswith("part 7 of line") and "has no elements" in note for note in notes)


@pytest.mark.parametrize(
    ("plies", "words"),
    [
        ((0.0, 90.0, 0.0, 90.0), "[0/90/0/90] is not symmetric about the middle"),
        ((30.0, 0.0, 0.0, 30.0), "[30/0/0/30] is not balanced"),
        ((30.0, -30.0, -30.0, 30.0), ""),
        ((45.0, -45.0, 90.0, 0.0), "[45/-45/90/0] is not symmetric"),
    ],
)
def test_laminates_that_couple_are_noted(
    plies: tuple[float, ...], words: str, tmp_path: Path
) -> None:
    deck = Foreign()
    plate = deck.layer()
    deck.quads(1, plate)
    composite(deck, 1, plies)
    ply_law(deck)
    ball(deck)
    control(deck)
    _, notes = translated(tmp_path, deck.text())
    noted = [note for note in notes if note.startswith("the laminate")]
    assert len(noted) == bool(words) and all(words in note for note in noted)


def test_the_cause_is_told_and_not_its_victim(tmp_path: Path) -> None:
    text = standard()[0].text()
    for old, new, cause, victim in (
        ("*ELEMENT_SHELL\n", "*ELEMENT_SHELL_MCID\n", "*ELEMENT_SHELL_MCID: these", "no plate"),
        ("*MAT_ENHANCED_COMPOSITE_DAMAGE", "*MAT_116", "*MAT_116 (line", "units of the deck"),
        ("*PART_COMPOSITE", "*PART_COMPOSITE_IGA_SHELL", "*PART_COMPOSITE_IGA_SHELL: this", "?"),
    ):
        assert victim not in refused(tmp_path, text.replace(old, new, 1), cause)


def test_a_ply_without_material_is_refused(tmp_path: Path) -> None:
    text = standard()[0].text()
    row = "         1     0.125       0.0         0         1     0.125      90.0"
    bad = text.replace(row, "         0" + row[10:], 1)
    refused(tmp_path, bad, "MID1 cannot be 0: the ply of thickness 0.125 needs a material")


@pytest.mark.parametrize(
    ("ratio", "young", "words"),
    [(0.3, 12000.0, "nu12 = PRBA EA/EB = 1.12"), (0.3, 20000.0, "nu12 = PRBA EA/EB = 0.675")],
)
def test_a_major_ratio_is_noted(ratio: float, young: float, words: str, tmp_path: Path) -> None:
    old = "  153000.0   10300.0   10300.0    0.0202    0.0202"
    text = standard()[0].text()
    assert old in text
    card = f"{45000.0:>10}{young:>10}{young:>10}{ratio:>10}{0.05:>10}"
    _, notes = translated(tmp_path, text.replace(old, card))
    assert any(words in note and "is PRBA the major ratio?" in note for note in notes)
    right = f"{45000.0:>10}{young:>10}{young:>10}{ratio * young / 45000.0:>10.6f}{0.05:>10}"
    _, notes = translated(tmp_path, text.replace(old, right))
    assert not any("PRBA" in note for note in notes)
    refused(tmp_path, text.replace(old, old.replace("0.0202", "   0.3")), "PRBA EA/EB = 4.46")
