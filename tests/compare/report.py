"""What a comparison of two builds finds."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Difference:
    """A column or array that differs, at its first place."""

    file: str
    data: str
    place: str
    old: str
    new: str

    def __str__(self) -> str:
        """One line."""
        where = ", ".join(word for word in (self.file, self.data, self.place) if word)
        return f"{where}: old {self.old}, new {self.new}"


@dataclass
class Report:
    """Differences, changes of names, and how much was compared."""

    case: str = ""
    differences: list[Difference] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    files: int = 0
    numbers: int = 0

    def differ(self, file: str, data: str, place: str, old: object, new: object) -> None:
        """Add a difference."""
        self.differences.append(Difference(file, data, place, str(old), str(new)))

    def note(self, text: str) -> None:
        """Add a change that is none of numbers."""
        self.notes.append(text)
