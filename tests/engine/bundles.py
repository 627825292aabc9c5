"""Bundles for tests."""

from dataclasses import replace

import numpy as np
from mindrun.bundle import Bundle
from mindrun.functions import Mlp, Procedure
from mindrun.robot.drivers.mock import MockActuator, MockSensor
from mindrun.robot.wiring import ActuatorWire, SensorWire, Wiring
from mindrun.weights import genes

from tests.minds import always, mind, rule, skill


def example() -> Bundle:
    """A bundle with one of everything."""
    top = rule("Top", always("skill", 1, 1.0), always("skill", 2, 1.0))
    go = skill("Go+On", Mlp(1), (0,), ("actuator", 0))
    grip = skill("Grip", Procedure("parts.claw.grip"), (0,), ("actuator", 1))
    weights = {"Go+On": np.arange(genes(go), dtype=np.float32)}
    return Bundle(mind(top, go, grip), weights, {"parts.claw": "def grip(r): return r"})


def wired() -> Bundle:
    """The same for a robot."""
    sensor = SensorWire("r0", MockSensor(0.25), 0.0, 2.0, median=3, on_fault="hold", blank=0.5)
    ends = (ActuatorWire("left_wheel", MockActuator(), trim=0.01), ActuatorWire("right_wheel", MockActuator()))
    bundle = example()
    ends += (ActuatorWire("claw", MockActuator(), low=0.25, slew=2.0, reversed=True),)
    return replace(bundle, wiring=Wiring("test", (sensor,), ends[: len(bundle.graph.actuators)]))
