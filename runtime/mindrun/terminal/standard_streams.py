"""The standard streams, such that no program ends by them: there, in any encoding, and never an exception.

What cannot be told is dropped, since it must not change what is done; what standard output does not take is
remembered: a document that is not whole is no success. Where a robot drives, nobody waits for a reader either: a
terminal that is paused must not keep a wheel turning.
"""

import os
import sys
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stdout
from ctypes import CDLL
from dataclasses import dataclass, field
from io import BufferedWriter, FileIO, RawIOBase, TextIOWrapper
from select import select
from threading import Condition, Lock, Thread
from time import monotonic
from typing import Any, TextIO

from mindrun.errors import reason
from mindrun.files.printable import visible

OUTPUT_DESCRIPTOR, ERROR_DESCRIPTOR = 1, 2
USUAL_COLUMNS = 80  # of a terminal that does not say
MAX_WAITING_PIECES = 1000  # pieces that wait for a reader; the oldest go first
PLAIN_SECONDS = 10.0  # from one status to the next, where there is no terminal that could rewrite a line
CLEAR = "\r\033[K"  # back to the beginning of the line, and nothing behind it
DRAIN_SECONDS = 1.0  # in which what a thread writes to standard error must be taken


class LineWriter(RawIOBase):
    """Writes to a file descriptor from a thread of its own; what nobody takes is dropped."""

    def __init__(self, descriptor: int, prefix: str = "") -> None:
        super().__init__()
        self._descriptor = descriptor
        self._prefix = prefix
        self._waiting: deque[bytes] = deque(maxlen=MAX_WAITING_PIECES)
        self._idle = True
        self._change = Condition()
        Thread(target=self._run, name="line_writer", daemon=True).start()

    def __call__(self, line: str) -> None:
        """Say a line, of which only what can be printed is said as it is; returns at once."""
        self.write(f"{self._prefix}{visible(' '.join(line.split()))}\n".encode(errors="replace"))

    def writable(self) -> bool:
        return True

    def write(self, data: Any) -> int:
        """Queue bytes as they are; their number, at once."""
        with self._change:
            self._waiting.append(bytes(data))
            self._change.notify_all()
        return memoryview(data).nbytes

    def drain(self, seconds: float) -> bool:
        """Wait until everything is written, but no longer than so many seconds; whether it is."""
        with self._change:
            return self._change.wait_for(lambda: self._idle and not self._waiting, seconds)

    def _run(self) -> None:
        while True:
            with self._change:
                self._idle = True
                self._change.notify_all()
                self._change.wait_for(lambda: self._waiting)
                data, self._idle = self._waiting.popleft(), False
            while data:
                try:
                    data = data[os.write(self._descriptor, data) :]
                except BlockingIOError:  # another program has left it not blocking
                    select([], [self._descriptor], [])
                except (OSError, ValueError):  # nobody listens, or the disk is full: perhaps not for ever
                    break


class Stream(FileIO):
    """A standard stream; its first error is kept as its `failure`, and nothing is written any more."""

    failure: OSError | None = None

    def write(self, data: Any) -> int:
        """Write some of `data`, or drop all of it after an error; the number of bytes done."""
        while self.failure is None:
            try:
                written = super().write(data)
            except OSError as error:
                self.failure = error
            else:
                if written is not None:
                    return written
                select([], [self], [])  # a terminal that another program left not blocking
        return memoryview(data).nbytes


class Printable(TextIOWrapper):
    """A stream for text in which others' names stand: no terminal obeys them."""

    def write(self, text: str) -> int:
        """Write the text, with what cannot be printed spelt out."""
        shown = text if text.isprintable() else "\n".join(map(visible, text.split("\n")))
        return super().write(shown)


def prepare(kind: type[TextIOWrapper] = TextIOWrapper) -> None:
    """Set the streams up, once, before anything is read or printed; those that somebody has redirected stay."""
    for number in range(3):
        _occupy(number)
    if sys.stdin is None:
        sys.stdin = open(0, encoding="utf-8", closefd=False)  # noqa: SIM115
    if sys.stdout is sys.__stdout__:  # a descriptor of its own, which `output_to_standard_error` leaves alone
        sys.stdout = _text(kind, Stream(os.dup(OUTPUT_DESCRIPTOR), "w"), sys.__stdout__)
    if sys.stderr is sys.__stderr__:
        sys.stderr = _text(kind, Stream(ERROR_DESCRIPTOR, "w", closefd=False), sys.__stderr__)


def detach_standard_error() -> None:
    """From now on a thread writes standard error: a robot drives on where its terminal is paused, or gone."""
    if isinstance(_raw(sys.stderr), Stream):
        sys.stderr = _text(Printable, LineWriter(ERROR_DESCRIPTOR), sys.stderr)


def flush_standard_error() -> None:
    """Wait for a moment until detached messages are written."""
    if isinstance(raw := _raw(sys.stderr), LineWriter):
        sys.stderr.flush()
        raw.drain(DRAIN_SECONDS)


def is_error_read() -> bool:
    """True if standard error has taken all that has been told so far."""
    raw = _raw(sys.stderr)
    return raw.drain(0.0) if isinstance(raw, LineWriter) else True


def error_columns() -> int | None:
    """The columns of the terminal that standard error goes to; None where it is none, or rewrites no line."""
    try:
        if not os.isatty(ERROR_DESCRIPTOR) or os.environ.get("TERM", "dumb") == "dumb":
            return None
        return os.get_terminal_size(ERROR_DESCRIPTOR).columns or USUAL_COLUMNS
    except OSError:
        return None


def output_failure() -> OSError | None:
    """The error because of which standard output has not taken everything; BrokenPipeError where its reader is gone."""
    raw = _raw(sys.stdout)
    return raw.failure if isinstance(raw, Stream) else None


def finish() -> str:
    """Write out what is left; why standard output is not whole, or nothing: a reader that is gone has seen enough."""
    sys.stdout.flush()
    failure = output_failure()
    if failure is None or isinstance(failure, BrokenPipeError):
        return ""
    return f"standard output cannot be written: {reason(failure)}"


def document(text: str) -> None:
    """Print what programs read: it is UTF-8, whatever the terminal is."""
    _write(sys.stdout, text, "utf-8")


def draw(text: str) -> None:
    """Write control characters to a terminal: back to the beginning of the line, say."""
    _write(sys.stderr, text, sys.stderr.encoding)


def _write(stream: TextIO, text: str, encoding: str) -> None:
    stream.flush()
    stream.buffer.write(text.encode(encoding, "backslashreplace"))
    stream.buffer.flush()


@contextmanager
def output_to_standard_error() -> Iterator[None]:
    """Let all that code of somebody else prints go to standard error, also where it is written in C.

    Who has had `sys.stdout` before still writes to standard output with it.
    """
    sys.stdout.flush()
    kept = os.dup(OUTPUT_DESCRIPTOR)
    try:
        os.dup2(ERROR_DESCRIPTOR, OUTPUT_DESCRIPTOR)
        with redirect_stdout(sys.stderr):
            yield
    finally:
        CDLL(None).fflush(None)  # C keeps back what does not go to a terminal
        os.dup2(kept, OUTPUT_DESCRIPTOR)
        os.close(kept)


@dataclass(slots=True)
class StatusLine:
    """A line on standard error that is rewritten, below sentences that `say` prints. Any thread may tell or show."""

    say: Callable[[str], None]
    clock: Callable[[], float] = monotonic
    columns: Callable[[], int | None] = error_columns
    _is_shown: bool = False
    _last: float = field(default=float("-inf"))
    _lock: Lock = field(default_factory=Lock, repr=False)

    def tell(self, sentence: str) -> None:
        """Print a sentence that stays."""
        with self._lock:
            self._erase()
            self.say(sentence)

    def show(self, line: str) -> None:
        """Rewrite the line, cut where the terminal ends; on no terminal print it, but not often.

        A terminal that is paused gets no more of them: sentences that wait would be lost.
        """
        columns = self.columns()
        with self._lock:
            if columns is None:
                if self.clock() - self._last >= PLAIN_SECONDS:
                    self._last = self.clock()
                    self.say(line)
            elif is_error_read():
                draw(CLEAR + visible(line)[: columns - 1])
                self._is_shown = True

    def clear(self) -> None:
        """Remove the line."""
        with self._lock:
            self._erase()

    def _erase(self) -> None:
        if self._is_shown:
            draw(CLEAR)
            self._is_shown = False


def _occupy(number: int) -> None:
    """Let nothing else get the number of a closed stream; reading and writing it still fail, but telling does not."""
    try:
        os.fstat(number)
    except OSError:
        descriptor = os.open(os.devnull, os.O_RDONLY if number == OUTPUT_DESCRIPTOR else os.O_WRONLY)
        os.dup2(descriptor, number)
        if descriptor != number:
            os.close(descriptor)
        os.set_inheritable(number, True)


def _raw(stream: TextIO) -> Any:
    return getattr(getattr(stream, "buffer", None), "raw", None)


def _text(kind: type[TextIOWrapper], raw: RawIOBase, old: TextIO | None) -> TextIOWrapper:
    """A stream with Python's own encoding, in which what that does not know is spelt out."""
    encoding = old.encoding if old else "utf-8"
    at_once = any(getattr(old, name, False) for name in ("line_buffering", "write_through"))  # PYTHONUNBUFFERED
    return kind(BufferedWriter(raw), encoding, "backslashreplace", line_buffering=at_once)
