"""What a sensor's kind says that it always reads: so in the lanes, and only there where it is so."""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import pytest
from mindrun.graph.graph import Graph, Reward, Sensor, Task, Thing
from mindrun.graph.policy import Policy
from mindrun.kinds.scenes.scene import Arena
from mindrun.kinds.sensors.battery import Battery
from mindrun.kinds.sensors.nearest import Bearing
from mindrun.kinds.sensors.waves import Clock, Sine
from mindrun.kinds.things.thing import Item, Power
from mindrun.numbers.quantity import Span
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from tests.minds import always, mind, rule

TICK = 1 / 60


@dataclass(frozen=True)
class World:
    """What is known of a world."""

    charges: bool = False
    is_solid: bool = False
    can_hold: bool = False
    tick: float = TICK
    things: frozenset[str] = field(default=frozenset())

    def is_constant(self, reading: str) -> bool:
        return False


def graph_of(kind: Any, *things: Thing) -> Graph:
    """A robot that drives in circles in an arena of 40, and reads it."""
    drive = rule("Top", always("actuator", 0, 0.9), always("actuator", 1, 0.8), reads=(0,))
    world = Task("World", Arena(40.0), things, 300, (), (), (), (Reward("", (("number", 1.0),), None),), ())
    return replace(mind(drive), sensors=(Sensor("it", kind, 0, 1),), tasks=(world,))


def seen(graph: Graph) -> Any:
    """What it reads in 300 ticks."""
    run = trace(Rollout(Policy(graph, {}), "World", "Top"), 5)
    return np.array([moment.readings[0] for moment in run.moments])


@pytest.mark.parametrize(
    ("kind", "charges", "always"),
    [
        (Battery(start=1.0, drain=0.0), True, 1.0),
        (Battery(start=0.5, drain=0.0), False, 0.5),
        (Battery(start=0.5, drain=0.0), True, None),
        (Battery(start=0.5, drain=0.0, charge=0.0), True, 0.5),
        (Battery(start=1.0, drain=0.001), False, None),
        (Sine(TICK), False, 0.5),
        (Sine(2 * TICK), False, 0.5),
        (Sine(3 * TICK), False, None),
        (Sine(4 * TICK), False, None),
        (Sine(2.0), False, None),
        (Clock(TICK), False, 0.0),
        (Clock(2 * TICK), False, None),
    ],
)
def test_it_is_so_in_the_lanes(kind: Any, charges: bool, always: float | None) -> None:
    assert kind.constant(World(charges=charges)) == always
    found = seen(graph_of(kind, *[Thing("socket", Power(Span(38.0, 38.0)))] * charges))
    if always is None:
        assert np.ptp(found) > 0.001
    else:
        assert found == pytest.approx(np.full(300, always), abs=1e-6)


def test_how_far_away_a_thing_is_counts_for_its_own_bearing() -> None:
    """Of two things the second: within its range the bearing points to it, beyond it reads 0.5."""
    things = (Thing("coin", Item(away=Span(12.0, 12.0))), Thing("gem", Item(away=Span(4.0, 4.0))))
    near, none = (seen(graph_of(Bearing("gem", range=reach), *things))[0] for reach in (5.0, 3.0))
    assert near == seen(graph_of(Bearing("gem"), *things))[0] != 0.5
    assert none == 0.5
