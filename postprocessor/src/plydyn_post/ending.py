"""What ended a test of strength: what had buckled at the peak, and what broke in the fall."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plydyn_post.broken_plies import END, BrokenPly, broken_places, broken_plies, place_words
from plydyn_post.compression import EVENTS, Compression
from plydyn_post.grid import has_point_field
from plydyn_post.maps import area_words
from plydyn_post.plies import Stack, read_stack
from plydyn_post.sublaminates import (
    OpenInterface,
    grown_of,
    harmless,
    open_interfaces,
    opened_of,
    states_of,
)
from plydyn_post.units import readable

#: The plate as a whole has buckled where it has deflected by this share of its thickness
BENT = 0.5
#: Less than this share of the stored energy at the peak broke: the plate gave way by bending alone
BROKE = 0.02
#: A mechanism with less of the energy that broke is not named
NAMED = 0.2
#: Fibres break away from the delaminations where less than this share of them lies over these
AWAY = 0.1


@dataclass(frozen=True)
class Ending:
    """What happened around the peak of a test."""

    taken: dict[str, float]  # energy that broke in the fall, by its column
    stored: float  # energy that the plate had stored at the peak
    interfaces: tuple[OpenInterface, ...]
    plies: tuple[BrokenPly, ...]
    deflection: float | None  # of the plate as a whole from the start of the stage to the peak
    thickness: float
    at_ends: float  # share of the points with newly broken fibres near the ends

    @property
    def opened(self) -> OpenInterface | None:
        """The interface whose sublaminate had buckled at the peak, or in a fall without damage."""
        return opened_of(self.interfaces, after=not self.breaks)

    @property
    def grown(self) -> OpenInterface | None:
        """The interface that took most energy in the fall."""
        return grown_of(self.interfaces)

    @property
    def shown(self) -> OpenInterface | None:
        """The interface of the map: the one that had opened, else the one that grew."""
        return self.opened or self.grown

    @property
    def harmless(self) -> tuple[OpenInterface, ...]:
        """Interfaces that opened early and had no part in the fall."""
        return harmless(self.interfaces)

    @property
    def has_bent(self) -> bool:
        """Whether the plate as a whole has buckled at the peak."""
        return self.deflection is not None and self.deflection > BENT * self.thickness

    @property
    def breaks(self) -> bool:
        """Whether what broke counts beside what was stored."""
        return sum(self.taken.values()) > BROKE * self.stored

    @property
    def is_away(self) -> bool:
        """Whether fibres broke away from what the impact has delaminated."""
        over = self.plies[0].over if self.plies else None
        return over is not None and over < AWAY

    @property
    def order(self) -> tuple[str, ...]:
        """Mechanisms with a name, the one with most energy first."""
        whole = sum(self.taken.values())
        known = sorted(self.taken, key=lambda name: -self.taken[name])
        return tuple(name for name in known if self.taken[name] > NAMED * whole)


def read_ending(test: Compression) -> Ending:
    """What the histories and fields of a test tell about its end."""
    energy = test.job.energy()
    stored = energy["internal"] - energy["dissipated"]
    places = broken_places(test)
    near = float(np.mean((places < END) | (places > 1.0 - END))) if len(places) else 0.0
    return Ending(
        test.broken(),
        float(stored[test.fall(energy["time"])[0]]),
        open_interfaces(test),
        broken_plies(test),
        _deflection(test),
        test.thickness,
        near,
    )


def _deflection(test: Compression) -> float | None:
    """The largest change of the mean deflection through the thickness up to the peak."""
    path = test.job.fields
    if not has_point_field(path, "displacement"):
        return None
    states = states_of(test, path)
    before, peak = (_mean_of(read_stack(test.job, time)) for time in (states.first, states.peak))
    return float(np.max(np.abs(peak - before)))


def _mean_of(stack: Stack) -> np.ndarray:
    """Deflection at the nodes of all quads, mean through the thickness, (columns, n, n)."""
    plies = [stack.values(ply, "displacement")[..., 2].mean(axis=(1, 4)) for ply in stack.plies]
    return np.mean(plies, axis=0)


def ending_words(test: Compression, ending: Ending) -> tuple[str, ...]:
    """What ended the test, in sentences; the first one names the mechanism."""
    if test.fallen is None:
        return ("The stress has not fallen from its peak: nothing ended the test yet.",)
    length = test.units.get("length", "")
    return tuple(
        filter(
            None,
            (
                f"{_mechanism(test, ending)} ended the test.",
                _fall_words(test, ending),
                _open_words(test, ending, length),
                _grown_words(test, ending),
                _ply_words(ending, length, test.axis),
                place_words(test),
                _bend_words(ending, length),
                *(_harmless_words(test, one, length) for one in ending.harmless),
            ),
        )
    )


def _mechanism(test: Compression, ending: Ending) -> str:
    """The mechanism: what had buckled, then what broke."""
    buckled = "" if test.pulled else _buckled(ending)
    if not ending.breaks:
        return (buckled or "bending, with hardly anything broken,").capitalize()
    broke = " and ".join(_event(test, ending, name) for name in ending.order)
    return ", then ".join(filter(None, (buckled, broke))).capitalize()


def _buckled(ending: Ending) -> str:
    """What had buckled at the peak, or in a fall in which nothing broke; empty for nothing."""
    if ending.opened is not None:
        return f"sublaminate buckling with opening of interface {ending.opened.number}"
    return "buckling of the whole plate" if ending.has_bent else ""


def _event(test: Compression, ending: Ending, name: str) -> str:
    """A mechanism that broke, with its ply or interface."""
    if name == "fibre damage":
        if ending.at_ends > 0.5 and not test.pulled:
            return "crushing of the ends"
        if not ending.plies:
            return "failure of fibres"
        ply = ending.plies[0]
        kind = "kinking" if ply.strain < 0.0 else "tearing"
        far = " away from the delaminations" if ending.is_away else ""
        return f"fibre {kind} of ply {ply.number} ({ply.angle:g}°){far}"
    if name == "delamination":
        grown = ending.grown
        return f"growth of delamination {grown.number}" if grown else "growth of delaminations"
    return "cracks of the matrix"


def _fall_words(test: Compression, ending: Ending) -> str:
    """The energies of the fall."""
    whole = sum(ending.taken.values())
    if test.fallen is None or whole <= 0.0:
        return "Nothing broke while the stress fell."
    order = sorted(ending.taken, key=lambda one: -ending.taken[one])
    shares = ", ".join(f"{EVENTS[name]} {ending.taken[name] / whole:.0%}" for name in order)
    fall = f"{test.stress[test.fallen] / test.strength:.0%}"
    return f"Energy that broke while the stress fell to {fall} of its peak: {shares}."


def _open_words(test: Compression, ending: Ending, length: str) -> str:
    """The interface whose sublaminate had buckled."""
    one = ending.opened
    if one is None:
        return "No sublaminate had buckled at the peak." if ending.interfaces else ""
    side = "lower" if one.below else "upper"
    x, y = one.place
    start, peak, after = (f"{gap:.2g} {length}" for gap in one.gaps)
    gaps = f"a gap of {start} at the start, {peak} at the peak, {after} after the fall"
    return (
        f"Interface {one.number} ({one.words}) was open{_from(test, one)}: {gaps}, widest at x ="
        f" {x:.3g}, y = {y:.3g}; its {side} side is {one.thickness:.3g} {length} thick."
    )


def _from(test: Compression, one: OpenInterface) -> str:
    """From when on an interface was open, where that is known."""
    return (
        "" if one.opened is None else f" from {one.opened / test.strength:.0%} of the strength on"
    )


def _grown_words(test: Compression, ending: Ending) -> str:
    """The interface that took most in the fall."""
    one = ending.grown
    if one is None or one.energies is None:
        return ""
    scale = readable(test.job.energy().unit("internal"), one.energies[1])
    taken = f"{one.energies[1] * scale.factor:.3g} {scale.unit}"
    return f"Interface {one.number} ({one.words}) took most of all in the fall: {taken}."


def _ply_words(ending: Ending, length: str, axis: int) -> str:
    """The ply with most broken fibres."""
    if not ending.plies:
        return ""
    one = ending.plies[0]
    first, last = one.along
    over = "" if one.over is None else f", {one.over:.0%} of it over the delaminations,"
    return (
        f"Ply {one.number} ({one.angle:g}°) broke most: {area_words(one.area, f'{length}2')}{over}"
        f" between {'xyz'[axis]} = {first:.3g} and {last:.3g}; its fibres were strained there by"
        f" {1.0e6 * one.strain:.0f} µm/m at the peak."
    )


def _bend_words(ending: Ending, length: str) -> str:
    """How far the plate as a whole has deflected."""
    if ending.deflection is None:
        return ""
    share = ending.deflection / ending.thickness
    return (
        f"At the peak the plate as a whole had deflected by {ending.deflection:.2g} {length},"
        f" {share:.2g} of its thickness."
    )


def _harmless_words(test: Compression, one: OpenInterface, length: str) -> str:
    """An interface that opened and did not matter."""
    return (
        f"Interface {one.number} opened{_from(test, one)}, by {one.gaps[1] - one.gaps[0]:.2g}"
        f" {length} at the peak, and took little in the fall: harmless, and not the end of the"
        " test."
    )
