"""Restart files whose numbers are changed on purpose, with sums that fit."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np

SUM = "check sum"


def check_sum(values: np.ndarray) -> str:
    """Bits turned by the place of their number, from 1; both halves added up, in hexadecimal."""
    bits = values.view(np.uint64) if values.dtype.kind == "f" else values.astype(np.int64)
    bits = bits.astype(np.uint64)
    turn = np.arange(1, len(bits) + 1, dtype=np.uint64) % np.uint64(64)
    turned = (bits << turn) | (bits >> (np.uint64(64) - turn) % np.uint64(64))
    low, high = (turned & np.uint64(0xFFFFFFFF)).sum(), (turned >> np.uint64(32)).sum()
    return f"{int(low):016X}{int(high):016X}"


def change(dump: Path, array: str, places: int | slice, value: float) -> None:
    """Put a value into an array of a restart file, as if it had been written so."""
    with h5py.File(dump, "r+") as file:
        numbers = file[array]
        assert numbers.attrs[SUM].decode() == check_sum(numbers[()])
        numbers[places] = value
        numbers.attrs[SUM] = np.bytes_(check_sum(numbers[()]))
