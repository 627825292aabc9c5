"""The guardian's first process: it opens no device, and does what is left to do when the one that does has ended."""

import os
import signal
from collections.abc import Callable
from contextlib import suppress

from mindrun.robot.guardian.plan import Plan
from mindrun.robot.guardian.realtime import ENDING_SIGNALS, IGNORED_SIGNALS, ignore
from mindrun.robot.guardian.rescue import ERROR_DESCRIPTOR, rescue
from mindrun.robot.guardian.status import OVER, REST, WORKER, say
from mindrun.robot.parent_process import end_with_parent
from mindrun.terminal.line_writer import LineWriter

RESCUE_SECONDS = 5.0


def watch(plan: Plan, frames: int, status: int, work: Callable[[int], int]) -> int:
    """Let another process `work`, which says its last word into the descriptor that it is given; its exit code.

    However that ends, or is stopped: without the word nothing is known to be at neutral, and all is brought there.
    """
    words, word = os.pipe()
    ignore(*IGNORED_SIGNALS)
    worker = _begun(work, words, word)
    os.close(frames)
    os.close(word)
    say(status, WORKER, worker)
    for name in ENDING_SIGNALS:
        signal.signal(signal.Signals[name], lambda number, frame: _pass_on(worker, number))
    os.waitid(os.P_PID, worker, os.WEXITED | os.WSTOPPED | os.WNOWAIT)
    ignore(*ENDING_SIGNALS)
    os.kill(worker, signal.SIGKILL)  # where it was stopped
    code = os.waitstatus_to_exitcode(os.waitpid(worker, 0)[1])
    if _is_at_rest(words):
        say(status, REST)
    else:
        how = f"by signal {-code}" if code < 0 else f"with exit code {code}"
        if not rescued(plan, status, RESCUE_SECONDS):
            report(f"it was ended {how} before all was at neutral; now all is, each by a process of its own")
    say(status, OVER)
    return abs(code)


def rescued(plan: Plan, status: int, seconds: float) -> list[str]:
    """Bring all to neutral, saying which are; the names of those that are not known to be, which are reported."""
    ignore(*IGNORED_SIGNALS, *ENDING_SIGNALS)  # whoever tells it to end is told that it does, when it is done
    at_rest = rescue(plan, lambda name: say(status, REST, name), seconds)
    missing = [channel.actuator for channel in plan.channels if channel.actuator not in at_rest]
    if missing:
        report(f"not known to be at neutral: {', '.join(missing)}; cut the actuators' power")
    return missing


def report(line: str) -> None:
    """Say a line on standard error, as far as it is read."""
    errors = LineWriter(ERROR_DESCRIPTOR, "guardian: ")
    errors(line)
    errors.drain(0.2)


def _begun(work: Callable[[int], int], words: int, word: int) -> int:
    watcher, code = os.getpid(), 1
    worker = os.fork()
    if not worker:
        try:
            os.close(words)
            os.setsid()  # a driver may end its whole process group, which the watcher is not in
            end_with_parent(watcher, signal.SIGTERM)
            code = work(word)
        finally:
            os._exit(code)
    return worker


def _pass_on(worker: int, number: int) -> None:
    with suppress(ProcessLookupError):
        os.kill(worker, number)


def _is_at_rest(words: int) -> bool:
    os.set_blocking(words, False)  # who was forked may hold the other end
    with suppress(BlockingIOError):
        return os.read(words, 1 << 10) == f"{REST}\n".encode()
    return False
