"""How the processes of a robot end: with a parent, by a signal, or by a driver; and what one that was forked may do."""

import ctypes
import os
import signal
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from types import FrameType
from typing import NoReturn

PARENT_DIED = 1  # PR_SET_PDEATHSIG
FAILURE_EXIT_CODE = 1
FORKED_EXIT_CODE = 70
STOP_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
INTERRUPTED = 130
MAX_INTERRUPTIONS = 5  # to interrupt what hangs, or to end in order, before the process is ended as it is
MESSAGE = "mindrun: a driver or a procedure has ended this process"

let_go_in_children: set[Callable[[], None]] = set()  # is called in every process that is forked, and not in this one


def end_with_parent(parent: int, by: signal.Signals) -> None:
    """Get this signal when process `parent`, or its thread that began this one, has ended, as far as the system can."""
    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).prctl(PARENT_DIED, by)
    if os.getppid() != parent:
        os.kill(os.getpid(), by)


def end_in_child(process: int) -> None:
    """End a process that code of a user has forked, and that has come back from it: only `process` drives."""
    if os.getpid() != process:
        os._exit(FORKED_EXIT_CODE)


def _in_child() -> None:
    while let_go_in_children:
        let_go_in_children.pop()()


os.register_at_fork(after_in_child=_in_child)


@contextmanager
def refuse_success(then: str = "") -> Iterator[None]:
    """A context in which `os._exit(0)` is a failure, in any thread. C may end the process unseen; `then` is told."""
    leave, process = os._exit, os.getpid()

    def _exit(status: int) -> NoReturn:
        if os.getpid() == process:
            os.write(2, f"{MESSAGE}{then}\n".encode())
            status = status or FAILURE_EXIT_CODE
        leave(status)

    os._exit = _exit
    try:
        yield
    finally:
        os._exit = leave


class StopSignals:
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
        return dict.fromkeys(STOP_SIGNALS, self.note) | {signal.SIGALRM: self.hurry}

    def hear(self) -> None:
        """Hear the signals, whoever has put something else in the place of what does: libraries of procedures do."""
        for number, handler in self.handlers.items():
            if signal.getsignal(number) != handler:
                signal.signal(number, handler)

    def in_order(self) -> None:
        """Interrupt nothing any more: the loop has ended by itself, and what follows takes its time."""
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
def stopping(grace: float) -> Iterator[StopSignals]:
    """Hear the signals that end programs, and let them end this one in order."""
    stop = StopSignals(grace)
    before = {number: signal.getsignal(number) for number in stop.handlers}
    stop.hear()
    try:
        yield stop
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        for number, handler in before.items():
            signal.signal(number, handler)
