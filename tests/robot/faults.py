"""A mind of one sensor of each kind, and drivers that fail in every way."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cache
from math import inf, nan
from typing import Any

import numpy as np
from mindrun.driver import DeviceError
from mindrun.engine.changes import ChangedEngine
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.wiring import SensorWire
from mindrun.robot.loop import Loop, Rate
from mindrun.robot.sensing import ReadingFilter, Sampler
from numpy.typing import NDArray

from tests.sim.minds import compile_text

TICK = 1 / 20
SENSORS = {
    "range_finder": ("range_finder at 0 120 240 deg range 12", 3),
    "bearing": ("bearing of ball", 1),
    "contact": ("contact of ball", 1),
    "held": ("held of ball", 1),
    "inside": ("inside of spot", 1),
    "inertial": ("inertial", 1),
    "battery": ("battery", 1),
    "compass": ("compass", 1),
}
MIND = """\
tick 1/20 s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
actuator claw is gripper neutral 0
sensor sense is {kind}
sensor pulse is sine period 2 s
skill Go is {function}
  reads sense
  reads pulse
  drives left_wheel at 0.2 + pulse * 0.7
  drives right_wheel at 0.9
  drives claw at pulse
task Play in arena size 40
  contains ball is item size 2
  contains spot is zone size 3
  lasts 100 ticks
"""

GOOD, TOO_LATE = 0.6, object()  # a device that gives this hangs until the test is over


@dataclass(slots=True)
class Clock:
    """Time that passes when somebody waits."""

    now: float = 1000.0

    def __call__(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += seconds


@dataclass(slots=True)
class Scripted:
    """A sensor driver whose device gives what the script says next; the last again and again."""

    count: int
    script: Sequence[Any]
    reads: int = 0
    closed: int = 0
    possible: tuple[float, float] = (0.0, 1.0)
    unit = ""
    usual = (0.0, 1.0)

    @property
    def readings(self) -> int:
        return self.count

    def open(self) -> "Scripted":
        return self

    def read(self) -> Any:
        given = self.script[min(self.reads, len(self.script) - 1)]
        self.reads += 1
        return given(self.count) if callable(given) else given

    def close(self) -> None:
        self.closed += 1


def good(count: int) -> list[float]:
    return [GOOD] * count


def bus_error(count: int) -> list[float]:
    raise DeviceError("the bus does not answer", "is it wired?")


def exception(count: int) -> list[float]:
    raise ZeroDivisionError("in a driver")


FAULTS: dict[str, Callable[[int], Any]] = {
    "nan": lambda count: [nan] * count,
    "infinite": lambda count: [inf] * count,
    "minus infinite": lambda count: [-inf] * count,
    "none at all": lambda count: None,
    "exception": exception,
    "bus error": bus_error,
    "out of range": lambda count: [7.0] * count,
    "negative": lambda count: [-0.3] * count,
    "too few": lambda count: [],
    "wrong type": lambda count: ["0.6"] * count,
    "true or false": lambda count: [True] * count,
    "text": lambda count: "0.6",
}


@dataclass(slots=True)
class Sent:
    """A guardian that remembers what it was sent, and says why it holds everything at neutral."""

    holds: str = ""
    commands: list[NDArray[np.float32]] = field(default_factory=list)
    armed: list[bool] = field(default_factory=list)

    def send(self, commands: Sequence[float], armed: bool) -> None:
        self.armed.append(armed)
        self.commands.append(np.array(commands, np.float32))


@dataclass(slots=True)
class Robot:
    """A loop with one scripted sensor; it is measured before each tick unless it `hangs`."""

    loop: Loop
    sampler: Sampler
    sent: Sent
    driver: Scripted
    hangs: bool = False
    device: Any = None

    def tick(self) -> None:
        """Measure, and tick."""
        if not self.hangs:
            self.device, self.sampler.latest = self.sampler._measured(self.device)
        self.loop.tick()


@cache
def graph(kind: str) -> Graph:
    text = MIND.format(kind=SENSORS[kind][0], function="rule")
    return compile_text(text)


def robot(kind: str, script: Sequence[Any], on_fault: str = "neutral", **wire: Any) -> Robot:
    """A robot whose sensor is of that kind."""
    clock, of = Clock(), graph(kind)
    driver = Scripted(SENSORS[kind][1], script)
    times = {"rate": 1 / TICK, "max_age": 1.5 * TICK, "hold": 2 * TICK}
    wired = SensorWire("sense", driver, 0.0, 1.0, on_fault=on_fault, blank=1.0, **times, **wire)
    sampler, sent = Sampler(wired, clock), Sent()
    loop = Loop(
        ChangedEngine(Policy(of, {})), ReadingFilter(of, [sampler]), sent, Rate(TICK, clock, clock.sleep), armed=True
    )
    loop.pace.begin()
    return Robot(loop, sampler, sent, driver)
