"""`mindc run --break`: the run ends where the first line of the file stops it."""

import json
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mindlang.breakpoints.resolve import breakpoints_of
from mindlang.breakpoints.subject import BreakpointSubject
from mindlang.breakpoints.watch import noticing, watcher
from mindlang.compiler.compile import load
from mindlang.compiler.source import Source
from mindlang.run.recorded_run import RecordedRun, record_run
from mindlang.run.setup import set_up
from tests.breakpoints.subjects import part
from tests.calling import Call
from tests.language.examples import COLLECT, ROOT

CHASE = ("--task", "Chase", "--seed", 3)


@pytest.fixture
def breaks(tmp_path: Path) -> Path:
    return tmp_path / "rules.break"


def found(mindc: Call, rules: Path, breaks: Path, text: str, *options: object, code: int = 1) -> dict[str, Any]:
    breaks.write_text(text)
    said = mindc("run", rules, *(options or CHASE), "--break", breaks, "--json")
    assert said.code == code, said.err
    data: dict[str, Any] = json.loads(said.out)
    return data


def recorded(rules: Path, task: str, text: str) -> tuple[RecordedRun, list[tuple[int, int]]]:
    """The run, and where each line stops it when its rows come in parts."""
    compiled = load(rules)
    setup = set_up(str(rules), compiled, task, None)
    assert compiled.mind
    subject = BreakpointSubject.of_run(compiled.mind.names, setup)
    read = breakpoints_of(Source("a.break", text), subject)
    assert read.diagnostics == ()
    noticed = noticing(setup, read.breakpoints)
    run = record_run(noticed, noticed.rollout(), 3)
    watching = watcher(read.breakpoints, noticed)
    stops = [stop for first in range(0, run.ticks, 50) for stop in watching.feed(part(run, first, first + 50))]
    return run, [(stop.tick, stop.breakpoint.line) for stop in stops]


def test_the_document_in_python_stops_where_the_command_does(
    mindc: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a mind whose lock has its skills in another order than they are declared in."""
    shutil.copytree(COLLECT.parent, tmp_path, ignore=shutil.ignore_patterns("runs"), dirs_exist_ok=True)
    code = (ROOT / "docs" / "breakpoints.md").read_text().partition("```python\n")[2].partition("```")[0]
    path, text = tmp_path / "collect.break", "stop when Avoid influences left_wheel above 70% and holding > 0.5\n"
    mind = tmp_path / "collect.mind"
    mind.write_text(mind.read_text().replace("lasts 30000 ticks", "lasts 1500 ticks"))
    monkeypatch.chdir(tmp_path)
    data = found(mindc, mind, path, text, "--task", "Collect", "--seed", 3)
    scope: dict[str, Any] = {}
    exec(code, scope)
    assert scope["compiled"].graph.skills != scope["setup"].ready.policy.graph.skills
    assert scope["stops"][0].tick == data["stopped"]["tick"]


def test_it_says_where_why_and_what_has_come_of_the_run(mindc: Call, rules: Path, breaks: Path) -> None:
    data = found(mindc, rules, breaks, "# the second\nstop on 2 reach of ball\nstop in tick 1199\n")
    (stop,) = data["stopped"]["by"]
    assert stop == {"file": str(breaks), "line": 2, "text": "stop on 2 reach of ball", "values": {"times": 2.0}}
    assert data["ticks"] == data["stopped"]["tick"] < 1199
    assert data["stopped"]["seconds"] == data["ticks"] / 60
    assert (data["counts"], data["by_event"]) == (2, {"reach of ball": 2})
    assert data["by_line"]["rewards 10 on reach of ball"] == 20
    assert sum(data["by_line"].values()) == pytest.approx(data["score"])


def test_for_people_it_names_the_line_and_its_values(mindc: Call, rules: Path, breaks: Path) -> None:
    breaks.write_text("stop when Turn influences left_wheel above 10% and left_wheel > 0\n")
    said = mindc("run", rules, *CHASE, "--break", breaks)
    assert said.code == 1
    assert "stopped in tick 1, after 0.02 s" in said.out
    assert f"{breaks}:1: stop when Turn" in said.out
    assert "Turn influences left_wheel 0.166667" in said.out
    assert "1 of 1,200, ended by a breakpoint" in said.out


def test_a_condition_may_ask_what_was_drawn(mindc: Call, tmp_path: Path, rules: Path, breaks: Path) -> None:
    mind = tmp_path / "drawn.mind"
    mind.write_text(f'use "{rules.name}"\nmaster Chase\ntask Sides is like Chase\n  draws side from -14 14\n')
    for seed in range(4):
        options = "--task", "Sides", "--seed", seed
        side = json.loads(mindc("run", mind, *options, "--json").out)["drawn"]["side"]
        data = found(mindc, mind, breaks, "stop when side > 0 and left_wheel >= 0\n", *options, code=int(side > 0))
        assert (data["stopped"] is None) == (side < 0)
        assert side < 0 or data["stopped"]["by"][0]["values"]["side"] == side


def test_where_nothing_stops_it_the_run_is_the_run(mindc: Call, rules: Path, breaks: Path) -> None:
    plain = json.loads(mindc("run", rules, *CHASE, "--json").out)
    assert found(mindc, rules, breaks, "stop when left_wheel > 2", code=0) == plain | {"stopped": None}
    assert "stopped nowhere" in mindc("run", rules, *CHASE, "--break", breaks).out


def test_a_line_that_holds_where_the_run_ends_leaves_its_end(mindc: Call, rules: Path, breaks: Path) -> None:
    roam = ("--task", "Roam", "--seed", 3, "--master", "Chase")
    plain = json.loads(mindc("run", rules, *roam, "--json").out)
    data = found(mindc, rules, breaks, "stop on collision", *roam)
    assert data["stopped"]["tick"] == plain["ticks"]
    assert {name: data[name] for name in plain} == plain


def test_an_event_that_the_task_does_not_name_changes_nothing_of_the_run(rules: Path) -> None:
    """A visit is noticed for the breakpoint alone; those of the task are in the columns where they were."""
    without, _ = recorded(rules, "Roam", "stop in tick 1")
    run, stops = recorded(rules, "Roam", "stop on visit of patch size 4\nstop on collision\n")
    assert {line for _, line in stops} >= {1}
    assert np.array_equal(run.body, without.body)
    assert np.array_equal(run.events[:, : without.events.shape[1]], without.events)
    visits = np.flatnonzero(np.diff(run.events[:, -1], prepend=0)) + 1
    assert [tick for tick, line in stops if line == 1] == visits.tolist()


def test_a_stop_on_a_share_is_where_the_share_is(rules: Path) -> None:
    """Chase has influence 1 and Turn 0.2, and both drive the wheel: a sixth of what arrives is from Turn."""
    _, stops = recorded(rules, "Chase", "stop when Turn influences left_wheel above 16%\n")
    assert stops == [(1, 1)]
    _, stops = recorded(rules, "Chase", "stop when Turn influences left_wheel above 17%\n")
    assert stops == []
    _, stops = recorded(rules, "Chase", "stop when Roam influences Turn above 20%\n")
    assert stops == [(1, 1)]  # 0.2 in float32 is a little more
    _, stops = recorded(rules, "Chase", "stop when Roam influences Turn above 21%\n")
    assert stops == []
    text = rules.read_text().replace("actuator left", "memory mood is cell decay 0.9\nactuator left")
    rules.write_text(text.replace("  drives left_wheel at 0.9", "  drives mood at 1\n  drives left_wheel at 0.9"))
    said = "stop when Turn influences left_wheel below 17%\nstop when Turn influences mood above 99%\n"
    assert recorded(rules, "Chase", said)[1] == [(1, 1), (1, 2)]


def test_the_picture_is_of_the_run_until_there(mindc: Call, rules: Path, breaks: Path, tmp_path: Path) -> None:
    breaks.write_text("stop in tick 100")
    said = mindc("run", rules, *CHASE, "--break", breaks, "--trace", tmp_path / "run.csv")
    assert said.code == 1
    assert "a row for each of 100 ticks" in said.err


def test_mistakes_are_reported_and_nothing_runs(mindc: Call, rules: Path, breaks: Path) -> None:
    breaks.write_text("stop on colision\n")
    said = mindc("run", rules, *CHASE, "--break", breaks)
    assert (said.code, said.out) == (1, "")
    assert "Did you mean collision?" in said.err
    rules.write_text(rules.read_text().replace("\n\nskill", "\nsensor gap is range_finder at 0 deg\n\nskill", 1))
    breaks.write_text("stop when left_wheel > 0 and 1 - gap > 0.5\n")
    said = mindc("run", rules, *CHASE, "--break", breaks)
    assert "Nobody measures gap in this run. [unmeasured-reading]" in said.err
    assert "Name a sensor that a skill below Roam or a reward reads, or that is wired." in said.err
    missing = mindc("run", rules, *CHASE, "--break", breaks.with_name("no.break"))
    assert (missing.code, missing.out) == (2, "")
    assert "cannot be read" in missing.err
