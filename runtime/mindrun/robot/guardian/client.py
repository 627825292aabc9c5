"""The controller's side: start the guardian, send it a frame each tick, and see that it lives."""

import fcntl
import os
import subprocess
import sys
from array import array
from collections.abc import Iterable, Sequence
from contextlib import suppress
from select import select
from termios import FIONREAD
from time import monotonic, monotonic_ns, sleep
from types import TracebackType

from mindrun.errors import MindError
from mindrun.robot.child_processes import keep_from_children, keep_no_longer
from mindrun.robot.guardian.frames import pack
from mindrun.robot.guardian.guard import FOLLOWING, LATCHED, NEUTRAL
from mindrun.robot.guardian.plan import Plan, to_json

# -P: a file of the user's folder that is named like a module must not be imported.
PROGRAM = (sys.executable, "-P", "-m", "mindrun.robot.guardian")
PIPE_BYTES = 4096  # that can wait in the pipe
FORKED_EXIT_CODE = 70  # exit code of a forked process that took itself for the controller
MAX_REPLACEMENTS = 3  # of a guardian, where these are killed as well
POLL_SECONDS = 0.002
HANG_SECONDS = 0.5  # in which the guardian has not once read all that was there


class GuardianError(MindError):
    """The guardian did not start, has latched, or is gone; whatever it is, nothing can be moved any more."""


class Guardian:
    """The guardian as a process of its own. Use it in `with`: at the end every actuator is at neutral.

    Call `send` once a tick, from the control loop and nowhere else: that it is called is what shows that the loop runs.
    """

    def __init__(
        self, plan: Plan, patience: float = 5.0, program: Sequence[str] = PROGRAM, inherited: Sequence[int] = ()
    ) -> None:
        self.state, self.why = NEUTRAL, "started"
        self._plan = f"{to_json(plan)}\n".encode()
        self._rest = tuple(channel.neutral for channel in plan.channels)
        self._patience = patience
        self._program, self._inherited = program, inherited
        self._number = 0
        self._rescued = False
        self._said = b""
        self._read_at = monotonic()
        self._controller = os.getpid()
        # A session of its own: no key of a terminal reaches it, neither Ctrl-C nor Ctrl-Z.
        self._process = subprocess.Popen(
            [*program],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            bufsize=0,
            start_new_session=True,
            pass_fds=inherited,
        )
        assert self._process.stdin
        assert self._process.stdout
        self._input, self._output = self._process.stdin, self._process.stdout
        keep_from_children(self._let_go)
        try:
            self._start()
        except BaseException:
            self._abandon()
            raise

    @property
    def pid(self) -> int:
        """The number of its process."""
        return self._process.pid

    def send(self, commands: Iterable[float], armed: bool) -> None:
        """One tick's commands in the order of the plan; without `armed` nothing moves.

        GuardianError where the guardian has latched, hangs or is gone; then another has tried to bring all to neutral.
        """
        self._end_in_children()
        self._listen()
        if self.state == LATCHED:
            raise GuardianError(f"the guardian holds every actuator at neutral: {self.why}", "start the robot again")
        try:
            self._see_it_read()
            os.write(self._input.fileno(), pack(self._number, monotonic_ns(), armed, tuple(commands)))
        except BlockingIOError:
            raise GuardianError(f"the guardian hangs: {self._rescue(hangs=True)}") from None
        except OSError:
            raise GuardianError(f"the guardian is gone: {self._rescue(hangs=False)}") from None
        self._number += 1

    def close(self) -> None:
        """End the frames and wait until every actuator is at neutral; GuardianError where one is not in time.

        So it is where the guardian has been killed, or hangs; then another has tried.
        """
        self._end_in_children()
        hangs = self.state in (NEUTRAL, FOLLOWING) and not self._hears()
        with suppress(OSError):
            self._input.close()
        try:
            if hangs:
                raise GuardianError(f"the guardian hangs: {self._rescue(hangs=True)}")
            if self._process.wait(self._patience) < 0 and not self._rescued:
                raise GuardianError(f"the guardian is gone: {self._rescue(hangs=False)}")
        except subprocess.TimeoutExpired:
            raise GuardianError(
                f"an actuator is not at neutral after {self._patience:g} s; process {self.pid} goes on trying",
                "cut the actuators' power",
            ) from None
        finally:
            self._output.close()
            keep_no_longer(self._let_go)

    def __enter__(self) -> "Guardian":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            self.close()
        except GuardianError as later:
            if error is None:
                raise
            raise GuardianError(f"{error}; {later}", later.hint) from error

    def _start(self) -> None:
        with suppress(BrokenPipeError):  # it says why
            self._input.write(self._plan)
        until = monotonic() + self._patience
        self.state = ""
        while not self.state:
            if not select([self._output], [], [], max(until - monotonic(), 0.0))[0]:
                raise GuardianError(f"the guardian is not ready after {self._patience:g} s")
            if not self._listen():
                raise GuardianError("the guardian ended before it was ready")
        if self.state != "ready":
            raise GuardianError(f"the guardian cannot start: {self.why}")
        self.state, self._read_at = NEUTRAL, monotonic()
        os.set_blocking(self._output.fileno(), False)
        os.set_blocking(self._input.fileno(), False)
        with suppress(OSError):
            fcntl.fcntl(self._input, fcntl.F_SETPIPE_SZ, PIPE_BYTES)

    def _see_it_read(self) -> None:
        """BlockingIOError where what was sent before has not been read for long."""
        now = monotonic()
        if not self._unread():
            self._read_at = now
        elif now - self._read_at > HANG_SECONDS:
            raise BlockingIOError

    def _hears(self) -> bool:
        """Whether a last frame is read, which lets everything rest; a guardian that is gone is another matter."""
        try:
            os.write(self._input.fileno(), pack(self._number, monotonic_ns(), False, self._rest))
            self._read_at = monotonic()
            while self._unread() and self._process.poll() is None:
                sleep(POLL_SECONDS)
                self._see_it_read()
        except BlockingIOError:
            return False
        except OSError:
            return True
        return True

    def _unread(self) -> int:
        """How many bytes wait in the pipe."""
        unread = array("i", [0])
        fcntl.ioctl(self._input, FIONREAD, unread)
        return unread[0]

    def _listen(self) -> bool:
        """Hear what the guardian has said since; False where it will say no more."""
        try:
            data = os.read(self._output.fileno(), 1 << 16)
        except BlockingIOError:
            return True
        *lines, self._said = (self._said + data).split(b"\n")
        if lines:
            self.state, _, self.why = lines[-1].decode(errors="replace").partition(" ")
        return bool(data)

    def _rescue(self, hangs: bool) -> str:
        """Bring the actuators to neutral in place of a guardian that no longer can; what came of it."""
        if hangs:
            self._process.kill()
        if self._process.wait() == 0:
            return "it was told to end, with every actuator at neutral"
        done = self._replaced()
        self._rescued = True  # not before: a signal may have interrupted it, and then it is tried again
        return done

    def _replaced(self) -> str:
        try:
            codes = (self._replacement().wait(self._patience) for _ in range(MAX_REPLACEMENTS))
            code = next((code for code in codes if code >= 0), None)
        except (OSError, subprocess.TimeoutExpired):  # it may still come to it
            return "nothing has brought the actuators to neutral yet"
        return "another has brought the actuators to neutral" if code == 0 else "an actuator may still move"

    def _replacement(self) -> "subprocess.Popen[bytes]":
        """Another, which brings everything to neutral and ends, whatever becomes of this process meanwhile."""
        with open(os.memfd_create("plan"), "w+b", buffering=0) as plan:  # noqa: PTH123  whole before there is a reader
            plan.write(self._plan)
            plan.seek(0)
            return subprocess.Popen(
                [*self._program, "--neutral", "-"],
                stdin=plan,
                stdout=subprocess.DEVNULL,
                start_new_session=True,
                pass_fds=self._inherited,
            )

    def _let_go(self) -> None:
        """In a forked process: neither speak to the guardian nor hear it, nor keep it alive."""
        self._input.close()
        self._output.close()

    def _end_in_children(self) -> None:
        """End a process that a procedure has forked and that has come back from it: it is no controller."""
        if os.getpid() != self._controller:
            os._exit(FORKED_EXIT_CODE)

    def _abandon(self) -> None:
        """It never was of use: let it end by itself if it does, since that is at neutral, or make it end."""
        with suppress(GuardianError):
            self.close()
        if self._process.poll() is None:
            self._process.kill()
            self._process.wait()
