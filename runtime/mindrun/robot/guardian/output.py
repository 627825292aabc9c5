"""One actuator's writer: a thread of its own, so that a device that hangs keeps no other from its neutral.

It opens the device anew, too, where that has failed for long: one that was unplugged comes back.
"""

import os
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from math import inf
from threading import Condition, Thread
from time import monotonic

from mindrun.driver import ActuatorDevice, failure
from mindrun.robot.processes import end_in_child

MIN_RETRY_SECONDS, MAX_RETRY_SECONDS = 0.002, 0.05  # seconds between two tries: at first, and in the end
BOOT_SECONDS = 5.0  # for a device that was opened anew to acknowledge its first command


@dataclass(frozen=True, slots=True)
class Wanted:
    """A value that a device should have; a newer one replaces it, whether or not it was written."""

    value: float
    neutral: bool


class ActuatorOutput:
    """Writes what is wanted until the device acknowledges it; at the beginning that is neutral.

    A device that has worked, refuses neutral, and has acknowledged nothing for longer than `patience` is lost: it is
    closed, and `opened` anew as often as it takes.
    """

    def __init__(
        self,
        name: str,
        rest: float,
        settled: Callable[[], None],
        opened: Callable[[], ActuatorDevice],
        patience: float,
        clock: Callable[[], float] = monotonic,
    ) -> None:
        self.name = name
        self.error = ""
        self._neutral = rest
        self._settled = settled
        self._opened = opened
        self._patience = patience
        self._clock = clock
        self._wanted = Wanted(rest, True)
        self._waiting: float | None = clock()  # since when nothing has been acknowledged that should have been
        self._closing = False
        self._process = os.getpid()
        self._change = Condition()
        self._thread = Thread(target=self._run, name=name, daemon=True)
        self._device: ActuatorDevice | None = None
        self._is_new_until = inf
        self._refuses_neutral = False
        self._writing_since: float | None = None

    def start(self, device: ActuatorDevice) -> None:
        """Begin to write."""
        self._device = device
        self._thread.start()

    def move(self, value: float) -> None:
        """Order a value; returns at once."""
        self._want(value, False)

    def rest(self) -> None:
        """Order neutral; returns at once."""
        self._want(self._neutral, True)

    @property
    def settled(self) -> bool:
        """Whether neutral was the last that was wanted, and is acknowledged."""
        with self._change:
            return self._wanted.neutral and self._waiting is None

    def late(self, now: float) -> float:
        """For how long the device has acknowledged nothing, though something was wanted; one that is slow answers."""
        with self._change:
            return 0.0 if self._waiting is None else now - self._waiting

    def hangs(self, now: float) -> float:
        """For how long the write under way has not returned, be it with an error; 0 where there is none."""
        since = self._writing_since
        return 0.0 if since is None else now - since

    def close(self, seconds: float) -> None:
        """Close the device; give up where that takes longer than allowed."""
        with self._change:
            self._closing = True
            self._change.notify()
        self._thread.join(seconds)

    def attempt(self) -> Wanted | None:
        """Write what is wanted, once: what has been tried without success, or None when there is nothing left to do."""
        wanted = self._wanted
        try:
            device = self._working_device()
            wanted = self._wanted  # of a device that was opened anew neutral: whoever opens it orders that
            self._writing_since = self._clock()
            device.write(wanted.value)
            end_in_child(self._process)
        except BaseException as error:  # whatever a driver raises, this thread goes on
            end_in_child(self._process)
            self.error, self._refuses_neutral = failure(error), wanted.neutral
            return wanted
        finally:
            self._writing_since = None
        with self._change:
            self.error, self._refuses_neutral, self._is_new_until = "", False, -inf
            if self._wanted is not wanted:
                self._waiting = self._clock()
                return wanted
            self._waiting = None
        if wanted.neutral:
            self._settled()
        return None

    def _working_device(self) -> ActuatorDevice:
        """The device, opened anew where it is lost; raises whatever its driver does."""
        now = self._clock()
        if self._refuses_neutral and self.late(now) > self._patience and now > self._is_new_until:
            self._close()
        if self._device is None:
            self._device = self._opened()
            self._is_new_until = self._clock() + BOOT_SECONDS
        return self._device

    def _close(self) -> None:
        device, self._device = self._device, None
        if device is not None:
            with suppress(BaseException):  # whatever its driver raises: it is of no use any more
                device.close()
            end_in_child(self._process)

    def _want(self, value: float, neutral: bool) -> None:
        with self._change:
            self._wanted = Wanted(value, neutral)
            if self._waiting is None:
                self._waiting = self._clock()
            self._change.notify()

    def _run(self) -> None:
        pause = MIN_RETRY_SECONDS
        while not self._closing:
            tried = self.attempt()
            with self._change:
                if tried is self._wanted:
                    self._change.wait(pause)
                elif tried is None and self._waiting is None and not self._closing:
                    self._change.wait()
                pause = min(2 * pause, MAX_RETRY_SECONDS) if tried is self._wanted else MIN_RETRY_SECONDS
        self._close()
