"""Whether a strength may be trusted: findings on its test as traffic lights."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from plydyn_post.case import Case, Light
from plydyn_post.compression import MOST_BENDING, QUASI_STATIC, Compression
from plydyn_post.ending import Ending
from plydyn_post.strength_assumed import begins_closed
from plydyn_post.sublaminates import states_of

ORDER = ("red", "amber", "green")
#: Difference of the forces of both ends over the load: in equilibrium, and no longer
BALANCED, UNBALANCED = 0.02, 0.05
#: A picture of a state below this share of the strength does not show the peak
NEAR_PEAK = 0.9


def strength_lights(test: Compression, ending: Ending, cases: Sequence[Case]) -> tuple[Light, ...]:
    """Findings on the test, then the worst of each stage; the worst first."""
    found = [*_of_end(test, ending), *_of_state(test, ending), *_of_rate(test), *_of_stages(cases)]
    return tuple(sorted(found, key=lambda light: ORDER.index(light.colour)))


def _of_end(test: Compression, ending: Ending) -> Iterator[Light]:
    """How the test ended, and whether the standard would count it."""
    if test.fallen is None:
        yield Light("red", "the stress has not fallen from its peak; the strength may be higher")
    else:
        yield Light("green", "the stress has fallen from its peak, which is the strength")
    if ending.at_ends > 0.5:
        yield Light("amber", "the plate broke at its ends, which the standards do not count")
    if ending.is_away and "fibre damage" in ending.order:
        words = "fibres broke away from the delaminations: this may be no strength after impact"
        yield Light("red", f"{words}; wide quads start kinking below its strength, see Checks")
    if test.bending > MOST_BENDING:
        words = f"the gauges bend by {test.bending:.3g} % at the peak, more than {MOST_BENDING:g} %"
        yield Light("amber", f"{words}: ASTM D7137 asks for less")
    shown = states_of(test, test.job.fields).peak
    share = float(np.interp(shown, test.time, test.stress)) / test.strength
    if share < NEAR_PEAK:
        words = f"the state next to the peak is at {share:.0%} of the strength"
        yield Light("amber", f"{words}: give the stage a smaller outputs.field_interval")


def _of_state(test: Compression, ending: Ending) -> Iterator[Light]:
    """Whether delaminations are as open at the start as in a coupon."""
    if not test.pulled and begins_closed(test, ending):
        words = "all delaminations begin closed; in a coupon debris and permanent shear hold them"
        yield Light("amber", f"{words} open, which can lower the strength by a fifth or more")


def _of_rate(test: Compression) -> Iterator[Light]:
    """Whether the test was slow enough."""
    most, peak = test.kinetic_share(), test.kinetic_at_peak()
    words = f"kinetic energy: {peak:.2g} of the internal one at the peak, at most {most:.2g} before"
    slow = (
        "quasi-static"
        if most <= QUASI_STATIC
        else f"more than {QUASI_STATIC:.0%}: load more slowly"
    )
    yield Light("green" if most <= QUASI_STATIC else "amber", f"{words}: {slow}")
    apart = test.unbalance()
    colour = "green" if apart <= BALANCED else "amber" if apart <= UNBALANCED else "red"
    words = f"the forces of both ends differ by {apart:.2%} at the peak"
    slow = (
        "in balance"
        if colour == "green"
        else "inertia carries a part of the load; load more slowly"
    )
    yield Light(colour, f"{words}: {slow}")


def _of_stages(cases: Sequence[Case]) -> Iterator[Light]:
    """The worst colour of each stage, and how many findings it has; they stand below."""
    for case in cases:
        if not case.lights:
            continue
        worst = min((light.colour for light in case.lights), key=ORDER.index)
        count = sum(light.colour == worst for light in case.lights)
        if worst == "green":
            yield Light("green", f"{case.job}: no warning and no note")
        else:
            kind = {"red": "warning", "amber": "note"}[worst] + ("s" if count > 1 else "")
            yield Light(worst, f"{case.job}: {count} {kind}; see Checks of {case.job} below")
