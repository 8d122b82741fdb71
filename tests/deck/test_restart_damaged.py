"""One wrong bit in the numbers or the decks of a restart file is found, wherever it is."""

from __future__ import annotations

from pathlib import Path

import h5py

from broken import CYCLES, impact, said

NORMAL, INPUT = 0, 2


def places(dump: Path) -> dict[str, tuple[int, int]]:
    """Where each array of a restart file begins, and how many bytes it has."""
    found: dict[str, tuple[int, int]] = {}

    def note(name: str, one: h5py.Dataset | h5py.Group) -> None:
        if isinstance(one, h5py.Dataset) and one.size > 0:
            assert one.chunks is None
            found[name] = (one.id.get_offset(), one.id.get_storage_size())

    with h5py.File(dump) as file:
        file.visititems(note)
    return found


def test_a_wrong_bit_is_found(tmp_path: Path) -> None:
    """In the first byte of every array, in the last and in the middle."""
    deck = impact(1, "springs", failing=True, end=1.0e-5)
    deck.add("DATABASE_BINARY_D3DUMP", (CYCLES,))
    code, text = said("run", deck.write(tmp_path / "job.k"), "-o", tmp_path)
    assert code == NORMAL, text
    dump = tmp_path / "job.dump01"
    whole = dump.read_bytes()
    arrays = places(dump)
    assert {"state/displacement", "state/history", "state/clock", "run/places"} <= arrays.keys()
    for number, (name, (start, length)) in enumerate(arrays.items()):
        for place in (start, start + length // 2, start + length - 1):
            wrong = bytearray(whole)
            wrong[place] ^= 1 << number % 8
            dump.write_bytes(wrong)
            code, text = said("restart", dump)
            assert code == INPUT, (name, text)
            assert "job.dump01 is damaged" in text
            if name.startswith("state/"):
                assert f"the {name.removeprefix('state/')} is not what was written" in text
    dump.write_bytes(whole)
    code, text = said("restart", dump)
    assert code == NORMAL, text
