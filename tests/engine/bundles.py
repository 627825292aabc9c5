"""Bundles for tests."""

from dataclasses import replace

import numpy as np
from mindrun.graph.bundle import Bundle
from mindrun.graph.graph import End, Lesson, Reward, Task, Thing
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes
from mindrun.graph.wiring import ActuatorWire, SensorWire, Wiring
from mindrun.kinds.events.event import Delivery, Reach, Visit
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.functions.procedure import Procedure
from mindrun.kinds.learners import Restarting
from mindrun.kinds.measures.measure import CommandChange, Retreat
from mindrun.kinds.scenes.scene import Arena
from mindrun.kinds.things.obstacle import Obstacle
from mindrun.kinds.things.thing import Item, Zone
from mindrun.numbers.quantity import Span
from mindrun.robot.drivers.mock import MockActuator, MockSensor

from tests.minds import always, mind, rule, skill

THINGS = (
    Thing("ball", Item(size=Span(3.0, 1.0, 0.5), reached="moves")),
    Thing("home", Zone(size=Span(4.0, 8.0))),
    Thing("rock", Obstacle(count=2)),
)
EACH = Reward("Σ", (("each", 0), ("measure", 1), ("*", 0)), None, (0, 1), (("reading", 0), ("number", 0.5), ("<", 0)))
TASK = Task(
    "Carry", Arena(40.0), THINGS, 100, (Retreat("ball"), CommandChange("thrust", 0.5)),
    (Delivery("ball"), Reach("home"), Visit("patch", 8.0)), (End(2),), (Reward("1", (("number", 1.0),), 0), EACH), (1,),
)  # fmt: skip
LESSON = Lesson("All", "Go+On", "Carry", "Top", 5, False, True, Restarting())


def example() -> Bundle:
    """A bundle with one of everything."""
    top = rule("Top", always("skill", 1, 1.0), always("skill", 2, 1.0))
    go = skill("Go+On", Mlp(1), (0,), ("actuator", 0))
    grip = skill("Grip", Procedure("parts.claw.grip"), (0,), ("actuator", 1))
    weights = {"Go+On": np.arange(genes(go), dtype=np.float32)}
    graph = replace(mind(top, go, grip), tasks=(TASK,), lessons=(LESSON,))
    return Bundle(Policy(graph, weights), {"parts.claw": "def grip(r): return r"})


def wired() -> Bundle:
    """The same for a robot."""
    sensor = SensorWire("r0", MockSensor(0.25), 0.0, 2.0, median=3, on_fault="hold", blank=0.5)
    ends = (ActuatorWire("left_wheel", MockActuator(), trim=0.01), ActuatorWire("right_wheel", MockActuator()))
    bundle = example()
    ends += (ActuatorWire("claw", MockActuator(), low=0.25, slew=2.0, reversed=True),)
    return replace(bundle, wiring=Wiring("test", (sensor,), ends[: len(bundle.graph.actuators)]))
