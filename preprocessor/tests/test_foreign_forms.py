"""Forms of LS-DYNA decks that say the same: they become one deck."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from ansys.dyna.core import Deck
from foreign_decks import (
    SPEED,
    Foreign,
    ball,
    composite,
    contact,
    control,
    ply_law,
    rigid,
    rim,
    sphere_profile,
    standard,
)

from plydyn_pre.errors import PreError
from plydyn_pre.translate import Choices, translate

LIKE = "IM7/8552"


def translated(folder: Path, text: str | bytes, **choices: object) -> tuple[str, list[str]]:
    """The new deck and the notes."""
    path = folder / "user.k"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    lines, _, notes = translate(path, folder / "job.k", Choices(**({"like": LIKE} | choices)))
    return "\n".join(lines), notes


def plain(deck: str) -> str:
    """A deck without the titles of its sets."""
    return re.sub(r"(?m)^(set \d+|single nodes)$", "held", deck)


def same(folder: Path, text: str | bytes, other: str) -> None:
    """Check that two decks become the same one."""
    assert plain(translated(folder, text)[0]) == plain(translated(folder, other)[0])


def refused(folder: Path, text: str, *words: str, **choices: object) -> str:
    """What is said of a deck that is not translated."""
    with pytest.raises(PreError) as caught:
        translated(folder, text, **choices)
    for each in words:
        assert each in str(caught.value)
    return str(caught.value)


def test_supports_in_every_form(tmp_path: Path) -> None:
    reference = standard()[0].text()
    deck, plate, _ = standard(held=False)
    edge = rim(plate)
    inner = sorted(set(plate) - set(edge))
    free = deck.text().removesuffix("*END\n")
    rows = "\n".join(f"{n:10d}         0         1         1         1" for n in edge)
    same(tmp_path, f"{free}*BOUNDARY_SPC_NODE\n{rows}\n*END\n", reference)
    hold = "*BOUNDARY_SPC_SET\n         1         0         1         1         1\n*END\n"
    forms = {
        "GENERAL": "ALL\n" + "\n".join(f"     DNODE{n:10d}" for n in inner),
        "COLUMN": "\n".join(f"{n:10d}" for n in edge),
        "LIST_GENERATE": "\n".join(f"{n:10d}{n:10d}" for n in edge),
    }
    for form, lines in forms.items():
        same(tmp_path, f"{free}*SET_NODE_{form}\n         1\n{lines}\n{hold}", reference)
    two = f"*SET_NODE_LIST\n5\n{','.join(map(str, edge[:16]))}\n".replace(",", ",")
    halves = [edge[:16], edge[16:]]
    two = "".join(
        f"*SET_NODE\n{sid}\n" + "\n".join(map(str, ids)) + "\n"
        for sid, ids in zip((5, 6), halves, strict=True)
    )
    same(tmp_path, f"{free}{two}*SET_NODE_ADD\n1\n5,6\n{hold}", reference)
    box = "*DEFINE_BOX\n3,0.1,39.9,0.1,39.9,-1,1\n*SET_NODE_GENERAL\n1\nPART,1\nDBOX,3\n"
    same(
        tmp_path,
        free + box.replace("DBOX,3", "\n".join(f"DNODE,{n}" for n in inner)) + hold,
        reference,
    )
    timed = "*BOUNDARY_SPC_SET_BIRTH_DEATH_ID\n1,edge\n1,0,1,1,1\n0.0,1e20\n*END\n"
    ids = "*SET_NODE_COLUMN\n         1\n" + forms["COLUMN"] + "\n"
    same(tmp_path, f"{free}{ids}{timed}", reference)


def test_codes_of_nodes_hold(tmp_path: Path) -> None:
    deck, plate, _ = standard(held=False)
    edge = {f"{n:8d}" for n in rim(plate)}
    lines = deck.text().splitlines()
    first = lines.index("*NODE") + 1
    for at in range(first, first + len(plate)):
        lines[at] += "       7       7" if lines[at][:8] in edge else "       0       0"
    same(tmp_path, "\n".join(lines), standard()[0].text())


def test_a_support_that_ends_is_a_motion_that_ends(tmp_path: Path) -> None:
    deck, plate, _ = standard(held=False)
    deck.set_of("SET_NODE_LIST", 1, rim(plate))
    deck.put("BOUNDARY_SPC_SET_BIRTH_DEATH", (1, 0, 1, 0, 1), (0.0, 1.0e-4))
    text, _ = translated(tmp_path, deck.text())
    rows = re.findall(r"\*BOUNDARY_PRESCRIBED_MOTION_SET\n\$.*\n(.*)", text)
    assert [row.split()[1] for row in rows] == ["1", "3"]
    assert all(float(row.split()[6]) == 1.0e-4 and row.split()[2] == "0" for row in rows)
    points = text.split(f"\ncurve {rows[0].split()[3]}\n")[1].split("*")[0].splitlines()[3:]
    assert [float(line.split()[1]) for line in points] == [0.0, 0.0]


VELOCITIES: dict[str, Callable[[Foreign, list[int], list[int]], None]] = {
    "part": lambda d, *_: d.put("INITIAL_VELOCITY_GENERATION", (9, 2, 0, 0, 0, -SPEED), (None,)),
    "node set": lambda d, _, nodes: (
        d.set_of("SET_NODE_LIST", 5, nodes),
        d.put("INITIAL_VELOCITY_GENERATION", (5, 3, 0, 0, 0, -SPEED), (None,)),
    ),
    "part set": lambda d, *_: (
        d.put("SET_PART_LIST", (5,), (9,)),
        d.put("INITIAL_VELOCITY_GENERATION", (5, 1, 0, 0, 0, -SPEED), (None,)),
    ),
    "set": lambda d, _, nodes: (
        d.set_of("SET_NODE_LIST", 5, nodes),
        d.put("INITIAL_VELOCITY", (5,), (0, 0, -SPEED)),
    ),
    "box": lambda d, *_: (
        d.put("DEFINE_BOX", (4, -1e3, 1e3, -1e3, 1e3, 0.3, 1e3)),
        d.put("INITIAL_VELOCITY", (0, 0, 4), (0, 0, -SPEED)),
    ),
    "nodes": lambda d, _, nodes: d.put(
        "INITIAL_VELOCITY_NODE", *[(n, 0, 0, -SPEED) for n in nodes]
    ),
}


@pytest.mark.parametrize("form", VELOCITIES)
def test_velocities_in_every_form(form: str, tmp_path: Path) -> None:
    deck, plate, nodes = standard(moved=False)
    VELOCITIES[form](deck, plate, nodes)
    same(tmp_path, deck.text(), standard()[0].text())


def test_the_velocity_of_the_inertia_and_that_of_all_nodes(tmp_path: Path) -> None:
    text = standard(moved=False)[0].text()
    own = text.replace("       0.0       0.0       0.0", "       0.0       0.0   -2000.0", 1)
    same(tmp_path, own, standard()[0].text())
    deck = standard(moved=False)[0]
    deck.put("INITIAL_VELOCITY", (None,), (0, 0, -SPEED))
    new, _ = translated(tmp_path, deck.text())
    assert "*INITIAL_VELOCITY\n" in new and "-2000.0" in new.split("*IMPACTOR_SPHERE")[1]


def stacked(
    joint: Callable[[Foreign, list[int], list[int]], None], gap: float = 0.25
) -> tuple[str, list[int], list[int]]:
    """Two parts of two plies each, one over the other, and what joins them."""
    deck = Foreign()
    lower, upper = deck.layer(0.125), deck.layer(0.125 + gap)
    deck.quads(1, lower)
    deck.quads(2, upper)
    composite(deck, 1, (0.0, 90.0))
    composite(deck, 2, (90.0, 0.0))
    ply_law(deck)
    deck.revolved(9, sphere_profile(0.5))
    rigid(deck)
    deck.set_of("SET_NODE_LIST", 1, [*rim(lower), *rim(upper)])
    deck.put("BOUNDARY_SPC_SET", (1, 0, 1, 1, 1))
    deck.put("INITIAL_VELOCITY_RIGID_BODY", (9, 0, 0, -SPEED))
    contact(deck, 2, 9)
    joint(deck, lower, upper)
    control(deck)
    return deck.text(), lower, upper


def segments(deck: Foreign, sid: int, ids: list[int]) -> None:
    """A set of the segments of a layer."""
    rows = []
    for j in range(8):
        for i in range(8):
            a = 9 * j + i
            rows.append(tuple(ids[k] for k in (a, a + 1, a + 10, a + 9)))
    deck.put("SET_SEGMENT", (sid,), *rows)


def sides(kind: str) -> Callable[[Foreign, list[int], list[int]], tuple[int, int, int, int]]:
    """What a contact names its two sides by."""

    def make(deck: Foreign, lower: list[int], upper: list[int]) -> tuple[int, int, int, int]:
        match kind:
            case "segments":
                segments(deck, 11, lower)
                segments(deck, 12, upper)
                return 11, 12, 0, 0
            case "part sets":
                deck.put("SET_PART_LIST", (11,), (1,))
                deck.put("SET_PART", (12,), (2,))
                return 11, 12, 2, 2
            case "nodes":
                deck.set_of("SET_NODE_LIST", 11, lower)
                return 11, 2, 4, 3
            case "shells":
                deck.set_of("SET_SHELL_LIST", 11, list(range(1, 65)))
                return 11, 2, 1, 3
            case "general":
                deck.put("SET_SEGMENT_GENERAL", (11,), ("PART", 1))
                return 11, 2, 0, 3
        return 1, 2, 3, 3

    return make


NINE = (9, 60.0, 90.0, -1.5, 0.3, 0.8, 0.4, 1.0e5)
TIEBREAK = "CONTACT_AUTOMATIC_ONE_WAY_SURFACE_TO_SURFACE_TIEBREAK"
SIDES = ("parts", "segments", "part sets", "nodes", "shells", "general")


def tiebreak(kind: str, name: str = TIEBREAK, *last: tuple[float, ...]) -> str:
    """A deck with a tiebreak contact between its two parts."""

    def joint(deck: Foreign, lower: list[int], upper: list[int]) -> None:
        pair = sides(kind)(deck, lower, upper)
        deck.put(name, pair, (0.0, 0.0), (None,), *(last or (NINE,)))

    return stacked(joint)[0]


@pytest.mark.parametrize("kind", SIDES[1:])
def test_a_tiebreak_by_any_sides(kind: str, tmp_path: Path) -> None:
    same(tmp_path, tiebreak(kind), tiebreak("parts"))


@pytest.mark.parametrize(
    "name",
    [
        f"{TIEBREAK}_MORTAR",
        f"{TIEBREAK}_SMOOTH",
        "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK",
        "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK_MORTAR",
        "CONTACT_AUTOMATIC_SINGLE_SURFACE_TIEBREAK",
    ],
)
def test_a_tiebreak_by_any_name(name: str, tmp_path: Path) -> None:
    if "SINGLE" in name:
        text = tiebreak("part sets", name).replace(
            "SET_PART_LIST\n        11\n         1",
            "SET_PART_LIST\n        11\n         1         2",
        )
        same(tmp_path, text, tiebreak("parts"))
        return
    same(tmp_path, tiebreak("parts", name), tiebreak("parts"))


def test_the_cards_of_mpp_and_of_the_number_are_in_front(tmp_path: Path) -> None:
    text = tiebreak("parts").replace(
        f"*{TIEBREAK}\n", f"*{TIEBREAK}_MPP_ID\n7,glue\n0,200,,3,2,1.0005\n& 1,1\n"
    )
    same(tmp_path, text, tiebreak("parts"))
    one = tiebreak("parts").replace(f"*{TIEBREAK}\n", f"*{TIEBREAK}_ID_MPP\n7,glue\n0,200\n")
    same(tmp_path, one, tiebreak("parts"))


def law_of(deck: str) -> list[list[float]]:
    """The numbers of the first bond of a deck."""
    rows = re.search(r"\*MAT_COHESIVE_MIXED_MODE_TITLE\+?\n.*\n\$.*\n(.*)\n\$.*\n(.*)", deck)
    assert rows
    return [[float(word) for word in row.split()] for row in rows.groups()]


@pytest.mark.parametrize(
    ("card", "energies"),
    [
        ((7, 60.0, 90.0, 1.0, 0.3, 0.8, 0.4, 1.0e5), (0.3, 0.8)),
        ((9, 60.0, 90.0, 1.0, 0.3, 0.8, 0.4, 1.0e5), (0.3, 0.8)),
        ((11, 60.0, 90.0, 1.0, 0.3, 0.8, 0.4, 1.0e5), (0.3, 0.8)),
        ((6, 60.0, 90.0, 0.02, 0.0, 0.0, 0.4, 1.0e5), (0.6, 0.9)),
        ((8, 60.0, 90.0, 0.02, 0.0, 0.0, 0.4, 1.0e5), (0.6, 0.9)),
        ((2, 60.0, 90.0, 0.0, 0.0, 0.0, 0.4, 1.0e5), (1.05 * 0.018, 1.05 * 0.10125)),
    ],
)
def test_every_option_of_failure_keeps_strength_and_energy(
    card: tuple[float, ...], energies: tuple[float, float], tmp_path: Path
) -> None:
    first, second = law_of(translated(tmp_path, tiebreak("parts", TIEBREAK, card))[0])
    # stiffness CN and CN CT2CN; the energy at the strength is 60^2/(2 CN) and 90^2/(2 CN CT2CN)
    assert first[4:6] == [1.0e5, 4.0e4]
    assert first[6:] == pytest.approx(energies, rel=1e-12)
    assert second[1:3] == [60.0, 90.0]


def test_the_classic_tiebreak_breaks_at_its_strengths(tmp_path: Path) -> None:
    name = "CONTACT_TIEBREAK_SURFACE_TO_SURFACE"
    deck, notes = translated(tmp_path, tiebreak("parts", name, (60.0, 90.0, 2.0, 2.0)))
    first, second = law_of(deck)
    assert second[1:3] == [60.0, 90.0]
    assert first[4] == 50.0 * 10300.0 / 0.25
    assert first[6] == pytest.approx(1.05 * 60.0**2 / (2.0 * first[4]))
    assert any("a bond that breaks at once" in note for note in notes)
    nodes = "CONTACT_TIEBREAK_NODES_TO_SURFACE"
    same(
        tmp_path,
        tiebreak("nodes", nodes, (60.0, 90.0, 2.0, 2.0)),
        tiebreak("parts", name, (60.0, 90.0, 2.0, 2.0)),
    )
    words = "NEN: 1 is not translated"
    refused(tmp_path, tiebreak("parts", nodes, (60.0, 90.0, 1.0, 2.0)), words)


def tied(kind: str, name: str = "CONTACT_TIED_SURFACE_TO_SURFACE_OFFSET") -> str:
    """A deck with a tied contact between its two parts."""

    def joint(deck: Foreign, lower: list[int], upper: list[int]) -> None:
        deck.put(name, sides(kind)(deck, lower, upper), (None,), (None,))

    return stacked(joint)[0]


@pytest.mark.parametrize("kind", SIDES)
def test_tied_parts_share_their_points(kind: str, tmp_path: Path) -> None:
    deck, _ = translated(tmp_path, tied(kind))
    assert "INTERFACE_COHESIVE" not in deck
    whole = standard()[0].text()
    assert (
        plain(deck).split("*NODE")[0].split("*IMPACTOR")[0]
        == plain(translated(tmp_path, whole)[0]).split("*NODE")[0].split("*IMPACTOR")[0]
    )


@pytest.mark.parametrize(
    "name",
    [
        "CONTACT_TIED_SURFACE_TO_SURFACE",
        "CONTACT_TIED_NODES_TO_SURFACE_OFFSET",
        "CONTACT_TIED_SHELL_EDGE_TO_SURFACE_CONSTRAINED_OFFSET",
        "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIED",
        "CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_MORTAR_TIED",
        "CONTACT_TIED_SURFACE_TO_SURFACE_MPP",
    ],
)
def test_tied_by_any_name(name: str, tmp_path: Path) -> None:
    text = tied("parts", name)
    text = text.replace(
        "*CONTACT_TIED_SURFACE_TO_SURFACE_MPP\n", "*CONTACT_TIED_SURFACE_TO_SURFACE_MPP\n0,200\n"
    )
    same(tmp_path, text, tied("parts"))


def test_a_bond_of_a_part_of_a_face_and_one_of_nothing_are_refused(tmp_path: Path) -> None:
    text = tied("segments")
    at = text.index("*SET_SEGMENT")
    lines = text[at:].splitlines()
    cut = text[:at] + "\n".join(lines[:2] + lines[10:])
    refused(tmp_path, cut, "SSID: it joins 56 of 64 faces")
    lonely = tied("parts").replace(
        "         1         2         3         3", "         1         1         3         3"
    )
    said = refused(tmp_path, lonely, "SSID MSID: joins no two neighbours of the stack of plies")
    line = lonely[: lonely.index("*CONTACT_TIED")].count("\n") + 1
    assert f"user.k:{line}: *CONTACT_TIED" in said


def test_a_contact_that_begins_late_and_a_box_are_refused(tmp_path: Path) -> None:
    text = standard()[0].text()
    card = "         1         9         3         3\n       0.2       0.2"
    assert card in text
    late = text.replace(card, card + " " * 40 + "    1.0e-4")
    refused(tmp_path, late, "BT: a contact that begins later is not translated")
    box = text.replace(card, card.replace("3         3\n", "3         3         7\n"))
    refused(tmp_path, box, "SBOXID: a box that cuts a contact is not translated")
    ever = text.replace(card, card + " " * 50 + "    1.0e20")
    same(tmp_path, ever, text)


def layups() -> dict[str, str]:
    """One layup in several forms: a deck for each."""

    def with_part(write: Callable[[Foreign, list[int]], None]) -> str:
        deck = Foreign()
        plate = deck.layer()
        write(deck, plate)
        ball(deck)
        deck.set_of("SET_NODE_LIST", 1, rim(plate))
        deck.put("BOUNDARY_SPC_SET", (1, 0, 1, 1, 1))
        deck.put("INITIAL_VELOCITY_RIGID_BODY", (9, 0, 0, -SPEED))
        control(deck)
        return deck.text()

    def cards(deck: Foreign, plate: list[int]) -> None:
        deck.quads(1, plate)
        composite(deck)
        ply_law(deck)

    def icomp(deck: Foreign, plate: list[int]) -> None:
        deck.quads(1, plate)
        ply_law(deck)
        deck.put("SECTION_SHELL", (1, 2, 0.833, 4, 0, 1.0, 1), (0.5,) * 4, (0.0, 90.0, 90.0, 0.0))
        deck.put("PART", "plate", (1, 1, 1))

    def rule(deck: Foreign, plate: list[int]) -> None:
        deck.quads(1, plate)
        ply_law(deck)
        deck.put("SECTION_SHELL", (1, 2, 0.833, 4, 0, -7.0, 1), (0.5,) * 4, (0.0, 90.0, 90.0, 0.0))
        deck.put(
            "INTEGRATION_SHELL", (7, 4), (-0.75, 0.25), (-0.25, 0.25), (0.25, 0.25), (0.75, 0.25)
        )
        deck.put("PART", "plate", (1, 1, 1))

    def beta(deck: Foreign, plate: list[int]) -> None:
        deck.quads(1, plate, name="ELEMENT_SHELL_BETA", extra=f"{'':>64}{90.0:>16}")
        composite(deck, 1, (-90.0, 0.0, 0.0, -90.0))
        ply_law(deck)

    def thickness(deck: Foreign, plate: list[int]) -> None:
        deck.quads(
            1, plate, name="ELEMENT_SHELL_THICKNESS", extra="".join(f"{0.5:>16}" for _ in range(4))
        )
        deck.put(
            "PART_COMPOSITE",
            "plate",
            (1, 16),
            (1, 0.25, 0.0, 0, 1, 0.25, 90.0),
            (1, 0.25, 90.0, 0, 1, 0.25, 0.0),
        )
        ply_law(deck)

    def offset(deck: Foreign, plate: list[int]) -> None:
        deck.quads(1, plate, name="ELEMENT_SHELL_OFFSET", extra=f"{0.25:>16}")
        deck.put(
            "PART_COMPOSITE_LONG",
            "plate",
            (1, 16, None, 1.0),
            *[(1, 0.125, a) for a in (0.0, 90.0, 90.0, 0.0)],
        )
        ply_law(deck)

    def by_element(deck: Foreign, plate: list[int]) -> None:
        plies = "         1     0.125       0.0                   1     0.125      90.0"
        more = "         1     0.125      90.0                   1     0.125       0.0"
        deck.quads(1, plate, name="ELEMENT_SHELL_COMPOSITE", extra=f"{plies}\n{more}")
        deck.put("PART", "plate", (1, 1, 1))
        deck.put("SECTION_SHELL", (1, 2), (1.0,) * 4)
        ply_law(deck)

    def turned(deck: Foreign, plate: list[int]) -> None:
        deck.quads(1, plate, turned=True)
        composite(deck)
        ply_law(deck)

    def long_card(deck: Foreign, plate: list[int]) -> None:
        deck.quads(1, plate)
        deck.put(
            "PART_COMPOSITE_LONG",
            "plate",
            (1, 16),
            *[(1, 0.125, a) for a in (0.0, 90.0, 90.0, 0.0)],
        )
        ply_law(deck, name="MAT_054")

    forms = (cards, icomp, rule, beta, thickness, offset, by_element, turned, long_card)
    return {form.__name__: with_part(form) for form in forms}


LAYUPS = layups()


@pytest.mark.parametrize("form", LAYUPS)
def test_layups_in_every_form(form: str, tmp_path: Path) -> None:
    own, other = (translated(tmp_path, LAYUPS[name])[0] for name in (form, "cards"))
    if form == "turned":  # the nodes between corners have other numbers
        own, other = (deck.split("*SET_NODE")[0] for deck in (own, other))
    assert plain(own) == plain(other)


def angles(deck: str) -> list[float]:
    """The angles of the plies, from the bottom up."""
    part = deck.split("*PART_COMPOSITE_LONG")[1].split("*")[0].splitlines()[5:]
    return [float(line.split()[2]) for line in part]


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


@pytest.mark.parametrize(
    ("extra", "words"),
    [
        (f"{'':>64}{30.0:>16}", "BETA: 30 at element 1, 90 elsewhere"),
        (f"{'':>64}{30.0:>16}", "one for a part is needed"),
    ],
)
def test_angles_that_differ_in_a_part_are_told(extra: str, words: str, tmp_path: Path) -> None:
    text = LAYUPS["beta"]
    one = f"{'':>64}{90.0:>16}"
    head, _, tail = text.rpartition(one)
    refused(tmp_path, head + extra + tail, words.replace("element 1,", "element 64,"))


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
    other = both.replace(twin, twin.replace("      90.0", "      45.0"))
    refused(tmp_path, other, "lies beside part", "and has other plies")


def test_several_parts_below_one_keyword(tmp_path: Path) -> None:
    text = LAYUPS["icomp"]
    part = "*PART\nplate\n         1         1         1\n"
    assert part in text
    two = text.replace(part, part + "spare\n         7         1         1\n")
    new, notes = translated(tmp_path, two)
    assert new == translated(tmp_path, text)[0]
    assert any(note.startswith("part 7 of line") and "has no elements" in note for note in notes)


def test_text_behind_the_columns_ends_of_lines_and_letters(tmp_path: Path) -> None:
    text = standard()[0].text()
    lines = text.splitlines()
    remarked = "\n".join(
        line if line[:1] in "*" or not line else f"{line:<80}  a remark, with 1 number"
        for line in lines
        if line not in ("plate", "ball")
    )
    titles = remarked.replace("*PART_COMPOSITE\n", "*PART_COMPOSITE\nplate\n")
    titles = titles.replace("*PART_INERTIA\n", "*PART_INERTIA\nball\n")
    cut = "\n".join(line[:80] if "," in line else line for line in titles.splitlines())
    same(tmp_path, cut.replace("  a remark, with", "  a remark with"), text)
    same(tmp_path, text.replace("\n", "\r\n").encode(), text)
    same(tmp_path, text.lower().encode(), text)
    same(tmp_path, text.replace("plate", "Plättchen 45°").encode("latin-1"), text)


def test_cards_that_others_tools_write(tmp_path: Path) -> None:
    text = standard()[0].text()
    saved = text.replace(
        "*SET_NODE_LIST\n         1\n",
        "*SET_NODE_LIST\n         1       0.0       0.0       0.0       0.0MECH      1         \n",
    )
    assert saved != text
    plot = "*DATABASE_BINARY_D3PLOT\n    0.0001         0         0         0         0\n"
    more = "         0       0.0       0.0       0.0         0         0\n"
    for each in (
        "*CONTROL_SHELL\n 20.0,0,-1,0,2,2,1\n",
        "*CONTROL_HOURGLASS\n1,0.1\n",
        "*HOURGLASS\n1,4\n",
    ):
        saved = saved.replace("*END", each + "*END")
    whole = saved.replace("*END", plot + more + "*END")
    same(tmp_path, whole, text.replace("*END", plot + "*END"))


@pytest.mark.parametrize(
    "names",
    [
        f"*PARAMETER\n{'R side':10}{90.0:>10}{'R none':10}{0.0:>10}\n",
        f"*PARAMETER_LOCAL\n{'R side':10}{90.0:>10}\n",
        "*PARAMETER_EXPRESSION\nR half            45.0\nR side      half*2\n",
        "*PARAMETER_EXPRESSION_LOCAL\nRside     &half*2\n".replace("&half", "sqrt(2025.0)"),
        "*PARAMETER_EXPRESSION\nR side,max(90.0, 2.0**3) + (1.0 -\n          1.0)\n",
        "*PARAMETER\nI n,2\n*PARAMETER_EXPRESSION\nR side    45*n^1\n",
    ],
)
def test_parameters_in_every_form(names: str, tmp_path: Path) -> None:
    text = standard()[0].text()
    named = text.replace("      90.0", "     &side", 1).replace("*KEYWORD\n", f"*KEYWORD\n{names}")
    same(tmp_path, named, text)
    same(tmp_path, text.replace("      90.0", "<45.0*2.0>", 1), text)


def test_a_parameter_of_an_included_file_stays_there(tmp_path: Path) -> None:
    text = standard()[0].text()
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "part.k").write_text("*PARAMETER_LOCAL\nR x,1.0\n*PARAMETER\nR side,90.0\n")
    include = "*INCLUDE_PATH_RELATIVE\nsub\n*INCLUDE\npart.k\n"
    named = text.replace("      90.0", "     &side", 1).replace(
        "*KEYWORD\n", f"*KEYWORD\n{include}"
    )
    same(tmp_path, named, text)
    refused(tmp_path, named.replace("&side", "   &x"), "B2: there is no parameter 'x'")


def test_all_obstacles_are_told_at_once(tmp_path: Path) -> None:
    text = standard()[0].text()
    bad = text.replace("      90.0", "      9O.0", 1)
    bad = bad.replace("*BOUNDARY_SPC_SET\n         1", "*BOUNDARY_SPC_SET\n         4")
    bad = bad.replace("*END", "*ELEMENT_BEAM\n1,1,1,2\n*LOAD_BLAST\n1,2\n*END")
    refused(
        tmp_path,
        bad,
        "B2: '9O.0' was given, a number is needed",
        "NSID: there is no set of nodes 4",
        "*ELEMENT_BEAM: these elements are not translated",
        "*LOAD_BLAST: this load is not translated",
    )


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


def with_more(text: str) -> str:
    """The plain deck with more keywords."""
    return standard()[0].text().replace("*END", f"{text}*END")


def test_a_motion_wins_over_a_support_of_the_same_points(tmp_path: Path) -> None:
    motion = "*DEFINE_CURVE\n7\n0,0\n1,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n1,1,2,7,0.1\n"
    deck, notes = translated(tmp_path, with_more(motion))
    assert any("64 points that it holds along x have a prescribed motion" in n for n in notes)
    held = re.search(r"\*BOUNDARY_SPC_SET\n\$.*\n(.*)", deck)
    assert held and held[1].split()[2:5] == ["0", "1", "1"]
    twice = "*BOUNDARY_SPC_NODE\n1,0,1,1,1\n"
    same(tmp_path, with_more(twice), standard()[0].text())


def test_loads_are_taken(tmp_path: Path) -> None:
    curve = "*DEFINE_CURVE\n7\n0,1\n1,1\n"
    loads = (
        "*LOAD_BODY_Z\n7,9810.0\n*LOAD_NODE_POINT\n41,3,7,-5.0\n"
        "*SET_SHELL_LIST\n3\n1,2\n*LOAD_SHELL_SET\n3,7,0.1\n"
    )
    deck, _ = translated(tmp_path, with_more(curve + loads + "*LOAD_SEGMENT\n7,0.2,,1,10,11,2\n"))
    rows = {
        name: deck.split(f"*{name}\n")[1].splitlines()[1].split()
        for name in ("LOAD_BODY_Z", "LOAD_NODE_POINT")
    }
    assert [float(word) for word in rows["LOAD_BODY_Z"]] == [7.0, 9810.0]
    assert [float(word) for word in rows["LOAD_NODE_POINT"]] == [41.0, 3.0, 7.0, -5.0]
    pressed = re.findall(r"\*LOAD_FACE_PRESSURE\n\$.*\n(.*)", deck)
    # the segment runs clockwise from above: its pressure acts upwards
    assert [float(row.split()[3]) for row in pressed] == [0.1, -0.2]
    # the frame accelerates upwards: the weight of the impactor is downwards
    assert deck.split("*IMPACTOR_SPHERE")[1].splitlines()[5].split()[4] == "-9810.0"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("*MAT_ADD_EROSION\n1\n", "*MAT_ADD_EROSION: plies of plydyn fail by their own law"),
        (
            "*LOAD_NODE_POINT\n100,3,7,1.0\n*DEFINE_CURVE\n7\n0,0\n1,1\n",
            "node 100 is not of the plate",
        ),
        ("*LOAD_SHELL_SET\n9,7,1.0\n", "there is no set of shells 9"),
        ("*LOAD_BODY_Z\n8\n", "there is no *DEFINE_CURVE 8"),
        ("*CONSTRAINED_NODAL_RIGID_BODY\n1,0,1\n", "this constraint is not translated"),
        ("*RIGIDWALL_PLANAR_MOVING\n0\n0,0,-5,0,0,-4\n1,2\n", "rigid wall is not translated"),
        ("*BOUNDARY_PRESCRIBED_MOTION_SET\n1,5,2,7\n", "DOF 5 with VAD 2"),
        ("*INITIAL_STRESS_SHELL\n1\n", "this initial state is not translated"),
        ("*FANCY_NEW\n1\n", "*FANCY_NEW: this keyword is not translated"),
    ],
)
def test_what_changes_the_result_is_never_lost_in_silence(
    text: str, words: str, tmp_path: Path
) -> None:
    deck = with_more(text)
    said = refused(tmp_path, deck, words)
    line = deck[: deck.index(text)].count("\n") + 1
    assert any(f"user.k:{line + step}: *" in said for step in range(3))


def test_a_blank_last_card_below_a_title_is_a_card(tmp_path: Path) -> None:
    titled = standard()[0].text().replace("*MAT_RIGID\n", "*MAT_RIGID_TITLE\nsteel\n")
    same(tmp_path, titled, standard()[0].text())


@pytest.mark.parametrize("text", [LAYUPS["icomp"], tied("parts"), tiebreak("parts")])
def test_a_deck_that_a_library_of_ansys_has_written_is_the_same(text: str, tmp_path: Path) -> None:
    """The library keeps the first card of plies of a part only; these decks have one at most."""
    deck = Deck()
    deck.loads(text)
    same(tmp_path, deck.write(), text)


def test_a_long_run_offers_the_implicit_thickness(tmp_path: Path) -> None:
    text = standard()[0].text()
    long = text.replace("*CONTROL_TERMINATION\n    0.0005", "*CONTROL_TERMINATION\n     0.005")
    # a wave crosses 0.125 mm in 0.125/sqrt(10300/1.6e-9) s = 4.9e-8 s; 0.3 of it is a step
    assert any("about 3e+05 steps" in n and "IMPL 2" in n for n in translated(tmp_path, long)[1])
    assert not any("IMPL 2" in n for n in translated(tmp_path, text)[1])


def test_units_are_found_from_the_plies_alone(tmp_path: Path) -> None:
    """The density of a rigid body is often one that gives it its mass."""
    heavy = standard()[0].text().replace("   7.8e-09", "   6.8e-03")
    _, notes = translated(tmp_path, heavy)
    assert any(note.startswith("units mm-s-t, found from the densities") for note in notes)
    named = heavy.replace("*END", "*CONTROL_UNITS\n        mm       sec  mtrc_ton\n*END")
    assert (
        "*CONTROL_UNITS\n$#  length      time      mass\n        mm         s         t"
        in (translated(tmp_path, named)[0])
    )
    refused(tmp_path, named.replace("mtrc_ton", "   stone"), "'stone' is no unit of mass")
