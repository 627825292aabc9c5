"""Places that are drawn: each is alike probable, none is another's, and what moves goes to another one."""

from collections import Counter

import numpy as np
import pytest
from mindrun.graph.draws import drawn_numbers
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import Trace, trace

from tests.sim.minds import compile_text

RUNS = 600
MIND = """
tick 1/10 s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor goal_bearing is bearing of goal
skill Go is rule
  reads goal_bearing
  drives left_wheel at 0.8 + 2 * (goal_bearing - 0.5)
  drives right_wheel at 0.8 - 2 * (goal_bearing - 0.5)
task World in SCENE
  draws side from -6 6 9
  draws far from 8 to 12
  contains ring is zone size 4 at -14 -14
  contains goal is zone size 4 THING
  starts at 0 0
  lasts TICKS ticks
  counts reach of goal
"""


def world(thing: str, ticks: int = 1, scene: str = "arena size 40") -> Rollout:
    text = MIND.replace("THING", thing).replace("TICKS", str(ticks)).replace("SCENE", scene)
    return Rollout(Policy(compile_text(text), {}), "World", "Go")


def begun(rollout: Rollout) -> list[Trace]:
    return [trace(rollout, seed) for seed in range(RUNS)]


def shares(found: Counter[object]) -> list[float]:
    return [count / found.total() for _, count in sorted(found.items(), key=repr)]


def test_places_are_alike_probable_and_those_of_one_name_differ() -> None:
    pairs = [frozenset(map(tuple, run.things[1:, :2])) for run in begun(world("at 9 0 or 0 9 or -9 0 count 2"))]
    assert {len(pair) for pair in pairs} == {2}
    assert shares(Counter(pairs)) == pytest.approx([1 / 3] * 3, abs=0.08)


def test_what_moves_goes_to_another_of_its_places() -> None:
    run = trace(world("at 9 0 or 0 9 or -9 0 reached moves", 4000), 1)
    track = [tuple(moment.things[1, :2]) for moment in run.moments]
    stops = [place for place, before in zip(track[1:], track, strict=False) if place != before]
    assert len(stops) > 20
    assert set(stops) == {(9, 0), (0, 9), (-9, 0)}


@pytest.mark.parametrize(("where", "sides"), [("ring", (-16, -16, -12, -12)), ("5 -9 to 15 9", (5, -9, 15, 9))])
def test_anywhere_within_is_all_of_it(where: str, sides: tuple[float, ...]) -> None:
    x, y = np.array([run.things[1, :2] for run in begun(world(f"within {where}"))]).T
    for values, low, high in ((x, sides[0], sides[2]), (y, sides[1], sides[3])):
        assert low <= values.min() < low + (high - low) / 50
        assert high >= values.max() > high - (high - low) / 50
        assert values.mean() == pytest.approx((low + high) / 2, abs=(high - low) / 20)


def test_who_begins_anywhere_on_its_way_is_as_often_on_each_stretch_as_that_is_long() -> None:
    rollout = world("at 9 0\n  contains cat is walker along 0 12 to 10 12 to 10 17 or -9 -9 to -9 -3 from anywhere")
    places = np.array([run.things[2, :2] for run in begun(rollout)])
    on_first = places[:, 1] >= 12
    assert on_first.mean() == pytest.approx(0.5, abs=0.07)
    x, y = places[on_first].T
    lengths = np.array([10, 5, np.hypot(10, 5)])
    found = [np.mean(y == 12), np.mean(x == 10), np.mean((y > 12) & (x < 10))]
    assert found == pytest.approx(lengths / lengths.sum(), abs=0.08)
    assert places[~on_first, 1].mean() == pytest.approx(-6, abs=0.3)


def test_a_number_is_drawn_from_the_seed_and_moves_nothing_else() -> None:
    with_number, without = world("at side -9"), world("at 9 -9")
    for seed in range(20):
        run, other = trace(with_number, seed), trace(without, seed)
        drawn = drawn_numbers(with_number.task.draws, seed)
        assert run.drawn.tolist() == [*drawn.values()]
        assert tuple(run.things[1, :2]) == (drawn["side"], -9)
        assert run.begin.tolist() == other.begin.tolist()
    sides = Counter[object](drawn_numbers(with_number.task.draws, seed)["side"] for seed in range(RUNS))
    assert shares(sides) == pytest.approx([1 / 3] * 3, abs=0.08)
    far = [drawn_numbers(with_number.task.draws, seed)["far"] for seed in range(RUNS)]
    assert (min(far), max(far), np.mean(far)) == pytest.approx((8, 12, 10), abs=0.12)


def test_a_place_is_computed_of_what_is_drawn() -> None:
    rollout = world("at 10 -2 + 1.5 * side\n  contains gem is item at (far - side) / 2 -side - 1")
    for seed in range(20):
        drawn, run = drawn_numbers(rollout.task.draws, seed), trace(rollout, seed)
        side, far = drawn["side"], drawn["far"]
        assert [tuple(place) for place in run.things[1:, :2]] == [(10, -2 + 1.5 * side), ((far - side) / 2, -side - 1)]


def test_there_are_as_many_as_are_drawn_where_they_would_be_anyway() -> None:
    lines = "at 9 0\n  contains gem is item count {0}\n  contains rock is obstacle count {0}\n  draws many from 0 1 3"
    drawn, all_of_them = world(lines.format("many")), world(lines.format(3))
    for seed in range(20):
        run, other, many = trace(drawn, seed), trace(all_of_them, seed), drawn_numbers(drawn.task.draws, seed)["many"]
        there = [place < many for place in range(3)]
        assert np.isfinite(run.things[2:, 0]).tolist() == (run.boxes[:, 0] < 1e29).tolist() == there
        assert np.array_equal(run.things[2:][there], other.things[2:][there])
        assert np.array_equal(run.boxes[there], other.boxes[there])


def test_a_wall_is_there_when_its_condition_holds_for_all_who_ask() -> None:
    fence = "at 9 0\n  contains fence is wall from 5 -9 to 5 9 when side < 8"
    eyes = "sensor ahead is range_finder at 0 deg range 10\nsensor near is distance of fence\nskill"
    text = MIND.replace("THING", fence).replace("TICKS", "900").replace("SCENE", "arena size 40")
    text = text.replace(" at 0 0", " at 0 0 facing 0 deg").replace("skill", eyes, 1)
    text = text.replace("drives left", "reads ahead\n  reads near\n  drives left", 1)
    rollout = Rollout(Policy(compile_text(text), {}), "World", "Go")
    for seed in range(6):
        run, is_there = trace(rollout, seed), drawn_numbers(rollout.task.draws, seed)["side"] < 8
        moments = [*run.moments]
        assert (moments[0].readings[1:3] < 1).tolist() == [is_there, is_there]
        assert (max(moment.body[0] for moment in moments) > 6) != is_there
        assert any(moment.touching for moment in moments) == is_there


def test_a_thing_is_there_when_its_condition_holds() -> None:
    rollout = world("at 9 0 when side > 0 and far > 10 or side < 0")
    for seed, run in enumerate(begun(rollout)):
        drawn = drawn_numbers(rollout.task.draws, seed)
        is_there = drawn["side"] < 0 or drawn["far"] > 10
        assert np.isfinite(run.things[1, 0]) == is_there
