"""Promises change nothing that is computed, and are counted over runs as they are judged in one."""

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mindrun.engine.promises import BY_SKILL, PromiseWatcher
from mindrun.sim.trace import Ticks, joined, trace

from mindlang.cli import _bench
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
FEW_TICKS = 4000
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


@pytest.fixture
def dock(tmp_path: Path) -> Path:
    path = tmp_path / "dock.mind"
    path.write_text(MIND, encoding="utf-8")
    return path


def bench(mindc: Call, *words: Any) -> dict[str, Any]:
    return dict(json.loads(mindc("bench", *words, "--json").out))


def test_a_bench_counts_what_its_runs_have(mindc: Call, dock: Path) -> None:
    whole: list[dict[str, Any]] = bench(mindc, dock, "--runs", 3)["promises"]
    setup = prepared(MIND)
    parts = [promises_in(setup.rollout(), "Feed", [seed]) for seed in setup.layouts(1, 3)]
    for i, each in enumerate(whole):
        assert each["runs"] == 3
        for name in each.keys() - {"skill", "promise"}:
            assert each[name] == sum(part[i][name] for part in parts)
        assert each["broken_runs"] == sum(part[i]["by_influence"] + part[i].get("by_skill", 0) > 0 for part in parts)
        assert each.get("broken_runs_by_skill", 0) == sum(part[i].get("by_skill", 0) > 0 for part in parts)
    assert whole[0]["by_influence"] > 0
    assert "SeekDock requires charge > 20%" in mindc("run", dock, "--seed", 1).out


def test_of_two_minds_a_bench_says_in_how_many_runs_each_breaks_a_promise(mindc: Call, dock: Path) -> None:
    other = dock.with_name("other.mind")
    other.write_text(MIND.replace("below 40%", "below 15%").replace("  maintains ahead > 40%\n", ""), encoding="utf-8")
    found = bench(mindc, dock, other, "--runs", 3)
    alone = [bench(mindc, path, "--runs", 3)["promises"] for path in (dock, other)]
    assert [mind["promises"] for mind in found["minds"]] == alone
    said = mindc("bench", dock, other, "--runs", 3).out.splitlines()
    assert [line.split("  ")[0] for line in said if line.startswith("SeekDock")] == [
        f"SeekDock {each['promise']}" for each in alone[0]
    ]
    broken = [f"{each[0]['broken_runs']} of 3" for each in alone]
    assert re.split("  +", next(line for line in said if "requires" in line))[1:] == broken
    assert next(line for line in said if "ahead" in line).endswith(" of 3       –")


@pytest.mark.parametrize(("how", "key", "here"), [("--worlds", "worlds", "as taught"), ("--credit", "skills", "whole")])
def test_where_a_promise_is_broken_in_most_runs_is_said(
    mindc: Call, dock: Path, monkeypatch: pytest.MonkeyPatch, how: str, key: str, here: str
) -> None:
    monkeypatch.setattr(_bench, "FEW_TICKS", FEW_TICKS)
    found, setup = bench(mindc, dock, "--runs", 4, how), prepared(MIND)
    few = promises_in(setup.rollout(), "Feed", setup.layouts(1, 4), FEW_TICKS)
    assert few[0]["runs"] == 3  # of 1,600 ticks
    there = {row.get("world", row.get("skill")): row.get("minds", [row])[0]["promises"] for row in found[key]}
    assert there.pop(here, found.get("promises")) == few
    said = mindc("bench", dock, "--runs", 4, how).out.splitlines()
    rows = said[next(place for place, line in enumerate(said) if line.startswith("promise broken in")) :]
    assert here in rows[0]
    for i, (each, row) in enumerate(zip(few, rows[1:], strict=True)):
        others = {name: of[i]["broken_runs"] for name, of in there.items() if name != "SeekDock"}
        most = max(others.values())
        name, *cells = re.split("  +", row)
        assert (name, cells[:2]) == (f"SeekDock {each['promise']}", [f"{each['broken_runs']} of 3", f"{most} of 3"])
        assert cells[2:] == [*others][[*others.values()].index(most) :][: most > each["broken_runs"]]
    assert max(map(len, rows)) <= 80
