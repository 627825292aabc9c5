"""Tasks of several robots: where they begin, what each is paid, and what happens to all of them at once."""

from collections.abc import Callable

import numpy as np
import pytest
from mindrun.graph.policy import Policy
from mindrun.graph.run_scores import Scores
from mindrun.sim.rollout import Rollout
from mindrun.sim.task_rows import rows_by_name
from mindrun.sim.trace import trace

from tests.sim.minds import DRIFTER, compile_text

SEEDS = range(1, 31)
ROBOTS = 4
PUSHED = """
  contains crate is box size 2 at 5 5 delivered stays
  contains goal is zone size 6 at 5 5
"""


def rollout(lines: str, interrupt: bool = True, first: str = "") -> Rollout:
    """Drifters in an arena, in which one is a mate and others are scouts."""
    task = f"""task Team in arena size 40
{first}
  contains object is item size 1
  contains mate is robot
  contains scout is robot count 2
  starts at -10 -10
  lasts 900 ticks
{lines}"""
    return Rollout(Policy(compile_text(DRIFTER + task), {}), "Team", "Drift", interrupt=interrupt)


def scores(lines: str, interrupt: bool = True) -> Scores:
    return rollout(lines, interrupt).score(np.zeros((1, 0), np.float32), SEEDS)


def test_the_score_is_the_mean_and_a_count_is_the_sum_over_the_robots() -> None:
    found = scores("  rewards 6 on reach of object\n  rewards 1 per tick\n  counts reach of object\n")
    assert (found.counts > 0).any()
    assert np.array_equal(found.by_line[0, :, 0], 6 * found.counts[0] / ROBOTS)
    assert (found.by_line[0, :, 1] == 900).all()


def test_a_collision_is_with_robots_of_that_name_and_both_have_it() -> None:
    alone = scores("  counts collision\n")
    found = scores("  counts collision with mate\n  counts collision with scout\n  counts collision\n")
    with_mate, with_scout, fixed = found.by_event[0].T
    assert np.array_equal(fixed, alone.by_event[0, :, 0])  # which robot it is in the way of changes no meaning
    assert with_mate.any()
    assert with_scout.any()
    assert (with_mate + with_scout).sum() % 2 == 0  # what the first meets meets the first


def test_what_happens_to_all_of_them_is_paid_to_each_and_has_happened_once() -> None:
    found = scores(
        f"{PUSHED}  ends on 2 delivery of crate\n  succeeds when time > 5\n  rewards 10 on delivery of crate\n"
        "  rewards 50 on success\n  rewards 3 * (count of delivery of crate) at the end\n"
        "  counts delivery of crate\n  counts success\n"
    )
    assert (found.by_line[0] == [10, 50, 3]).all()
    assert (found.by_event[0] == 1).all()
    assert (found.ended_by == 1).all()


def test_an_end_that_comes_for_one_of_them_comes_for_all_and_each_counts_towards_it() -> None:
    one, three = (scores(f"  ends on {times} reach of object\n  counts reach of object\n") for times in (1, 3))
    assert (one.by_event[one.ended_by == 0] >= 1).all()
    assert (three.by_event[three.ended_by == 0] >= 3).all()
    assert (three.ticks >= one.ticks).all()
    assert (one.ticks < 900).any()


@pytest.mark.parametrize(
    ("said", "is_there"),
    [
        ("count 3 away 5 to 9", lambda x, y: 5 <= np.hypot(x + 10, y + 10) <= 9),
        ("at 10 12 to -3 4", lambda x, y: (x, y) in [(10, 12), (-3, 4)]),
        ("at 10 12 or -3 4", lambda x, y: (x, y) in [(10, 12), (-3, 4)]),
        ("at side 3", lambda x, y: x in (7, -7) and y == 3),
        ("count 20", lambda x, y: max(abs(x), abs(y)) <= 17),
    ],
)
@pytest.mark.parametrize("is_first", [False, True])
def test_they_begin_where_they_are_said_to(said: str, is_there: Callable[[float, float], bool], is_first: bool) -> None:
    lines = f"  draws side from -7 7\n  contains cousin is robot {said}\n"
    run = rollout("", first=lines) if is_first else rollout(lines)
    rows = rows_by_name(run.task)["cousin"][is_first:]  # the first robot has the first name
    worlds = [trace(run, seed) for seed in SEEDS]
    begun = [tuple(place) for world in worlds for place in world.things[rows, :2]]
    assert all(is_there(*place) for place in begun)
    assert len({*begun}) > 1
    assert all((world.begin[:2] == (-10, -10)).all() for world in worlds)
