"""The order of a tick as docs/language/tasks.md has it: sense, think, act, step, judge, recall."""

import numpy as np
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import Moment, trace

from tests.sim.minds import compile_text

# Drives to the ball and carries it; `mood` remembers whether the ball was held.
MIND = """
tick 1/60 s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5 thrust 300
actuator right_wheel is wheel side right neutral 0.5 thrust 300
actuator claw is gripper neutral 0
sensor ball_bearing is bearing of ball
sensor ready is contact of ball
sensor holding is held of ball
sensor home_bearing is bearing of home
memory mood is cell decay 0 start 0.25
skill Go is rule
  reads ball_bearing
  reads home_bearing
  reads ready
  reads holding
  drives left_wheel at 0.8 + 4 * (ball_bearing - 0.5) * (1 - holding) + 4 * (home_bearing - 0.5) * holding
  drives right_wheel at 0.8 - 4 * (ball_bearing - 0.5) * (1 - holding) - 4 * (home_bearing - 0.5) * holding
  drives claw at ready + holding
  drives mood at holding
task Test in arena size 36
  contains ball is item size 2
  contains home is zone size 6 reached moves
  lasts 1500 ticks
  rewards ball_bearing per tick
  rewards mood per tick
  rewards 1 on delivery of ball when holding > 0.5
  rewards 1 on delivery of ball when mood > 0.5
  rewards progress toward home per tick
  rewards 1 per tick when holding > 0.5 - mood
"""


def graph() -> Graph:
    return compile_text(MIND)


def moments(seed: int) -> list[Moment]:
    return list(trace(Rollout(Policy(graph(), {}), "Test", "Go"), seed).moments)


def test_a_reward_reads_what_the_skills_read() -> None:
    """A sensor as it was sensed before the step, and a memory before it takes its new value."""
    of, run = graph(), moments(3)
    rows = {part.name: part.start for part in (*of.sensors, *of.memories)}
    read = np.array([m.readings for m in run], np.float64)
    mood = read[:, rows["mood"]]
    assert mood[0] == 0.25
    assert np.array_equal(mood[1:], read[:-1, rows["holding"]]), "it remembers what was held when its tick began"
    assert run[-1].lines[0] == _sum(read[:, rows["ball_bearing"]])
    assert run[-1].lines[1] == _sum(mood)
    assert run[-1].lines[5] == (read[:, rows["holding"]] > 0.5 - mood).sum()
    assert 0 < mood.mean() < 1


def _sum(values: np.ndarray) -> float:
    """From left to right, as a run adds."""
    total = 0.0
    for value in values:
        total += value
    return total


def test_an_event_is_of_the_step_and_a_condition_of_before() -> None:
    """What is delivered was held when the tick began, and the memory of it is a tick older."""
    delivered, held, remembered = 0, 0, 0
    for seed in range(6):
        run = moments(seed)
        events = [i for i, m in enumerate(run) if m.events[0]]
        delivered += len(events)
        held += run[-1].lines[2]
        remembered += run[-1].lines[3]
        assert all(run[i].held == -1 for i in events), "when all is judged it has moved"
    assert held == remembered == delivered > 5


def test_measures_are_of_before_anything_moves() -> None:
    for seed in range(3):
        run = trace(Rollout(Policy(graph(), {}), "Test", "Go"), seed)
        home, before, total = run.things[1, :2], run.begin[:2], 0.0
        for m in run.moments:
            total += float(np.hypot(*(home - before)) - np.hypot(*(home - m.body[:2])))
            assert np.isclose(m.lines[4], total, atol=1e-6)
            home, before = m.things[1, :2], m.body[:2]
