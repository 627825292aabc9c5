"""The example in a folder of its own."""

import shutil
from pathlib import Path

import pytest

COLLECT = Path(__file__).parents[2] / "examples" / "collect"


@pytest.fixture
def collect(tmp_path: Path) -> Path:
    """A folder with collect.mind and what it was taught."""
    for name in ("collect.mind", "collect.lock", "weights"):
        copy = shutil.copytree if (COLLECT / name).is_dir() else shutil.copy
        copy(COLLECT / name, tmp_path / name)
    return tmp_path
