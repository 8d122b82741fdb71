"""What a recipe, a notation or a mesh can be wrong about."""

from __future__ import annotations


class PreError(ValueError):
    """Something the user can put right; the text says how."""


class OutputError(PreError):
    """A file or a folder that cannot be written."""


class LayupError(PreError):
    """A stacking sequence that cannot be read, with the column that is wrong."""

    def __init__(self, notation: str, column: int, message: str) -> None:
        """Point at a column of the notation, counted from 1."""
        super().__init__(f"column {column}: {message}\n  {notation}\n  {' ' * (column - 1)}^")
        self.notation = notation
        self.column = column


class MeshError(PreError):
    """A mesh that cannot be made or used."""


class RecipeError(PreError):
    """A value of a study that is wrong, with the keys that lead to it."""

    def __init__(self, path: str, message: str) -> None:
        """Say what is wrong at a place such as ``laminate.layup``."""
        super().__init__(f"{path}: {message}" if path else message)
        self.path = path
        self.message = message

    def within(self, outer: str) -> RecipeError:
        """The same error, seen from a table further out."""
        inner = f".{self.path}" if outer and self.path and self.path[0] != "[" else self.path
        return RecipeError(outer + inner, self.message)


def require(holds: bool, path: str, message: str) -> None:
    """Raise an error about a key unless something holds."""
    if not holds:
        raise RecipeError(path, message)


def require_positive(thing: object, *names: str) -> None:
    """Raise an error about the first of some fields that is not above zero."""
    for name in names:
        value = getattr(thing, name)
        require(value > 0, name, f"{value!r} must be above zero")


def require_not_negative(thing: object, *names: str) -> None:
    """Raise an error about the first of some fields that is below zero."""
    for name in names:
        value = getattr(thing, name)
        require(value >= 0, name, f"{value!r} must not be negative")


def require_between(thing: object, low: float, high: float, *names: str) -> None:
    """Raise an error about the first of some fields that is not from `low` to `high`."""
    for name in names:
        value = getattr(thing, name)
        require(low <= value <= high, name, f"{value!r} must be from {low:g} to {high:g}")
