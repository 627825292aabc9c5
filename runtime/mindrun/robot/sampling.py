"""Sensors read outside of the control loop: a thread each, so that a slow or hung one never delays a tick."""

import threading
from collections.abc import Callable
from dataclasses import dataclass
from math import inf, isfinite
from time import monotonic

from mindrun.driver import SensorDevice, failure
from mindrun.graph.wiring import SensorWire
from mindrun.numbers.given_numbers import is_truth, number, values


@dataclass(frozen=True, slots=True)
class Sample:
    """What was measured: a value for each reading in natural units, None where there was nothing, and when it began.

    `fault` says why there are no values; times are seconds of a monotonic clock.
    """

    values: tuple[float | None, ...]
    at: float
    fault: str = ""


class Sampler:
    """Measures one sensor again and again, in a thread of its own; `latest` is what came of it last.

    A device that fails is closed and opened anew, so that one that was unplugged comes back.
    """

    def __init__(self, wire: SensorWire, clock: Callable[[], float] = monotonic) -> None:
        self.wire = wire
        self.latest: Sample | None = None
        self._clock = clock
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name=f"sensor {wire.sensor}", daemon=True)

    def start(self) -> None:
        """Begin to measure."""
        self._thread.start()

    def stop(self, wait: float = 1.0) -> None:
        """Measure no more; a thread that hangs is left behind, it goes with the process."""
        self._stop.set()
        self._thread.join(wait)

    def measured_once(self) -> Sample:
        """A sample measured now, in this thread, of a device that is open for it alone."""
        device, sample = self._measured(None)
        _close(device)
        return sample

    def _run(self) -> None:
        device: SensorDevice | None = None
        due = self._clock()
        while not self._stop.is_set():
            device, self.latest = self._measured(device)
            due = max(due + 1 / self.wire.rate, self._clock())
            self._stop.wait(due - self._clock())
        _close(device)

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
            why = failure(error)
        _close(device)
        return None, Sample((), began, why)


def checked(given: object, at: float, wire: SensorWire) -> Sample:
    """A sample of the values that a device gave, whatever kind of numbers these are, or of the fault that they are."""
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


def _close(device: SensorDevice | None) -> None:
    if device is not None:
        try:
            device.close()
        except BaseException:  # whatever its driver raises: it is of no use any more
            return
