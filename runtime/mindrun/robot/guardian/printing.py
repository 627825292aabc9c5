"""What drivers print: it never waits, and never fails, whoever reads it, so that a `print` keeps no motor running."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Thread

from mindrun.terminal.line_writer import LineWriter

OUTPUT_DESCRIPTOR, ERROR_DESCRIPTOR = 1, 2
PIECE_BYTES, LAST_SECONDS = 1 << 16, 0.3  # that are read at once; for what is left in the end


@contextmanager
def printing_never_waits() -> Iterator[None]:
    """Meanwhile a thread of this process passes on to standard error what it and those it forks print, or drops it.

    They hold the reading end as well: where this process is gone, a pipe takes what they print.
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

    thread = Thread(target=pass_on, name="printing", daemon=True)
    thread.start()
    try:
        yield
    finally:
        for descriptor in (OUTPUT_DESCRIPTOR, ERROR_DESCRIPTOR):
            os.dup2(errors, descriptor)  # the last of the writing ends, but for those of forked processes that hang
        thread.join(LAST_SECONDS)
        writer.drain(LAST_SECONDS)
