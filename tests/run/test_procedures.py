"""`mindc run` with procedures: what they raise, and what numba cannot compile."""

import json
from pathlib import Path

import pytest

from tests.calling import RULES, Call

CALLING = RULES.replace("skill Turn is rule", "skill Turn is procedure from turning.turn\n  reads feeler").replace(
    "  drives left_wheel at 0.9\n  drives right_wheel at 0.1\n", "  drives left_wheel\n  drives right_wheel\n"
)
FAST = "def turn(left, ahead, right):\n    return 0.9, 0.1\n"
SLOW = "def turn(left, ahead, right):\n    return [*{'left': 0.9, 'right': 0.1}.values()]\n"


@pytest.fixture
def calling(tmp_path: Path) -> Path:
    path = tmp_path / "calling.mind"
    path.write_text(CALLING, encoding="utf-8")
    return path


def test_a_slow_procedure_gives_the_same_run_and_says_so(mindc: Call, calling: Path, tmp_path: Path) -> None:
    module = tmp_path / "turning.py"
    module.write_text(FAST)
    options = ("run", calling, "--task", "Roam", "--seed", 2, "--json")
    fast = mindc(*options)
    module.write_text(SLOW)
    slow = mindc(*options)
    assert json.loads(fast.out) == json.loads(slow.out)
    assert "Turn runs in Python" not in fast.err
    assert "Turn runs in Python, which is slow: " in slow.err


@pytest.mark.parametrize(
    ("body", "message"),
    [("raise ValueError('no')", "ValueError: no"), ("return (1, 2, 3)[:]", "returned 3 values instead of 2")],
)
@pytest.mark.parametrize("command", ["run", "bench"])
def test_a_procedure_that_fails_is_not_mindcs_fault(
    mindc: Call, calling: Path, tmp_path: Path, command: str, body: str, message: str
) -> None:
    (tmp_path / "turning.py").write_text(f"def turn(left, ahead, right):\n    {body}\n")
    code, out, err = mindc(command, calling, "--quiet")
    assert (code, out) == (1, "")
    assert err.startswith("procedure turning.turn ")
    assert err.endswith(f"{message}\n")


@pytest.mark.parametrize("source", [FAST, SLOW])
def test_what_a_procedure_prints_is_talk(mindc: Call, calling: Path, tmp_path: Path, source: str) -> None:
    (tmp_path / "turning.py").write_text("print('begins')\n" + source.replace("    ", "    print('turns')\n    "))
    said = mindc("run", calling, "--task", "Roam", "--json", "--picture", tmp_path / "path.png")
    assert json.loads(said.out)["task"] == "Roam"
    assert "begins\n" in said.err
    assert "turns\n" in said.err


def test_a_run_to_a_breakpoint_is_made_once(mindc: Call, calling: Path, tmp_path: Path) -> None:
    """So a procedure is called once a tick of the run that was there."""
    (tmp_path / "turning.py").write_text(SLOW.replace("    ", "    print('turns')\n    "))
    breaks = tmp_path / "a.break"
    breaks.write_text("stop when left_wheel > 2")
    said = mindc("run", calling, "--task", "Roam", "--seed", 3, "--break", breaks, "--json")
    assert said.err.split("\n").count("turns") == json.loads(said.out)["ticks"] > 10


def test_a_missing_procedure_is_unreadable_input(mindc: Call, calling: Path) -> None:
    said = mindc("run", calling)
    assert said.code == 2
    assert "turning" in said.err
    assert "Traceback" not in said.err
