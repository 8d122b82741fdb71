"""Files that the user names."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from plydyn_pre.errors import OutputError, PreError

_DEEPEST = 20  # files that include each other
_LARGEST = 1 << 30  # bytes of a file


def is_file(path: Path) -> bool:
    """Whether there is a regular file; a name that no file can have is none."""
    return os.path.isfile(path)  # noqa: PTH113 - that of a path raises for such names


def is_folder(path: Path) -> bool:
    """Whether there is a folder."""
    return os.path.isdir(path)  # noqa: PTH112


def is_other(path: Path) -> bool:
    """Whether there is something that is no regular file, such as a folder or a device."""
    return os.path.exists(path) and not is_file(path)  # noqa: PTH110


def read_included(path: Path, depth: int) -> str:
    """The text of a deck, or of a file that others include so many times over."""
    if not is_file(path) or path.stat().st_size > _LARGEST:
        raise PreError(f"{path}: there is no such file, or it is larger than 1 GB")
    if depth > _DEEPEST:
        raise PreError(f"{path}: more than {_DEEPEST} files include each other")
    return path.read_text(encoding="utf-8-sig", errors="replace").replace("\x00", "")


def write_lines(lines: Iterator[str], path: Path) -> None:
    """Write a file; nothing is left of one that fails on the way."""
    part = path.with_name(f".{path.name}.part")
    try:
        with part.open("w", encoding="utf-8", newline="\n") as stream:
            stream.writelines(f"{line}\n" for line in lines)
        part.replace(path)
    except OSError as error:
        raise OutputError(f"{path} cannot be written: {error.strerror}") from error
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)
