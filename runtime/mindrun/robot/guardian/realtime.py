"""Settings of a process for real time: SCHED_FIFO, locked memory, signals, prints that never wait."""

import ctypes
import gc
import os
import resource
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from mindrun.terminal.standard_streams import ERROR_DESCRIPTOR, OUTPUT_DESCRIPTOR, LineWriter

FIFO_PRIORITY = 20
LOCK_ALL_MEMORY = 1 | 2  # MCL_CURRENT | MCL_FUTURE
STACK_BYTES = 256 << 10  # for each thread: locked memory is not for stacks that nobody uses
PIECE_BYTES, LAST_SECONDS = 1 << 16, 0.3  # that are read at once; for what is left in the end
IGNORED_SIGNALS = ("SIGINT", "SIGTSTP", "SIGTTIN", "SIGTTOU", "SIGPIPE", "SIGUSR1", "SIGUSR2", "SIGALRM")
ENDING_SIGNALS = ("SIGTERM", "SIGHUP", "SIGQUIT")


def set_realtime() -> None:
    """Ask for real-time scheduling and locked memory; without them the guardian works, later on a busy machine."""
    threading.stack_size(STACK_BYTES)
    sys.setswitchinterval(0.0005)
    with suppress(OSError):
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(FIFO_PRIORITY))
    with suppress(OSError):
        Path("/proc/self/oom_score_adj").write_text("-1000")
    with suppress(OSError, AttributeError):
        # Under a limit, what is locked now would be missing later.
        if os.geteuid() == 0 or resource.getrlimit(resource.RLIMIT_MEMLOCK)[0] == resource.RLIM_INFINITY:
            ctypes.CDLL(None, use_errno=True).mlockall(LOCK_ALL_MEMORY)
    gc.freeze()


def ignore(*names: str) -> None:
    """Let these signals do nothing from now on."""
    for name in names:
        signal.signal(signal.Signals[name], signal.SIG_IGN)


def wake_on_signals(descriptor: int) -> None:
    """From now on a signal that ends programs writes its number there, and one of the terminal does nothing.

    Ctrl-C is the controller's to answer: when that ends, so do its frames.
    """
    ignore(*IGNORED_SIGNALS)
    signal.set_wakeup_fd(descriptor, warn_on_full_buffer=False)
    for name in ENDING_SIGNALS:
        signal.signal(signal.Signals[name], lambda number, frame: None)


@contextmanager
def printing_never_waits() -> Iterator[None]:
    """A context in which what is printed here, and in forks, is passed on to standard error by a thread, or dropped.

    So a `print` of a driver never fails, and keeps no motor running, whoever reads it. Forks hold the
    reading end as well: where this process is gone, a pipe takes what they print.
    """
    errors = os.dup(ERROR_DESCRIPTOR)
    reading, writing = os.pipe()
    for descriptor in (OUTPUT_DESCRIPTOR, ERROR_DESCRIPTOR):
        os.dup2(writing, descriptor)
    os.close(writing)
    writer = LineWriter(errors)

    def pass_on() -> None:
        while piece := os.read(reading, PIECE_BYTES):
            writer.write(piece)

    thread = threading.Thread(target=pass_on, name="printing", daemon=True)
    thread.start()
    try:
        yield
    finally:
        for descriptor in (OUTPUT_DESCRIPTOR, ERROR_DESCRIPTOR):
            os.dup2(errors, descriptor)  # the last of the writing ends, but for those of forked processes that hang
        thread.join(LAST_SECONDS)
        writer.drain(LAST_SECONDS)
