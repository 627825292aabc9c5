"""The standard streams, such that no program ends by them: there, in any encoding, and never an exception.

What cannot be told is dropped, since it must not change what is done; what standard output does not take is
remembered: a document that is not whole is no success.
"""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from ctypes import CDLL
from io import BufferedWriter, FileIO, RawIOBase, TextIOWrapper
from select import select
from typing import Any, TextIO

from mindrun.errors import reason
from mindrun.files.printable import visible
from mindrun.terminal.line_writer import LineWriter

OUTPUT_DESCRIPTOR, ERROR_DESCRIPTOR = 1, 2
USUAL_COLUMNS = 80  # of a terminal that does not say
DRAIN_SECONDS = 1.0  # in which what a thread writes to standard error must be taken


class Stream(FileIO):
    """A standard stream; its first error is kept as its `failure`, and nothing is written any more."""

    failure: OSError | None = None

    def write(self, data: Any) -> int:
        """Write everything, or drop it; the length of `data` in any case."""
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
        """The text, with what cannot be printed spelt out."""
        shown = text if text.isprintable() else "\n".join(map(visible, text.split("\n")))
        return super().write(shown)


def prepare(kind: type[TextIOWrapper] = TextIOWrapper) -> None:
    """Set the streams up, once, before anything is read or printed; those that somebody has redirected stay."""
    for number in range(3):
        _occupy(number)
    if sys.stdin is None:
        sys.stdin = open(0, encoding="utf-8", closefd=False)  # noqa: SIM115
    if sys.stdout is sys.__stdout__:  # a descriptor of its own, which `talk` leaves alone
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
    """Whether standard error has taken all that has been told so far."""
    raw = _raw(sys.stderr)
    return raw.is_idle if isinstance(raw, LineWriter) else True


def error_columns() -> int | None:
    """How wide the terminal is that standard error goes to; None where it is none, or one that rewrites no line."""
    try:
        if not os.isatty(ERROR_DESCRIPTOR) or os.environ.get("TERM", "dumb") == "dumb":
            return None
        return os.get_terminal_size(ERROR_DESCRIPTOR).columns or USUAL_COLUMNS
    except OSError:
        return None


def lost() -> OSError | None:
    """Why standard output has not taken everything, if it has not; BrokenPipeError where its reader is gone."""
    raw = _raw(sys.stdout)
    return raw.failure if isinstance(raw, Stream) else None


def finish() -> str:
    """Write out what is left; why standard output is not whole, or nothing.

    A reader that is gone, `head` say, has seen enough: that is no reason.
    """
    sys.stdout.flush()
    failure = lost()
    if failure is None or isinstance(failure, BrokenPipeError):
        return ""
    return f"standard output cannot be written: {reason(failure)}"


def document(text: str) -> None:
    """Print what programs read: it is UTF-8, whatever the terminal is."""
    sys.stdout.flush()
    sys.stdout.buffer.write(text.encode("utf-8", "backslashreplace"))
    sys.stdout.buffer.flush()


def draw(text: str) -> None:
    """Write control characters to a terminal: back to the beginning of the line, say."""
    sys.stderr.flush()
    sys.stderr.buffer.write(text.encode(sys.stderr.encoding, "backslashreplace"))
    sys.stderr.buffer.flush()


@contextmanager
def talk() -> Iterator[None]:
    """Around code of somebody else: what it prints goes to standard error, also where it is written in C.

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
