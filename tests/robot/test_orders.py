"""Orders to a robot that drives: what is taken and what is not, who is heard, and what is read of them."""

import os
from collections.abc import Iterator
from pathlib import Path
from socket import AF_UNIX, SOCK_DGRAM, socket

import pytest
from mindrun.driver import DeviceError
from mindrun.engine.engine import Engine
from mindrun.errors import MindError
from mindrun.graph.bundle import Bundle, write_bundle
from mindrun.graph.graph import Graph
from mindrun.graph.named_readings import vector
from mindrun.graph.policy import Policy
from mindrun.graph.wiring import SensorWire, Wiring, flaws
from mindrun.robot.drivers.mock import MockSensor
from mindrun.robot.order_client import ADDRESS, say_order
from mindrun.robot.orders import OrderDriver, Orders, with_orders
from mindrun.robot.simulated_world import simulated
from mindrun.sim.commanded_lanes import CommandedWorld

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source
from mindlang.robot.wire import check_wiring
from tests.robot.test_world import until

MIND = """
tick 1/20 s
master Go
body Rover is disc
actuator left is wheel side left neutral 0.5
sensor wanted is order 1 to 3 timeout 2 s
sensor pace is order -1 to 1
sensor two is reading 2 of wanted
skill Go is rule
  reads two
  reads pace
  drives left at two * pace
task Go in plain
  lasts 100 ticks
  rewards two per tick
"""
OTHERS = os.getuid() + 1  # user
WIRING = """
robot: rover
sensors:
actuators:
  left:
    driver: mock
"""


@pytest.fixture
def graph() -> Graph:
    found = compile_source(Source("go.mind", MIND)).graph
    assert found
    return found


class Clock:
    """A clock that goes when it is told to."""

    now = 0.0

    def __call__(self) -> float:
        return self.now


@pytest.mark.parametrize(
    ("line", "answer"),
    [
        ("wanted 3", "wanted is 3"),
        ("wanted=0\n", "wanted is 0"),
        ("pace -0.5", "pace is -0.5"),
        ("wanted 4", "wanted cannot be 4: it is one of 1 to 3, or 0 for none of them"),
        ("wanted 1.5", "wanted cannot be 1.5: it is one of 1 to 3, or 0 for none of them"),
        ("pace 1.01", "pace cannot be 1.01: it is a number from -1 to 1"),
        ("pace inf", "pace cannot be inf: an order is a number"),
        ("wanted red", "wanted cannot be red: an order is a number"),
        ("wantd 3", "there is no order wantd; did you mean wanted?"),
        ("two 1", "there is no order two; there is wanted, pace"),
        ("stop", "stop is no order; an order is a name and a number: wanted 1"),
        ("wanted 1 2 3 4 5 6 7 8 9", "wanted 1 2 3 4 5 6 7… is no order; an order is a name and a number: wanted 1"),
    ],
)
def test_every_order_has_one_answer(graph: Graph, line: str, answer: str) -> None:
    said = Orders(graph)._answered(line.encode(), [os.getuid()]).decode()
    assert said[1:].replace("\n", "; ") == answer


def test_what_was_said_last_counts_until_it_is_silent(graph: Graph) -> None:
    clock = Clock()
    orders = Orders(graph, clock=clock)
    assert orders.now("wanted") is None
    for line in ("wanted 2", "pace 0.5", "wanted 3"):
        orders.say(line)
    clock.now = 2.0
    assert (orders.now("wanted"), orders.now("pace")) == (3, 0.5)
    clock.now = 1e6
    assert (orders.now("wanted"), orders.now("pace")) == (0, 0.5)


def test_an_order_is_read_as_its_sensor_says(graph: Graph) -> None:
    orders = Orders(graph)
    read = OrderDriver(orders, "wanted", 3).open().read, OrderDriver(orders, "pace", 1).open().read
    assert [each() for each in read] == [(0.0, 0.0, 0.0), (0.5,)]
    orders.say("wanted 2")
    orders.say("pace -1")
    assert [each() for each in read] == [(0.0, 1.0, 0.0), (0.0,)]


def test_no_line_of_robot_yaml_names_it_and_one_that_does_counts(graph: Graph) -> None:
    wiring = check_wiring(Source("robot.yaml", WIRING), graph).wiring
    assert wiring
    assert [*flaws(wiring, graph)] == []
    bare = with_orders(wiring, graph, graph.sensors, Orders(graph))
    assert [wire.sensor for wire in bare.sensors] == ["wanted", "pace"]
    wire = SensorWire("pace", MockSensor(), -1.0, 1.0)
    orders = Orders(graph, ["pace"])
    wired = with_orders(Wiring("rover", (wire,), wiring.actuators), graph, graph.sensors, orders)
    assert [wire.sensor for wire in wired.sensors] == ["wanted", "pace"]
    assert wired.sensors[1] is wire
    with pytest.raises(MindError, match=r"wired in robot\.yaml"):
        orders.say("pace 1")


def test_a_line_of_readings_may_leave_it_out(graph: Graph) -> None:
    engine = Engine(Policy(graph, {}))
    assert engine.tick(vector(graph, {})).tolist() == [0.0]
    assert engine.tick(vector(graph, {"wanted": [0, 1, 0], "pace": 1})).tolist() == [1.0]


# Who is heard


@pytest.fixture
def heard(graph: Graph) -> Iterator[Orders]:
    orders, told = Orders(graph), list[str]()
    with orders.heard(told.append):
        yield orders
    assert told == []
    with pytest.raises(MindError, match="takes no orders"):
        say_order("wanted", 1, os.getpid())


def test_orders_come_to_the_process_that_drives(heard: Orders) -> None:
    assert say_order("wanted", 3, os.getpid()) == "wanted is 3"
    assert heard.now("wanted") == 3
    with pytest.raises(MindError, match="wanted cannot be 9") as refused:
        say_order("wanted", 9, os.getpid())
    assert refused.value.hint == ""


def test_nonsense_ends_nothing(heard: Orders) -> None:
    with socket(AF_UNIX, SOCK_DGRAM) as nobody:  # at no address
        for data in (b"", b"\xff\0", b"wanted " * 99):
            nobody.sendto(data, f"{ADDRESS}{os.getpid()}")
    assert say_order("wanted", 1, os.getpid()) == "wanted is 1"


def test_a_thousand_orders_leave_the_last(heard: Orders) -> None:
    for number in range(1000):
        say_order("pace", number / 1000, os.getpid())
    assert heard.now("pace") == 0.999
    assert len(heard._said) == 1


def test_another_user_is_not_heard(graph: Graph) -> None:
    orders = Orders(graph)
    assert orders._answered(b"wanted 3", [OTHERS]) == b"-this robot is driven by another user"
    assert orders._answered(b"wanted 3", []).startswith(b"-")
    assert orders.now("wanted") is None


# In a simulated world


def test_in_a_world_it_is_what_the_task_draws_until_somebody_says_one(graph: Graph) -> None:
    worlds = [CommandedWorld(graph, "Go", seed) for seed in range(20)]
    assert {tuple(world.readings()[:3].tolist()) for world in worlds} == {(1, 0, 0), (0, 1, 0), (0, 0, 1)}
    for world in worlds:
        world.step([0.5])
        assert world.order("wanted", 2)
        assert not world.order("wanted", 4)
        assert not world.order("two", 1)
        world.step([0.5])  # in which the readings are still those before
        before = world.score
        for _ in range(9):
            assert world.readings()[[0, 1, 2, 4]].tolist() == [0, 1, 0, 1]
            world.step([0.5])
        assert world.score == before + 9


def test_the_world_of_a_dry_run_is_told(graph: Graph, tmp_path: Path) -> None:
    path, orders = tmp_path / "go.bundle", Orders(graph)
    write_bundle(path, Bundle(Policy(graph, {}), {}))
    with simulated(path, "Go", 1) as world:
        device = OrderDriver(orders, "wanted", 3, world).open()
        drawn = device.read()
        assert sum(drawn) == 1
        said = 1 + (drawn.index(1.0) + 1) % 3
        orders.say(f"wanted {said}")
        until(lambda: device.read().index(1.0) == said - 1)
        device.close()
    with pytest.raises(DeviceError):
        device.read()
