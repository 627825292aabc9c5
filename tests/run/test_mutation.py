"""The mutation tester: what it breaks, and that the tests notice."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
HERE = ROOT / "benchmarks" / "mutation"
TEXT = """
def share(values, total, most=1):
    \"\"\"Said to people, and never touched.\"\"\"
    if total <= 0 or not values:
        return 0.5
    for value in values:
        total += value * 2 - 1
    assert total != 7
    return min(total, most) if total > 1 else total
"""
EXPECTED = {
    "most=2", "total < 0", "total > 0", "total <= 1", "and (not values)", "if total <= 0:", "if not values:",
    "or values",
    "return 1.5", "    return\n", "pass", "in ():", "value / 2", "2 + 1", "value * 3", "+= value * 2\n", "- 2\n",
    "+= value - 1\n", "+= 2 - 1\n", "min(most, total)", "total >= 1", "total > 2", "return min(total, most)\n",
    "return total",
}  # fmt: skip


def broken(text: str, folder: Path) -> list[str]:
    """The mutants of a text."""
    sys.path.insert(0, str(HERE))
    try:
        from mutants import mutants
    finally:
        sys.path.remove(str(HERE))
    (folder / "a.py").write_text(text)
    return [mutant.text for mutant in mutants(folder, folder / "a.py")]


def test_every_kind_of_mistake_is_made(tmp_path: Path) -> None:
    found = broken(TEXT, tmp_path)
    whole = ast.unparse(ast.parse(TEXT))
    assert whole not in found
    assert len(set(found)) == len(found)
    for part in EXPECTED:
        assert any(part in text + "\n" and part not in whole + "\n" for text in found), part
    assert all("Said to people" in text and "assert total != 7" in text for text in found)


@pytest.mark.slow
@pytest.mark.parametrize("room", ["think", "recording"])
def test_a_small_sample_is_noticed(room: str) -> None:
    done = subprocess.run(
        [sys.executable, HERE, room, "--sample", "6", "--seed", "3"], capture_output=True, text=True, check=False
    )
    assert done.stdout.startswith(room), done.stderr
    assert done.returncode == 0, done.stdout
