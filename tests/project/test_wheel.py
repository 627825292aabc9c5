"""A wheel with machine code: its first start compiles nothing."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from mindrun.sim import cache

from tests.language.examples import ROOT

FIRST_START = """
import sys
from mindrun.sim import warmup
units = warmup.every_unit()
print(warmup.is_there(units), warmup.is_native(units))
for each in units:
    each.load()
print("numba" in sys.modules)
"""


@pytest.mark.slow
@pytest.mark.skipif(not cache.fitting(), reason="there are no wheels with machine code for such a processor")
def test_its_first_start_compiles_nothing(tmp_path: Path) -> None:
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", tmp_path]
    subprocess.run(build, cwd=ROOT, env=os.environ | {"MIND_COMPILED": "1"}, check=True, capture_output=True)
    (wheel,) = tmp_path.glob("*.whl")
    assert "none-any" not in wheel.name
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path / "installed")
    environment = os.environ | {"PYTHONPATH": str(tmp_path / "installed"), "NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    command = [sys.executable, "-c", FIRST_START]
    ended = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=True)
    assert ended.stdout.split() == ["True", "False", "False"], ended.stderr
    assert not [*(tmp_path / "cache").glob("*/*.code")]
