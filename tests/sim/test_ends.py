"""What ends a run and when it is a success; what commands cost; what a closed gate leaves to others."""

import numpy as np
import pytest
from mindrun.graph.graph import End
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from mindlang.run.outcome import bench_data, run_data
from tests.sim.minds import compile_text
from tests.sim.test_tasks import SEEKER, moments, rollout, score

DELIVERIES = """
task Test in arena size 60
  contains object is item size 1 reached moves
  contains home is zone size 6
  lasts 2000 ticks
  counts reach of object
"""


def test_the_third_event_ends_the_run_and_not_the_first() -> None:
    found = score(DELIVERIES + "  ends on 3 reach of object\n")
    assert (found.by_event[found.ended_by == 0] == 3).all()
    assert (found.ended_by == 0).any()
    assert (found.by_event <= 3).all()


def test_a_success_is_paid_once_and_told() -> None:
    task = DELIVERIES + "  succeeds on 2 reach of object\n  rewards 50 on success\n  counts success\n"
    found, of = score(task), rollout(task).task
    succeeded = found.ended_by[0] == 0
    assert succeeded.any()
    assert (found.total[0] == 50.0 * succeeded).all()
    data = bench_data(of, found, range(8), 1.0)
    assert data["success"]["mean"] == succeeded.mean()
    assert set(data["by_event"]) == {"reach of object", "success"}
    one = rollout(task).score(np.zeros((1, 0), np.float32), [int(np.flatnonzero(succeeded)[0])])
    assert run_data(of, one)["succeeded"]
    assert run_data(of, one)["ended_by"] == "2 reach of object"


def test_without_interruption_a_success_happens_once() -> None:
    task = DELIVERIES + "  succeeds on 1 reach of object\n  rewards 50 on success\n"
    on = rollout(task, interrupt=False).score(np.zeros((1, 0), np.float32), range(8))
    assert set(on.total[0]) <= {0.0, 50.0}
    assert (on.ticks == 2000).all()


@pytest.mark.parametrize("other", ["", "  ends on collision\n", "  ends when charge < 39.99%\n"])
def test_the_share_of_successes_is_the_same_where_nothing_interrupts(other: str) -> None:
    task = DELIVERIES + "  succeeds on 1 reach of object\n" + other
    share = [
        bench_data(
            rollout(task).task, rollout(task, interrupt=on).score(np.zeros((1, 0), np.float32), range(8)), range(8), 1.0
        )["success"]
        for on in (True, False)
    ]
    assert share[0] == share[1]
    assert share[0]["mean"] > 0 or other.endswith("%\n")
    one = rollout(task, interrupt=False).score(np.zeros((1, 0), np.float32), [0])
    assert run_data(rollout(task).task, one)["succeeded"] == (one.met[0, 0] == 0)


def test_a_condition_ends_the_run_in_the_tick_in_which_it_holds() -> None:
    task = "task Test in plain\n  contains object is item\n  contains home is zone\n  contains plug is power\n"
    task += "  lasts 900 ticks\n  ends when charge < 45%\n  rewards 1 per tick\n  rewards charge per tick\n"
    found = moments(task, "Rest")
    charge = [float(row.readings[rollout(task).graph.sensors[-1].start]) for row in found]
    assert charge[-1] < 0.45 <= charge[-2]
    assert rollout(task).task.ends == (End(None, when=rollout(task).task.ends[0].when, text="charge < 45%"),)


def test_a_command_costs_what_it_is_as_it_acts() -> None:
    drive = "\nactuator servo is servo neutral 0.25 delay 3 ticks\nskill Turn is rule\n  drives servo at 0.75\n"
    task = drive + "task Test in plain\n  contains object is item\n  contains home is zone\n  contains plug is power\n"
    task += "  lasts 9 ticks\n  rewards servo per tick\n"
    assert score(task, "Turn").total[0, 0] == 3 * 0.25 + 6 * 0.75


@pytest.mark.parametrize(("gate", "command"), [("", 0.3), (" otherwise 1", 0.65)])
def test_a_closed_gate_has_no_weight_in_the_mean(gate: str, command: float) -> None:
    """Two skills drive one wheel, of which one does so only where a condition holds that never does."""
    text = (
        SEEKER
        + f"""
skill Steady is rule
  drives left_wheel at 0.3
skill Sometimes is rule
  reads charge
  drives left_wheel at 0.9 when charge > 2{gate}
skill Both is rule
  influences Steady at 1
  influences Sometimes at 1
task Test in plain
  contains object is item
  contains home is zone
  contains plug is power
  lasts 2 ticks
  rewards left_wheel per tick
"""
    )
    found = Rollout(Policy(compile_text(text), {}), "Test", "Both").score(np.zeros((1, 0), np.float32), [1])
    assert found.total[0, 0] / 2 == pytest.approx(command)
    assert found.faults[0, 0] == 0


def test_a_wall_that_opens_bars_no_way_and_is_seen_no_more() -> None:
    text = """
tick 1/60 s
master Go
body Robot is disc size 2
actuator left is wheel side left neutral 0.5
actuator right is wheel side right neutral 0.5
sensor ahead is eye of gate at 0 deg range 40
sensor way is bearing of gate
skill Go is rule
  reads ahead
  reads way
  drives left at 1
  drives right at 1
task Test in arena size 60
  contains gate is wall from 0 -30 to 0 30
  contains button is zone size 2 at -10 0
  starts at -20 3 facing 0 deg
  lasts 12 s
"""
    for line, last in (
        ("", -1.5),
        ("  opens gate when ahead < 0.05\n", 28.9),
        ("  opens gate on reach of button\n", -1.5),
    ):
        graph = compile_text(text + line)
        found = list(trace(Rollout(Policy(graph, {}), "Test", "Go"), 1).moments)
        assert found[-1].body[0] == pytest.approx(last, abs=0.2), line
        near = next(i for i, moment in enumerate(found) if moment.readings[0] < 0.05)
        assert all((moment.readings[0] == 1.0) == (last > 0) for moment in found[near + 1 :])
        assert all(moment.readings[1] == 0.5 for moment in found)


def test_a_servo_turns_by_its_speed_and_its_sensors_with_it() -> None:
    text = """
tick 1/60 s
master Turn
body Robot is box size 4 2
actuator wheel is wheel side left neutral 0.5 starts 20%
actuator pan is servo range 90 deg speed 30 deg neutral 0.5
sensor look is direction of pan
sensor post_seen is bearing of post on pan
sensor ahead is range_finder at 0 deg range 10 on pan
skill Turn is rule
  reads look
  reads post_seen
  reads ahead
  drives pan at 0
  drives wheel at 0.59
task Test in arena size 40
  contains post is zone at 0 10
  starts at 10 0 facing 0 deg
  lasts 6 ticks
"""
    found = list(trace(Rollout(Policy(compile_text(text), {}), "Test", "Turn"), 1).moments)
    looks = [moment.readings[0] for moment in found]
    assert looks == pytest.approx([0.5 - degrees / 360 for degrees in (0, 30, 60, 90, 90, 90)], abs=1e-6)
    seen = [moment.readings[1] for moment in found]
    assert seen == pytest.approx([0.5 - (135 - degrees) / 360 for degrees in (0, 30, 60, 90, 90, 90)], abs=1e-6)
    walls = [8.0 / 10, (10 / 0.8660254 - 2) / 10, 1.0, 1.0, 1.0, 1.0]  # from the rim: 2 ahead, 1 aside
    assert [moment.readings[2] for moment in found] == pytest.approx(walls, abs=1e-5)
    assert all(moment.body[0] == 10.0 for moment in found), "the wheel does not start"
