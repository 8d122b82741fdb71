"""A laminate of which one interface can fail has histories of that one."""

from __future__ import annotations

from pathlib import Path

import pytest

from runs import ROOT, run_deck

SIDE = 2.0


@pytest.mark.parametrize("interface", [1, 2, 3])
def test_other_interfaces_are_tied(interface: int, tmp_path: Path) -> None:
    """Over four plies; the quad that has failed before the run is the area of its interface."""
    text = (ROOT / "tests/deck/delamination/deck.k").read_text()
    ply = f"{3:10}{1.0:10}{0.0:10}{0:10}"
    text = text.replace(f"{ply}{2:10}\n", "".join(f"{ply}{k:10}\n" for k in (2, 3, 4)))
    # *INTERFACE_COHESIVE and *INITIAL_DELAMINATION name it
    card = f"{1:10}{{0}}{{0}}{9:10}"
    text = text.replace(card.format(f"{0:10}"), card.format(f"{interface:10}"))
    text = text.replace(f"{1:10}{1:10}{1:10}{7:10}", f"{1:10}{interface:10}{interface:10}{7:10}")
    path = tmp_path / "some.k"
    path.write_text(text)
    table = run_deck(path, tmp_path, "some").table("delamination")
    areas = [name for name in table.names if name.startswith("interface") and name.endswith("area")]
    assert areas == [f"interface {interface} area", f"interface {interface} failed area"]
    assert table[areas[0]][0] == SIDE**2
    assert table["sum"][0] == table["projected area"][0] == SIDE**2
