"""How far, how fast, or to where a wheel has turned, by a rotary encoder."""

from dataclasses import dataclass
from math import inf
from time import monotonic, sleep
from typing import Annotated, Any, Literal, get_args

from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import Quantity, Reference
from mindrun.robot.driver_support import METRES, PIN, open_pins, pins

Measure = Literal["speed", "distance", "angle"]
MEASURE = Reference("measure", get_args(Measure))
STEPS = Quantity("steps of a turn", {"": 1.0}, low=1, high=100_000, whole=True)
MAX_STEPS_PER_SECOND = 1000  # that a program counts
LEAST_SPEED_SECONDS = 0.02  # seconds over which a speed is taken at least


@dataclass(slots=True)
class EncoderDevice:
    """An encoder, and where it was when its speed was asked for last."""

    driver: "Encoder"
    rotary: Any
    steps: int
    at: float

    def read(self) -> tuple[float]:
        """The distance (m), the speed since the reading before (m/s), or the angle (degrees)."""
        if self.driver.measure == "speed":
            sleep(max(0.0, self.at + LEAST_SPEED_SECONDS - monotonic()))
        with pins("the encoder cannot be read"):
            bool(self.rotary.a.is_active)  # pins that are gone count nothing, and say so only here
            steps, now = int(self.rotary.steps), monotonic()
        turns = steps / self.driver.steps
        match self.driver.measure:
            case "distance":
                return (turns * self.driver.circumference,)
            case "angle":
                return (turns * 360 % 360,)
        travelled = (steps - self.steps) / self.driver.steps * self.driver.circumference
        speed, self.steps, self.at = travelled / (now - self.at), steps, now
        return (speed,)

    def close(self) -> None:
        self.rotary.close()


@kind("sensor driver", "encoder")
class Encoder:
    """A rotary encoder with two pins, `a` and `b`, that has `steps` in a turn of the wheel (A leads B: forwards).

    `measure` says what is read: metres a second, for an `odometer` (0.5 standing, 1 forward) or a `speed`; the distance
    in metres since it was opened, or the angle of the wheel, 0 to 360 degrees. `circumference` is the wheel's. A wheel
    that counts the wrong way has `a` and `b` the other way round. Its outputs connect to ground; those that put out 5 V
    need a level shifter. Steps are counted by a program, some 1,000 a second at most: a wheel that turns faster reads
    slower than it is.
    """

    a: Annotated[int, PIN]
    b: Annotated[int, PIN]
    steps: Annotated[int, STEPS]
    circumference: Annotated[float, METRES] = 0.2
    measure: Annotated[Measure, MEASURE] = "speed"

    readings = 1
    near = None  # metres that were travelled are no distance to anything

    @property
    def seconds(self) -> float:
        """The seconds over which a speed is taken at least; 0 for a distance or an angle."""
        return LEAST_SPEED_SECONDS if self.measure == "speed" else 0.0

    @property
    def most(self) -> float:
        """The speed at which steps come as fast as they are counted; of a distance and an angle nobody knows."""
        return MAX_STEPS_PER_SECOND / self.steps * self.circumference if self.measure == "speed" else inf

    @property
    def unit(self) -> str:
        return {"distance": "m", "speed": "m/s", "angle": "deg"}[self.measure]

    @property
    def usual(self) -> tuple[float, float]:
        """A metre a second backward and forward; a metre, or a turn."""
        return {"speed": (-1.0, 1.0), "distance": (0.0, 1.0), "angle": (0.0, 360.0)}[self.measure]

    def open(self) -> EncoderDevice:
        """The encoder, which counts from now on."""
        options = {"a": self.a, "b": self.b, "max_steps": 0}
        [rotary] = open_pins((f"the encoder on GPIO {self.a} and {self.b}", "RotaryEncoder", options))
        return EncoderDevice(self, rotary, 0, monotonic())
