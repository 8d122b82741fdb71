"""Looking at a run does not change it: the points move in another order where nobody does."""

from __future__ import annotations

import re
from pathlib import Path

import h5py
import numpy as np
import pytest

from broken import KINDS, said
from decks import Deck

EACH_STEP, AT_THE_END = 1.0e-15, 1.0
# one restart file, of the end
NO_CYCLE = 1000000
TABLES = "GLSTAT|SPCFORC|NODOUT|BINARY_D3PLOT"


def looked_at(deck: Deck, interval: float) -> str:
    """The text of a deck with one interval for all that is written of its points."""
    text = re.sub(rf"(\*DATABASE_(?:{TABLES})\n).*", rf"\g<1>{interval},", deck.text())
    return re.sub(r"(\*DATABASE_PROFILE\n.*,)[^,\n]*\n", rf"\g<1>{interval}\n", text)


def last_state(deck: Deck, interval: float, threads: int, folder: Path) -> dict[str, np.ndarray]:
    """The state at the end of a run, and what the impactor felt in each step."""
    folder.mkdir()
    path = folder / "job.k"
    path.write_text(looked_at(deck, interval))
    code, text = said("run", path, "-o", folder, f"ncpu={threads}")
    assert code == 0, text
    rows = (folder / "job.energy.csv").read_text().splitlines()
    assert (len(rows) > 10) == (interval == EACH_STEP)
    with h5py.File(folder / "job.dump01") as file:
        state = {name: values[()] for name, values in file["state"].items()}
    table = (folder / "job.impactor_1.csv").read_bytes()
    return {**state, "table": np.frombuffer(table, dtype=np.uint8)}


@pytest.mark.parametrize("case", KINDS)
def test_same_bits_however_often_one_looks(case: str, tmp_path: Path) -> None:
    """The last state and every line of the impactor; one thread looks often, three rarely."""
    deck = KINDS[case]()
    deck.add("DATABASE_BINARY_D3DUMP", (NO_CYCLE,))
    often = last_state(deck, EACH_STEP, 1, tmp_path / "often")
    rarely = last_state(deck, AT_THE_END, 3, tmp_path / "rarely")
    assert often.keys() == rarely.keys()
    for name, values in often.items():
        assert np.array_equal(values, rarely[name], equal_nan=True), name
