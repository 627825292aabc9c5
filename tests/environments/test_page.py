"""The examples of docs/gymnasium.md run."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("package", ["gymnasium", "stable_baselines3"])
def test_the_examples_run(package: str) -> None:
    pytest.importorskip(package)
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / "gymnasium.md").read_text(encoding="utf-8"), re.DOTALL)
    [code] = [block for block in blocks if ("stable_baselines3" in block) == (package == "stable_baselines3")]
    words = [sys.executable, "-c", code]
    done = subprocess.run(words, cwd=ROOT / "examples" / "collect", capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
