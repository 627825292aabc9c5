"""The benchmarks are honest: both programs do the same work."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_plain_pymunk_loop_goes_where_the_lanes_go(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    from plain_pymunk import Robot
    from workloads import collect, random_weights

    graph = collect()[0]
    weights = random_weights(graph, 4)
    run = trace(Rollout(Policy(graph, weights), "Collect", "Collect", interrupt=False), seed)
    robot = Robot(graph, weights, run, seed)
    for moment in run.moments:
        robot.tick()
        if moment.tick == 400:
            break
    assert (*robot.body.position, robot.body.angle) == pytest.approx(moment.body[:3], abs=0.01)
    assert robot.score == pytest.approx(moment.lines.sum(), abs=1e-4)
    assert np.hypot(*(moment.body[:2] - run.begin[:2])) > 2


@pytest.mark.slow
def test_check_is_timed() -> None:
    command = [sys.executable, "-m", "benchmarks.check", "--rounds", "1", "--only", "check", "--json"]
    done = subprocess.run(command, cwd=BENCHMARKS.parent, capture_output=True, text=True, check=True)
    cpu, wall, ours, all_ = json.loads(done.stdout)["check"]["here"]
    assert min(cpu, wall) > 0
    assert 10 < ours < all_
