"""How a robot is told to stop: a signal, after whose tick the loop ends. A tick that does not end is interrupted."""

import os
import signal
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from types import FrameType

STOP_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
INTERRUPTED = 130
MAX_INTERRUPTIONS = 5  # to interrupt what hangs, or to end in order, before the process is ended as it is


class Stop:
    """True once a signal has come. From then on all has to end within `grace` seconds, or is interrupted.

    The guardian has every actuator at neutral meanwhile, since it hears nothing, and when this process has ended.
    """

    def __init__(self, grace: float) -> None:
        self._grace = grace
        self._came = False
        self._in_order = False
        self._tries = 0

    def __bool__(self) -> bool:
        return self._came

    @property
    def handlers(self) -> Mapping[signal.Signals, Callable[[int, FrameType | None], None]]:
        """What hears each signal."""
        return dict.fromkeys(STOP_SIGNALS, self.note) | {signal.SIGALRM: self.hurry}

    def hear(self) -> None:
        """Hear the signals, whoever has put something else in the place of what does: libraries of procedures do."""
        for number, handler in self.handlers.items():
            if signal.getsignal(number) != handler:
                signal.signal(number, handler)

    def in_order(self) -> None:
        """The loop has ended by itself: what follows takes its time, and is not interrupted."""
        self._in_order = True

    def note(self, _number: int, _frame: FrameType | None) -> None:
        """A signal came: the second interrupts at once, but not what brings everything to neutral afterwards."""
        if not self._came:
            self._came = True
            signal.setitimer(signal.ITIMER_REAL, self._grace, self._grace)
        else:
            self._interrupt()

    def hurry(self, _number: int, _frame: FrameType | None) -> None:
        """The grace period is over: interrupt the loop."""
        self._tries += 1
        if self._tries >= MAX_INTERRUPTIONS:  # a procedure that catches everything, or a disk that does not answer
            os._exit(INTERRUPTED)
        self._interrupt()

    def _interrupt(self) -> None:
        if not self._in_order:
            self._in_order = True
            raise KeyboardInterrupt


@contextmanager
def stopping(grace: float) -> Iterator[Stop]:
    """Hear the signals that end programs, and let them end this one in order."""
    stop = Stop(grace)
    before = {number: signal.getsignal(number) for number in stop.handlers}
    stop.hear()
    try:
        yield stop
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        for number, handler in before.items():
            signal.signal(number, handler)
