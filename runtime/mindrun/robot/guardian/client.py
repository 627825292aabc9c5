"""The controller's side: start the guardian, send it a frame each tick, and see that it lives."""

import fcntl
import os
import signal
import subprocess
import sys
from collections.abc import Iterable, Sequence
from contextlib import AbstractContextManager, suppress
from termios import FIONREAD
from time import monotonic, monotonic_ns, sleep
from typing import IO

from mindrun.errors import MindError
from mindrun.robot.guardian.guard import FOLLOWING, LATCHED, MOVES_ON, NEUTRAL, NOT_ARMED, STARTED
from mindrun.robot.guardian.messages import Heard, pack
from mindrun.robot.guardian.plan import Plan, to_json
from mindrun.robot.guardian.watch import RESCUE_SECONDS
from mindrun.robot.processes import end_in_child, let_go_in_children

# -P: a file of the user's folder that is named like a module must not be imported.
PROGRAM = (sys.executable, "-P", "-m", "mindrun.robot.guardian")
PIPE_BYTES = 4096  # that can wait in the pipe
POLL_SECONDS = 0.002
HANG_SECONDS = 0.5  # in which the guardian has not once read all that was there
MAX_REPLACEMENTS = 3  # of a guardian, where these are killed as well
WORDS_SECONDS = RESCUE_SECONDS + 1.0  # in which all is said of what is brought to neutral in place of a guardian
KILL_SECONDS = 0.5  # for a process to end that is killed; one that waits for a device does not hear it
CUT = "cut the actuators' power"


class Processes:
    """The process that was started, what it and its own processes have said, and how another is started."""

    def __init__(self, plan: Plan, program: Sequence[str], inherited: Sequence[int]) -> None:
        self.plan = f"{to_json(plan)}\n".encode()
        self.is_replaced = False
        self._names = [channel.actuator for channel in plan.channels]
        self._program, self._inherited = program, inherited
        self.first = self._begun(subprocess.PIPE)
        assert self.first.stdin
        assert self.first.stdout
        self.input, self.output = self.first.stdin, self.first.stdout
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
        if heard.rests:
            return "it has ended, with every actuator at neutral"
        moving = [name for name in self._names if name not in heard.at_rest]
        if not moving:
            return "another has brought the actuators to neutral"
        at_rest = [name for name in self._names if name in heard.at_rest]
        return f"{', '.join(moving)} may still move; at neutral: {', '.join(at_rest) or 'none'}"

    def end(self, seconds: float) -> None:
        """Wait for the guardian, which has no more to do, to end; kill it where that takes longer."""
        try:
            self.first.wait(seconds)
        except subprocess.TimeoutExpired:
            self._kill()

    def let_go(self) -> None:
        """Close both pipes: neither speak to it nor hear it, nor keep it alive."""
        for pipe in (self.input, self.output):
            with suppress(OSError):
                pipe.close()

    def _kill(self) -> None:
        """End all of its processes."""
        for group in (self.first.pid, self.worker):
            with suppress(ProcessLookupError):
                os.killpg(group, signal.SIGKILL)
        with suppress(subprocess.TimeoutExpired):
            self.first.wait(KILL_SECONDS)

    def _start_others(self) -> None:
        for _ in range(MAX_REPLACEMENTS):
            another = self.start_another()
            assert another.stdout
            with another.stdout:
                heard = Heard(another.stdout.fileno(), at_rest=self.heard.at_rest)
                in_time = heard.wait(lambda heard: heard.is_over, WORDS_SECONDS)
            if heard.is_over or not in_time:  # it may still come to it
                return

    def start_another(self) -> "subprocess.Popen[bytes]":
        """Start another guardian, which brings everything to neutral and ends, whatever becomes of this process."""
        with open(os.memfd_create("plan"), "w+b", buffering=0) as plan:  # noqa: PTH123  whole before there is a reader
            plan.write(self.plan)
            plan.seek(0)
            return self._begun(plan, "--neutral", "-")

    def _begun(self, plan: IO[bytes] | int, *words: str) -> "subprocess.Popen[bytes]":
        """A guardian, in a session of its own: no key of a terminal reaches it, neither Ctrl-C nor Ctrl-Z."""
        process = subprocess.Popen(
            [*self._program, *words], stdin=plan, stdout=subprocess.PIPE, bufsize=0, start_new_session=True,
            pass_fds=self._inherited,
        )  # fmt: skip
        assert process.stdout
        os.set_blocking(process.stdout.fileno(), False)
        return process


class GuardianError(MindError):
    """The guardian did not start, has latched, or is gone; whatever it is, nothing can be moved any more."""


class Guardian(AbstractContextManager["Guardian"]):
    """The guardian as a process of its own. Use it in `with`: at the end every actuator is at neutral.

    Call `send` once a tick, from the control loop and nowhere else: that it is called is what shows that the loop runs.
    """

    def __init__(
        self, plan: Plan, patience: float = 5.0, program: Sequence[str] = PROGRAM, inherited: Sequence[int] = ()
    ) -> None:
        self._rest = tuple(channel.neutral for channel in plan.channels)
        self._patience = patience
        self._number = 0
        self._controller = os.getpid()
        self._processes = Processes(plan, program, inherited)
        self._heard, self._frames = self._processes.heard, self._processes.input.fileno()
        self._read_at = monotonic()
        let_go_in_children.add(self._processes.let_go)
        try:
            self._start()
        except GuardianError as error:
            done = self._abandon()
            raise GuardianError(f"{error}; {done}" if done else str(error), error.hint) from None
        except BaseException:
            self._abandon()
            raise

    @property
    def pid(self) -> int:
        """The number of the process that opens the actuators."""
        return self._processes.worker

    @property
    def state(self) -> str:
        """The guardian's state, as it said last: neutral, following or latched."""
        return self._heard.state

    @property
    def why(self) -> str:
        """The reason for its state, as it said last."""
        return self._heard.why

    @property
    def holds(self) -> str:
        """The reason, as it said last, to hold every actuator at neutral, whatever it is sent; "" where it does not.

        What it says of a tick's commands is heard with the next tick.
        """
        return "" if self.state == FOLLOWING or self.why in (STARTED, NOT_ARMED) else self.why

    def send(self, commands: Iterable[float], armed: bool) -> None:
        """Send one tick's commands in the order of the plan; without `armed` nothing moves.

        GuardianError where the guardian has latched, hangs or is gone; then others have tried to bring all to neutral.
        """
        end_in_child(self._controller)  # a procedure may have forked it
        self._heard.listen()
        if self.state == LATCHED:
            if MOVES_ON in self.why:
                raise GuardianError(f"the guardian follows no more: {self.why}", CUT)
            raise GuardianError(f"the guardian holds every actuator at neutral: {self.why}", "start the robot again")
        try:
            if self._heard.is_lost:
                raise BrokenPipeError
            self._see_it_read()
            os.write(self._frames, pack(self._number, monotonic_ns(), armed, tuple(commands)))
        except BlockingIOError:
            raise self._lost("hangs") from None
        except OSError:
            raise self._lost("is gone") from None
        self._number += 1

    def close(self) -> None:
        """End the frames and wait until every actuator is at neutral; GuardianError where that is not known in time."""
        end_in_child(self._controller)  # a procedure may have forked it
        heard = self._heard
        hangs = self.state in (NEUTRAL, FOLLOWING) and not heard.is_lost and not self._reads_last_frame()
        with suppress(OSError):
            self._processes.input.close()
        try:
            if hangs:
                raise self._lost("hangs")
            if self._processes.is_replaced:
                return
            if not heard.wait(lambda heard: heard.is_lost, self._patience):
                raise GuardianError(
                    f"an actuator is not at neutral after {self._patience:g} s; process {self.pid} goes on trying", CUT
                )
            if not heard.rests:
                raise self._lost("is gone")
        finally:
            self._finish()

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        try:
            self.close()
        except GuardianError as later:
            if error is None:
                raise
            raise GuardianError(f"{error}; {later}", later.hint) from error

    def _start(self) -> None:
        with suppress(BrokenPipeError):  # it says why
            self._processes.input.write(self._processes.plan)
        heard = self._heard
        if not heard.wait(lambda heard: heard.state or heard.is_lost, self._patience):
            raise GuardianError(f"the guardian is not ready after {self._patience:g} s")
        if heard.state == "failed":
            raise GuardianError(f"the guardian cannot start: {self.why}")
        if heard.state != "ready" or heard.is_lost:
            raise GuardianError("the guardian ended before it was ready")
        heard.state, heard.why, self._read_at = NEUTRAL, STARTED, monotonic()
        os.set_blocking(self._frames, False)
        with suppress(OSError):
            fcntl.fcntl(self._frames, fcntl.F_SETPIPE_SZ, PIPE_BYTES)

    def _see_it_read(self) -> None:
        """BlockingIOError where what was sent before has not been read for long."""
        now = monotonic()
        if not self._unread():
            self._read_at = now
        elif now - self._read_at > HANG_SECONDS:
            raise BlockingIOError

    def _reads_last_frame(self) -> bool:
        """Send a last frame, which lets everything rest; False if the guardian hangs, and does not read it in time."""
        try:
            os.write(self._frames, pack(self._number, monotonic_ns(), False, self._rest))
            self._read_at = monotonic()
            while self._unread() and not (self._heard.is_lost or self._heard.has_ended):
                sleep(POLL_SECONDS)
                self._see_it_read()
                self._heard.listen()
        except BlockingIOError:
            return False
        except OSError:
            return True
        return True

    def _unread(self) -> int:
        """How many bytes wait in the pipe."""
        return int.from_bytes(fcntl.ioctl(self._frames, FIONREAD, bytes(4)), sys.byteorder)

    def _lost(self, how: str) -> GuardianError:
        """The error of a guardian that is lost, once others have brought to neutral what they could."""
        done = self._processes.replace()
        return GuardianError(f"the guardian {how}: {done}", CUT if "may still move" in done else "")

    def _abandon(self) -> str:
        """Let a guardian that was never ready end by itself, at neutral, or replace it; what came of that."""
        heard, done = self._heard, ""
        with suppress(OSError):
            self._processes.input.close()
        failed = self.state == "failed" and heard.wait(lambda heard: heard.is_lost, self._patience)
        if not failed or not (heard.rests or heard.has_ended):
            done = self._processes.replace()
        self._finish()
        return done

    def _finish(self) -> None:
        if self._heard.rests or self._heard.has_ended or self._processes.is_replaced:
            self._processes.end(self._patience)
        self._processes.output.close()
        let_go_in_children.discard(self._processes.let_go)
