"""Sensors read outside of the control loop, a thread each, so that a slow or hung one never delays a tick.

In each tick the newest samples are filtered; a sensor with a fault reads what its wiring declares for that. Where a
servo looks that nothing measures is reckoned from what it was sent.
"""

import threading
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from math import inf, isfinite, nan, pi
from statistics import median
from time import monotonic
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mindrun.driver import SensorDevice, discard, failure
from mindrun.graph.graph import Graph, Sensor
from mindrun.graph.measured import measured_on_robot, rows_of
from mindrun.graph.wiring import SensorWire, Wiring, reading, reckoned, within_turn
from mindrun.numbers.given_numbers import is_truth, number, values
from mindrun.robot.guardian.guard import meant, moved
from mindrun.robot.guardian.plan import Channel, Plan

FINE, UNMEASURED, FAILED, STALE = range(4)  # the fault of a sensor in a tick


@dataclass(frozen=True, slots=True)
class Sample:
    """A measurement: a value for each reading in natural units, None where there was nothing, and when it began.

    `fault` says why there are no values; times are seconds of a monotonic clock.
    """

    values: tuple[float | None, ...]
    at: float
    fault: str = ""


class SampleSource(Protocol):
    """What has the samples of a sensor: its wire, and the newest of them."""

    @property
    def wire(self) -> SensorWire: ...
    @property
    def latest(self) -> Sample | None: ...


class Sampler:
    """Measures one sensor again and again, in a thread of its own; `latest` is its newest sample.

    A device that fails is closed and opened anew, so that one that was unplugged comes back.
    """

    def __init__(self, wire: SensorWire, clock: Callable[[], float] = monotonic) -> None:
        self.wire = wire
        self.latest: Sample | None = None
        self._clock = clock
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name=f"sensor {wire.sensor}", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def stop(self, wait: float = 1.0) -> None:
        """Measure no more; a thread that hangs is left behind, it goes with the process."""
        self._stop.set()
        self._thread.join(wait)

    def measured_once(self) -> Sample:
        """A sample measured now, in this thread, of a device that is open for it alone."""
        device, sample = self._measured(None)
        discard(device)
        return sample

    def _run(self) -> None:
        device: SensorDevice | None = None
        due = self._clock()
        while not self._stop.is_set():
            device, self.latest = self._measured(device)
            due = max(due + 1 / self.wire.rate, self._clock())
            self._stop.wait(due - self._clock())
        discard(device)

    def _measured(self, device: SensorDevice | None) -> tuple[SensorDevice | None, Sample]:
        """The device, open if it works, and a sample of it."""
        began = self._clock()
        try:
            device = device or self.wire.driver.open()
            began = self._clock()
            return device, checked(device.read(), began, self.wire)
        except BaseException as error:  # a driver may fail in any way, and the robot has to know
            if isinstance(error, KeyboardInterrupt) and threading.current_thread() is threading.main_thread():
                raise  # Ctrl-C
            discard(device)
            return None, Sample((), began, failure(error))


def checked(given: object, at: float, wire: SensorWire) -> Sample:
    """A sample of what a device gave: numbers of any type as floats, or the fault that it is."""
    low, high = getattr(wire.driver, "possible", (-inf, inf))
    expected, found = wire.driver.readings, values(given)
    if found is None or len(found) != expected:
        return Sample((), at, f"gave {given!r:.60}, not a list of {expected} value{'s' * (expected != 1)}")
    measured: list[float | None] = []
    for value in found:
        if value is None:
            measured.append(None)
            continue
        try:
            plain = number(value)
        except TypeError:
            plain = None
        if plain is None or is_truth(value):
            return Sample((), at, f"gave {value!r:.60}, which is no number")
        if not isfinite(plain):
            return Sample((), at, f"gave {plain}")
        if not low <= plain <= high:
            return Sample((), at, f"gave {plain:g}, which is not between {low:g} and {high:g}")
        measured.append(plain)
    return Sample(tuple(measured), at)


@dataclass(frozen=True, slots=True)
class FilteredReadings:
    """The filtered readings of a tick [graph.width], NaN where one is missing; the rest is per wired sensor.

    `must_stop` says that every actuator has to be neutral; `faults` are FINE, …; `ages` in seconds, infinite where
    there is no sample; `why` the sentences.
    """

    readings: NDArray[np.float32]
    must_stop: bool
    faults: tuple[int, ...]
    ages: tuple[float, ...]
    why: Mapping[str, str]


@dataclass(slots=True)
class _State:
    """A sensor: its last samples for the median, and its last good readings with their time."""

    source: SampleSource
    sensor: Sensor
    window: deque[Sample]
    good: tuple[float, ...] = ()
    good_at: float = -inf


class ReadingFilter:
    """The wired sensors of a mind; `measured` [graph.width] says which readings come of them, or of time alone."""

    def __init__(self, graph: Graph, sources: Sequence[SampleSource]) -> None:
        sensors = {sensor.name: sensor for sensor in graph.sensors}
        self._width = graph.width
        self.measured = rows_of(graph, measured_on_robot(graph, {source.wire.sensor for source in sources}))
        self._states = [
            _State(source, sensors[source.wire.sensor], deque(maxlen=source.wire.median)) for source in sources
        ]

    def now(self, time: float) -> FilteredReadings:
        """The readings of a tick that begins at `time`."""
        readings = np.full(self._width, nan, np.float32)
        faults, ages, why, must_stop = [], [], {}, False
        for state in self._states:
            fault, age, reason = _assess(state, time)
            values = _answer(state, fault, time)
            readings[state.sensor.place] = nan if values is None else values
            faults.append(fault)
            ages.append(age)
            must_stop |= values is None
            if fault != FINE:
                why[state.source.wire.sensor] = reason
        return FilteredReadings(readings, must_stop, tuple(faults), tuple(ages), why)


def _assess(state: _State, time: float) -> tuple[int, float, str]:
    """The fault of a sensor now (FINE, …), the age of its sample, and why."""
    sample = state.source.latest
    if sample is None:
        return UNMEASURED, inf, "has not been measured yet"
    age = time - sample.at
    if age > state.source.wire.max_age:
        return STALE, age, f"was measured {age:.2f} s ago; {sample.fault}".rstrip("; ")
    if sample.fault:
        return FAILED, age, sample.fault
    if not state.window or state.window[-1] is not sample:
        state.window.append(sample)
        wire, circular = state.source.wire, state.sensor.kind.circular
        rows = ([reading(wire, value, circular) for value in each.values] for each in state.window)
        middle = median_direction if circular else median
        good = tuple(float(middle(column)) for column in zip(*rows, strict=True))
        if not all(map(isfinite, good)):
            return FAILED, age, "has readings that are no numbers"
        state.good, state.good_at = good, sample.at
    return FINE, age, ""


def median_direction(directions: Sequence[float]) -> float:
    """The median of directions in turns, 0..1: about the one that is nearest to all, the short ways round."""

    def ways(origin: float) -> list[float]:
        return [(each - origin + 0.5) % 1 - 0.5 for each in directions]

    origin = min(directions, key=lambda each: sum(map(abs, ways(each))))
    return within_turn(origin + median(ways(origin)))


def _answer(state: _State, fault: int, time: float) -> tuple[float, ...] | float | None:
    """The readings, or what each of them is; None where every actuator has to be neutral."""
    wire = state.source.wire
    if fault == FINE:
        return state.good
    state.window.clear()
    match wire.on_fault:
        case "blank":
            return wire.blank
        case "hold" if time - state.good_at <= wire.max_age + wire.hold:
            return state.good
    return None


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
