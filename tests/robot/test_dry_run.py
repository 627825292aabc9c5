"""`mindrun --dry`: what it says before, while and after it drives, and that the robot waits for none of it."""

import os
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from time import sleep
from types import SimpleNamespace

import numpy as np
import pytest
from mindrun.driver import DeviceError
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Graph, Task, Thing
from mindrun.graph.policy import Policy
from mindrun.robot.dry_run import MAX_THINGS_NAMED, DryRun, beginning, outcome
from mindrun.robot.recording import read
from mindrun.robot.world_server import SimulatedScene
from mindrun.sim.commanded_lanes import CommandedWorld
from mindrun.sim.rollout import Rollout
from mindrun.terminal.standard_streams import CLEAR, PLAIN_SECONDS, StatusLine, error_columns

from mindlang.compiler.compile import load
from tests.calling import RULES, write_rules
from tests.robot.driving import MINDRUN, PATIENCE
from tests.robot.test_dry_recording import served
from tests.robot.test_world import until
from tests.sim.minds import compile_text

STATUS = {
    "seed": 3, "tick": 90, "events": {"reach of ball": 2, "collision": 0}, "ended": None,
    "commands": {"left_wheel": 0.5, "right_wheel": 1.0},
    "by_line": {"rewards 10 on reach of ball": 20.0, "rewards -5": -0.5}, "score": 19.5,
}  # fmt: skip


@pytest.fixture
def roam(tmp_path: Path) -> Graph:
    graph = load(write_rules(tmp_path)).graph
    assert graph
    return graph


def task_of(graph: Graph, name: str) -> Task:
    return next(task for task in graph.tasks if task.name == name)


# What is said before and after


def test_it_begins_with_world_task_seed_and_how_to_end_it(roam: Graph) -> None:
    assert beginning(roam, task_of(roam, "Roam"), "Roam", 7) == [
        "dry run: Roam with Roam in charge, in a world of 40 x 40 with rock, ball, seed 7",
        "no device is touched: the world is simulated, in real time",
        "it ends with its run, after 600 ticks (10 s) at the latest; Ctrl-C ends it now",
    ]
    assert "in a world without walls with ball," in beginning(roam, task_of(roam, "Chase"), "Roam", 7)[0]


def test_a_world_full_of_things_is_named_by_some(roam: Graph) -> None:
    task = task_of(roam, "Roam")
    things = tuple(Thing(f"thing_{number % 20}", task.things[-1].kind) for number in range(40))
    first = beginning(roam, replace(task, things=things), "Roam", 7)[0]
    assert first.count("thing_") == MAX_THINGS_NAMED
    assert f"{20 - MAX_THINGS_NAMED} more" in first


@pytest.mark.parametrize(
    ("ended", "said"),
    [
        (None, "ended before it was over"),
        ("time", "lasted its time"),
        ("collision", "ended by collision"),
        ("success: reach of ball", "ended by reach of ball, a success"),
    ],
)
def test_it_ends_with_what_came_of_the_run(roam: Graph, ended: str | None, said: str) -> None:
    assert outcome(task_of(roam, "Roam"), "Chase", STATUS | {"ended": ended}) == [
        "Roam with Chase in charge",
        "  seed  3",
        "events  2 × reach of ball",
        "        0 × collision",
        f" ticks  90 of 600, {said}",
        "",
        "20.00  rewards 10 on reach of ball",
        "-0.50  rewards -5",
        "19.50  score",
    ]


def test_a_score_that_is_no_number_is_said(roam: Graph) -> None:
    broken = {"by_line": {"rewards 1": float("nan")}, "score": float("nan")}
    lines = outcome(task_of(roam, "Roam"), "Roam", STATUS | broken)
    assert lines[-1] == "not a number  score"


@pytest.mark.parametrize("task", ["Roam", "Chase"])
def test_the_world_is_paid_as_the_same_run_of_mindc(roam: Graph, task: str) -> None:
    """Every reward line to the last bit: before the end of the run, and after it."""
    rollout = Rollout(Policy(roam, {}), task, roam.master)
    world, engine = CommandedWorld(roam, task, 3), Engine(Policy(roam, {}))
    while world.ended is None:
        last = world.by_line
        world.step(engine.tick(world.readings()))
    scores = rollout.score(np.zeros((1, 0), np.float32), [3])
    texts = [reward.text for reward in task_of(roam, task).rewards]
    assert world.by_line == dict(zip(texts, scores.by_line[0, 0].tolist(), strict=True))
    assert world.score == scores.total[0, 0]
    assert world.by_line != last
    assert world.tick == scores.ticks[0, 0]


def test_lines_of_one_text_come_to_the_score_of_mindc_in_their_order(tmp_path: Path) -> None:
    large = "10000000000000000"
    paid = ["0.1", large, f"-{large}", "0.1"]
    lines = "\n".join(f"  rewards {amount} per tick" for amount in paid)
    text = RULES.replace("  rewards -5 on collision", lines)
    (tmp_path / "roam.mind").write_text(text, encoding="utf-8")
    graph = load(tmp_path / "roam.mind").graph
    assert graph
    rollout = Rollout(Policy(graph, {}), "Roam", graph.master)
    world, engine = CommandedWorld(graph, "Roam", 3), Engine(Policy(graph, {}))
    while world.ended is None:
        world.step(engine.tick(world.readings()))
    assert world.score == rollout.score(np.zeros((1, 0), np.float32), [3]).total[0, 0]
    assert world.score != sum(world.by_line.values())
    assert len(world.by_line) == len(rollout.task.rewards) - 1


MEMORY = """\
tick 1/20 s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
memory count is cell decay 0.9 start 20%
sensor pulse is sine period 0.7 s
skill Go is rule
  reads pulse
  drives count at pulse
  drives left_wheel at 0.6
task Look in arena size 40
  lasts 60 ticks
  ends when count > 55%
  rewards count per tick
"""


def test_what_is_paid_for_a_memory_is_that_of_the_mind_that_commands() -> None:
    graph = compile_text(MEMORY)
    world, engine = CommandedWorld(graph, "Look", 3), Engine(Policy(graph, {}))
    while world.ended is None:
        commands = engine.tick(world.readings())
        world.remember({"count": float(engine.readings[graph.memories[0].start])})
        world.step(commands)
    scores = Rollout(Policy(graph, {}), "Look", "Go").score(np.zeros((1, 0), np.float32), [3])
    assert world.score == scores.total[0, 0]
    assert world.tick == scores.ticks[0, 0] < 60


def test_the_world_is_told_the_memories_of_the_mind() -> None:
    graph = compile_text(MEMORY)
    scene, engine = SimulatedScene(CommandedWorld(graph, "Look", 3)), Engine(Policy(graph, {}))
    with served(scene) as path:
        run = DryRun(graph, graph.tasks[0], "Go", path, StatusLine(print))
        with run.shown():
            for _ in range(3):
                engine.tick(np.zeros(graph.width, np.float32))
                run.watch(SimpleNamespace(engine=engine))  # type: ignore[arg-type]
                now = {"count": float(engine.readings[graph.memories[0].start])}
                until(lambda now=now: scene.memories == now)  # type: ignore[misc]
        scene.tick()
    assert scene.status()["score"] == now["count"]


def test_a_dry_run_ends_when_its_world_does(roam: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mindrun.robot.dry_run.SHOW_SECONDS", 0.001)
    run = DryRun(roam, task_of(roam, "Roam"), "Roam", "nowhere", StatusLine(print))
    loop = SimpleNamespace(engine=Engine(Policy(roam, {})))

    def until_lost() -> None:
        while run.watch(loop):  # type: ignore[arg-type]
            sleep(0.001)

    with pytest.raises(DeviceError, match="the simulated world at nowhere does not answer"), run.shown():
        until_lost()


# The line while it drives


def test_the_line_has_time_who_acts_events_score_and_commands(roam: Graph) -> None:
    run = DryRun(roam, task_of(roam, "Roam"), "Roam", "nowhere", StatusLine(print))
    assert (
        run.state(STATUS) == "1.5 s, tick 90 of 600  2 × reach of ball  score 19.50  left_wheel 0.50  right_wheel 1.00"
    )

    class Loop:
        engine = Engine(Policy(roam, {}))

    Loop.engine.tick(np.ones(roam.width, np.float32))
    assert run.watch(Loop)  # type: ignore[arg-type]
    assert "600  Chase 1.00, Turn 0.20  2 ×" in run.state(STATUS)
    Loop.engine.influence[:] = 0.0
    assert "  nobody acts  " in run.state(STATUS)


class Terminal:
    """What is drawn and said, of a terminal so wide."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, columns: int | None, is_read: bool = True) -> None:
        self.now, self.words, self.is_read = 0.0, list[str](), is_read
        monkeypatch.setattr("mindrun.terminal.standard_streams.draw", lambda text: self.words.append(text))
        monkeypatch.setattr("mindrun.terminal.standard_streams.is_error_read", lambda: self.is_read)
        self.line = StatusLine(self.words.append, clock=lambda: self.now, columns=lambda: columns)


def test_a_terminal_has_one_line_that_is_rewritten_below_what_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal(monkeypatch, 10)
    terminal.line.show("one line that is too long")
    terminal.line.show("two\x1b[2J")
    terminal.line.tell("a sentence")
    terminal.line.tell("another")
    terminal.line.show("three")
    terminal.line.clear()
    terminal.line.clear()
    assert terminal.words == [
        f"{CLEAR}one line ", f"{CLEAR}two\\u001b", CLEAR, "a sentence", "another", f"{CLEAR}three", CLEAR,
    ]  # fmt: skip


def test_elsewhere_a_line_is_printed_now_and_then(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal(monkeypatch, None)
    for number in range(25):
        terminal.now = float(number)
        terminal.line.show(f"{number} s")
    assert terminal.words == [f"{number} s" for number in range(0, 25, round(PLAIN_SECONDS))]


@pytest.mark.parametrize(
    ("is_terminal", "kind", "columns", "found"),
    [(True, "xterm", 132, 132), (True, "xterm", 0, 80), (True, "dumb", 132, None), (False, "xterm", 132, None)],
)
def test_how_wide_the_terminal_is(
    monkeypatch: pytest.MonkeyPatch, is_terminal: bool, kind: str, columns: int, found: int | None
) -> None:
    monkeypatch.setenv("TERM", kind)
    monkeypatch.setattr("os.isatty", lambda number: is_terminal)
    monkeypatch.setattr("os.get_terminal_size", lambda number: os.terminal_size((columns, 24)))
    assert error_columns() == found


def test_a_terminal_that_is_paused_gets_no_more_lines(monkeypatch: pytest.MonkeyPatch) -> None:
    """Else they would push the sentences out that wait to be read."""
    terminal = Terminal(monkeypatch, 80, is_read=False)
    terminal.line.show("one")
    terminal.line.tell("a sentence")
    terminal.is_read = True
    terminal.line.show("two")
    assert terminal.words == ["a sentence", f"{CLEAR}two"]


@contextmanager
def terminal() -> Iterator[tuple[int, int]]:
    """Both ends of a terminal: what reads it, and what a program writes to."""
    reading, writing = os.openpty()
    try:
        yield reading, writing
    finally:
        os.close(reading)


def heard(reading: int) -> str:
    """All that is written to a terminal until nobody has its other end any more."""
    said = b""
    with suppress(OSError):
        while True:
            said += os.read(reading, 4096)
    return said.decode()


def begun(bundle: Path, writing: int, *words: str) -> "subprocess.Popen[bytes]":
    """A dry run on that terminal."""
    words = (*MINDRUN, str(bundle), "--dry", "--arm", *words)
    return subprocess.Popen(words, stderr=writing, env=os.environ | {"TERM": "xterm"})


def test_on_a_terminal_the_line_is_rewritten_until_the_outcome(quick: Path) -> None:
    with terminal() as (reading, writing):
        process = begun(quick, writing)
        os.close(writing)
        states, _, result = heard(reading).rpartition(CLEAR)
        assert process.wait(PATIENCE) == 0
    assert CLEAR in states
    assert " of 20  Go " in states
    assert "ticks  20 of 20, lasted its time\r\n" in result


def test_a_robot_drives_on_where_its_terminal_is_paused(bundle: Path, tmp_path: Path) -> None:
    """Nothing is read until it has ended: it ends all the same, with all its ticks."""
    day = tmp_path / "day.rec"
    with terminal() as (_reading, writing):
        os.set_blocking(writing, False)
        with suppress(BlockingIOError):
            while True:
                os.write(writing, b"x" * 1024)
        os.set_blocking(writing, True)
        process = begun(bundle, writing, "--ticks", "15", "--record", str(day))
        assert process.wait(PATIENCE) == 0
        os.close(writing)
    _, (rows,) = read(day)
    assert len(rows) == 15
