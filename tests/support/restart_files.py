"""Restart files whose numbers are changed on purpose."""

from __future__ import annotations

from pathlib import Path

import h5py


def change(dump: Path, array: str, places: int | slice, value: float) -> None:
    """Put a value into an array of a restart file, as if it had been written so."""
    with h5py.File(dump, "r+") as file:
        assert file[array].fletcher32
        file[array][places] = value
