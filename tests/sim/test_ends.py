"""What ends a run and when it is a success; what commands cost; what a closed gate leaves to others."""

import numpy as np
import pytest
from mindrun.graph.graph import End
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout

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
