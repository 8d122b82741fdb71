"""Worked examples of the manual are files that the unit tests build."""

import re

import pytest

from runs import ROOT


@pytest.mark.parametrize("module", ["momentum_history", "damping_ratio"])
def test_example_is_the_file_that_is_built(module: str) -> None:
    page = (ROOT / "manual" / "extending.md").read_text()
    blocks = re.findall(r"^```fortran\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    source = (ROOT / "tests" / "unit" / f"{module}.f90").read_text()
    assert source in blocks, f"tests/unit/{module}.f90 and manual/extending.md must be the same"
