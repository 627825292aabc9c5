"""Real-time settings of a process: few imports, SCHED_FIFO, locked memory, the last to be killed for memory."""

import ctypes
import gc
import os
import resource
import signal
import sys
import threading
from contextlib import suppress
from importlib.util import find_spec, module_from_spec
from pathlib import Path

FIFO_PRIORITY = 20
LOCK_ALL_MEMORY = 1 | 2  # MCL_CURRENT | MCL_FUTURE
STACK_BYTES = 256 << 10  # for each thread: locked memory is not for stacks that nobody uses
IGNORED_SIGNALS = ("SIGINT", "SIGTSTP", "SIGTTIN", "SIGTTOU", "SIGPIPE", "SIGUSR1", "SIGUSR2", "SIGALRM")
ENDING_SIGNALS = ("SIGTERM", "SIGHUP", "SIGQUIT")


def import_little(package: str) -> None:
    """Let modules of a package be imported without all the others that its `__init__` imports."""
    found = find_spec(package)
    assert found
    if package not in sys.modules:
        sys.modules[package] = module_from_spec(found)


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
