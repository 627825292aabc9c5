"""In which tasks all runs are one: where nothing is drawn, and as soon as one thing is, none."""

from dataclasses import replace

import pytest
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.tasks import is_one_world
from mindrun.kinds.scenes.scene import Gymnasium
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from tests.sim.minds import compile_text

TEXT = """\
tick 1/50 s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
actuator claw is gripper neutral 0
sensor eye is range_finder at 0 deg
sensor ear is range_finder at 90 deg
skill Go is rule
  reads eye
  drives left_wheel at eye
  drives claw at eye
skill Other is rule
  reads ear
  drives right_wheel at ear
task Course in arena size 60
  contains rock is obstacle size 2 at 0 10
  contains fence is wall from -20 -20 to 0 -20
  contains coin is item size 1 at 5 5
  starts at -10 0 facing 0 deg
  lasts 40 ticks
  counts reach of coin
"""
ZONE = "  contains home is zone size 4 at 10 0\n  lasts"
CAT = "item size 1 at 5 5", "walker along 5 5 to 5 9"
NO_CLAW = ("actuator claw is gripper neutral 0\n", ""), ("  drives claw at eye\n", "")
ONE: dict[str, tuple[tuple[str, str], ...]] = {
    "as it is": (),
    "in plain": (("arena size 60", "plain"),),
    "where a plain scene begins": (("arena size 60", "plain"), ("starts at -10 0", "starts")),
    "noise of what nobody reads": (("at 90 deg", "at 90 deg noise 5%"),),
    "what varies and nobody measures": (("  lasts", "  varies noise of ear 1 to 5%\n  lasts"),),
    "a size of a schedule": (("coin is item size 1", "coin is item size 3 to 1 by 0.5"),),
    "a size of a schedule that stays": (("item size 1 at 5 5", "item size 3 to 1 by 0.5 reached stays at 5 5"),),
    "what is delivered stays": (("item size 1 at", "item size 1 delivered stays at"), ("  lasts", ZONE)),
    "what is reached vanishes": (("item size 1", "item size 1 reached vanishes"),),
    "nothing takes what would move": (("item size 1", "item size 1 delivered moves"),),
    "nobody carries what would move": (*NO_CLAW, ("item size 1", "item size 1 delivered moves"), ("  lasts", ZONE)),
    "whoever goes a way": (CAT,),
    "a grid of one size": (("size 2 at 0 10", "grid 20 size 2"),),
    "a number that nothing depends on": (("  lasts", "  draws side from 0 1\n  lasts"),),
    "a number that is always the same": (("  lasts", "  draws side from 5 5\n  lasts"), ("at 5 5", "at side 5")),
    "a grid without any": (("size 2 at 0 10", "grid 90 size 2 to 3 jitter 1"),),
}
DRAWN: dict[str, tuple[tuple[str, str], ...]] = {
    "where the robot faces": ((" facing 0 deg", ""),),
    "where it starts": (("starts at -10 0 facing", "starts facing"),),
    "where a thing is": (("item size 1 at 5 5", "item size 1"),),
    "where one will be": (("item size 1", "item size 1 reached moves"),),
    "where one is that is delivered": (("item size 1", "item size 1 delivered moves"), ("  lasts", ZONE)),
    "where a box is that is delivered": (
        *NO_CLAW, ("item size 1", "box size 1 delivered moves"), ("  lasts", ZONE), ("reach of", "delivery of"),
    ),
    "how large a thing is": (("item size 1", "item size 1 to 2"),),
    "how large an obstacle is": (("obstacle size 2", "obstacle size 2 to 3"),),
    "how far off one is": (("obstacle size 2", "obstacle jitter 1 size 2"),),
    "where obstacles are": (("size 2 at 0 10", "count 2 size 2"),),
    "where somebody goes": (("item size 1 at", "walker size 1 at"),),
    "which of its places it is at": (("item size 1 at 5 5", "item size 1 at 5 5 or 5 9"),),
    "which of its places an obstacle is at": (("at 0 10", "at 0 10 or 9 10"),),
    "where in a region it is": (("item size 1 at 5 5", "item size 1 within 5 5 to 9 9"),),
    "where on its way it begins": (("item size 1 at 5 5", "walker along 5 5 to 5 9 from anywhere"),),
    "which way it is on": (("item size 1 at 5 5", "walker along 5 5 to 5 9 or 5 9 to 5 5"),),
    "a number that is a place": (("  lasts", "  draws side from 3 5\n  lasts"), ("at 5 5", "at side 5")),
    "a number that is paid": (("  lasts", "  draws side from 3 5\n  rewards side per tick\n  lasts"),),
    "whether a thing is there": (("  lasts", "  draws side from 3 5\n  lasts"), ("at 5 5", "at 5 5 when side > 4")),
    "what varies": (("  lasts", "  varies thrust of left_wheel 60 to 80\n  lasts"),),
    "what varies of a sensor": (("  lasts", "  varies noise of eye 0 to 5%\n  lasts"),),
    "what fails": (("  lasts", "  fails left_wheel 1% per s\n  lasts"),),
    "noise of what is read": (("at 0 deg\nsensor ear", "at 0 deg noise 5%\nsensor ear"),),
    "what is not measured": (("at 0 deg\nsensor ear", "at 0 deg lost 5%\nsensor ear"),),
    "noise of what is paid": (("at 90 deg", "at 90 deg noise 5%"), ("  lasts", "  rewards ear per tick\n  lasts")),
    "noise of what acts": (("right neutral 0.5", "right neutral 0.5 noise 1%"),),
    "what slips": (("right neutral 0.5", "right neutral 0.5 slip 1%"),),
    "what Python does": (("Go is rule", "Go is procedure from procedures.act"), ("left_wheel at eye", "left_wheel")),
}  # fmt: skip


def graph_of(changes: tuple[tuple[str, str], ...]) -> Graph:
    """The mind with these changes."""
    text = TEXT
    for old, new in changes:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return compile_text(text)


@pytest.mark.parametrize("changes", ONE.values(), ids=ONE)
def test_where_nothing_is_drawn_all_runs_are_one(changes: tuple[tuple[str, str], ...]) -> None:
    graph = graph_of(changes)
    assert is_one_world(graph, graph.tasks[0], "Go")
    rollout = Rollout(Policy(graph, {}), "Course", "Go")
    runs = [[(m.body.tolist(), m.readings.tolist()) for m in trace(rollout, seed).moments] for seed in (1, 2)]
    assert repr(runs[0]) == repr(runs[1])


@pytest.mark.parametrize("changes", DRAWN.values(), ids=DRAWN)
def test_one_thing_that_is_drawn_is_enough(changes: tuple[tuple[str, str], ...]) -> None:
    graph = graph_of(changes)
    assert not is_one_world(graph, graph.tasks[0], "Go")


def test_who_acts_may_draw_and_who_does_not_draws_nothing() -> None:
    graph = graph_of(
        (
            ("at 90 deg", "at 90 deg noise 5%"),
            ("Other is rule", "Other is procedure from procedures.act"),
            ("right_wheel at ear", "right_wheel"),
        )
    )
    assert is_one_world(graph, graph.tasks[0], "Go")
    assert not is_one_world(graph, graph.tasks[0], "Other")


def test_nobody_knows_what_an_environment_draws() -> None:
    graph = graph_of(())
    assert not is_one_world(graph, replace(graph.tasks[0], scene=Gymnasium("Pendulum-v1")), "Go")
