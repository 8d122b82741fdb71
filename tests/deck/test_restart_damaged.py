"""One wrong bit in a restart file is found, wherever it is."""

from __future__ import annotations

from pathlib import Path

import h5py
import pytest

from broken import CYCLES, impact, said

NORMAL, INPUT = 0, 2


@pytest.fixture(scope="module")
def dump(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A restart file, beside the results that belong to it."""
    folder = tmp_path_factory.mktemp("damaged")
    deck = impact(1, "springs", failing=True, end=1.0e-5)
    deck.add("DATABASE_BINARY_D3DUMP", (CYCLES,))
    code, text = said("run", deck.write(folder / "job.k"), "-o", folder)
    assert code == NORMAL, text
    return folder / "job.dump01"


def chunks(dump: Path) -> dict[str, tuple[int, int]]:
    """Where the first chunk of each dataset begins, and how many bytes it has."""
    found: dict[str, tuple[int, int]] = {}

    def note(name: str, one: h5py.Dataset | h5py.Group) -> None:
        if isinstance(one, h5py.Dataset) and one.size > 0:
            assert one.fletcher32
            chunk = one.id.get_chunk_info(0)
            found[name] = (chunk.byte_offset, chunk.size)

    with h5py.File(dump) as file:
        file.visititems(note)
    return found


def damaged(dump: Path, whole: bytes, place: int, bit: int) -> tuple[int, str]:
    """Exit code and words of a restart from a file with one wrong bit."""
    wrong = bytearray(whole)
    wrong[place] ^= 1 << bit
    dump.write_bytes(wrong)
    try:
        return said("restart", dump)
    finally:
        dump.write_bytes(whole)


def test_a_wrong_bit_is_found(dump: Path) -> None:
    """In the first byte of every dataset, in the last and in the middle."""
    whole = dump.read_bytes()
    datasets = chunks(dump)
    assert {"state/displacement", "state/history", "state/clock", "run/places"} <= datasets.keys()
    for number, (name, (start, length)) in enumerate(datasets.items()):
        for place in (start, start + length // 2, start + length - 1):
            code, text = damaged(dump, whole, place, number % 8)
            assert code == INPUT, (name, text)
            assert "job.dump01 is damaged" in text
            if name.startswith("state/"):
                assert f"the {name.removeprefix('state/')} is not what was written" in text
    code, text = said("restart", dump)
    assert code == NORMAL, text


def test_a_wrong_bit_in_an_attribute_is_found(dump: Path) -> None:
    """The count of kept files, the version, the name of the job and the path of the deck too."""
    whole = dump.read_bytes()
    with h5py.File(dump) as file:
        attributes = file["run"].attrs
        dumps = int(attributes["dumps"]).to_bytes(8, "little")
        texts = [attributes["kind"], attributes["version"], file["decks/1/1"].attrs["path"]]
    places = [whole.index(bytes(words)) for words in texts]
    for name in (b"job\0", b"dumps\0"):
        places.append(whole.index(name))
    # the value follows its name, type and space
    places.append(whole.index(dumps, places[-1]))
    for place in places:
        code, text = damaged(dump, whole, place, 0)
        assert code == INPUT, (place, text)
    code, text = said("restart", dump)
    assert code == NORMAL, text


@pytest.mark.parametrize("step", [-1, 1])
def test_a_file_of_another_layout_is_refused(dump: Path, step: int) -> None:
    """Its numbers or the defaults of its deck would have another meaning."""
    whole = dump.read_bytes()
    with h5py.File(dump, "r+") as file:
        attributes = file["run"].attrs
        attributes["format"] = attributes["format"] + step
    try:
        code, text = said("restart", dump)
    finally:
        dump.write_bytes(whole)
    assert code == INPUT, text
    assert "it must be read by the version that wrote it" in text
