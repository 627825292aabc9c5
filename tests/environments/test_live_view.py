"""`render_mode="human"`: each step is a row of the page of `mindc view`; a new episode takes its place."""

import logging
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from queue import SimpleQueue
from typing import Any

import numpy as np
import pytest
from mindrun.robot.loop import Rate
from mindrun.robot.recording import read
from websockets.sync.client import connect
from websockets.typing import Origin

from mindlang.run.recorded_run import record_run
from mindlang.run.recording import run_bytes
from tests.calling import write_rules
from tests.view.serving import ViewingClient

gymnasium = pytest.importorskip("gymnasium")

from mindlang.environments import TaskEnv, live_view, register  # noqa: E402

ROOT = Path(__file__).parents[2]
PLAYABLE = (
    ("Chase is rule", "Chase is mlp hidden 2"),
    ("left_wheel at 3 * ball_bearing - 0.7", "left_wheel"),
    ("right_wheel at 2.3 - 3 * ball_bearing", "right_wheel"),
)


@pytest.fixture
def roam(tmp_path: Path) -> Path:
    return write_rules(tmp_path)


@pytest.fixture(autouse=True)
def opened(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The addresses at which a browser is opened; there is one, and no time passes."""
    found: list[str] = []

    def open_browser(address: str) -> bool:
        found.append(address)
        return True

    monkeypatch.setattr(live_view, "open_browser", open_browser)
    monkeypatch.setattr(live_view, "Rate", lambda tick: Rate(tick, clock=lambda: 0.0, sleep=lambda seconds: None))
    return found


@contextmanager
def seen(env: TaskEnv) -> Iterator[ViewingClient]:
    """A client at the page of an environment."""
    assert env.address
    host, token = re.fullmatch(r"http://(.*)/#(.*)", env.address).groups()
    with connect(f"ws://{host}/rows", origin=Origin(f"http://{host}"), compression=None, max_size=None) as client:
        client.send(token)
        yield ViewingClient(client)


def rows(about: dict[str, Any], viewer: ViewingClient, ticks: int) -> dict[str, np.ndarray]:
    """The groups of the rows 1 to `ticks` that a page is sent."""
    while viewer.hear("ticks")["known"] < ticks:
        pass
    frame = viewer.frame(say="rows", fork=0, **{"from": 1}, to=ticks + 1, every=1, ask=1)
    count = int(np.frombuffer(frame, "<u4", 6)[4])
    assert count == ticks
    doubles = np.frombuffer(frame, "<f8", count * about["doubles"], 24).reshape(count, -1)
    singles = np.frombuffer(frame, "<f4", count * about["singles"], 24 + doubles.nbytes).reshape(count, -1)
    return {
        name: (doubles, singles)[block][:, first : first + width]
        for name, (block, first, width) in about["columns"].items()
    }


def test_a_step_is_a_row_and_an_episode_a_run(roam: Path, opened: list[str]) -> None:
    env = TaskEnv(roam, "Roam", render_mode="human")
    assert env.address is None
    before, _ = env.reset(seed=4)
    assert opened == [env.address]
    with seen(env) as viewer:
        about = viewer.hear("about")
        assert (about["source"], about["task"], about["seed"], about["of_ticks"]) == ("environment", "Roam", "4", None)
        assert about["title"] == "Roam with Roam in charge, commanded by a program"
        actions = np.random.default_rng(1).random((30, 2)).astype(np.float32)
        read, paid = [before], [0.0]
        for action in actions:
            after, reward, *_ = env.step(action)
            read.append(after)
            paid.append(paid[-1] + reward)
        found = rows(about, viewer, 30)
        assert np.array_equal(found["commands"], actions)
        assert not found["influence"].any()
        assert not found["flow"].any()
        sensed = env._episodes.readings
        assert np.array_equal(found["readings"][:, sensed], read[:-1])
        assert found["rewards"].sum(axis=1) == pytest.approx(paid[1:])
        body = env._episodes.lanes.state.world.body
        assert np.array_equal(found["robot"][-1], body[:3, 0])
        viewer.say(say="why", fork=0, tick=3, actuator=0)
        assert "a program acts here" in viewer.hear("refused")["why"]
        viewer.say(say="change", fork=0, tick=3, what="reading", column=[1, 2], value=0.3, lasts=1)
        assert "recording is what it is" in viewer.hear("refused")["why"]

        env.reset(seed=5)
        again = viewer.hear("about")
        assert (again["seed"], again["title"]) == ("5", about["title"])
        env.step(actions[0])
        assert np.array_equal(rows(again, viewer, 1)["commands"], actions[:1])
    assert len(opened) == 1
    env.close()
    with pytest.raises(OSError, match="refused"), seen_at(opened[0]):
        pass


@contextmanager
def seen_at(address: str) -> Iterator[None]:
    with connect(re.sub("^http(.*)/#.*", r"ws\1/rows", address)):
        yield


def test_its_rows_are_those_of_a_recording(roam: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Of the run with the same commands; but for influence, as no skill acts."""
    added: list[Any] = []

    class Coming(SimpleQueue):  # type: ignore[type-arg]
        def put(self, item: Any, block: bool = True, timeout: float | None = None) -> None:
            added.append(item)
            super().put(item, block, timeout)

    monkeypatch.setattr(live_view, "SimpleQueue", Coming)
    env = TaskEnv(roam, "Roam", render_mode="human")
    setup = env._episodes.setup
    run = record_run(setup, setup.rollout(), 4)
    (tmp_path / "run.rec").write_bytes(run_bytes(run, setup, 4))
    about, parts = read(tmp_path / "run.rec")
    env.reset(seed=4)
    for commands in run.commands:
        env.step(commands)
    assert env._view
    assert replace(env._view._about, world=None) == replace(about, world=None, bundle="", sensors=())
    env.close()
    assert [each is None for each in added] == [True, *[False] * run.ticks, True]
    rows, expected = np.concatenate([each for each in added if each is not None]), np.concatenate([*parts])
    for name in ("tick", "time", "armed", "readings", "commands", "sent"):
        assert np.array_equal(rows[name], expected[name], equal_nan=True), name
    for name in about.row["world"].names:
        assert np.array_equal(rows["world"][name], expected["world"][name], equal_nan=True), name


def test_while_nothing_comes_nothing_is_added(roam: Path) -> None:
    env = TaskEnv(roam, "Roam", render_mode="human")
    env.reset(seed=4)
    assert env._view
    viewed = live_view._viewed(env._episodes, env._view._about, SimpleQueue())
    for _ in range(3):  # the beginning, and what comes after it
        viewed.grow()
        assert (viewed.known, viewed.over) == (0, False)
    env.close()


def test_the_end_of_an_episode_is_said(roam: Path) -> None:
    roam.write_text(roam.read_text("utf-8").replace("lasts 600 ticks", "lasts 20 ticks"), "utf-8")
    env = TaskEnv(roam, "Roam", render_mode="human")
    env.reset(seed=4)
    with seen(env) as viewer:
        over = False
        while not over:
            _, _, *ends, _ = env.step(np.full(2, 0.5, np.float32))
            over = any(ends)
        while (ticks := viewer.hear("ticks"))["known"] < 20:
            assert not ticks["over"]
    env.close()
    env.close()


def test_what_the_hierarchy_does_around_a_skill_that_is_played_is_shown(roam: Path) -> None:
    text = roam.read_text("utf-8")
    for old, new in PLAYABLE:
        assert old in text
        text = text.replace(old, new)
    roam.write_text(text, "utf-8")
    env = TaskEnv(roam, "Roam", "Roam", skill="Chase", render_mode="human")
    env.reset(seed=4)
    with seen(env) as viewer:
        about = viewer.hear("about")
        assert about["title"] == "Roam with Roam in charge, Chase played by a program"
        for _ in range(40):
            env.step(np.array([0.9, 0.4], np.float32))
        found = rows(about, viewer, 40)
        names = [node["name"] for node in about["nodes"]]
        influence = found["influence"]
        assert (influence[:, 0] == 1).all()  # the master's
        chase = [about["nodes"][names.index("Chase")]["columns"][0][1] - about["columns"]["influence"][1]]
        acts = influence[:, chase[0]] > 0
        assert acts.any()
        sent = [i for i, edge in enumerate(about["edges"]) if names[edge["from"]] == "Chase"]
        assert np.array_equal(found["flow"][:, sent] > 0, np.repeat(acts[:, None], len(sent), axis=1))
    env.close()


def test_without_a_browser_the_address_is_logged(
    roam: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(live_view, "open_browser", lambda address: False)
    with caplog.at_level(logging.WARNING):
        env = TaskEnv(roam, "Roam", render_mode="human")
        env.reset(seed=1)
    assert [record.getMessage() for record in caplog.records] == [f"the environment is seen at {env.address}"]
    env.close()


def test_a_program_that_forgets_to_close_it_ends_all_the_same(roam: Path) -> None:
    register(roam)
    program = (
        "import sys, numpy as np, gymnasium\n"
        "from mindlang.environments import register\n"
        "register(sys.argv[1])\n"
        "env = gymnasium.make('mind/Roam-v0', render_mode='human')\n"
        "env.reset(seed=1)\n"
        "for _ in range(5): env.step(np.full(2, 0.5, np.float32))\n"
    )
    words = [sys.executable, "-c", program, str(roam)]
    done = subprocess.run(words, capture_output=True, text=True, timeout=600, env=os.environ | {"DISPLAY": ""})
    assert done.returncode == 0, done.stderr
    assert done.stdout == ""
    assert [line.partition(" at ")[0] for line in done.stderr.splitlines()] in ([], ["the environment is seen"])


def test_another_way_to_render_is_refused(roam: Path) -> None:
    with pytest.raises(Exception, match='cannot be rendered as "ansi"') as raised:
        TaskEnv(roam, "Roam", render_mode="ansi")
    assert '"rgb_array" or "human"' in raised.value.hint
