"""Ultrasonic range finders with trigger and echo pins (HC-SR04 and its kin), fired in turn."""

from dataclasses import dataclass, field
from math import gcd
from threading import Event
from time import monotonic, sleep
from typing import Annotated, Any

from mindrun.driver import DeviceError
from mindrun.kinds.registry import kind
from mindrun.robot.driver_support import METRES, PIN, OpenSensor, Ranging, close_all, open_pins, pins

SOUND_METRES_PER_SECOND = 343.2  # metres a second, at 20 °C
TRIGGER_SECONDS = 10e-6  # seconds, HC-SR04 data sheet
ECHO_START_SECONDS = 0.05  # seconds until the echo line must have gone high; it does so within 1 ms
ECHO_END_SECONDS = 0.25  # seconds until it must be low again where nothing echoed: 38 ms, of some makes 200 ms
EDGE_DELAY_SECONDS = 0.003  # seconds that the news of an edge may need


@dataclass(slots=True, weakref_slot=True, eq=False)
class Pair:
    """The two pins of one range finder. The times of the edges are the kernel's, not ours."""

    trigger: Any
    echo: Any
    rose: Any = None
    fell: Any = None
    risen: Event = field(default_factory=Event)
    fallen: Event = field(default_factory=Event)

    def __post_init__(self) -> None:
        self.echo.pin.edges = "both"
        self.echo.pin.bounce = None
        self.echo.pin.when_changed = self.changed

    def changed(self, ticks: Any, level: Any) -> None:
        """An edge of the echo line."""
        if level:
            self.rose = ticks
            self.risen.set()
        elif self.risen.is_set():
            self.fell = ticks
            self.fallen.set()

    def measure(self, reach: float) -> float | None:
        """Metres to what echoed, None where nothing did within `reach`."""
        begin = monotonic()
        while self.echo.pin.state:
            if monotonic() - begin > ECHO_END_SECONDS:
                raise DeviceError(f"{self} holds its echo line high", "is it broken, or wired to another pin?")
            sleep(0.001)
        self.risen.clear()
        self.fallen.clear()
        self.trigger.on()
        sleep(TRIGGER_SECONDS)
        self.trigger.off()
        if not self.risen.wait(ECHO_START_SECONDS):
            raise DeviceError(f"{self} does not answer", "is it wired to these pins, and has it 5 V?")
        if not self.fallen.wait(2 * reach / SOUND_METRES_PER_SECOND + EDGE_DELAY_SECONDS):
            if self.echo.pin.state:
                return None
            # the line is low, so there was an echo: it must not read as none
            if not self.fallen.wait(ECHO_START_SECONDS):
                raise DeviceError(f"{self} answered, but when is not known")
        metres = float(self.echo.pin_factory.ticks_diff(self.fell, self.rose)) * SOUND_METRES_PER_SECOND / 2
        return metres if metres <= reach else None

    def __str__(self) -> str:
        return f"the range finder on {self.trigger.pin} and {self.echo.pin}"

    def close(self) -> None:
        self.trigger.close()
        self.echo.close()


def firing_order(count: int) -> list[int]:
    """The order of firing: where it can be, two neighbours of the ring never follow each other, nor last and first."""
    strides = [stride for stride in range(2, count - 1) if gcd(stride, count) == 1]
    if not strides:
        return [*range(0, count, 2), *range(1, count, 2)]
    stride = min(strides, key=lambda step: abs(step - count / 3))
    return [index * stride % count for index in range(count)]


@kind("sensor driver", "ultrasonic")
class Ultrasonic(Ranging):
    """Ultrasonic range finders with a trigger and an echo pin each (HC-SR04, US-100, RCWL-1601): metres to an echo.

    `trigger` and `echo` list the GPIO numbers in the order of the sensor's angles. Echo is 5 V on an HC-SR04: bring it
    to 3.3 V with two resistors. They are fired in turn, never two neighbours, and each is listened to for as long as
    sound needs to `range` and back: ten of them up to 1 m take 70 ms. What is farther away, or does not echo, is none.
    """

    trigger: Annotated[tuple[int, ...], PIN]
    echo: Annotated[tuple[int, ...], PIN]
    range: Annotated[float, METRES] = 1.0

    @property
    def readings(self) -> int:
        return len(self.trigger)

    @property
    def seconds(self) -> float:
        """The seconds for which all of them are listened to."""
        return len(self.trigger) * 2 * self.range / SOUND_METRES_PER_SECOND

    def open(self) -> OpenSensor:
        if len(self.trigger) != len(self.echo) or not self.trigger:
            raise DeviceError(f"{len(self.trigger)} trigger pins and {len(self.echo)} echo pins make no pairs")
        parts = []
        for trigger, echo in zip(self.trigger, self.echo, strict=True):
            what = f"the range finder on GPIO {trigger} and {echo}"
            parts.append((what, "OutputDevice", {"pin": trigger}))
            parts.append((what, "InputDevice", {"pin": echo, "pull_up": False}))
        made = open_pins(*parts)
        pairs = [*map(Pair, made[::2], made[1::2])]
        return OpenSensor(lambda: self.metres(pairs), lambda: close_all(pairs))

    def metres(self, pairs: list[Pair]) -> tuple[float | None, ...]:
        """One measurement of each, in turn; each takes as long as sound needs to and fro, so that echoes die away."""
        found: list[float | None] = [None] * len(pairs)
        for index in firing_order(len(pairs)):
            begin = monotonic()
            with pins(f"range finder {index + 1} cannot be read"):
                found[index] = pairs[index].measure(self.range)
            sleep(max(0.0, begin + 2 * self.range / SOUND_METRES_PER_SECOND - monotonic()))
        return tuple(found)
