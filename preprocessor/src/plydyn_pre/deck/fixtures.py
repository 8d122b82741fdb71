"""Keywords of fixtures."""

from __future__ import annotations

from collections.abc import Iterator

from plydyn_pre.deck.cards import Card, title_line, titled
from plydyn_pre.deck.names import Names
from plydyn_pre.study import Bar, Clamp, Fixture, Plane, Punch, Ring

_FACES = {"bottom": -1, "top": 1}
_NONE, _RECTANGLE, _CIRCLE = 0, 1, 2


def fixture_keywords(names: Names, first: int = 1) -> Iterator[str]:
    """All fixtures, with numbers from the first one on."""
    for number, fixture in enumerate(names.study.fixtures, start=first):
        cards = _cards(names, fixture)
        head = {"fid": number, "face": _FACES[fixture.face]}
        title = title_line(fixture.title)
        cards[0] = {**head, **cards[0]}
        yield titled(f"FIXTURE_{fixture.kind.upper()}", title, *cards)


def _cards(names: Names, fixture: Fixture) -> list[Card]:
    """The cards of a fixture, the first one without number and face."""
    friction = {"fs": fixture.friction, "fd": fixture.dynamic_friction, "dc": fixture.decay}
    if isinstance(fixture, Clamp):
        x, y = fixture.centre or names.mesh.middle
        force = {"force": fixture.force * names.study.share_of(fixture)}
        soft = {"stiff": fixture.stiffness * names.study.share_of(fixture)}
        tip = {"xc": x, "yc": y, "ri": fixture.inner, "ro": fixture.outer}
        return [force | {"lcid": names.curve(fixture.curve)} | soft | friction, tip]
    edge = {"radius": fixture.radius} if isinstance(fixture, Bar) else {"edge": fixture.edge}
    motion = [fixture.move_x, fixture.move_y, fixture.move_z]
    curves = dict(zip(("lcx", "lcy", "lcz"), map(names.curve, motion), strict=True))
    moves: list[Card] = [curves] if any(motion) else []
    return [{"gap": fixture.gap} | edge | friction, _outline(names, fixture), *moves]


def _outline(names: Names, fixture: Bar | Plane | Ring | Punch) -> Card:
    """The second card of a body."""
    if isinstance(fixture, Bar):
        return dict(zip(("x1", "y1", "x2", "y2"), (*fixture.start, *fixture.end), strict=True))
    x, y = fixture.centre or names.mesh.middle
    place = {"xc": x, "yc": y}
    if isinstance(fixture, Ring):
        return place | {"ri": fixture.inner, "ro": fixture.outer}
    size = fixture.size if isinstance(fixture, Punch) else names.study.window_of(fixture)
    name = "shape" if isinstance(fixture, Punch) else "window"
    if isinstance(size, tuple):
        sides = {"lx": size[0], "ly": size[1], "radius": fixture.corner}
        return {name: _RECTANGLE} | place | sides
    shape = _CIRCLE if size > 0.0 else _NONE
    return {name: shape} | place | {"lx": 0.0, "ly": 0.0, "radius": size / 2}
