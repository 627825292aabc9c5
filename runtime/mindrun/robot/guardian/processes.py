"""A guardian's processes, as the controller has them: begun, replaced where they are lost, ended."""

import os
import signal
import subprocess
from collections.abc import Sequence
from contextlib import suppress

from mindrun.robot.guardian.plan import Plan, to_json
from mindrun.robot.guardian.status import Heard
from mindrun.robot.guardian.watch import RESCUE_SECONDS

MAX_REPLACEMENTS = 3  # of a guardian, where these are killed as well
WORDS_SECONDS = RESCUE_SECONDS + 1.0  # in which all is said of what is brought to neutral in place of a guardian
KILL_SECONDS = 0.5  # for a process to end that is killed; one that waits for a device does not hear it


class Processes:
    """The process that was started, what it and its own processes have said, and how another is started."""

    def __init__(self, plan: Plan, program: Sequence[str], inherited: Sequence[int]) -> None:
        self.plan = f"{to_json(plan)}\n".encode()
        self.is_replaced = False
        self._names = [channel.actuator for channel in plan.channels]
        self._program, self._inherited = program, inherited
        # A session of its own: no key of a terminal reaches it, neither Ctrl-C nor Ctrl-Z.
        self.first = subprocess.Popen(
            [*program],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            bufsize=0,
            start_new_session=True,
            pass_fds=inherited,
        )
        assert self.first.stdin
        assert self.first.stdout
        self.input, self.output = self.first.stdin, self.first.stdout
        os.set_blocking(self.output.fileno(), False)
        self.heard = Heard(self.output.fileno())

    @property
    def worker(self) -> int:
        """The number of the process that opens the actuators."""
        return self.heard.worker or self.first.pid

    def replace(self) -> str:
        """Bring the actuators to neutral in place of a guardian that no longer can; what came of it.

        It is the process that watches the worker which does it or, where that is lost as well, another.
        """
        heard = self.heard
        heard.listen()
        if not heard.rests and self.first.poll() is None:
            with suppress(ProcessLookupError):
                os.kill(self.worker, signal.SIGKILL)
            heard.wait(lambda heard: heard.is_over, WORDS_SECONDS)
        if not heard.rests and not heard.is_over:
            self._kill()
            self._start_others()
        self.is_replaced = True  # not before: a signal may have interrupted it, and then it is tried again
        return self._outcome()

    def end(self, seconds: float) -> None:
        """Wait for the end of what has no more to do, but not for ever."""
        try:
            self.first.wait(seconds)
        except subprocess.TimeoutExpired:
            self._kill()

    def let_go(self) -> None:
        """Neither speak to it nor hear it, nor keep it alive."""
        with suppress(OSError):
            self.input.close()
        with suppress(OSError):
            self.output.close()

    def _kill(self) -> None:
        """End all of its processes."""
        for group in (self.first.pid, self.worker):
            with suppress(ProcessLookupError):
                os.killpg(group, signal.SIGKILL)
        with suppress(subprocess.TimeoutExpired):
            self.first.wait(KILL_SECONDS)

    def _start_others(self) -> None:
        for _ in range(MAX_REPLACEMENTS):
            another = self.another()
            assert another.stdout
            with another.stdout:
                os.set_blocking(another.stdout.fileno(), False)
                heard = Heard(another.stdout.fileno(), at_rest=self.heard.at_rest)
                in_time = heard.wait(lambda heard: heard.is_over, WORDS_SECONDS)
            if heard.is_over or not in_time:  # it may still come to it
                return

    def another(self) -> "subprocess.Popen[bytes]":
        """Another, which brings everything to neutral and ends, whatever becomes of this process meanwhile."""
        with open(os.memfd_create("plan"), "w+b", buffering=0) as plan:  # noqa: PTH123  whole before there is a reader
            plan.write(self.plan)
            plan.seek(0)
            return subprocess.Popen(
                [*self._program, "--neutral", "-"],
                stdin=plan,
                stdout=subprocess.PIPE,
                bufsize=0,
                start_new_session=True,
                pass_fds=self._inherited,
            )

    def _outcome(self) -> str:
        at_rest = [name for name in self._names if self.heard.rests or name in self.heard.at_rest]
        moving = [name for name in self._names if name not in at_rest]
        if self.heard.rests:
            return "it has ended, with every actuator at neutral"
        if not moving:
            return "another has brought the actuators to neutral"
        return f"{', '.join(moving)} may still move; at neutral: {', '.join(at_rest) or 'none'}"
