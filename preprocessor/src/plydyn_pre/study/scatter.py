"""Strengths of a bond that scatter from point to point."""

from __future__ import annotations

from plydyn_pre.errors import require, require_not_negative, require_positive

#: With less, strengths vary by more than their half
_LEAST = 2.0


def scatters(material: object) -> bool:
    """Whether the strengths of a material scatter."""
    return bool(getattr(material, "scatter", 0.0))


def idle_scatter(material: object) -> list[str]:
    """Keys of a bond that tell how strengths scatter, where none does."""
    keys = () if scatters(material) else ("scatter_length", "seed")
    return [key for key in keys if getattr(material, key)]


def check_scatter(material: object, modulus: float) -> None:
    """Refuse a modulus of Weibull below the least, and a length or a seed that cannot be."""
    rule = f"{modulus:g} must be {_LEAST:g} or more, or 0"
    require(modulus == 0.0 or modulus >= _LEAST, "scatter", rule)
    require_not_negative(material, "seed")
    if scatters(material):
        require_positive(material, "scatter_length")
