"""What a task does with a run: things reached, carried and delivered, schedules, the battery, visits, ends, rewards."""

from itertools import pairwise

import numpy as np
import pytest
from mindrun.graph.policy import Policy
from mindrun.graph.run_scores import Scores
from mindrun.sim.lanes import advance
from mindrun.sim.lanes.think import think
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import Moment, trace

from tests.sim.minds import compile_text

# Turns toward the object until it holds it, then toward the zone; closes and opens the claw as Collect's Grab does.
SEEKER = """
tick 1/60 s
master Seek
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
actuator claw is gripper neutral 0
sensor object_bearing is bearing of object
sensor home_bearing is bearing of home
sensor power_bearing is bearing of plug
sensor holding is held of object
sensor ready is contact of object
sensor in_home is inside of home
sensor charge is battery start 50% drain 0.001 charge 0.01
skill Seek is rule
  reads object_bearing
  reads home_bearing
  reads holding
  reads ready
  reads in_home
  drives left_wheel at 0.9 + 4 * (object_bearing - 0.5) * (1 - holding) + 4 * (home_bearing - 0.5) * holding
  drives right_wheel at 0.9 - 4 * (object_bearing - 0.5) * (1 - holding) - 4 * (home_bearing - 0.5) * holding
  drives claw at (ready + holding) * (1 - in_home)
skill Charge is rule
  reads power_bearing
  drives left_wheel at 0.9 + 4 * (power_bearing - 0.5)
  drives right_wheel at 0.9 - 4 * (power_bearing - 0.5)
skill Rest is rule
  reads in_home
  drives left_wheel at 0.5
task Anywhere in plain
  contains object is item
  contains home is zone
  contains plug is power
  lasts 1 ticks
"""


def rollout(task: str, master: str = "Seek", interrupt: bool = True) -> Rollout:
    return Rollout(Policy(compile_text(SEEKER + task), {}), "Test", master, interrupt=interrupt)


def moments(task: str, master: str = "Seek", seed: int = 1) -> list[Moment]:
    return list(trace(rollout(task, master), seed).moments)


def score(task: str, master: str = "Seek", runs: int = 8) -> Scores:
    return rollout(task, master).score(np.zeros((1, 0), np.float32), range(runs))


def test_carrying_and_delivering() -> None:
    """The item follows the claw, is let go in the zone, and appears elsewhere; only deliveries count."""
    task = """
task Test in arena size 60
  contains object is item size 1
  contains home is zone size 6
  lasts 6000 ticks
  rewards 30 on delivery of object
  counts delivery of object
"""
    run = moments(task)
    delivered = [i for i, m in enumerate(run) if m.events[0]]
    assert len(delivered) > 5
    for before, m in pairwise(run):
        x, y, size = m.things[0]
        if m.held == 0:
            expected = m.body[:2] + 1.5 * np.array([np.cos(m.body[2]), np.sin(m.body[2])])
            assert np.allclose((x, y), expected)
        elif before.held == 0 and not m.events[0]:
            assert np.allclose((x, y), before.things[0, :2], atol=0.2)
        assert size == 1
    for i in delivered:
        assert run[i - 1].held == 0
        assert run[i].held == -1
        assert np.hypot(*(run[i].things[0, :2] - run[i].body[:2])) >= 10
    assert run[-1].lines[0] == 30 * len(delivered)


def test_a_schedule_shrinks_with_every_success() -> None:
    task = """
task Test in plain
  contains object is item size 3 to 2.5 by 0.1 reached moves
  lasts 5000 ticks
  rewards 10 on reach of object
  counts reach of object
"""
    run = moments(task)
    sizes = [run[0].things[0, 2], *(m.things[0, 2] for m in run if m.events[0])]
    assert len(sizes) > 8
    assert np.allclose(sizes, np.maximum(2.5, 3 - 0.1 * np.arange(len(sizes))))


def test_the_battery_drains_and_charges_in_a_power_zone() -> None:
    task = """
task Test in arena size 40
  contains plug is power size 6
  lasts 2000 ticks
  ends on exhaustion
  rewards charge per tick
  counts exhaustion
"""
    run = moments(task, "Charge")
    steps = {round(b.battery - a.battery, 6) for a, b in pairwise(run)}
    assert {-0.001, 0.01} <= steps
    assert len(run) == 2000
    ended = score(task, "Rest")
    assert set(ended.ended_by.ravel()) == {0}
    assert set(ended.ticks.ravel()) <= {500, 501}
    assert set(ended.counts.ravel()) == {1}


def test_patches_are_visited_once() -> None:
    task = """
task Test in arena size 40
  contains object is item size 1 reached moves
  lasts 3000 ticks
  rewards 10 on visit of patch size 4
  rewards 1 on reach of object
  counts visit of patch size 4
"""
    run = trace(rollout(task), 3)
    where = {_patch(run.begin)}
    visits = 0
    for m in run.moments:
        new = _patch(m.body) not in where
        where.add(_patch(m.body))
        assert bool(m.events[0]) == new
        visits += new
    assert visits > 20


def _patch(body: np.ndarray) -> tuple[int, int]:
    return int((body[0] + 20) // 4), int((body[1] + 20) // 4)


def test_a_collision_ends_the_run_and_is_paid_once() -> None:
    task = """
task Test in arena size 30
  contains home is zone size 2
  lasts 4000 ticks
  ends on collision
  rewards -200 on collision
  rewards 0.01 * forward per tick
"""
    ended = score(task)
    assert set(ended.ended_by.ravel()) == {0}
    assert set(ended.by_line[..., 0].ravel()) == {-200}
    assert (ended.ticks < 4000).all()
    on = rollout(task, interrupt=False).score(np.zeros((1, 0), np.float32), range(8))
    assert set(on.ended_by.ravel()) == {-1}
    assert set(on.ticks.ravel()) == {4000}
    assert (on.by_line[..., 0] <= -200).all()


def test_conditions_and_loops_in_rewards() -> None:
    task = """
task Test in plain
  contains object is item size 1
  lasts 200 ticks
  rewards 2 * forward - 1 per tick
  rewards 1 per tick when object_bearing < 0.5
  rewards 1 per tick when object_bearing >= 0.5
  rewards p - 0.25 per tick for each p in charge when p > 1/4
  rewards progress toward object per tick
  rewards advance toward object - retreat from object per tick
"""
    run = moments(task)
    lines = run[-1].lines
    assert lines[1] + lines[2] == 200
    charge = [m.readings[6] for m in run]
    assert lines[3] == pytest.approx(sum(c - 0.25 for c in charge if c > 0.25))
    assert lines[4] == pytest.approx(lines[5])
    begin = trace(rollout(task), 1)
    first = np.hypot(*(begin.things[0, :2] - begin.begin[:2]))
    last = np.hypot(*(run[-1].things[0, :2] - run[-1].body[:2]))
    assert lines[4] == pytest.approx(first - last)


def test_the_change_of_thrust() -> None:
    """Total variation of each side's command over ten ticks, beyond a share."""
    task = """
task Test in plain
  contains object is item size 1
  lasts 100 ticks
  rewards change of thrust beyond 20% over 10 ticks per tick
"""
    run = moments(task)
    commands = np.array([[0.5, 0.5, 0.0], *(m.commands for m in run)])[:, :2].astype(np.float64)
    steps = np.abs(np.diff(commands, axis=0))
    expected = sum(np.maximum(0, steps[max(0, i - 9) : i + 1].sum(0) - 0.2).sum() for i in range(100))
    assert run[-1].lines[0] == pytest.approx(expected)


def test_a_reward_that_is_not_a_number_is_a_fault() -> None:
    task = """
task Test in plain
  contains object is item size 1
  lasts 50 ticks
  rewards 1 / (charge - charge) per tick
"""
    broken = score(task, runs=2)
    assert (broken.total == -np.inf).all()
    assert (broken.faults == 1).all()


def test_a_reading_that_is_not_a_number_reaches_no_actuator() -> None:
    task = """
task Test in plain
  contains object is item size 1
  lasts 50 ticks
"""
    world = rollout(task)
    jobs = world.jobs(np.zeros((1, 0), np.float32), np.array([1, 2, 3], np.uint64))
    tile = world.tile(3)
    world.fill(tile, jobs)
    advance.before(world.tables, tile.state, jobs)
    tile.state.mind.readings[0, 1] = np.nan
    think(world.tables, tile.state, 3, 0, len(world.tables.skills))
    advance.after(world.tables, tile.state, jobs, True)
    assert tile.state.mind.commands[:, 1].tolist() == [0.5, 0.5, 0.0]
    assert tile.state.mind.commands[0, 0] != 0.5
    assert tile.state.run.faults[:3].tolist() == [0, 3, 0]


def test_a_delay_shifts_the_commands() -> None:
    task = """
task Test in plain
  contains object is item size 1
  lasts 60 ticks
"""
    late = SEEKER.replace("side left neutral 0.5", "side left neutral 0.5 delay 3 ticks")
    late = late.replace("side right neutral 0.5", "side right neutral 0.25 delay 1 ticks")
    run = list(trace(Rollout(Policy(compile_text(late + task), {}), "Test", "Seek"), 1).moments)
    assert [m.commands[0] for m in run[:3]] == [0.5] * 3
    assert run[0].commands[1] == 0.25
    wanted = [_left(m) for m in run]
    assert np.allclose([m.commands[0] for m in run[3:]], wanted[:-3], atol=1e-6)


def _left(m: Moment) -> float:
    return float(np.clip(0.9 + 4 * (float(m.readings[0]) - 0.5), 0, 1))


@pytest.mark.parametrize("lanes", [1, 5])
def test_every_event_is_counted_by_itself(lanes: int) -> None:
    """However many lanes share a tile, and whichever end early: what a trace sees event by event is what is scored."""
    task = """
task Test in arena size 50
  contains object is item size 2
  contains home is zone size 6
  contains plug is power size 6
  contains rock is obstacle grid 25 size 2
  lasts 3000 ticks
  ends on collision
  counts delivery of object
  counts reach of plug
  counts visit of patch size 6
"""
    one = rollout(task)
    scores = Rollout(Policy(one.graph, {}), "Test", "Seek", lanes=lanes).score(np.zeros((1, 0), np.float32), range(12))
    for seed in range(12):
        seen = sum(moment.events for moment in trace(one, seed).moments)
        assert np.array_equal(scores.by_event[0, seed], seen)
    assert len(one.task.events) == 4
    assert np.array_equal(scores.counts, scores.by_event[:, :, list(one.task.counts)].sum(axis=2))
    assert (scores.by_event[0].max(axis=0) > 0).all()  # each of them happens


def test_what_has_been_run_is_told_on_the_way() -> None:
    """Also where all lanes end in the same tick."""
    told: list[float] = []
    task = "task Test in plain\n  contains object is item\n  lasts 2500 ticks\n"
    rollout(task).score(np.zeros((1, 0), np.float32), range(8), told.append)
    assert told == pytest.approx([3.2, 3.2, 1.6])


def test_an_event_soon_after_another() -> None:
    """It counts in the tick of the other and in so many ticks after that, and no later; each time anew."""
    task = """
task Test in arena size 60
  contains object is item size 1 reached moves
  contains home is zone size 12 reached moves
  lasts 4000 ticks
  counts leave of home
  counts reach of object
"""
    run = [m.events for m in moments(task)]
    left, reached = (np.flatnonzero([events[i] for events in run]) for i in (0, 1))
    gaps = sorted({int(tick - left[left <= tick][-1]) for tick in reached if (left <= tick).any()})
    assert len(gaps) > 3
    for ticks in gaps[1:-1]:
        for within in (ticks, ticks - 1):
            soon = f"{task}  counts reach of object within {within} ticks of leave of home\n"
            came = [tick for tick in reached if any(tick - within <= other <= tick for other in left)]
            assert np.flatnonzero([m.events[2] for m in moments(soon)]).tolist() == came
            assert 0 < len(came) < len(reached)
    counts = [sum(m.events for m in moments(soon, seed=seed)).tolist() for seed in range(8)]
    assert score(soon).by_event[0].tolist() == counts
    assert len({each[2] for each in counts}) > 1


def test_a_success_soon_after_an_event() -> None:
    task = """
task Test in arena size 60
  contains object is item size 1 reached moves
  contains home is zone size 12 reached moves
  lasts 6000 ticks
  succeeds on 8 reach of object
  rewards 7 on success within 1500 ticks of leave of home
  counts leave of home
"""
    paid = []
    for seed in range(16):
        run = moments(task, seed=seed)
        left = [m.tick for m in run if m.events[2]]  # behind the end's event, and the success that is paid
        paid.append(run[-1].lines[0] == 7)
        assert paid[-1] == any(run[-1].tick - 1500 <= tick for tick in left)
        assert run[-1].events[0] == 1
    assert 0 < sum(paid) < len(paid)
