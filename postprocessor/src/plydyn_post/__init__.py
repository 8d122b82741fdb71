"""Curves, profiles and pictures of plydyn results.

```python
import plydyn_post as post

job = post.open("results/plate")  # or the job that plydyn_pre.run gives
print(job.numbers()["peak force"])
force = job.history("impactor_1").frame()
job.figure("force", "force.png")
```
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from plydyn_post.errors import ResultsError
    from plydyn_post.interfaces import Interface
    from plydyn_post.job import Job
    from plydyn_post.job import open_job as open
    from plydyn_post.plies import PlyStress
    from plydyn_post.table import Table

__all__ = ["Interface", "Job", "PlyStress", "ResultsError", "Table", "open"]

#: Where each name is, and its name there: what draws is slow to load, and neither a help nor a
#: shell that completes a command draws
_PLACES = {
    "Interface": ("interfaces", "Interface"),
    "Job": ("job", "Job"),
    "PlyStress": ("plies", "PlyStress"),
    "ResultsError": ("errors", "ResultsError"),
    "Table": ("table", "Table"),
    "open": ("job", "open_job"),
}


def __getattr__(name: str) -> Any:  # noqa: ANN401 - classes and a function
    """Load what is asked for."""
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module, there = _PLACES[name]
    return getattr(import_module(f"{__name__}.{module}"), there)
