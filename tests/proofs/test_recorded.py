"""`mindc prove --run`: what a run shows beside what is proved."""

from pathlib import Path

import pytest

from mindlang.cli import _session as session
from mindlang.cli import _terminal as terminal
from tests.calling import RULES, Call
from tests.proofs.test_prove_command import proved


def test_a_run(mindc: Call) -> None:
    found = proved(mindc, "examples/collect/power.mind", "--run", "--seed", 1)
    run = found["run"]
    assert (run["task"], run["seed"], run["faults"]) == ("CollectWithPower", 1, 0)
    left, _, claw = (actuator["run"] for actuator in found["actuators"])
    assert left["neutral_ticks"] == 0
    assert claw["neutral_ticks"] > 0
    assert claw["rests_on"] == [f"a run of {run['ticks']:,} ticks of task CollectWithPower, seed 1"]
    said = mindc("prove", "examples/collect/power.mind", "--run")
    assert f"{claw['neutral_ticks']} ({claw['neutral_ticks'] / run['ticks']:.1%}), the first of them tick" in said.out


def test_a_run_without_influence(mindc: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The claw has no driver, the left wheel one that is always on; the right one only as far as the left one turns."""
    text = RULES.replace("sensor ball", "actuator claw is gripper neutral 0.25\nsensor ball").replace("1200", "30")
    text = text.replace("  influences Turn at 0.2", "  influences Turn at 0").replace(
        "  drives right_wheel at 2.3", "# "
    )
    path = tmp_path / "turning.mind"
    path.write_text(text)
    monkeypatch.setattr(session, "ensure_compiled", lambda _: terminal.tell("this may take a minute"))
    assert mindc("prove", path, "--run").err == "this may take a minute\n"
    found = proved(mindc, path, "--run", "--seed", 3)
    assert (found["run"]["ticks"], found["run"]["seed"]) == (30, 3)
    left, right, claw = (actuator["run"] for actuator in found["actuators"])
    assert (left["neutral_ticks"], left["first_tick"]) == (0, None)
    assert (right["neutral_ticks"], right["first_tick"], right["commands"]) == (30, 1, [0.5, 0.5])
    assert (claw["neutral_ticks"], claw["first_tick"], claw["commands"]) == (30, 1, [0.25, 0.25])
    rests = ["a run of 30 ticks of task Chase, seed 3"]
    assert left["rests_on"] == right["rests_on"] == claw["rests_on"] == rests
