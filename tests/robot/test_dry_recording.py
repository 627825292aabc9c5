"""The recording of a dry run: it has the world, and the robot waits for none of it."""

import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Event, Thread
from time import monotonic, sleep
from types import SimpleNamespace

import numpy as np
import pytest
from mindrun.engine.engine import Engine
from mindrun.graph.bundle import Bundle, write_bundle
from mindrun.graph.policy import Policy
from mindrun.robot.dry_run import MAX_END_TICKS, DryRun
from mindrun.robot.recording import read
from mindrun.robot.replay import replay_recording
from mindrun.robot.world_server import SimulatedScene, WorldServer, listening
from mindrun.sim.commanded_lanes import CommandedWorld
from mindrun.terminal.standard_streams import StatusLine

from mindlang.compiler.compile import load
from mindlang.view.viewed_recording import viewed_recording
from tests.calling import RULES
from tests.robot.driving import MINDRUN, PATIENCE

NEVER_SECONDS = 1e6  # no tick of the world but those of the test


class Hesitant(SimulatedScene):
    """A world that answers while it is let."""

    def __init__(self, world: CommandedWorld) -> None:
        super().__init__(world)
        self.answers = Event()
        self.answers.set()

    def answer(self, what: bytes, name: str, value: float) -> bytes:
        """As any other, later."""
        self.answers.wait(PATIENCE)
        return super().answer(what, name, value)


@contextmanager
def served(scene: SimulatedScene) -> Iterator[str]:
    """The socket of a world that stands still by itself."""
    server = WorldServer(scene)
    with TemporaryDirectory() as folder, listening(Path(folder, "world")) as listener:
        thread = Thread(target=server.serve, args=(listener, NEVER_SECONDS))
        thread.start()
        try:
            yield str(Path(folder, "world"))
        finally:
            server.end()
            thread.join(PATIENCE)


def test_it_has_where_the_robot_was_what_was_paid_and_how_it_ended(rules: Path, tmp_path: Path) -> None:
    day, bundle = tmp_path / "day.rec", tmp_path / "rules.bundle"
    graph = load(rules).graph
    assert graph
    write_bundle(bundle, Bundle(Policy(graph, {}), {}))
    words = [*MINDRUN, bundle, "--dry", "--arm", "--task", "Roam", "--seed", "9", "--record", day]
    assert subprocess.run([*map(str, words)], timeout=PATIENCE * 3, check=False).returncode == 0
    about, parts = read(day)
    rows = np.concatenate([*parts])
    assert about.world
    assert (about.world.task, about.world.seed, len(about.world.boxes)) == ("Roam", 9, 9)
    assert len(set(rows["world"]["pose"][:, 0].tolist())) > 5
    assert (rows["world"]["ended"][0], rows["world"]["ended"][-1]) == (-3, 0)  # a collision ends it
    assert rows["world"]["rewards"][-1, 0] == -5
    assert replay_recording(day, bundle).differs is None
    for mind in (bundle, rules):
        viewed = viewed_recording(day, mind)
        while not viewed.over:
            viewed.grow()
        assert (viewed.failed, viewed.ended_by) == (None, "collision")
        ticks = np.arange(1, len(rows) + 1)
        assert viewed.group("robot", ticks).tobytes() == rows["world"]["pose"].tobytes()
        assert (viewed.about["task"], viewed.about["seed"]) == ("Roam", "9")


def test_it_has_its_end_however_long_a_tick_is(tmp_path: Path) -> None:
    """A row is a tick late: the loop goes on until the end is in one."""
    text = RULES.replace("tick 1/60 s", "tick 1/5 s").replace("lasts 600 ticks", "lasts 4 ticks")
    (tmp_path / "rules.mind").write_text(text, encoding="utf-8")
    graph = load(tmp_path / "rules.mind").graph
    assert graph
    bundle = tmp_path / "rules.bundle"
    write_bundle(bundle, Bundle(Policy(graph, {}), {}))
    day = tmp_path / "day.rec"
    words = [*MINDRUN, bundle, "--dry", "--arm", "--task", "Roam", "--record", day]
    assert subprocess.run([*map(str, words)], timeout=PATIENCE * 3, check=False).returncode == 0
    rows = np.concatenate([*read(day)[1]])
    assert (rows["world"]["ended"][0], rows["world"]["ended"][-1]) == (-3, -1)


def test_a_run_whose_recording_never_gets_the_end_ends(rules: Path) -> None:
    """So it is where a recording for a viewer alone was given up."""
    graph = load(rules).graph
    assert graph
    world = CommandedWorld(graph, "Roam", 3)
    with served(SimulatedScene(world)) as path:
        loop, line = SimpleNamespace(engine=Engine(Policy(graph, {}))), StatusLine(lambda sentence: None)
        recorded, plain = (DryRun(graph, world.task, "Roam", path, line, seed) for seed in (3, None))
        recorded._is_over = plain._is_over = True
        assert [recorded.watch(loop) for _ in range(MAX_END_TICKS + 2)] == [True] * MAX_END_TICKS + [False] * 2  # type: ignore[arg-type]
        assert not plain.watch(loop)  # type: ignore[arg-type]
        for run in (recorded, plain):
            with run.shown():
                pass


def test_a_recorder_waits_for_no_world(rules: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What was answered last is recorded, however long the world is silent, and what it answers then a row later."""
    monkeypatch.setattr("mindrun.robot.simulated_world.EXCHANGE_SECONDS", PATIENCE)
    graph = load(rules).graph
    assert graph
    world = CommandedWorld(graph, "Roam", 3)
    scene = Hesitant(world)
    with served(scene) as path:
        seen = DryRun(graph, world.task, "Roam", path, StatusLine(lambda sentence: None), 3)
        loop, first = SimpleNamespace(engine=Engine(Policy(graph, {}))), list(world.pose)
        assert seen.about
        assert (seen.about.begin[:3], seen.about.things) == (tuple(first), 1)

        def recorded() -> list[float]:
            seen.watch(loop)  # type: ignore[arg-type]
            return list(seen.latest()["pose"][0])

        with seen.shown():
            scene.answers.clear()
            assert all(recorded() == first for _ in range(1000))
            for _ in range(10):
                world.step([1.0, 0.0])
            scene.answers.set()
            end = monotonic() + PATIENCE
            while recorded() != list(world.pose):
                assert monotonic() < end
                sleep(0.01)
            assert not seen.has_ended
            while world.ended is None:
                world.step([1.0, 0.0])
            while not seen.has_ended:
                assert monotonic() < end
                recorded()
                sleep(0.01)
    assert list(world.pose) != first


def test_a_world_is_the_run_of_mindc_column_by_column(rules: Path) -> None:
    """Under the commands of the same mind each row is that of `mindc run --record`."""
    from mindlang.run.recorded_run import record_run
    from mindlang.run.setup import set_up

    setup = set_up(str(rules), load(rules), "Roam", None)
    run = record_run(setup, setup.rollout(), 3)
    graph = setup.ready.policy.graph
    world, engine = CommandedWorld(graph, "Roam", 3), Engine(Policy(graph, {}))
    for tick in range(run.ticks):
        now = world.columns()
        assert np.array_equal(now["pose"], run.body[tick])
        assert np.array_equal(now["things"][:, :3], run.things[tick], equal_nan=True)
        assert (int(now["held"]), now["ended"]) == (run.held[tick], -3)
        world.step(engine.tick(world.readings()))
    last = world.columns()
    assert np.array_equal(last["pose"], run.body[-1])
    assert np.array_equal(last["rewards"], run.lines[-1])
    assert np.array_equal(last["events"], run.events[-1])
    assert (bool(last["touching"]), int(last["ended"])) == (bool(run.touching[-1]), run.ended)
