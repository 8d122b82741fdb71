"""The page about the listing: its lines are those of the program for the tutorial's coupon."""

from __future__ import annotations

import re
import subprocess

import pytest

from runs import ROOT
from tutorial import blocks, environment

PAGE = ROOT / "manual/listing.md"
#: Beginnings of lines that depend on the machine, or are of a run
OTHER = (
    *("plydyn ", "built as", "flags", "threads", "memory", "    cycle"),
    *("a step", "a line of energies", "time to come"),
)
RUN = re.compile(r" +\d+ +\S+ +[\d.]+% ")
NUMBER = re.compile(r"[-+]?\d+(?:\.\d*)?(?:[Ee][-+]?\d+)?")


@pytest.fixture(scope="module")
def listing(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """Lines of `plydyn check` of the coupon."""
    folder = tmp_path_factory.mktemp("listing")
    recipe = next(block for block in blocks() if block.file == "small.toml")
    (folder / "small.toml").write_text(recipe.text)

    def do(*words: str) -> str:
        ended = subprocess.run(
            words, cwd=folder, env=environment(), capture_output=True, text=True, check=True
        )
        return ended.stdout

    do("plydyn-pre", "new", "coupon.toml", "--template", "astm-d7136")
    do("plydyn-pre", "deck", "small.toml")
    return do("plydyn", "check", "small.k").splitlines()


def printed() -> list[str]:
    """Lines of the blocks of the page that do not depend on the machine."""
    text = "".join(block.text for block in blocks(PAGE))
    lines = [line for line in text.splitlines() if line.strip()]
    return [line for line in lines if not line.startswith(OTHER) and not RUN.match(line)]


def agree(line: str, other: str) -> bool:
    """Whether the parts of a line between dots are parts of another one, numbers to 0.1 %."""
    at = 0
    parts = line.rstrip().split("...")
    for i, part in enumerate(parts):
        words = [NUMBER.sub("#", word) for word in part.split()]
        pattern = r"\s+".join(re.escape(word) for word in words).replace(
            r"\#", f"({NUMBER.pattern})"
        )
        if i == len(parts) - 1 and words:
            pattern = rf"(?<!\S){pattern}\s*$"
        found = re.compile(pattern).search(other, at)
        if found is None:
            return False
        numbers = [float(number) for number in NUMBER.findall(part)]
        if numbers != pytest.approx([float(number) for number in found.groups()], rel=1.0e-3):
            return False
        at = found.end()
    return True


@pytest.mark.parametrize("line", printed())
def test_line_is_printed(listing: list[str], line: str) -> None:
    """Words as they stand; numbers but for round-off."""
    assert any(agree(line, other) for other in listing)


def test_changed_lines_are_found() -> None:
    """Another number or another word does not agree."""
    line = "quads   884 of 9 nodes"
    assert agree("quads 884 of ... nodes", line)
    assert not agree("quads 885 of ... nodes", line)
    assert not agree("bricks 884", line)
