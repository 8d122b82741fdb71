"""What the tests share."""

from pathlib import Path

import pytest
import synthetic


@pytest.fixture(scope="session")
def job(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished job, only to be read; its name without an ending."""
    return synthetic.write_job(tmp_path_factory.mktemp("finished"))


@pytest.fixture
def own_job(tmp_path: Path) -> Path:
    """A finished job that a test may change."""
    return synthetic.write_job(tmp_path / "own")
