"""Keys of recipes that earlier versions had, and what to use in their place."""

from __future__ import annotations

#: By the kind of the table that had them
REMOVED: dict[str, dict[str, str]] = {
    "ply_codam2": {
        "onset": "onset is by the stresses on what remains in the other direction",
        "brittle": "the stress of crushed fibres falls along lines, or to plateau",
        "scatter": "strengths of plies do not scatter; those of a cohesive material can",
        "fibre_scatter": "strengths of plies do not scatter; those of a cohesive material can",
        "scatter_length": "strengths of plies do not scatter; those of a cohesive material can",
        "seed": "strengths of plies do not scatter; those of a cohesive material can",
    },
}


def successor(kind: type, key: str) -> str | None:
    """What to use in place of a key that a table of this kind had; none for other keys."""
    return REMOVED.get(getattr(kind, "kind", ""), {}).get(key)
