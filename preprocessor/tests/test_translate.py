"""Decks of LS-DYNA: what they become, and what the page tells."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from deck_cards import cards_of, split_columns
from foreign_decks import translate
from programs import plydyn_pre, run_deck, solve
from user_decks import Layout, cohesive, composite, thick

from plydyn_pre.errors import PreError
from plydyn_pre.keywords import keywords
from plydyn_pre.library import find_card
from plydyn_pre.library_text import as_lsdyna
from plydyn_pre.translate import Choices
from plydyn_pre.translate.block import raw_table
from plydyn_pre.translate.schema import table
from plydyn_pre.translate.table_text import table_lines

DECKS = {"composite": composite, "cohesive": cohesive, "thick": thick}
LAYOUTS: tuple[Layout, ...] = ("fixed", "comma", "long")
LIKE = "HTS40/977-2"


def translated(
    folder: Path, text: str, like: str = LIKE, allow_lost: bool = False
) -> tuple[str, str]:
    """The deck and the page of a deck."""
    (folder / "user.k").write_text(text, encoding="utf-8")
    lines, page, _ = translate(
        folder / "user.k", folder / "job.k", Choices(like, allow_lost=allow_lost)
    )
    return "\n".join(lines) + "\n", page


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("name", DECKS)
def test_a_deck_is_the_same_in_every_layout(name: str, layout: Layout, tmp_path: Path) -> None:
    own, _ = translated(tmp_path, DECKS[name]())
    assert translated(tmp_path, DECKS[name](layout))[0] == own


@pytest.mark.parametrize("name", DECKS)
def test_a_translated_deck_runs_to_its_end(name: str, solver: str, tmp_path: Path) -> None:
    (tmp_path / "user.k").write_text(DECKS[name](), encoding="utf-8")
    result = plydyn_pre(tmp_path, "translate", "user.k", "--like", LIKE)
    assert result.returncode == 0, result.stderr
    assert (tmp_path / "user_plydyn.md").is_file()
    assert "normal end" in run_deck(solver, tmp_path, "user_plydyn.k")
    history = (tmp_path / "user_plydyn.impactor_1.csv").read_text().splitlines()
    forces = [float(line.split(",")[1]) for line in history[1:]]
    # the gap of 0.01 mm is closed at 2 m/s after 5 us
    assert max(forces) > 1.0 and forces[3] == 0.0


def test_a_composite_keeps_its_plies_turned_by_the_axes_of_its_material(tmp_path: Path) -> None:
    cards = cards_of(translated(tmp_path, composite())[0])
    plies = [line.split() for line in cards["PART_COMPOSITE_LONG"][2:]]
    assert [float(ply[1]) for ply in plies] == [0.25] * 4
    # the axis a of the material is along y
    assert [float(ply[2]) for ply in plies] == [-45.0, 45.0, 0.0, 90.0]
    assert "INTERFACE_COHESIVE" not in cards


def test_minor_ratios_become_major_ones_and_strengths_are_kept(tmp_path: Path) -> None:
    cards = cards_of(translated(tmp_path, composite())[0])["MAT_PLY_CODAM2_TITLE+"]
    rows = [[float(word) for word in line.split()] for line in cards[1:5]]
    elastic = [1, 1.6e-9, 153000, 10300, 10300, 0.0202 * 153000 / 10300]
    assert rows[0] == pytest.approx([*elastic, elastic[-1], 0.4], rel=1e-12)
    assert rows[1] == [6000, 6000, 3700]
    assert rows[2][:5] == [2537, 1580, 82, 236, 90]
    assert rows[3][:4] == [91.6, 79.9, 0.22, 1.1]


def test_strengths_without_toughnesses_are_refused_or_noted_at_the_top(tmp_path: Path) -> None:
    with pytest.raises(PreError, match=r"so that the strengths are lost and the ply elastic"):
        translated(tmp_path, composite(), like="")
    deck, page = translated(tmp_path, composite(), like="", allow_lost=True)
    assert "*MAT_PLY_ELASTIC" in deck and "*MAT_PLY_CODAM2" not in deck
    first = page.split("## What to look at")[1].split("##")[0]
    assert "LOST: " in first and "--like NAME takes them from a ply of the library" in first
    assert re.search(r"\| XT \| 2537 \| lost: its card has no fracture energy", page)


def test_what_stands_in_and_what_cannot_fail_is_told_first(tmp_path: Path) -> None:
    (tmp_path / "user.k").write_text(composite(), encoding="utf-8")
    _, _, notes = translate(tmp_path / "user.k", tmp_path / "job.k", Choices(LIKE))
    assert any(f"are those of {LIKE} of the library" in note for note in notes)
    assert any(note.startswith("no delamination") for note in notes)
    (tmp_path / "user.k").write_text(cohesive(), encoding="utf-8")
    _, _, notes = translate(tmp_path / "user.k", tmp_path / "job.k", Choices(LIKE))
    assert not any(note.startswith("no delamination") for note in notes)


def test_a_card_that_is_missing_is_told_by_its_fields(tmp_path: Path) -> None:
    with pytest.raises(PreError) as caught:
        translated(tmp_path, "*KEYWORD\n*PART\nplate\n*END\n")
    words = "user.k:2: *PART: card 2 is missing: PID SECID MID EOSID HGID GRAV ADPOPT TMID"
    assert words in str(caught.value)


def test_cohesive_bricks_between_shells_are_interfaces(tmp_path: Path) -> None:
    cards = cards_of(translated(tmp_path, cohesive())[0])
    assert len(cards["PART_COMPOSITE_LONG"]) == 2 + 3
    rows = [line.split()[:4] for line in cards["INTERFACE_COHESIVE"]]
    assert rows == [["1", "1", "1", "2"], ["1", "2", "2", "2"]]
    law = cards["MAT_COHESIVE_MIXED_MODE_TITLE"]
    first, second = ([float(word) for word in line.split()] for line in law[1:3])
    assert first[4:] == [1e6, 5e5, 0.28, 0.79]
    assert second[:3] == [-1.634, 62.3, 92.3]
    # toughnesses of MAT_262 are its own: fibres and matrix, in tension and compression
    codam = cards["MAT_PLY_CODAM2_TITLE+"]
    assert [float(word) for word in codam[4].split()[:4]] == [91.6, 79.9, 0.22, 1.1]
    # shells of 0.5 at 0, 0.5 and 1: from -0.25 to 1.25, the middle at 0.5
    heights = {line[40:56].strip() for line in cards["NODE"]}
    assert heights == {"0.5"}


def test_a_tiebreak_between_thick_shells_is_an_interface(tmp_path: Path) -> None:
    cards = cards_of(translated(tmp_path, thick())[0])
    assert [line.split()[:4] for line in cards["INTERFACE_COHESIVE"]] == [["1", "2", "2", "2"]]
    law = cards["MAT_COHESIVE_MIXED_MODE_TITLE"]
    assert [float(word) for word in law[1].split()[4:]] == [1e6, 5e5, 0.28, 0.79]


@pytest.mark.parametrize(("make", "top"), [(composite, 0.5), (cohesive, 1.25), (thick, 1.0)])
def test_a_meshed_ball_is_a_sphere(make: Callable[[], str], top: float, tmp_path: Path) -> None:
    text = translated(tmp_path, make())[0]
    _, place, motion = cards_of(text)["IMPACTOR_SPHERE_TITLE"]
    radius, mass, x, y, z = (float(word) for word in split_columns(place, 10)[1:6])
    assert (radius, mass, x, y) == (6.0, 2.0e-4, 10.0, 10.0)
    assert z == pytest.approx(top + 0.01 + 6.0, abs=1e-5)
    assert motion.split()[:4] == ["0.0", "0.0", "-2000.0", "1"]


def test_friction_of_the_contact_is_that_of_the_impactor(tmp_path: Path) -> None:
    text, page = translated(tmp_path, composite())
    assert [float(word) for word in cards_of(text)["CONTACT_IMPACTOR"][1].split()] == [0.3, 0.3, 0]
    assert "friction of the impactor" in page
    table = composite().replace("0.3,0.3,", "2.0,0.3,").replace("0.3       0.3", "2.0       0.3")
    assert table != composite()
    with pytest.raises(PreError, match=r"FS FD DC: a table, the friction of parts"):
        translated(tmp_path, table)
    lost, page = translated(tmp_path, table, allow_lost=True)
    assert len(cards_of(lost)["CONTACT_IMPACTOR"]) == 1
    assert "a table, the friction of parts" in page


def test_negative_mass_scaling_is_taken(tmp_path: Path) -> None:
    """A positive one would take mass from most elements, and is lost."""
    text, page = translated(tmp_path, composite("comma"))
    step = [float(word) for word in cards_of(text)["CONTROL_TIMESTEP"][0].split()]
    assert step == [0.0, 0.0, 0.0, 0.0, -1.0e-7]
    assert "look at Mass scaling in the listing" in page
    assert re.search(r"\| DT2MS \| -1e-07 \| taken", page)
    positive = composite("comma").replace("-1e-07", "1e-07")
    assert positive != composite("comma")
    text, page = translated(tmp_path, positive)
    assert "CONTROL_TIMESTEP" not in cards_of(text)
    assert re.search(r"\| DT2MS \| 1e-07 \| no effect here: elements with a larger step", page)


@pytest.mark.parametrize(("theirs", "own"), [("0.9", 0.0), ("0.67", 0.67)])
def test_a_share_of_the_step_is_taken_below_the_usual_one(
    theirs: str, own: float, tmp_path: Path
) -> None:
    deck = composite("comma").replace(",0.9,", f",{theirs},")
    assert f",{theirs}," in deck
    text, page = translated(tmp_path, deck)
    assert float(cards_of(text)["CONTROL_TIMESTEP"][0].split()[1]) == own
    assert ("waves need room" in page) == (own == 0.0)


def test_quads_are_raised_and_edges_held_with_their_mid_sides(tmp_path: Path) -> None:
    cards = cards_of(translated(tmp_path, composite())[0])
    assert len(cards["NODE"]) == (2 * 4 + 1) ** 2
    assert len(cards["ELEMENT_PLATE_Q9"]) == 2 * 16
    held = [word for line in cards["SET_NODE_LIST_TITLE"][2:] for word in line.split()]
    assert len(set(held)) == 8 * 4


@pytest.mark.parametrize("name", DECKS)
def test_every_keyword_and_every_filled_field_is_on_the_page(name: str, tmp_path: Path) -> None:
    text = DECKS[name]("comma")
    _, page = translated(tmp_path, text)
    parts = page.split("### ")[1:]
    names = [line[1:] for line in text.splitlines() if line.startswith("*")]
    names = [each for each in names if not each.startswith(("KEYWORD", "END"))]
    assert [part.split(",")[0][1:] for part in parts] == names
    blocks = re.split(r"^\*.*\n", text, flags=re.M)[2:-1]
    for keyword, part, block in zip(names, parts, blocks, strict=True):
        lines = [line for line in block.splitlines() if not line.startswith("$")]
        rows = re.findall(
            r"^\| (?!field|---)(.*?) \| (.*?) \| (taken|replaced|no effect here|lost)", part, re.M
        )
        titled = keyword in ("TITLE",) or keyword.endswith(("_ID", "_TITLE"))
        if keyword.startswith(("NODE", "ELEMENT", "SET", "PART")) or titled:
            assert rows
            continue
        filled = sum(bool(word.strip()) for line in lines for word in line.split(","))
        assert len(rows) == filled, keyword


def test_a_load_that_is_not_translated_is_refused_or_noted_at_the_top(tmp_path: Path) -> None:
    extra = "*LOAD_THERMAL_CONSTANT\n         1      23.5\n*END"
    text = composite().replace("*END", extra)
    line = text[: text.index("*LOAD_THERMAL")].count("\n") + 1
    with pytest.raises(PreError) as caught:
        translated(tmp_path, text)
    said = f"user.k:{line}: *LOAD_THERMAL_CONSTANT: this load is not translated"
    assert said in str(caught.value) and "--allow-lost makes it a note" in str(caught.value)
    _, page = translated(tmp_path, text, allow_lost=True)
    assert said in page.split("## What to look at")[1].split("##")[0]
    part = page.split("### *LOAD_THERMAL_CONSTANT")[1]
    assert "| card 1 field 2 | 23.5 | lost: this load is not translated |" in part
    # what is wrong beside it is no loss, and nothing is advised that was done
    with pytest.raises(PreError) as caught:
        translated(tmp_path, text.replace("*END", "*LOAD_SHELL_SET\n       999"), allow_lost=True)
    assert str(caught.value).endswith("*LOAD_SHELL_SET ESID: there is no set of shells 999")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("1,0.5,90.0", "1,0.5,9O.0", "B1: '9O.0' was given, a number is needed"),
        ("1,0.5,90.0", "1,-0.5,90.0", "THICK1: -0.5 must be above zero"),
        ("1,0.5,90.0", "9,0.5,90.0", "MID1: a ply of part 2 is of material 9, which is not there"),
        ("1.0,4.0,7.0", "1.0,4.0,7.0,1,1", "'1' is a field too many"),
        ("2e-05,,,,", "", "ENDTIM: missing; a value is needed"),
        ("2e-05,,,,", "-1.0", "ENDTIM: -1 was given, a number above zero is needed"),
        ("7,0,1,1,1,1,1,1", "8,0,1,1,1,1,1,1", "NSID: there is no set of nodes 8"),
        ("7,0,1,1,1,1,1,1", "7,3,1,1,1,1,1,1", "CID: there is no *DEFINE_COORDINATE_SYSTEM 3"),
        ("7,0,1,1,1,1,1,1", "7,0,1.5,1,1,1,1,1", "DOFX: '1.5' was given, a whole number"),
        ("1,1,1,2,7,6", "1,1,1,2,7,999999", "N4: there is no node 999999"),
        ("1,1,1,2,7,6", "1,1,1,2,3,4", "N1: element 1 has no area"),
        ("1,1,1,2,7,6", "1,1,1,2,7,7", "N4: element 1 is a triangle"),
        ("1,1,1,2,7,6", "1,1,1,2,7,0", "N4: element 1 is a triangle"),
        ("1,0.0,0.0,0.0\n", "1,0.0,0.0,0.5\n", "plates of plydyn are flat"),
        ("1.6e-09,153000.0", "-1.6e-09,153000.0", "RO: -1.6e-09 was given, a number above zero"),
        ("1.6e-09,153000.0", "1.6e-09,&young", "EA: there is no parameter 'young'"),
        ("20,0.0,0.0,-2000.0", "20,0.0,0.0,-2000.0,0,0,0,0,1", "'1' is a field too many"),
        ("1000000.0,500000.0,0.28", "1000000.0,500000.0,0.0001", "as a material of plydyn: GIC"),
        (
            "6000.0,3700.0,6000.0,0.0",
            "6000.0,3700.0,6000.0,-5.0",
            "AOPT: there is no *DEFINE_COORDINATE_SYSTEM 5",
        ),
    ],
)
def test_nonsense_is_told_with_its_line_and_field(
    old: str, new: str, words: str, tmp_path: Path
) -> None:
    text = cohesive("comma")
    assert old in text
    line = text[: text.index(old)].count("\n") + 1
    with pytest.raises(PreError, match=re.escape(words)) as caught:
        translated(tmp_path, text.replace(old, new, 1))
    place = re.match(r".*user\.k:(\d+): \*", str(caught.value))
    # the line itself, or that of the keyword that it is about
    assert place and 0 < int(place[1]) <= max(line, text.count("\n"))


LAWS = {
    "022": "1,1.6e-9,153000,10300,,.02,.02,.4\n6000,3700,6000,0,0\n,,\n,,\n90,2537,82,236,0",
    "055": "1,1.6e-9,153000,10300,,0,0,.4\n6000,3700,6000,0,3\n0\n0,1,0\n0\n1580,2537,236,82,90",
    "219": (
        "1,1.6e-9,153000,10300,,.0202,,.4\n6000,,,1\n,,,1,0,0,2\n,,,0,1,0\n0\n"
        ".008,.0166,.02,,.05,.03,.03\n.023,.0103,.02,,.08,.03,.03"
    ),
    "001": "1,2.7e-9,70000,.3",
}


@pytest.mark.parametrize("law", LAWS)
def test_other_laws_of_plies_are_accepted_by_the_solver(
    law: str, solver: str, tmp_path: Path
) -> None:
    text = composite("comma")
    start = text.index("*MAT_054")
    text = f"{text[:start]}*MAT_{law}\n{LAWS[law]}\n{text[text.index('*NODE', start) :]}"
    deck, _ = translated(tmp_path, text)
    plies = [line.split() for line in cards_of(deck)["PART_COMPOSITE_LONG"][2:]]
    # axes along x: of the elements (022), v x n (055), a (219)
    assert [float(ply[2]) for ply in plies] == [45.0, -45.0, 90.0, 0.0]
    (tmp_path / "job.k").write_text(deck, encoding="utf-8")
    solve(solver, tmp_path, "check", "job.k")


def test_the_rate_dependent_bond_keeps_its_static_numbers(tmp_path: Path) -> None:
    text = cohesive("comma")
    start, end = text.index("*MAT_COHESIVE"), text.index("*MAT_262")
    bond = "*MAT_240\n11,1e-9,0,1,4000,2000,.004\n.28,,,62.3,,,\n.79,,,92.3,,,\n"
    deck, page = translated(tmp_path, text[:start] + bond + text[end:])
    law = cards_of(deck)["MAT_COHESIVE_MIXED_MODE_TITLE"]
    # moduli over the thickness of the layer
    assert [float(word) for word in law[1].split()[4:]] == [1e6, 5e5, 0.28, 0.79]
    assert [float(word) for word in law[2].split()[:3]] == [1.0, 62.3, 92.3]
    assert "| THICK | 0.004 | replaced: over THICK, the stiffness of the interface |" in page


def test_nonsense_is_an_exit_code_and_no_input_is_replaced(tmp_path: Path) -> None:
    def said(text: str, *words: str) -> str:
        (tmp_path / "user.k").write_text(text, encoding="utf-8")
        result = plydyn_pre(tmp_path, "translate", "user.k", *words)
        assert result.returncode == 2, result.stdout
        assert "Traceback" not in result.stderr
        assert [path.name for path in tmp_path.iterdir()] == ["user.k"]
        return result.stderr

    assert "user.k:1: *KEYWORD: missing" in said("no deck\n")
    assert "no plate; *PART_COMPOSITE" in said("*KEYWORD\n*TITLE\nx\n*END\n")
    assert "give another name" in said(composite(), "-o", "user.k")
    assert "there is no such file" in said("*INCLUDE\nnone.k\n*END\n")
    assert "include each other" in said("*INCLUDE\nuser.k\n*END\n")
    assert "'nothing' is not in the library" in said(composite(), "--like", "nothing")


def test_the_page_of_the_manual_is_the_table_of_the_translation() -> None:
    page = Path(__file__).parents[2] / "manual" / "foreign.md"
    assert page.read_text(encoding="utf-8") == "\n".join(table_lines()) + "\n"


def test_no_card_of_the_solver_is_written_down_twice() -> None:
    """The translator reads them as the solver has printed them."""
    raw = raw_table("lsdyna.toml")
    shared = [name for name in raw if name in keywords()]
    assert len(shared) > 40
    assert [name for name in shared if "cards" in raw[name]] == []


def test_no_entry_of_the_table_is_left_without_a_reason() -> None:
    for name, entry in table().items():
        assert entry.cards is not None or entry.words, name
        assert entry.fate == "taken" or entry.words, name


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("#RADIOSS STARTER\n/BEGIN\nplate\n", "a deck of Radioss"),
        ("/PREP7\nET,1,SHELL181\n", "a deck of Ansys"),
        ("[impactor]\nradius = 8.0\n", "a recipe of plydyn-pre"),
        ("$MeshFormat\n4.1 0 8\n", "a mesh of gmsh"),
        ("    -1\n  2411\n         1\n", r"a universal file \(.unv\)"),
        ("# vtk DataFile Version 3.0\n", "a mesh of VTK"),
        ("\x89HDF\r\n\x1a\n", "a file of HDF5, as .med is"),
    ],
)
def test_decks_of_other_programs_are_refused_by_name(text: str, name: str, tmp_path: Path) -> None:
    with pytest.raises(PreError, match=f"this is {name}; decks of LS-DYNA, Abaqus and Nastran"):
        translated(tmp_path, text)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("user.k", "*KEYWORD\n*NODE\n1,0,0,0\n*ELEMENT_SHELL\n1,1,1,1,1,1\n*END\n"),
        ("user.inp", "*Heading\nmesh\n*Node\n1,0.,0.,0.\n*Element, type=S4R\n1,1,1,1,1\n"),
        ("user.bdf", "BEGIN BULK\nGRID,1,,0.,0.,0.\nCQUAD4,1,1,1,1,1,1\nENDDATA\n"),
    ],
)
def test_a_mesh_alone_is_sent_to_a_recipe(name: str, text: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text, encoding="utf-8")
    words = r"no material; a file that is a mesh alone can be that of a recipe"
    with pytest.raises(PreError, match=words):
        translate(tmp_path / name, tmp_path / "job.k")


@pytest.mark.parametrize("law", ["054", "261"])
def test_cards_of_a_material_of_the_library_come_back_as_it_is(law: str, tmp_path: Path) -> None:
    lines = "\n".join(as_lsdyna(find_card(LIKE)))
    cards = re.split(r"(?m)^(?=\*MAT)", lines)[1:]
    assert cards[0].startswith("*MAT_ENHANCED") and cards[1].startswith("*MAT_LAMINATED")
    card = cards[0] if law == "054" else re.sub(r"(?m)^( +)2(?= +1\.\d*e-09)", r"\g<1>1", cards[1])
    text = composite()
    start = text.index("*MAT_054")
    text = text[:start] + card.strip() + "\n" + text[text.index("*NODE", start) :]
    cards_of_deck = cards_of(translated(tmp_path, text, LIKE)[0])
    codam = next(rows for name, rows in cards_of_deck.items() if name.startswith("MAT_PLY_CODAM2"))
    values = find_card(LIKE).values
    rows = [[float(word) for word in line.split()] for line in codam[1:5]]
    for row, keys in (
        (rows[0][2:], "E1 E2 E3 nu12 nu13 nu23"),
        (rows[1], "G12 G13 G23"),
        (rows[2][:5], "XT XC YT YC SL"),
        (rows[3][:4], "G1T G1C G2T G2C"),
    ):
        assert row == pytest.approx([float(values[key].value) for key in keys.split()], rel=1e-9)
