"""Worlds at the bounds of every number: each run ends, in a result and never in a signal."""

import json
import signal
import subprocess
import sys
import time
from math import inf
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.graph.policy import Policy
from mindrun.kinds import registry
from mindrun.numbers.quantity import Quantity
from mindrun.sim.rollout import Rollout

from tests.draws import cases
from tests.sim.minds import compile_text

MIND = """
tick {tick} s
master Go
body Robot is disc size {size} density {density} linear_damping {damping} angular_damping {damping}
actuator left_wheel is wheel side left neutral 0.5 thrust {thrust}
actuator right_wheel is wheel side right neutral 0.5 thrust {other}
actuator claw is gripper neutral 0 reach {reach}
sensor eyes is range_finder at -360 0 90 deg range {range}
sensor way is bearing of ball
sensor turn is derivative of way range {range}
sensor speed is inertial range {range}
sensor beat is sine period {period} s
skill Go is rule
  reads eyes
  reads way
  reads turn
  reads speed
  reads beat
  drives left_wheel at {left}
  drives right_wheel at 0.5 + turn - beat
  drives claw at 1 - beat
task Far in {scene}
  contains ball is item size {thing}
  contains home is zone size {thing}
  contains rock is obstacle count 3 size {rock}
  lasts {ticks} ticks
  ends on exhaustion
  rewards progress toward ball + 10 * forward per tick
  rewards 1000000000000 on reach of home
  counts collision
sensor battery is battery
"""
PLAIN = {
    "tick": "1/60", "size": 2, "density": 2, "damping": 5, "thrust": 80, "other": 80, "reach": 1.5, "range": 12,
    "period": 1, "left": 1, "scene": "plain", "thing": 1, "rock": 1, "ticks": 500,
}  # fmt: skip
BOUNDS = {
    "tick": ("0.00001", 1000), "size": (0.01, 1000), "density": (0.001, 10**6), "damping": (0, 10**6),
    "thrust": (-(10**6), 10**6), "other": (-(10**6), 10**6), "reach": (0, 10**5), "range": ("0.000001", 10**6),
    "period": ("0.000001", 10**9), "left": (0, 1, 0.5),
    "scene": ("plain", "arena size 0.01", "arena size 100000", "arena size 50"), "thing": (0, 10**5),
    "rock": (0, 10**5), "ticks": (1, 500),
}  # fmt: skip
worlds = st.fixed_dictionaries({name: st.sampled_from((PLAIN[name], *BOUNDS[name])) for name in BOUNDS})

CALLED = """
import sys, json, numpy as np
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source
for line in sys.stdin:
    graph = compile_source(Source("test.mind", json.loads(line))).graph
    if graph:  # else it is refused: the robot does not fit into its world
        Rollout(Policy(graph, {}), "Far", "Go", lanes=3).score(np.zeros((1, 0), np.float32), range(5))
    print("over", flush=True)
"""


def test_every_number_of_every_kind_has_two_bounds() -> None:
    nouns = ("actuator", "sensor", "memory", "body", "task", "content", "skill", "event", "measure", "curriculum")
    found = [
        (noun, name, argument.key, argument.type)
        for noun in nouns
        for name, cls in registry.kinds(noun).items()
        for argument in registry.arguments(cls)
        if isinstance(argument.type, Quantity)
    ]
    assert len(found) > 50
    assert [(noun, name, key) for noun, name, key, of in found if not -inf < of.low < of.high < inf] == []


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(1, 7))
def test_a_robot_that_flies_for_ever_ends_its_run(seed: int) -> None:
    text = MIND.format(**PLAIN | {"density": 0.001, "damping": 0, "thrust": 10**6, "other": 10**6, "ticks": 200_000})
    text = text.replace("right_wheel at 0.5 + turn - beat", "right_wheel at 1")
    scores = Rollout(Policy(compile_text(text), {}), "Far", "Go").score(np.zeros((1, 0), np.float32), [seed])
    assert scores.ended_by[0, 0] == -2
    assert scores.faults[0, 0] >= 1
    assert scores.ticks[0, 0] < 200_000


@pytest.mark.slow
@settings(max_examples=cases(300), deadline=None)
@given(said=st.lists(worlds, min_size=20, max_size=20))
def test_no_world_ends_in_a_signal(said: list[dict[str, object]]) -> None:
    lines = "".join(json.dumps(MIND.format(**PLAIN | each)) + "\n" for each in said)
    ended = subprocess.run(
        [sys.executable, "-c", CALLED], input=lines, capture_output=True, text=True, timeout=600, check=False
    )
    assert ended.returncode == 0, ended.stderr
    assert len(ended.stdout.split()) == len(said)


@pytest.mark.slow
@pytest.mark.parametrize("name", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_a_bench_in_the_middle_of_a_slice(tmp_path: Path, name: signal.Signals) -> None:
    path = tmp_path / "m.mind"
    path.write_text(MIND.format(**PLAIN | {"ticks": 10_000_000}))
    call = [
        sys.executable,
        "-c",
        "from mindlang.cli import main; main()",
        "bench",
        path,
        "--runs",
        "100000",
        "--workers",
        "1",
    ]
    bench = subprocess.Popen(call, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    try:
        time.sleep(15)  # it computes by now, or compiles: both must end
        bench.send_signal(name)
        assert bench.wait(60) in (130, -name)
    finally:
        bench.kill()
