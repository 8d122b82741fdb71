"""What a report is to be made of."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from plydyn_post.results import Results


@dataclass(frozen=True)
class Plan:
    """What a report is made of."""

    jobs: tuple[Results, ...]
    folder: Path
    measured: tuple[Path, ...] = ()
    window: float | None = None  # of the running mean, in time
    time: float | None = None  # of pictures and profiles
    plain: bool = False  # pictures by matplotlib
    peak: float | None = None  # time of the largest load of the last job, a test of strength

    def alone(self, job: Results) -> Plan:
        """The plan of one job; its measured curves are those of an impact."""
        return replace(self, jobs=(job,), time=None)


@dataclass(frozen=True)
class Task:
    """An image to make."""

    section: str
    name: str  # of the file
    caption: str
    draw: Callable[[Path], object]  # and write it to a path


def file_name(label: str) -> str:
    """A label as a part of the name of a file."""
    return label.replace("/", "_")
