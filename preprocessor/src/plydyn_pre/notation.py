"""Words of recipes that several modules know."""

from __future__ import annotations

#: Behind the name of a material that joins plies of other directions or materials only
BETWEEN_UNLIKE = " between unlike plies"
