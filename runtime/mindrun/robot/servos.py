"""Where a servo looks that nothing measures: reckoned from what it was sent, as it turns in the simulated world."""

from collections import deque
from dataclasses import dataclass, field
from math import pi
from typing import Any

import numpy as np

from mindrun.graph.graph import Graph
from mindrun.graph.wiring import SensorWire, Wiring, reckoned
from mindrun.robot.guardian.guard import meant, moved
from mindrun.robot.guardian.plan import Channel, Plan
from mindrun.robot.sensing import Sample


@dataclass(slots=True)
class ReckonedServo:
    """A servo at its neutral, and the source of the samples of a sensor that reads where it looks.

    It is its sensor's driver as well, which opens nothing. `place` is its number among the actuators, `tick` in
    seconds; `value` is what its driver was sent last, `late` are the commands that do not act yet, and `angle`, in
    radians, is to the left.
    """

    sensor: str
    kind: Any  # with a range and a speed
    place: int
    channel: Channel
    tick: float
    latest: Sample | None = None
    value: float = field(init=False)
    late: deque[float] = field(init=False)
    angle: float = field(init=False)

    readings = 1
    unit = ""
    usual = (0.0, 1.0)

    def __post_init__(self) -> None:
        self.value, neutral = self.channel.rest, _single(self.kind.neutral)
        self.late = deque([neutral] * self.kind.delay)
        self.angle = (1.0 - 2.0 * neutral) * self.kind.range

    @property
    def wire(self) -> SensorWire:
        """The wire of its sensor, whose readings are what it says."""
        return SensorWire(self.sensor, self, 0.0, 1.0)

    def open(self) -> "ReckonedServo":
        return self

    def read(self) -> tuple[float]:
        """The direction, as the sensor of the simulated world reads it."""
        return (0.5 - self.angle / (2.0 * pi),)

    def close(self) -> None: ...

    def look(self, time: float) -> None:
        """Say where it looks in the tick that begins at `time`."""
        self.latest = Sample(self.read(), time)

    def turn(self, command: float | None) -> None:
        """Turn for a tick to what the guardian makes of a command, by no more than its speed; None is its rest."""
        self.value = self.channel.rest if command is None else moved(self.channel, command, self.value, self.tick)
        self.late.append(_single(meant(self.channel, self.value)))
        left, most = (1.0 - 2.0 * self.late.popleft()) * self.kind.range - self.angle, self.kind.speed
        self.angle += min(most, max(-most, left))


def _single(command: float) -> float:
    """A command as the engine and the world have it, in float32."""
    return float(np.float32(command))


def reckoned_servos(wiring: Wiring, graph: Graph, plan: Plan) -> list[ReckonedServo]:
    """The servos whose directions nothing measures, one for each sensor that reads such a direction."""
    places = {actuator.name: place for place, actuator in enumerate(graph.actuators)}
    pairs = ((sensor, places[servo]) for sensor, servo in reckoned(wiring, graph).items())
    return [
        ReckonedServo(sensor, graph.actuators[place].kind, place, plan.channels[place], graph.tick)
        for sensor, place in pairs
    ]
