"""`mindc why --ends`: where runs end, and where on its body a robot was touched."""

import json
from math import cos, hypot, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mindrun.sim.trace import joined, last_touch, trace
from rich.console import Group

import mindlang
from mindlang.attribution.ends import ends_text
from tests.calling import RULES, Call

CARRYING = """tick 1/60 s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
actuator claw is gripper neutral 0
sensor eye is range_finder at 0 deg

skill Go is rule
  reads eye
  drives left_wheel at 0.9
  drives right_wheel at 0.9
  drives claw at 1

task Go in arena size 40
  starts at 0 0 facing 0 deg
  contains ball is item size 2 at 6 0
  lasts 600 ticks
  ends on collision
"""
SLOP_UNITS = 0.11  # by which what touches may overlap, and a little more


CARRIED = """\
Go with Go in charge, 1 run from seed 1

runs  ended by   moved at the end by
   1  collision  Go 1

touched at             left  right  unseen  room  what it ran into
with the ball it held     1      0       –     –  wall 1

at: from straight ahead; unseen: the rays to both sides of it had read more room
than it went in the last tick; room: by the nearer of them, units, median

1 of 1 touches are of the ball that the claw held, which no sensor feels: have
Go keep farther away.
mindc view --seed 1/1 shows one: collision, in tick 264.
"""


@pytest.mark.parametrize("body", ["disc", "box size 4 1"])
def test_a_touch_is_on_the_rims_of_both(tmp_path: Path, body: str) -> None:
    path = tmp_path / "rules.mind"
    text = RULES.replace("Robot is disc", f"Robot is {body}")
    path.write_text(text.replace("  contains rock", "  contains crate is box size 2\n  contains rock"))
    rollout = mindlang.load(path).rollout("Roam", "Chase")
    touched = 0
    for seed in range(20):
        run = trace(rollout, seed)
        if not (ticks := joined(run.chunks)).touching[-1]:
            continue
        touch = last_touch(rollout, run.state)
        assert touch is not None
        x, y, angle = ticks.body[-1, :3]
        ahead, aside = touch.ahead, touch.aside
        there = np.array([x + ahead * cos(angle) - aside * sin(angle), y + ahead * sin(angle) + aside * cos(angle)])
        box = run.boxes[touch.box] if touch.box < len(run.boxes) else np.array([0, 0, 20, 20])  # the walls of the arena
        assert (np.abs(there - box[:2]) - box[2:]).max() == pytest.approx(0, abs=SLOP_UNITS)
        rim = hypot(ahead, aside) - 1 if body == "disc" else max(abs(ahead) - 2, abs(aside) - 0.5)
        assert rim == pytest.approx(0, abs=SLOP_UNITS)
        touched += 1
    assert touched > 3


def found(mindc: Call, path: Path, *words: object) -> dict[str, Any]:
    said = mindc("why", path, "--ends", "--runs", 40, *words, "--json", "--quiet")
    assert (said.code, said.err) == (0, "")
    data: dict[str, Any] = json.loads(said.out)
    return data


def test_what_the_claw_held_ran_into_a_wall(mindc: Call, tmp_path: Path) -> None:
    path = tmp_path / "go.mind"
    path.write_text(CARRYING)
    said = mindc("why", path, "--ends", "--quiet")
    assert (said.code, said.out, said.err) == (0, CARRIED, "")


def test_ends_are_those_of_bench_and_their_runs_can_be_made_again(mindc: Call, rules: Path) -> None:
    data = found(mindc, rules, "--task", "Roam")
    bench = json.loads(mindc("bench", rules, "--task", "Roam", "--runs", 40, "--json").out)
    assert data["ended"] == bench["ended"]
    end = data["ends"][-1]
    run = json.loads(mindc("run", rules, "--task", "Roam", "--seed", f"1/{end['run']}", "--json").out)
    assert (run["ticks"], run["ended_by"], run["seed"]) == (end["tick"], end["ended_by"], end["seed"])


@pytest.mark.parametrize(("looks", "said"), [(180, "where rays had read what came"), (0, "where no ray looks")])
def test_it_backs_into_a_wall_that_a_ray_sees_or_not(mindc: Call, rules: Path, looks: int, said: str) -> None:
    text = CARRYING.replace("at 0 deg", f"at {looks} deg").replace("wheel at 0.9", "wheel at 0.1")
    rules.write_text(text.replace("facing 0 deg", "facing 5 deg"))
    [end] = found(mindc, rules)["ends"]
    touch = end["run_into"]
    assert (touch["angle"], touch["what"], touch["by"]) == (pytest.approx(175, abs=1), "wall", None)
    assert touch["is_unseen"] is (looks == 0)
    assert said in " ".join(mindc("why", rules, "--ends").out.split())


def test_where_nothing_is_touched_it_says_so(mindc: Call, rules: Path) -> None:
    said = mindc("why", rules, "--task", "Chase", "--ends", "--runs", 3)
    assert said.out.endswith("Nothing ended any run: all lasted their time.\n")
    rules.write_text(rules.read_text().replace("lasts 1200 ticks", "lasts 1200 ticks\n  ends on reach of ball"))
    said = mindc("why", rules, "--task", "Chase", "--ends", "--runs", 3)
    assert "\n   3  reach of ball  Chase 3\n\nNo run ended as the robot ran into something.\n" in said.out
    outside = {"task": "Land", "master": "Land", "seed": 1, "runs": 3, "environment": "Moon-v3"}
    outside |= {"ended": {"its end": 3}}
    end = {"run": 1, "tick": 190, "ended_by": "its end", "in_control": None, "run_into": None}
    group = ends_text(outside | {"ends": [end]})
    assert isinstance(group, Group)
    assert "only Moon-v3 knows" in str(group.renderables[-2])


@pytest.mark.parametrize("words", [("left_wheel",), ("--tick", 3), ("--no-interruption",), ("--paths", 3)])
def test_what_has_no_part_in_it_is_refused(mindc: Call, rules: Path, words: tuple[object, ...]) -> None:
    said = mindc("why", rules, "--ends", *words)
    assert (said.code, said.out) == (2, "")
    assert "--ends" in said.err
