"""Files that the user names."""

from __future__ import annotations

from pathlib import Path


def is_file(path: Path) -> bool:
    """Whether there is a regular file; a name that no file can have is none."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


def is_folder(path: Path) -> bool:
    """Whether there is a folder."""
    try:
        return path.is_dir()
    except (OSError, ValueError):
        return False


def is_other(path: Path) -> bool:
    """Whether there is something that is no regular file, such as a folder or a device."""
    try:
        return path.exists() and not path.is_file()
    except (OSError, ValueError):
        return False
