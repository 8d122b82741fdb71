"""Strengths that scatter from point to point: the keys that plies and bonds share."""

from __future__ import annotations

from collections.abc import Mapping

from plydyn_pre.errors import require, require_not_negative, require_positive

#: Keys of a material that are moduli of Weibull
_MODULI = ("scatter", "fibre_scatter")
#: With less, strengths vary by more than their half
_LEAST = 2.0


def scatters(material: object) -> bool:
    """Whether any strength of a material scatters."""
    return any(getattr(material, name, 0.0) for name in _MODULI)


def idle_scatter(material: object) -> list[str]:
    """Keys of a material that tell how strengths scatter, where none does."""
    keys = () if scatters(material) else ("scatter_length", "seed")
    return [key for key in keys if getattr(material, key)]


def check_scatter(material: object, *moduli: str) -> None:
    """Refuse moduli of Weibull between 0 and the least, and a length or a seed that cannot be."""
    for name in moduli:
        modulus = getattr(material, name)
        rule = f"{modulus:g} must be {_LEAST:g} or more, or 0"
        require(modulus == 0.0 or modulus >= _LEAST, name, rule)
    require_not_negative(material, "seed")
    if scatters(material):
        require_positive(material, "scatter_length")


def refuse_scatter(materials: Mapping[str, object]) -> None:
    """Refuse strengths that scatter where there are bricks."""
    for name, material in materials.items():
        rule = "strengths of bricks do not scatter; 0, or leave bricks out"
        require(not scatters(material), f"materials.{name}.scatter", rule)
