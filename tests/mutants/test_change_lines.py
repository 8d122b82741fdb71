"""Changes of a line are single, and touch what a program does."""

from __future__ import annotations

import pytest
from change_lines import changes
from try_mutants import FOLDERS, choose


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("   a = b + c", ["   a = b - c", ""]),
        ("   a = b*c", ["   a = b/c", ""]),
        ("   a = b**c", [""]),
        ("   if (a >= b .and. .not. c) return", ["   if (a > b .and. .not. c) return",
         "   if (a >= b .or. .not. c) return", "   if (a >= b .and. c) return"]),
        ("   x%y(i) = -z", ["   x%y(i) = z", ""]),
        ("   call move(a, 0.5_wp)", ["   call move(a, 1.0_wp)", ""]),
        ("   a = max(b, c) &", ["   a = min(b, c) &"]),
        ('   word = "a + b" ! or c - d', [""]),
        ("   real(wp) :: a = 0.0_wp", []),
        ("   !> a + b", []),
        ("   pure real(wp) function f(a) result(b)", []),
        ("   use plydyn_base_text, only : text", []),
        ("   p => q(1)", []),
        ("   end if", []),
    ],
)  # fmt: skip
def test_each_change_is_one_of_the_rules(line: str, expected: list[str]) -> None:
    assert changes(line) == expected


def test_the_rest_of_a_statement_stays() -> None:
    assert changes("      & + c", "   a = b &") == ["      & - c"]
    assert changes("   c = d", "   a = b &") == []


def test_a_seed_chooses_the_same_mutants_in_all_folders() -> None:
    first, again, other = (choose(seed, len(FOLDERS)) for seed in (1, 1, 2))
    assert first == again != other
    assert sorted(one.path.parts[1] for one in first) == sorted(FOLDERS)
    for one in first:
        assert one.old != one.new
        assert one.new in changes(one.old, one.before)
