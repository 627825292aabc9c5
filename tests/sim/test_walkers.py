"""Walkers: they go where they say, stay among their walls, and are caught."""

import numpy as np
import pytest
from mindrun.engine.engine import Engine
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from tests.sim.following import follow
from tests.sim.minds import compile_text

MIND = """
tick 1/60 s
master Hunt
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor cat_bearing is bearing of cat
sensor cat_near is contact of cat
sensor cat_ahead is eye of cat at -20 0 20 deg range 15
sensor guard_away is distance of guard range 20
sensor mark is floor of guard at 0 ahead 1
sensor proximity is range_finder at 0 45 -45 deg range 8
skill Hunt is rule
  reads cat_bearing
  reads cat_near
  reads cat_ahead
  reads guard_away
  reads mark
  reads proximity
  drives left_wheel at 0.75 + 2 * (cat_bearing - 0.5)
  drives right_wheel at 0.75 - 2 * (cat_bearing - 0.5)
task World in arena size 30
  contains cat is walker size 2 speed 3 OUTCOME
  contains mouse is walker size 0.5 speed 6 turning 300 deg count 3 reached vanishes
  contains guard is walker size 2 speed 4 along -8 0 to 8 0 to 8 9 count 2
  contains rock is obstacle grid 10 size 2 to 3 jitter 1
  lasts TICKS ticks
  rewards progress toward cat per tick
  counts reach of cat
  counts reach of mouse
  counts reach of guard
"""


def world(ticks: int, outcome: str = "", text: str = MIND) -> Rollout:
    graph = compile_text(text.replace("TICKS", str(ticks)).replace("OUTCOME", outcome))
    return Rollout(Policy(graph, {}), "World", graph.master)


@pytest.mark.parametrize("seed", [6, 1, 5])
def test_walkers_are_where_plain_arithmetic_has_them(seed: int) -> None:
    rollout = world(600, ("", "reached moves", "reached vanishes")[seed % 3])
    happened = follow(rollout, Engine(Policy(rollout.graph, {})), seed)
    assert happened["Reach"] > 0


@pytest.mark.parametrize("seed", range(3))
def test_drawn_ways_are_gone_as_plain_arithmetic_has_it(seed: int) -> None:
    way = "along -8 0 to 8 0 to 8 9 or -8 -6 to 8 -6"
    text = MIND.replace("along -8 0 to 8 0 to 8 9", way + (" from anywhere" if seed else ""))
    rollout = world(500, text=text)
    follow(rollout, Engine(Policy(rollout.graph, {})), seed)


def test_who_wanders_stays_among_walls_and_comes_about() -> None:
    """None ever overlaps the border or a rock, and each has been in all quarters of the arena."""
    rollout = world(20_000)
    run = trace(rollout, 1)
    track = np.array([moment.things[[0, 1]] for moment in run.moments])
    for walker in (0, 1):
        x, y, size = track[:, walker].T
        there = np.isfinite(x)
        x, y, half = x[there], y[there], size[there] / 2
        assert (np.abs(x) + half <= 15).all()
        assert (np.abs(y) + half <= 15).all()
        for box_x, box_y, wide, high in run.boxes:
            assert not ((np.abs(x - box_x) < wide + half) & (np.abs(y - box_y) < high + half)).any()
    assert {(a > 0, b > 0) for a, b in track[:, 0, :2]} == {(a, b) for a in (False, True) for b in (False, True)}


def test_a_way_is_gone_round_at_its_speed() -> None:
    """16 + 9 + 18.36 units at 4 a second, one place at a time, and the second of two is a place ahead."""
    rollout = world(2_000)
    run = trace(rollout, 3)
    guards = [i for i, row in enumerate(rollout.tables.things) if row["walker"] >= 4]
    tracks = np.array([run.things[guards], *(moment.things[guards] for moment in run.moments)])[:, :, :2]
    assert tracks[0].tolist() == [[-8, 0], [8, 0]]
    places = [[-8, 0], [8, 0], [8, 9]]
    for guard, first in ((0, 0), (1, 1)):
        stops = [places.index(place) for place in tracks[:, guard].tolist() if place in places]
        assert stops == [(first + i) % 3 for i in range(len(stops))]
        assert len(stops) > 8
    assert np.linalg.norm(np.diff(tracks, axis=0), axis=2).max() <= 4 / 60 + 1e-12


def test_a_direction_drifts_by_its_turning_in_a_second_whatever_the_tick() -> None:
    """Over a second, the root of the mean square of many."""
    for tick in ("1/60", "1/10"):
        text = MIND.replace("tick 1/60", f"tick {tick}").replace("arena size 30", "plain").replace("300 deg", "40 deg")
        text = "\n".join(line for line in text.splitlines() if "rock" not in line)
        rollout = world(1 + round(1 / eval(tick)), text=text)
        turns = []
        for seed in range(150):
            turned = [moment.turned[1:4] for moment in trace(rollout, seed).moments]
            turns.append(turned[-1] - turned[0])
        assert np.sqrt(np.mean(np.square(turns))) == pytest.approx(np.radians(40), rel=0.12)


CHASE = """
tick 1/60 s
master Rest
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
skill Rest is rule
  drives left_wheel at 0.5
task World in arena size 60
  starts at 0 0
  contains cat is walker size 1 speed 6 seeks robot at 12 5
  contains mouse is walker size 1 speed 3 flees robot range 8 at 3 -4 reached vanishes
  contains dog is walker size 1 speed 4 seeks mouse range 0.5 at -20 -20
  lasts TICKS ticks
"""


def test_who_seeks_comes_straight_and_who_flees_stays_away() -> None:
    """13 units at 0.1 a tick: the cat is there in tick 130, and stays. A mouse that is near goes away by 0.05."""
    run = trace(world(2_000, text=CHASE), 1)
    track = np.array([moment.things[:, :2] for moment in run.moments])
    cat, mouse, dog = (np.linalg.norm(track[:, i], axis=1) for i in range(3))
    assert cat[:129] == pytest.approx(13 - 0.1 * np.arange(1, 130))
    assert (cat[130:] == 0).all()
    assert mouse[:59] == pytest.approx(5 + 0.05 * np.arange(1, 60))
    assert (mouse > 4.9).all()
    assert np.ptp(dog) > 1, "nothing is in half a unit: it wanders"
