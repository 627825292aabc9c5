"""Promises change nothing that is computed, and are counted over runs as they are judged in one."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mindrun.engine.promises import BY_SKILL, PromiseWatcher
from mindrun.sim.trace import Ticks, joined, trace

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source
from mindlang.run.promises import promises_in
from mindlang.run.setup import RunSetup, set_up
from tests.calling import Call

MIND = """\
tick 1/20 s
master Feed
body Rover is disc size 2
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor food_bearing is bearing of food
sensor dock_bearing is bearing of dock noise 2%
sensor charge is battery drain 3% per s charge 20% per s
sensor hungry is latch of charge below 40% above 90%
sensor in_dock is inside of dock noise 10%
sensor ahead is range_finder at 0 deg noise 10%
skill SeekFood is rule
  reads food_bearing
  drives left_wheel at 0.1 + food_bearing
  drives right_wheel at 1.1 - food_bearing
skill SeekDock is rule
  requires charge > 20%
  maintains ahead > 40%
  maintains charge > 10%
  achieves in_dock > 50%
  reads dock_bearing
  drives left_wheel at 0.1 + dock_bearing
  drives right_wheel at 1.1 - dock_bearing
skill Feed is rule
  reads hungry
  influences SeekDock at 1 when hungry > 0.5 otherwise 0
  influences SeekFood at 1 when hungry < 0.5 otherwise 0
task Feed in arena size 60
  contains food is item count 5 reached moves
  contains dock is power size 8
  lasts 80 s
  rewards in_dock per tick
"""
WATCHED = (
    MIND.replace("skill SeekFood", "sensor unsafe is broken SeekDock\nskill SeekFood")
    .replace("  reads hungry", "  reads hungry\n  reads unsafe")
    .replace("when hungry > 0.5", "when hungry > 0.5 and unsafe < 0.5")
)


def prepared(text: str) -> RunSetup:
    return set_up("drawn.mind", compile_source(Source("drawn.mind", text)), None, None)


def made(setup: RunSetup, seed: int) -> Ticks:
    return joined(trace(setup.rollout(), seed).chunks)


def test_a_promise_changes_nothing_that_is_computed() -> None:
    promised = ("requires", "maintains", "achieves")
    plain = "".join(line for line in MIND.splitlines(True) if line.split()[0] not in promised)
    one, other = made(prepared(MIND), 3), made(prepared(plain), 3)
    for name in ("body", "influence", "commands", "lines"):
        assert np.array_equal(getattr(one, name), getattr(other, name), equal_nan=True)
    assert np.isfinite(one.readings).all()
    assert np.isnan(other.readings).any()  # nobody reads what is ahead


@pytest.mark.parametrize("seed", range(3))
def test_a_broken_promise_is_read_in_the_tick_in_which_it_is_broken(seed: int) -> None:
    setup = prepared(WATCHED)
    graph, run = setup.ready.policy.graph, made(setup, seed)
    watcher = PromiseWatcher(graph, "Feed")
    judged = watcher.feed(run.readings, run.influence)
    maintains = [i for i, (_, promise) in enumerate(watcher.promises) if promise.word == "maintains"]
    place = next(sensor.start for sensor in graph.sensors if sensor.name == "unsafe")
    broken = (judged[:, maintains] >= BY_SKILL).any(axis=1)
    assert broken.any()
    assert np.array_equal(run.readings[:, place] > 0.5, broken)


def test_a_bench_counts_what_its_runs_have(mindc: Call, tmp_path: Path) -> None:
    path = tmp_path / "dock.mind"
    path.write_text(MIND, encoding="utf-8")
    whole: list[dict[str, Any]] = json.loads(mindc("bench", path, "--runs", 3, "--json").out)["promises"]
    setup = prepared(MIND)
    parts = [promises_in(setup.rollout(), "Feed", [seed]) for seed in setup.layouts(1, 3)]
    for i, each in enumerate(whole):
        assert each["runs"] == 3
        for name in each.keys() & {"held", "by_skill", "by_influence", "unfinished", "broken_runs"}:
            assert each[name] == sum(part[i][name] for part in parts)
    assert whole[0]["by_influence"] > 0
    assert "SeekDock requires charge > 20%" in mindc("run", path, "--seed", 1).out
