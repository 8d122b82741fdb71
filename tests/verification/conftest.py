"""What all verification tests share."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from comparison import Comparison


@pytest.fixture
def compare(record_property: Callable[[str, object], None]) -> Comparison:
    """Compares numbers and curves with their references, for the test and for the report."""
    return Comparison(record_property)
