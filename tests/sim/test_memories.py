"""Memories hold, count and reckon: the lanes, the engine and plain Python to the bit, and what each kind means."""

import numpy as np
import pytest
from mindrun.engine.engine import Engine
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import Moment, trace

from tests.plain import Plain
from tests.sim.minds import compile_text

ROBOT = """
tick 1/20 s
master Go
body Robot is disc size 2
actuator left_wheel is wheel side left neutral 0.5 noise 5%
actuator right_wheel is wheel side right neutral 0.5
sensor left_turns is odometer side left range 9 noise 2% lost 1%
sensor right_turns is odometer side right range 20 noise 2%
sensor north is compass noise 2% dead_zone 0.01
sensor wish is order 0 to 1 every 0.2 s
sensor other is order 0 to 1 every 0.3 s
sensor pulse is sine period 2.3 s
"""
ALL = """
memory home is place left left_turns right right_turns compass north range 15
memory kept is register start 30%
memory count is counter step 7%
memory mood is cell decay 0.9
sensor way is bearing of home dead_zone 0.02 range 9
sensor far is distance of home range 11
skill Go is rule
  reads wish
  reads other
  reads pulse
  reads way
  reads far
  influences Mark at 1 when wish > 0.9
  influences Count at other
  drives kept at other when wish < 0.3
  drives mood at far
  drives left_wheel at 0.4 + wish * 0.6
  drives right_wheel at 0.9 - pulse * 0.4 + way / 9
skill Mark is rule
  reads other
  reads kept
  drives home at other + kept / 9
  drives kept at 1
skill Count is rule
  reads wish
  drives count at wish
task Go in arena size 60
  lasts 10000 ticks
  rewards far per tick
"""


def moments(text: str, seed: int = 3) -> list[Moment]:
    """A run of the text's task Go with Go in charge."""
    return [*trace(Rollout(Policy(compile_text(text), {}), "Go", "Go", interrupt=False), seed).moments]


def test_the_lanes_the_engine_and_plain_python_agree_for_10000_ticks() -> None:
    graph = compile_text(ROBOT + ALL)
    engine, plain, run = Engine(Policy(graph, {})), Plain(graph, {}), moments(ROBOT + ALL)
    for number, moment in enumerate(run):
        commands = engine.tick(moment.readings)
        assert engine.readings.tobytes() == moment.readings.tobytes()
        assert commands.tobytes() == moment.commands.tobytes()
        if number < 1500:
            assert np.float32(plain.tick(moment.readings)).tobytes() == commands.tobytes()
            assert np.float32(plain.readings).tobytes() == moment.readings.tobytes()
    kept = np.array([moment.readings[graph.memories[0].start :] for moment in run])
    assert (np.ptp(kept, axis=0) > 0.4).all(), "some memory is never moved"


def test_readings_that_failed_leave_a_place_where_it_is() -> None:
    graph = compile_text(ROBOT + ALL)
    engine, plain = Engine(Policy(graph, {})), Plain(graph, {})
    draw = np.random.default_rng(5)
    before = None
    for tick in range(300):
        readings = draw.random(graph.width, np.float32)
        if lost := tick % 4 == 3:
            readings[draw.integers(3)] = np.nan
            readings[3] = 0.5  # nobody marks a new place
        commands = engine.tick(readings)
        assert np.array_equal(commands, np.float32(plain.tick(readings)), equal_nan=True)
        assert np.array_equal(engine.readings, np.float32(plain.readings), equal_nan=True)
        home = engine.readings[graph.memories[0].place]
        if before is not None:
            assert np.array_equal(home, before)
        before = home if lost else None


def kept_by(kind: str, driven: str, ticks: int = 6) -> list[float]:
    """What a memory of a kind reads from tick to tick, where a rule sends what stands in `driven`."""
    text = f"memory m is {kind}\nsensor t is clock period 1 s\nskill Go is rule\n  reads t\n  reads m\n  {driven}\n"
    task = f"task Go in plain\n  lasts {ticks} ticks\n  rewards m per tick\n"
    graph = compile_text(ROBOT + text + task)
    return [round(float(each.readings[graph.memories[0].start]), 6) for each in moments(ROBOT + text + task)]


@pytest.mark.parametrize(
    ("kind", "driven", "reads"),
    [
        ("register start 20%", "drives m at 0.7 when t < 4%", [0.2, 0.7, 0.7, 0.7, 0.7, 0.7]),
        ("cell decay 0", "drives m at 0.7 when t < 4%", [0.0, 0.7, 0.0, 0.0, 0.0, 0.0]),
        ("register", "drives m at t when t < 12% otherwise 1", [0.0, 0.0, 0.05, 0.1, 1.0, 1.0]),
        ("counter step 10%", "drives m at 1", [0.0, 0.1, 0.1, 0.1, 0.1, 0.1]),
        ("counter step 10%", "drives m at 1 when t < 4% otherwise 0.5", [0.0, 0.1, 0.1, 0.1, 0.1, 0.1]),
        ("counter step 60%", "drives m at (0.5 - m) * 10 + 0.3", [0.0, 0.6, 0.0, 0.6, 0.0, 0.6]),
        ("counter step 60%", "drives m at 0.6 - greatest of 0 (0.06 - t) * 9", [0.0, 0.0, 0.6, 0.6, 0.6, 0.6]),
    ],
)  # fmt: skip
def test_a_memory_keeps(kind: str, driven: str, reads: list[float]) -> None:
    assert kept_by(kind, driven) == reads


def test_a_counter_stays_at_1() -> None:
    text = "memory m is counter step 30%\nsensor t is clock period 0.1 s\n"
    text += "skill Go is rule\n  reads t\n  drives m at 1 - t\n"
    graph = compile_text(ROBOT + text + "task Go in plain\n  lasts 12 ticks\n  rewards m per tick\n")
    last = moments(ROBOT + text + "task Go in plain\n  lasts 12 ticks\n  rewards m per tick\n")[-1]
    assert last.readings[graph.memories[0].place].tolist() == [1.0, 1.0]


HOMING = """
tick 1/100 s
master Go
body Robot is disc size 2
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor left_turns is odometer side left range 30
sensor right_turns is odometer side right range 30
sensor north is compass
memory home is place left left_turns right right_turns compass north
sensor way is bearing of home
sensor far is distance of home range 40
sensor true_way is bearing of post
sensor true_far is distance of post range 40
sensor t is clock period 8 s
skill Go is rule
  reads t
  reads way
  reads far
  reads true_way
  reads true_far
  drives left_wheel at 0.8 + t / 9
  drives right_wheel at 0.9 - t / 20
  drives home at 1 when t < 25%
task Go in plain
  contains post is zone size 0.1 at 0 0
  starts at 0 0 facing 30 deg
  lasts 700 ticks
  rewards far per tick
"""


def test_a_place_is_where_the_robot_was() -> None:
    """The odometers of the lanes say the speed before it is damped: a way is 1 + dt·c as long as it is."""
    graph = compile_text(HOMING.replace(" when t < 25%", " when t < 0.1%"))
    rows = {sensor.name: sensor.start for sensor in graph.sensors}
    run = moments(HOMING.replace(" when t < 25%", " when t < 0.1%"))[100:]
    found = {name: np.array([each.readings[row] for each in run], np.float64) for name, row in rows.items()}
    assert found["way"].tolist() == pytest.approx(found["true_way"].tolist(), abs=0.01)
    assert (found["far"] * 40 / 1.05).tolist() == pytest.approx((found["true_far"] * 40 + 1).tolist(), abs=0.6)
    assert found["far"].max() > 0.5


def test_a_place_is_the_robots_own_while_it_is_driven() -> None:
    graph = compile_text(HOMING)
    home = graph.memories[0].place
    run = np.array([each.readings[home] for each in moments(HOMING)])
    assert (np.abs(run[:201] - 0.5) < 0.002).all()  # a tick's way from it at most
    assert np.abs(run[400] - 0.5).max() > 0.02
