"""Strengths of plies that scatter: one quad fails at its factor times the strength.

The deck is that of `fibre_damage`. A correlation length of 2 km gives all of the quad one factor.
"""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np
import pytest

from broken import said
from runs import ROOT, Results, run_deck
from scatter import FIBRES, MATRIX, ply_factor

DECK = (ROOT / "tests/deck/fibre_damage/deck.k").read_text()
FIRST_SET = "*SET_NODE_LIST\n$#     SID\n         1\n"
SEED, M, LENGTH, MF = 5, 10.0, 2.0e6, 25.0
XT, YT, G1T, G2T, E1 = 2537.0, 82.0, 91.6, 0.22, 153.0e3
WIDTH, AREA = 2.0, 1.0 * 0.25
MIDDLE = (1.0, 0.5)


def scattered(card: str, text: str = DECK) -> str:
    """The deck with a card of *PLY_SCATTER."""
    assert FIRST_SET in text
    return text.replace(FIRST_SET, f"*PLY_SCATTER\n{card}\n{FIRST_SET}")


def run(text: str, folder: Path) -> Results:
    """Results of a deck."""
    path = folder / "deck.k"
    path.write_text(text)
    return run_deck(path, folder, "deck")


def line(results: Results, kind: str) -> list[float]:
    """Modulus, smallest and largest factor that the listing gives."""
    found = re.search(
        rf"  {kind}: modulus of Weibull (\S+), factors (\S+) to (\S+)", results.listing()
    )
    assert found
    return [float(number) for number in found.groups()]


def pulled(results: Results, strain: float) -> float:
    """Largest force along x: work over displacement, which has two speeds."""
    energy = results.table("energy")
    speed = np.where(energy["time"][1:] <= 1.0e-3, strain / 1.0e-3, 0.03 / 0.025 * strain / 1.0e-3)
    return float(np.max(np.diff(energy["external"]) / np.diff(energy["time"]) / (speed * WIDTH)))


def test_fibres_fail_at_their_factor(tmp_path: Path) -> None:
    """Peak force and energy; the tolerance is a line of the histories, 2.5e-5 of strain."""
    factor = ply_factor(SEED, MF, LENGTH, MIDDLE, 1, FIBRES)
    assert abs(factor - 1.0) > 0.01
    results = run(scattered(f"1, {SEED}, 0.0, {LENGTH}, {MF}"), tmp_path)
    assert pulled(results, 0.025) == pytest.approx(factor * XT * AREA, rel=2.5e-5 * E1 / XT)
    spent = results.table("energy")["fibre damage"][-1]
    assert spent == pytest.approx(G1T * AREA, rel=4.0e-7 * E1 / XT)
    assert line(results, "fibres") == pytest.approx([MF, factor, factor], rel=1.0e-3)
    assert "  matrix: modulus" not in results.listing()


def test_matrix_fails_at_its_factor(tmp_path: Path) -> None:
    """Fibres across, and a band of 0.5 mm, in which no mode snaps back."""
    factor = ply_factor(SEED, M, LENGTH, MIDDLE, 1, MATRIX)
    assert abs(factor - 1.0) > 0.01
    band = 0.5
    text = DECK.replace(
        "0.25       0.0         0         0 ", "0.25      90.0         0         0 "
    )
    text = text.replace("0.22       1.1       0.0 ", "0.22       1.1       0.5 ")
    assert text.count("90.0         0") == text.count("1.1       0.5 ") == 1
    results = run(scattered(f"1, {SEED}, {M}, {LENGTH}, {MF}", text), tmp_path)
    onset = factor * YT / 10.3e3
    assert pulled(results, 0.025) == pytest.approx(factor * YT * AREA, rel=2.5e-5 / onset)
    spent = results.table("energy")["matrix damage"][-1]
    # damage begins within a step of 4e-7 of strain
    assert spent == pytest.approx(G2T * AREA * WIDTH / band, rel=4.0e-7 / onset)
    assert line(results, "matrix") == pytest.approx([M, factor, factor], rel=1.0e-3)


@pytest.mark.parametrize(
    ("card", "words"),
    [
        ("9, 1, 10.0, 2.0", "*PLY_SCATTER card 1 MID: ply material 9 is not defined"),
        (
            "1, 1, 1.5, 2.0",
            "*PLY_SCATTER card 1 M: M = 1.5 would scatter the strengths by more than half",
        ),
        ("1, 1, 10.0, 2.0, 1.0", "*PLY_SCATTER card 1 MF: MF = 1 would scatter"),
        ("1, 1, 0.0, 2.0", "*PLY_SCATTER card 1 M: no strength scatters with M and MF of 0"),
        ("1, 1, 10.0, 0.0", "*PLY_SCATTER card 1 LENGTH: LENGTH cannot be 0"),
        ("1, -1, 10.0, 2.0", "*PLY_SCATTER card 1 SEED: SEED cannot be -1"),
        ("1, 1, 10.0, 2.0\n1, 2, 8.0, 2.0", "the strengths of material 1 scatter already"),
    ],
)
def test_wrong_cards_are_refused(card: str, words: str, tmp_path: Path) -> None:
    """File, line and field."""
    path = tmp_path / "deck.k"
    path.write_text(scattered(card))
    code, text = said("check", path)
    assert code == 2
    row = path.read_text().splitlines().index("*PLY_SCATTER") + 2 + card.count("\n")
    assert f"deck.k:{row}: " in text
    assert words in text


def test_other_laws_are_refused(tmp_path: Path) -> None:
    """The strengths of other materials cannot scatter."""
    path = tmp_path / "deck.k"
    elastic = DECK.split("*MAT_PLY_CODAM2_TITLE")[0] + "*MAT_PLY_ELASTIC\n"
    elastic += "1,1.6e-9,153000.,10300.,10300.,0.3,0.3,0.4\n6000.,6000.,3700.\n"
    path.write_text(scattered("1, 1, 10.0, 2.0", elastic + FIRST_SET + DECK.split(FIRST_SET)[1]))
    code, text = said("check", path)
    assert code == 2
    assert "*PLY_SCATTER card 1 MID: the strengths of *MAT_PLY_ELASTIC cannot scatter" in text
    assert "a material of *MAT_PLY_CODAM2" in text


def test_a_material_of_no_ply_has_no_bands(tmp_path: Path) -> None:
    """It is listed without widths, strains and factors, of which there are none."""
    block = DECK[DECK.index("*MAT_PLY_CODAM2_TITLE") :]
    lines = block[: block.index("\n*") + 1].splitlines()
    row = next(k for k, text in enumerate(lines) if text.split()[:2] == ["1", "1.60e-9"])
    lines[row] = lines[row].replace("         1", "         9", 1)
    other = "\n".join(lines) + f"\n*PLY_SCATTER\n9, 1, {M}, 2.0\n"
    path = tmp_path / "deck.k"
    path.write_text(DECK.replace(FIRST_SET, other + FIRST_SET))
    code, text = said("check", path)
    assert code == 0, text
    _, _, after = text.partition("Damage of material 9")
    assert after.partition("Size and mass")[0].split("\n")[3:] == [
        "no ply has this material",
        "",
        "",
    ]
    assert "scatter of the strengths" not in text


def test_a_band_that_is_too_wide_for_the_strongest_point_is_refused(tmp_path: Path) -> None:
    """SNAP 1: fibres in a band of 3.3 mm, which 4.15 mm less the square of the factor allows."""
    factor = ply_factor(SEED, 3.0, LENGTH, MIDDLE, 1, FIBRES)
    longest = 2.0 * E1 * G1T / XT**2 / 1.05
    choices = "         0         0       0.0         0         0         0       0.0         0"
    assert DECK.count(choices) == 1
    text = DECK.replace(choices, "0, 1")
    for share, code in ((0.99, 0), (1.01, 2)):
        # matrix and shear need narrower bands than fibres: let them be tougher
        tough = f"91.6, 400.0, 50.0, 50.0, {share * longest / factor**2}"
        row = next(row for row in text.splitlines() if row.startswith("      91.6"))
        path = tmp_path / "deck.k"
        path.write_text(scattered(f"1, {SEED}, 0.0, {LENGTH}, 3.0", text.replace(row, tough)))
        found, words = said("check", path)
        assert found == code, words
        if code:
            assert "the crack band of fibre tension" in words
            assert "the square of the largest factor of the strength" in words


def test_threads_and_a_restart_have_the_same_bits(tmp_path: Path) -> None:
    """Short correlation, factors of each point, and damage at the restart."""
    text = scattered(f"1, {SEED}, {M}, 0.7, {MF}").replace("2.5e-3         0", "1.6e-3         0")
    text = text.replace("*END", "*DATABASE_BINARY_D3DUMP\n9000\n*END")
    files = []
    for threads in (1, 2):
        folder = tmp_path / str(threads)
        folder.mkdir()
        path = folder / "deck.k"
        path.write_text(text)
        code, words = said("run", path, "-o", folder, f"ncpu={threads}")
        assert code == 0, words
        files.append((folder / "deck.energy.csv").read_bytes())
    assert files[0] == files[1]
    code, words = said("restart", tmp_path / "1" / "deck.dump01")
    assert code == 0, words
    assert (tmp_path / "1" / "deck.energy.csv").read_bytes() == files[0]
    # fibres have begun to break before the restart, and go on
    rows = list(csv.DictReader((tmp_path / "1" / "deck.energy.csv").open()))
    spent = [float(row["fibre damage [mJ]"]) for row in rows]
    cycles = [int(row["cycle [-]"]) for row in rows]
    assert 0.0 < spent[int(np.searchsorted(cycles, 9000))] < 0.9 * spent[-1]
