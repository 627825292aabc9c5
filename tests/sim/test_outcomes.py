"""What becomes of what is reached and delivered is said by the thing, and by no line that rewards or counts it."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.kinds.things.thing import OUTCOMES
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import Moment, trace

from tests.draws import cases
from tests.sim.minds import compile_text
from tests.sim.outcomes import PlainWorld

TICKS = 900
CARRIER = """
tick 1/60 s
master Carry
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5 thrust 300
actuator right_wheel is wheel side right neutral 0.5 thrust 300
actuator claw is gripper neutral 0
sensor ball_bearing is bearing of ball noise 2%
sensor home_bearing is bearing of home
sensor plug_bearing is bearing of plug
sensor ready is contact of ball
sensor holding is held of ball
sensor in_home is inside of home
sensor in_plug is inside of plug
sensor beat is sine period 5 s
sensor eyes is range_finder at -40 40 deg range 9 noise 3% lost 2%
sensor charge is battery start 60% drain 0.001 charge 0.004 noise 1% every 2 ticks
sensor drift is derivative of ball_bearing
sensor swing is derivative of eyes
memory mood is cell decay 0.9
skill Carry is rule
  reads beat
  reads mood
  influences Fetch at beat * 2 - mood / 9
  influences Charge at 1 - beat * 2
  drives mood at beat
skill Fetch is rule
  reads ball_bearing
  reads home_bearing
  reads ready
  reads holding
  drives left_wheel at 0.8 + 4 * (ball_bearing - 0.5) * (1 - holding) + 4 * (home_bearing - 0.5) * holding
  drives right_wheel at 0.8 - 4 * (ball_bearing - 0.5) * (1 - holding) - 4 * (home_bearing - 0.5) * holding
  drives claw at ready + holding
skill Charge is rule
  reads plug_bearing
  reads in_plug
  reads charge
  reads holding
  drives left_wheel at 0.8 + 4 * (plug_bearing - 0.5)
  drives right_wheel at 0.8 - 4 * (plug_bearing - 0.5)
  drives claw at holding
"""
ROUND = """
tick 1/60 s
master Round
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5 thrust 300
actuator right_wheel is wheel side right neutral 0.5 thrust 300
skill Round is rule
  drives left_wheel at 1
  drives right_wheel at 0.8
"""
BASE = "  rewards forward per tick\n"
MEASURING = (
    "counts reach of ball",
    "counts reach of home",
    "counts reach of plug",
    "counts delivery of ball",
    "counts collision",
    "counts exhaustion",
    "rewards 0 on reach of ball",
    "rewards 3 on reach of plug when charge > 0.2",
    "rewards 0 on delivery of ball",
    "rewards progress toward ball - retreat from home per tick",
    "rewards 0 * charge per tick",
    "rewards drift per tick when mood > 0.4",
    "rewards p per tick for each p in eyes when p < 1/2",
    "rewards p per tick for each p in swing",
    "rewards change of thrust beyond 20% over 10 ticks per tick",
)
outcomes = st.sampled_from(OUTCOMES)


@st.composite
def worlds(draw: st.DrawFn) -> str:
    """A task with an item, a zone and a power, each of which says what becomes of it."""
    scene = draw(st.sampled_from(["plain", "arena size 36", "arena size 60"]))
    ball = f"size {draw(st.sampled_from(['2', '3 to 1 by 0.5', '1 to 2']))}"
    lines = [
        f"contains ball is item {ball} reached {draw(outcomes)} delivered {draw(outcomes)}",
        f"contains home is zone size 6 reached {draw(outcomes)}",
        f"contains plug is power size 5 reached {draw(outcomes)}",
        f"lasts {TICKS} ticks",
    ]
    if draw(st.booleans()) and scene != "plain":
        lines.append("contains rock is obstacle count 4 size 2 to 4")
    return "\n".join([f"task Test in {scene}", *(f"  {line}" for line in lines), BASE])


def graph(task: str, lines: Sequence[str] = ()) -> Graph:
    return compile_text(CARRIER + task + "".join(f"  {line}\n" for line in lines))


def moments(of: Graph, seed: int) -> list[Moment]:
    return list(trace(Rollout(Policy(of, {}), "Test", "Carry"), seed).moments)


@settings(max_examples=cases(20), deadline=None)
@given(worlds(), st.lists(st.sampled_from(MEASURING), unique=True), st.integers(0, 2**31))
def test_what_measures_changes_nothing(task: str, lines: list[str], seed: int) -> None:
    """Bit for bit the same run, whatever is counted and rewarded besides."""
    base, measured = graph(task), graph(task, lines)
    read = sorted({i for skill in base.skills for i in skill.inputs})
    before, after = moments(base, seed), moments(measured, seed)
    assert len(before) == len(after)
    for a, b in zip(before, after, strict=True):
        assert a.body.tobytes() == b.body.tobytes()
        assert a.things.tobytes() == b.things.tobytes()
        assert (a.held, a.touching) == (b.held, b.touching)
        assert a.readings[read].tobytes() == b.readings[read].tobytes()
        assert a.commands.tobytes() == b.commands.tobytes()
        assert a.lines[0] == b.lines[0]


@settings(max_examples=cases(20), deadline=None)
@given(worlds(), st.integers(0, 2**31))
def test_outcomes_are_those_of_plain_python(task: str, seed: int) -> None:
    lines = ["counts reach of ball", "counts reach of home", "counts reach of plug", "counts delivery of ball"]
    of = graph(task, [*lines, *(f"rewards progress toward {thing} per tick" for thing in ("ball", "home", "plug"))])
    run = trace(Rollout(Policy(of, {}), "Test", "Carry"), seed)
    plain, paid = PlainWorld(of, of.tasks[0], run), np.zeros(3)
    order = [of.tasks[0].events[i] for i in of.tasks[0].counts]
    for moment in run.moments:
        reached, delivered, progress = plain.tick(moment, grips=moment.commands[2] > 0.5)
        expected = [0 in reached, 1 in reached, 2 in reached, 0 in delivered]
        assert [bool(moment.events[of.tasks[0].events.index(event)]) for event in order] == expected, moment.tick
        assert moment.held == plain.held, moment.tick
        things = np.array([thing or (np.nan, np.nan, 0.0) for thing in plain.things])
        assert np.array_equal(things[:, :2], moment.things[:, :2], equal_nan=True), moment.tick
        paid += [progress[name] for name in plain.names[:3]]
        assert np.array_equal(paid, moment.lines[1:4]), moment.tick


def test_such_a_world_has_everything_happen() -> None:
    """Else the two tests above would show nothing."""
    task = "task Test in arena size 36\n  contains ball is item size 2\n  contains home is zone size 6\n"
    task += f"  contains plug is power size 5\n  lasts {TICKS} ticks\n"
    lines = ["counts reach of ball", "counts reach of home", "counts reach of plug", "counts delivery of ball"]
    seen = sum(sum(m.events for m in moments(graph(task + BASE, lines), seed)) for seed in range(8))
    assert min(seen) > 3


@pytest.mark.parametrize("lanes", [1, 3, 16])
def test_lanes_that_close_ranks_keep_what_was_reached(lanes: int) -> None:
    task = "task Test in arena size 36\n  contains ball is item size 2 reached stays delivered vanishes\n"
    task += "  contains home is zone size 6 reached moves\n  contains plug is power size 5 reached vanishes\n"
    task += f"  contains rock is obstacle count 4\n  lasts {TICKS} ticks\n  ends on collision\n"
    lines = ["counts reach of ball", "counts reach of home", "counts reach of plug", "counts delivery of ball"]
    of = graph(task + BASE, lines)
    scores = Rollout(Policy(of, {}), "Test", "Carry", lanes=lanes).score(np.zeros((1, 0), np.float32), range(20))
    for seed in range(20):
        assert np.array_equal(scores.by_event[0, seed], sum(m.events for m in moments(of, seed)))
    assert (scores.by_event[0].max(axis=0) > 0).all()
    assert len({*scores.ticks.ravel().tolist()}) > 3


def test_what_stays_is_reached_anew_after_it_was_left() -> None:
    """The robot circles, in and out of the zone: as many events as times that it comes in."""
    of = compile_text(f"""{ROUND}task Test in arena size 24
  contains plug is power size 8 reached stays
  lasts {TICKS} ticks
  counts reach of plug
""")
    found = 0
    for seed in range(12):
        run = list(trace(Rollout(Policy(of, {}), "Test", "Round"), seed).moments)
        x, y, size = run[0].things[0]
        inside = [max(abs(m.body[0] - x), abs(m.body[1] - y)) <= size / 2 for m in run]
        comes_in = np.array([now and not before for before, now in zip([False, *inside], inside, strict=False)])
        assert np.array_equal(comes_in, [bool(m.events[0]) for m in run])
        assert all(np.array_equal(m.things, run[0].things) for m in run)
        found += comes_in.sum()
    assert found > 20


def test_what_has_vanished_is_nowhere() -> None:
    """A bearing 0.5, nothing in reach, held or inside, no progress and no charge; its event never comes again."""
    task = "task Test in arena size 40\n  contains ball is item size 2 delivered vanishes\n"
    task += "  contains home is zone size 8 reached stays\n  contains plug is power size 6 reached vanishes\n"
    task += "  lasts 3000 ticks\n  rewards progress toward ball per tick\n"
    of = graph(task, ["counts delivery of ball", "counts reach of plug"])
    names = {sensor.name: sensor.start for sensor in of.sensors}
    gone = 0
    for seed in range(5):
        run = moments(of, seed)
        events = np.array([m.events for m in run])
        assert (events.sum(axis=0) <= 1).all()
        if not events[:, 0].any() or not events[:, 1].any():
            continue
        gone += 1
        after = run[max(np.argmax(events[:, 0]), np.argmax(events[:, 1])) + 1 :]
        assert all(np.isnan(m.things[[0, 2], :2]).all() for m in after)
        assert {m.readings[names["plug_bearing"]] for m in after} == {0.5}
        assert {float(m.readings[names[name]]) for m in after for name in ("ready", "holding", "in_plug")} == {0.0}
        assert {abs(float(m.readings[names["ball_bearing"]]) - 0.5) <= 0.02 + 1e-6 for m in after} == {True}  # noise
        assert after[0].lines[0] == after[-1].lines[0]
        assert {m.held for m in after} == {-1}
        assert all(b.battery <= a.battery for a, b in pairwise(after))
    assert gone > 1


def test_an_item_that_is_delivered_and_stays_stays_in_the_claw() -> None:
    task = "task Test in arena size 36\n  contains ball is item size 2 delivered stays\n"
    task += "  contains home is zone size 8\n  contains plug is power\n"
    of = graph(task + f"  lasts {TICKS} ticks\n", ["counts delivery of ball"])
    runs = [moments(of, seed) for seed in range(8)]
    delivered = [(run, i) for run in runs for i, m in enumerate(run) if m.events[0]]
    assert len(delivered) > 3
    assert all(run[i].held == 0 and run[i - 1].held in (0, -1) for run, i in delivered)
