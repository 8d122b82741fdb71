"""The pristine plate of a chain: the same stages without the blow before them."""

from __future__ import annotations

from dataclasses import replace

from plydyn_pre.errors import PreError
from plydyn_pre.study import Study

#: Share of the time of the impact after which the run without a blow ends
BEFORE = 1.0e-3


def without_blow(study: Study) -> Study:
    """The chain whose impactor stands far away, and whose first run ends before it moves much.

    Raises PreError where there is no blow to leave out: the first run needs an impactor that a
    stage removes, and no stage may bring another one.
    """
    removed = any("impactor" in stage.remove for stage in study.stages)
    again = any(stage.impactor is not None for stage in study.stages)
    if study.impactor is None or not removed or again:
        raise PreError(
            "--with-pristine leaves out the impact of the first run; right would be a recipe with"
            " an impactor that a later stage removes, and without one in its stages"
        )
    far = max(study.impactor.gap, study.impactor.radius)
    # the velocity of a fall is known, and its energy may not stand beside it
    impactor = replace(study.impactor, gap=far, energy=None)
    control = replace(study.control, end_time=BEFORE * study.control.end_time)
    title = f"{study.title}; without the impact"
    return replace(study, title=title, impactor=impactor, control=control)
