"""Named sets of what a ply of kind ply_codam2 leaves open beside the constants of its material."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields
from typing import Any

from plydyn_pre.errors import RecipeError
from plydyn_pre.study import PlyCodam2
from plydyn_pre.suggest import suggestion
from plydyn_pre.tables import Table

#: Choices for Nagaraj, Carrera, Petrolo, Int. J. Non-Linear Mech. 127 (2020) 103591, section 4.3:
#: what the paper leaves open as decks/damage_impact answers it, and its one damage a direction
_NAGARAJ = {
    "shear": "exponential",
    "shear_strain": 0.05,
    "width_rule": "gauss_point",
    "snap_back": "drop",
    "weakens_across": False,
    "largest_damage": 0.99,
    "closure": False,
}
#: The defaults of the same keys
_DEFAULT = {each.name: each.default for each in fields(PlyCodam2) if each.name in _NAGARAJ}
MODELS: Mapping[str, Mapping[str, Any]] = {
    "default": {key: _DEFAULT[key] for key in _NAGARAJ},
    "nagaraj2020": _NAGARAJ,
}


def with_models(table: Table) -> Table:
    """The table of a recipe whose plies have the values of the sets that they name.

    What a ply gives itself, or takes from the library, stays.
    """
    materials = table.get("materials")
    if not isinstance(materials, dict):
        return table
    named = {name: _with_model(name, each) for name, each in materials.items()}
    return table | {"materials": named}


def model_lines() -> Iterator[str]:
    """The sets as the lines of a table, a row for each key."""
    yield "| key | " + " | ".join(f'`model = "{name}"`' for name in MODELS) + " |"
    yield "| --- |" + " --- |" * len(MODELS)
    for key in _NAGARAJ:
        yield f"| `{key}` | " + " | ".join(_toml(each[key]) for each in MODELS.values()) + " |"


def _with_model(name: str, material: Any) -> Any:  # noqa: ANN401 - any value of a recipe
    """A material with the values of the set that it names."""
    if not (isinstance(material, dict) and "model" in material):
        return material
    place, model = f"materials.{name}.model", material["model"]
    if material.get("kind") != PlyCodam2.kind:
        raise RecipeError(place, f"only plies of kind {PlyCodam2.kind} have one")
    if not isinstance(model, str) or model not in MODELS:
        raise RecipeError(place, f"{model!r} is not a model; {suggestion(str(model), MODELS)}")
    return {**MODELS[model], **{key: each for key, each in material.items() if key != "model"}}


def _toml(value: str | float) -> str:
    """A value as a recipe has it."""
    text = str(value).lower() if isinstance(value, bool) else f"{value}"
    return f'`"{text}"`' if isinstance(value, str) else f"`{text}`"
