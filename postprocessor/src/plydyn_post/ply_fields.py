"""Fields of the damage of plies: names alone, for what draws them and for what only lists them."""

from __future__ import annotations

#: With their names in print
MECHANISMS = {
    "damage_fibre": "fibre",
    "damage_matrix": "matrix",
    "damage_shear": "shear",
}
