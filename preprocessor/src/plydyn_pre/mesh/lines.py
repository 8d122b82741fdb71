"""Lines of quads that are fine in some intervals and grow between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, inf

import numpy as np

from plydyn_pre.mesh.grid import Reals

_MOST_SCALE = 1.1
# share of a size by which a count of quads may be off
_NOISE = 1e-9
# a piece shorter than this share of the finer quads beside it goes to them
_SHORT = 0.5


@dataclass(frozen=True)
class Span:
    """An interval of a line with the size of its quads at most."""

    low: float
    high: float
    size: float


@dataclass(frozen=True)
class _Piece(Span):
    """A part of the line between two cuts."""

    is_fine: bool  # in a span, and not between them


def zoned_line(
    marks: Sequence[float], spans: Sequence[Span], growth: float, largest: float
) -> Reals:
    """Ends of quads on a line, (quads + 1,): equal in the spans, growing between them.

    The line begins at the first mark and ends at the last, and a quad ends at every mark. Where
    spans overlap the finest counts. Outside of them quads grow from the spans, each at most
    `growth` times the one before and near `largest` at most.
    """
    pieces = _pieces(marks, spans, largest)
    filled: dict[int, Reals] = {}
    while len(filled) < len(pieces):
        starts = {k: _starts(pieces, filled, k, growth) for k in range(len(pieces))}
        # spans first, the finest before the others, then what lies beside them, outwards
        _, _, _, _, number = min(
            (
                not piece.is_fine,
                piece.size,
                filled.keys().isdisjoint((k - 1, k + 1)),
                min(starts[k]),
                k,
            )
            for k, piece in enumerate(pieces)
            if k not in filled
        )
        filled[number] = _filled(pieces[number], starts[number], growth)
    return np.concatenate([filled[0], *(filled[k][1:] for k in range(1, len(pieces)))])


def graded_line(length: float, quads: int, grading: float) -> Reals:
    """Ends of some quads on a line, (quads + 1,), the last one `grading` times the first."""
    steps = grading ** (np.arange(quads) / max(quads - 1, 1))
    places = np.concatenate([[0.0], np.cumsum(steps)])
    return places * (length / places[-1])


def place_on(line: Reals, at: Reals) -> Reals:
    """Places on a line of quads; 1.5 lies midway between its second and its third end."""
    return np.interp(at, np.arange(len(line)), line)


def with_middles(line: Reals, order: int) -> Reals:
    """A line of quads, with their middles where they have nine nodes."""
    return place_on(line, np.arange(order * (len(line) - 1) + 1) / order)


def _pieces(marks: Sequence[float], spans: Sequence[Span], largest: float) -> list[_Piece]:
    """The line between its marks and the ends of its spans.

    A span ends a little further on where a shorter piece than half a quad would be left.
    """
    slack = _NOISE * (marks[-1] - marks[0])
    cuts = list(marks)
    for end in sorted(end for span in spans for end in (span.low, span.high)):
        if marks[0] < end < marks[-1] and min(abs(end - cut) for cut in cuts) > slack:
            cuts.append(end)
    cuts.sort()
    pieces = [_piece(low, high, spans, largest) for low, high in pairwise(cuts)]
    place = 1
    while place < len(pieces):
        one, other = pieces[place - 1], pieces[place]
        if one.high not in marks and _are_joined(one, other):
            finer = min(one, other, key=lambda piece: (not piece.is_fine, piece.size))
            pieces[place - 1 : place + 1] = [_Piece(one.low, other.high, finer.size, finer.is_fine)]
            place = max(place - 1, 1)
        else:
            place += 1
    return pieces


def _piece(low: float, high: float, spans: Sequence[Span], largest: float) -> _Piece:
    """A part of the line with the finest size of the spans over it."""
    middle = (low + high) / 2
    sizes = [span.size for span in spans if span.low < middle < span.high]
    return _Piece(low, high, min(sizes, default=largest), bool(sizes))


def _are_joined(one: Span, other: Span) -> bool:
    """Whether two pieces are one: they have one size, or the coarser is too short for a quad."""
    finer, coarser = sorted((one, other), key=lambda piece: piece.size)
    return finer.size == coarser.size or coarser.high - coarser.low < _SHORT * finer.size


def _starts(
    pieces: Sequence[_Piece], filled: dict[int, Reals], number: int, growth: float
) -> tuple[float, float]:
    """Sizes of the first quads at both ends of a piece by what lies beside it; inf for any."""
    return (
        _start(pieces, filled, number, -1, growth),
        _start(pieces, filled, number, 1, growth),
    )


def _start(
    pieces: Sequence[_Piece], filled: dict[int, Reals], number: int, step: int, growth: float
) -> float:
    """Size of the first quad at an end of a piece."""
    piece, beside = pieces[number], number + step
    if not 0 <= beside < len(pieces):
        return inf
    if beside in filled:
        finer = pieces[beside].is_fine and not (piece.is_fine and pieces[beside].size >= piece.size)
        last = _last_size(filled[beside], step)
        return growth * last if finer else inf if piece.is_fine else last
    end = piece.high if step > 0 else piece.low
    beyond = pieces[beside:] if step > 0 else pieces[: beside + 1]
    reached = (
        growth * other.size + (growth - 1.0) * min(abs(other.low - end), abs(other.high - end))
        for other in beyond
        if other.is_fine
    )
    least = min(reached, default=inf)
    return least if least < piece.size else inf


def _last_size(line: Reals, step: int) -> float:
    """Size of the quad at the upper end of a line, or at the lower end for a positive step."""
    sizes = np.diff(line)
    if np.ptp(sizes) <= _NOISE * sizes[0]:
        return float(line[-1] - line[0]) / len(sizes)
    return float(sizes[-1] if step < 0 else sizes[0])


def _filled(piece: _Piece, starts: tuple[float, float], growth: float) -> Reals:
    """Ends of the quads of a piece, (quads + 1,)."""
    length = piece.high - piece.low
    if min(starts) == inf:
        count = max(1, ceil(length / piece.size - _NOISE))
        return np.linspace(piece.low, piece.high, count + 1)
    if starts[0] <= starts[1]:
        line = piece.low + _growing(piece, starts, growth)
    else:
        line = (piece.high - _growing(piece, starts[::-1], growth))[::-1]
    line[[0, -1]] = piece.low, piece.high
    return line


def _growing(piece: _Piece, starts: tuple[float, float], growth: float) -> Reals:
    """Ends of quads on a line from 0 that grow from its beginning, or from both of its ends.

    All are scaled to fill the piece: up by a tenth at most, and never in a span. An end whose start
    is inf is free.
    """
    length, largest = piece.high - piece.low, piece.size
    most = 1.0 + _NOISE if piece.is_fine else _MOST_SCALE
    heads: list[float] = []
    tails: list[float] = []
    total = 0.0
    head, tail = (min(start, largest) for start in starts)
    while not heads or most * total < length:
        total += min(head, tail)
        if head <= tail:
            heads.append(head)
            head = min(growth * head, largest)
        else:
            tails.append(tail)
            tail = min(growth * tail, largest)
    places = np.concatenate([[0.0], np.cumsum([*heads, *tails[::-1]])])
    return places * (length / places[-1])
