"""A worker that is a process: begun at its place, asked with frames, and never waited for in vain."""

import os
import subprocess
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from signal import Signals

from mindrun.work.frame import DIGEST_BYTES, LINE_END, Frame, FrameError, Stream, read, read_first, unpack
from mindrun.work.last_step import LastStep
from mindrun.work.pipes import LostError, Pipes
from mindrun.work.worker import ALIVE, MAX_SILENT_SECONDS, READY

START_SECONDS = 600.0  # until a worker is there: others may have to leave their machine first


@dataclass(frozen=True, slots=True)
class Place:
    """Where a worker runs: what to call it, and the command that is one, with variables of its surroundings.

    One of this machine, which `writes_step`, is told with --last-step behind which descriptor.
    """

    name: str
    command: Sequence[str]
    variables: Mapping[str, str] = field(default_factory=dict)
    writes_step: bool = False


class NoFrameError(LostError):
    """Who was asked speaks of something else; one that begins with that is no worker, now or the next time."""


class Child:
    """The worker at a place; `hear` takes what it says on standard error.

    LostError where it has ended, has been silent for too long, or answers nonsense.
    """

    def __init__(self, place: Place, hear: Callable[[bytes], object] = lambda part: None) -> None:
        self.place, self._hear = place, hear
        self.process: subprocess.Popen[bytes] | None = None
        self._pipes: Pipes | None = None
        self._at = ""
        self.last_step: LastStep | None = None
        self._is_over = False

    @property
    def has_begun(self) -> bool:
        """Whether its process is there."""
        return self._pipes is not None

    def begin(self) -> None:
        """Begin the process, unless it is there, and wait until it says that it takes jobs."""
        if self._pipes is not None:
            return
        self._at = ""
        try:
            self.process = self._begun()
        except OSError as error:
            raise LostError(f"{error.strerror}") from error
        if self._is_over:  # it was killed while it was begun
            self.end_process()
        self._pipes = Pipes(self.process, START_SECONDS, self._hear)
        self._pipes.silent_seconds = _silent_seconds(self._first(self._pipes))

    def ask(self, data: bytes) -> Frame:
        """The answer to a frame; in between it may say that it is alive."""
        assert self._pipes is not None
        self._at = ""
        try:
            self._pipes.write(data)
        except OSError as error:
            raise self._ended(f"{error.strerror}") from error
        while (answer := self._heard(self._pipes)).kind == ALIVE:
            self._at = f"{answer.about.get('at', '')}"[:300]
        if answer.about.get("of") != data[-DIGEST_BYTES:].hex():
            raise LostError("it answers another job than it was asked")
        return answer

    def where(self) -> str:
        """In or after which step of an environment it is, as far as is known, in words; else nothing."""
        if self.last_step is not None and (found := self.last_step.read()):
            return " in ".join(found)
        return self._at

    def ending(self) -> str:
        """How its process has ended: an exit code or a signal; nothing where that is not known."""
        code = self.process.poll() if self.process is not None else None
        if code is None:
            return ""
        if code >= 0:
            return f"exit code {code}"
        return Signals(-code).name if -code in {*Signals} else f"signal {-code}"

    def kill(self) -> None:
        """End the process, and one that is just being begun; whoever waits for it is told by its pipes."""
        self._is_over = True
        self.end_process()

    def end(self) -> None:
        """End the process, whatever it does."""
        self.end_process()
        pipes, self._pipes = self._pipes, None
        if pipes is not None:
            pipes.close()
        last_step, self.last_step = self.last_step, None
        if last_step is not None:
            last_step.close()
        if self.process is not None:
            self.process.wait()

    def _begun(self) -> "subprocess.Popen[bytes]":
        command, inherited = [*self.place.command], list[int]()
        if self.place.writes_step:
            self.last_step = LastStep()
            inherited.append(self.last_step.descriptor)
            command += ["--last-step", f"{self.last_step.descriptor}"]
        # A session of its own: Ctrl-C at the terminal is for who asks, who lets the work go on to be saved.
        pipe = subprocess.PIPE
        return subprocess.Popen(
            command,
            stdin=pipe,
            stdout=pipe,
            stderr=pipe,
            bufsize=0,
            start_new_session=True,
            env={**os.environ, **self.place.variables},
            pass_fds=inherited,
        )

    def end_process(self) -> None:
        """End the process alone; whoever waits for it is told by its pipes, and the next question begins another."""
        if (process := self.process) is not None:
            with suppress(OSError):
                process.kill()

    def _first(self, pipes: Pipes) -> Frame:
        """What it says first. It is given the end of a line, which a worker passes over, and others answer."""
        with suppress(OSError):  # one that has ended may have said why
            pipes.write(LINE_END)
        return self._heard(pipes, read_first)

    def _heard(self, pipes: Pipes, take: Callable[[Stream], bytes | None] = read) -> Frame:
        try:
            data = take(pipes)
            if data is None:
                raise self._ended("it ended")
            return unpack(data)
        except LostError as error:
            raise LostError(f"{error}, {where}" if (where := self.where()) else f"{error}") from error
        except FrameError as error:
            raise NoFrameError(f"its answer is no frame: {error}") from error
        except OSError as error:
            raise self._ended(f"{error.strerror}") from error

    def _ended(self, otherwise: str) -> LostError:
        said = (self._pipes.last_line() if self._pipes else "") or otherwise
        return LostError(f"{said} ({how})" if (how := self.ending()) else said)


def _silent_seconds(first: Frame) -> float:
    match first.kind, first.about:
        case kind, {"silent_seconds": int(seconds)} if kind == READY and 0 < seconds <= MAX_SILENT_SECONDS:
            return float(seconds)
    raise NoFrameError("what it says first is not that it is ready")
