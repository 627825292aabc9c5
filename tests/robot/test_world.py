"""The simulated world: bit for bit that of training, and a process that any number of clients can talk to."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from math import inf, nan
from pathlib import Path
from socket import AF_UNIX, SOCK_STREAM, socket
from tempfile import TemporaryDirectory
from threading import Thread

import numpy as np
import pytest
from mindrun.driver import DeviceError
from mindrun.engine.engine import Engine
from mindrun.errors import MindError
from mindrun.graph.bundle import Bundle, write_bundle
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.wiring import flaws
from mindrun.kinds.registry import kinds
from mindrun.robot.drivers.simulated import SimulatedActuator, SimulatedSensor
from mindrun.robot.dry_run import simulated_wiring
from mindrun.robot.simulated_world import READ, REQUEST, STATUS, WRITE, WorldConnection, simulated, status
from mindrun.robot.world_server import SimulatedScene, WorldServer, listening
from mindrun.sim.commanded_lanes import CommandedWorld
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from mindlang.compiler.compile import load
from mindlang.run.setup import set_up
from tests.calling import RULES, write_rules
from tests.sim.test_rollout import some_weights

COLLECT = Path(__file__).parents[2] / "examples" / "collect"
PATIENCE = 600.0  # seconds; the simulator may have to be compiled
STILL = """task Still in plain
  contains ball is item size 2
  lasts 3 ticks
  rewards 1 * forward per tick
"""


@pytest.fixture(autouse=True)
def patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """A shared machine takes its time."""
    monkeypatch.setattr("mindrun.robot.simulated_world.EXCHANGE_SECONDS", PATIENCE)


def graph_of(path: Path) -> Graph:
    graph = load(path).graph
    assert graph
    return graph


def until(holds: Callable[[], object]) -> None:
    """Wait until something is true."""
    end = time.monotonic() + PATIENCE
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.01)


# The world


def follow(graph: Graph, weights: dict[str, np.ndarray], task: str, seed: int, most: int = 500) -> int:
    """The engine in a CommandedWorld and the lanes: the same readings, commands and places; for how many ticks."""
    world, engine = CommandedWorld(graph, task, seed), Engine(Policy(graph, weights))
    delayed = any(actuator.kind.delay for actuator in graph.actuators)
    moments = trace(Rollout(Policy(graph, weights), task, graph.master), seed).moments
    for moment, _ in zip(moments, range(most), strict=False):
        assert world.ended is None
        readings = world.readings()
        commands = engine.tick(readings)
        world.step(commands)
        assert np.array_equal(readings, moment.readings)
        assert np.array_equal(engine.influence, moment.influence)
        assert delayed or np.array_equal(commands, moment.commands)
        assert world.pose == tuple(moment.body[:3])
        assert world.tick == moment.tick
    assert (world.ended is not None) == (next(moments, None) is None)
    return world.tick


@pytest.mark.parametrize(
    ("mind", "task"), [("collect", "Collect"), ("collect", "GoToObject"), ("ball", "Reach"), ("ball", "Avoid")]
)
def test_the_world_is_that_of_training(mind: str, task: str) -> None:
    graph = graph_of(COLLECT / f"{mind}.mind")
    ticks = [follow(graph, some_weights(graph, seed + 3), task, seed, 200) for seed in range(2)]
    assert max(ticks) == 200


def test_the_shipped_mind_does_there_what_it_has_learnt() -> None:
    path = COLLECT / "collect.mind"
    ready = set_up(str(path), load(path), "Collect", None).ready
    weights = {name: np.asarray(genome) for name, genome in ready.policy.weights.items()}
    assert follow(ready.policy.graph, weights, "Collect", 5, 600) > 500


def test_commands_wait_as_in_training() -> None:
    graph = graph_of(COLLECT / "ball.mind")
    late = tuple(replace(a, kind=replace(a.kind, delay=3)) for a in graph.actuators)
    assert follow(replace(graph, actuators=late), some_weights(graph, 5), "GoToObject", 1) == 500


@pytest.fixture
def roam(tmp_path: Path) -> Graph:
    return graph_of(write_rules(tmp_path))


def test_a_run_that_has_ended_stands_still(roam: Graph) -> None:
    world = CommandedWorld(roam, "Roam", 1)
    while world.ended is None:
        world.step([1, 1])
    tick, pose = world.tick, world.pose
    assert (world.ended, world.events) == ("collision", {"collision": 1, "reach of ball": 0})
    world.step([0, 0])
    assert (world.tick, world.pose) == (tick, pose)


def test_a_run_ends_with_its_time_even_where_nothing_can_happen(tmp_path: Path) -> None:
    (tmp_path / "still.mind").write_text(RULES.partition("task Chase")[0] + STILL, encoding="utf-8")
    world = CommandedWorld(graph_of(tmp_path / "still.mind"), "Still", 1)
    for _ in range(5):
        world.step([0.5, 0.5])
    assert (world.tick, world.ended, world.events) == (3, "time", {})


def test_a_command_that_is_no_number_is_neutral(roam: Graph) -> None:
    world, other = CommandedWorld(roam, "Roam", 1), CommandedWorld(roam, "Roam", 1)
    for command in (nan, inf, -inf):
        world.step([0.8, command])
        other.step([0.8, 0.5])
    assert world.pose == other.pose


def test_there_must_be_such_a_task_and_master(roam: Graph) -> None:
    with pytest.raises(MindError, match="there is no task Fly"):
        CommandedWorld(roam, "Fly", 1)
    with pytest.raises(MindError, match="there is no skill Fly"):
        CommandedWorld(roam, "Roam", 1, "Fly")


# What clients are told


@dataclass
class Counting:
    """A world whose readings are the number of the tick, and whose runs end after `lasts` ticks."""

    graph: Graph
    lasts: int = 1 << 30
    seed: int = 0
    tick: int = 0
    pose: tuple[float, float, float] = (1.0, 2.0, 3.0)
    events: dict[str, int] = field(default_factory=dict)
    by_line: dict[str, float] = field(default_factory=dict)
    score: float = 0.0
    given: list[float] = field(default_factory=list)

    @property
    def ended(self) -> str | None:
        return "time" if self.tick >= self.lasts else None

    def readings(self) -> np.ndarray:
        return np.full(self.graph.width, self.tick, np.float32)

    def step(self, commands: list[float]) -> None:
        self.tick += self.ended is None
        self.given = commands

    def remember(self, cells: dict[str, float]) -> None: ...

    def begin(self, seed: int) -> None:
        self.seed, self.tick = seed, 0


@contextmanager
def served(world: Counting, path: Path | None = None) -> Iterator[tuple[str, WorldServer]]:
    """A server of that world in a thread, which ticks a thousand times a second."""
    server = WorldServer(SimulatedScene(world))
    with TemporaryDirectory() as folder, listening(path or Path(folder, "world")) as listener:
        thread = Thread(target=server.serve, args=(listener, 0.001))
        thread.start()
        try:
            yield str(path or Path(folder, "world")), server
        finally:
            server.end()
            thread.join(PATIENCE)
            assert not thread.is_alive()


def connected(path: str) -> socket:
    client = socket(AF_UNIX, SOCK_STREAM)
    client.settimeout(PATIENCE)
    client.connect(path)
    return client


def hangs_up(client: socket) -> bool:
    """Whether the server has cut a client off, which has read all that it was told before."""
    with suppress(ConnectionError):
        while client.recv(1 << 16):
            pass
    return True


def request(what: bytes, name: bytes, value: float = 0.0) -> bytes:
    return REQUEST.pack(what, len(name), value) + name


def test_sensors_are_read_and_actuators_are_written(roam: Graph) -> None:
    world = Counting(roam)
    with served(world) as (path, _):
        feeler = SimulatedSensor(path, "feeler", 3).open()
        first = feeler.read()
        assert len(set(first)) == 1
        assert len(first) == 3
        until(lambda: feeler.read() > first)
        wheel = SimulatedActuator(path, "right_wheel").open()
        assert status(path)["commands"] == {"left_wheel": 0.5, "right_wheel": 0.5}
        wheel.write(0.125)
        until(lambda: world.given == [0.5, 0.125])
        found = status(path)
        assert (found["pose"], found["ended"], found["seed"]) == ([1.0, 2.0, 3.0], None, 0)
        feeler.close()
        wheel.close()
        with pytest.raises(DeviceError, match="closed"):
            wheel.write(0.5)


def test_what_is_not_there_is_refused_and_nothing_else_happens(roam: Graph) -> None:
    world = Counting(roam)
    with served(world) as (path, _):
        with pytest.raises(DeviceError, match="there is no sensor nose"):
            SimulatedSensor(path, "nose").open()
        with pytest.raises(DeviceError, match="feeler has 3 readings there, not 1"):
            SimulatedSensor(path, "feeler", 1).open()
        with pytest.raises(DeviceError, match="there is no actuator tail"):
            SimulatedActuator(path, "tail").open()
        wheel = SimulatedActuator(path, "left_wheel").open()
        for value in (-0.1, 1.1, nan, inf):
            with pytest.raises(DeviceError, match="not between 0 and 1"):
                wheel.write(value)
        wheel.write(1.0)
        assert status(path)["commands"] == {"left_wheel": 1.0, "right_wheel": 0.5}
        wheel.close()


@pytest.mark.parametrize("bad", [b"?" * 11, request(READ, b"\xff"), bytes(100), b"\xff" * 100_000])
def test_who_sends_nonsense_is_cut_off_and_nobody_else(roam: Graph, bad: bytes) -> None:
    with served(Counting(roam)) as (path, _):
        good, other = WorldConnection(path), connected(path)
        good.ask(READ, "feeler")
        held = good._socket
        with suppress(ConnectionError):
            other.sendall(bad)
        assert hangs_up(other)
        other.close()
        good.ask(READ, "feeler")
        assert good._socket is held
        good.close()


def test_who_goes_away_in_a_word_or_never_listens_is_forgotten(roam: Graph) -> None:
    with served(Counting(roam)) as (path, server):
        gone, deaf = connected(path), connected(path)
        gone.sendall(request(WRITE, b"left_wheel", 1.0)[:-1])
        gone.close()
        with pytest.raises(ConnectionError):
            deaf.sendall(request(STATUS, b"") * 1_000_000)
        deaf.close()
        assert status(path)["commands"]["left_wheel"] == 0.5
        until(lambda: not server.clients)


def test_requests_may_come_in_pieces_or_many_at_once(roam: Graph) -> None:
    with served(Counting(roam)) as (path, _):
        client = connected(path)
        for byte in request(WRITE, b"left_wheel", 0.25):
            client.sendall(bytes((byte,)))
        assert client.recv(100) == b"\x01\0\0\0\0"
        client.sendall(request(WRITE, b"right_wheel", 0.5) + request(WRITE, b"right_wheel", 0.75))
        until(lambda: status(path)["commands"] == {"left_wheel": 0.25, "right_wheel": 0.75})
        client.close()


def test_a_run_that_has_ended_can_still_be_read(roam: Graph) -> None:
    with served(Counting(roam, lasts=5)) as (path, _):
        until(lambda: status(path)["ended"] == "time")
        assert SimulatedSensor(path, "feeler", 3).open().read() == (5.0, 5.0, 5.0)


def test_the_guardian_can_still_stop_the_wheels_of_a_world_that_ends(
    roam: Graph, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("mindrun.robot.world_server.NEUTRAL_SECONDS", PATIENCE)
    world = Counting(roam)
    with served(world) as (path, server):
        wheel = SimulatedActuator(path, "left_wheel").open()
        wheel.write(1.0)
        server.end()
        wheel.write(0.5)
        until(lambda: world.given == [0.5, 0.5])
        wheel.close()


def test_a_world_that_does_not_answer_is_an_error_and_can_come_back(
    roam: Graph, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "world"
    link = WorldConnection(str(path))
    with pytest.raises(DeviceError, match="does not answer: No such file"):
        link.ask(STATUS)
    with listening(path), monkeypatch.context() as soon:
        soon.setattr("mindrun.robot.simulated_world.EXCHANGE_SECONDS", 0.05)
        with pytest.raises(DeviceError, match="timed out"):
            link.ask(STATUS)
    with served(Counting(roam), path=path):
        assert link.ask(STATUS)
        link.close()


def test_a_socket_replaces_nothing(tmp_path: Path) -> None:
    path = tmp_path / "world"
    with listening(path):
        with pytest.raises(MindError, match="cannot listen"), listening(path):
            pass
        assert path.exists()
    assert not path.exists()
    path.write_text("a file of somebody")
    with pytest.raises(MindError, match="cannot listen"), listening(path):
        pass
    assert path.read_text() == "a file of somebody"
    with pytest.raises(MindError, match="cannot listen"), listening(tmp_path / ("x" * 200)):
        pass


# The process


@pytest.fixture
def bundle(roam: Graph, tmp_path: Path) -> Path:
    write_bundle(tmp_path / "roam.bundle", Bundle(Policy(roam, {}), {}))
    return tmp_path / "roam.bundle"


def test_a_mind_lives_in_a_world_of_its_own_process(roam: Graph, bundle: Path) -> None:
    with simulated(bundle, "Chase", 3) as path:
        wiring = simulated_wiring(roam, path, roam.master)
        assert list(flaws(wiring, roam)) == []
        sensors = [wire.driver.open() for wire in wiring.sensors]
        actuators = [wire.driver.open() for wire in wiring.actuators]
        begin = status(path)
        engine = Engine(Policy(roam, {}))

        def tick() -> int:
            commands = engine.tick(np.array([value for sensor in sensors for value in sensor.read()]))
            for actuator, command in zip(actuators, commands.tolist(), strict=True):
                actuator.write(command)
            return int(status(path)["tick"])

        until(lambda: tick() > begin["tick"] + 30)
        end = status(path)
        assert end["pose"] != begin["pose"]
        assert set(end["commands"].values()) != {0.5}
        assert (end["seed"], end["events"], end["ended"]) == (3, {"reach of ball": 0}, None)
        for device in (*sensors, *actuators):
            device.close()
    assert not Path(path).exists()


def test_a_world_that_cannot_be_says_why(bundle: Path, tmp_path: Path) -> None:
    with pytest.raises(MindError, match="there is no task Fly; There is Chase, Roam"), simulated(bundle, "Fly", 1):
        pass
    with pytest.raises(MindError, match="cannot read"), simulated(tmp_path / "none", "Roam", 1):
        pass


PARENT = """
import sys, time
from pathlib import Path
from mindrun.robot.simulated_world import simulated
with simulated(Path(sys.argv[1]), "Chase", 1) as path:
    print(path, flush=True)
    time.sleep(600)
"""


def test_the_world_ends_with_its_parent(bundle: Path) -> None:
    environment = os.environ | {"TMPDIR": str(bundle.parent)}
    program = [sys.executable, "-c", PARENT, str(bundle)]
    with subprocess.Popen(program, stdout=subprocess.PIPE, text=True, env=environment) as parent:
        assert parent.stdout
        path = parent.stdout.readline().strip()
        assert status(path)["tick"] >= 0
        parent.send_signal(signal.SIGKILL)
    until(lambda: not Path(path).exists())


def test_the_drivers_have_names() -> None:
    assert kinds("sensor driver")["simulated"] is SimulatedSensor
    assert kinds("actuator driver")["simulated"] is SimulatedActuator
