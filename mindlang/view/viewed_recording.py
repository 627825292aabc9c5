"""A recording, seen: what was read, thought and sent, and the world where there was a simulated one.

One to which somebody still writes is followed, on this machine or on another one through ssh.
"""

import os
import re
import shlex
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from select import select
from time import sleep
from typing import TYPE_CHECKING

import numpy as np
from mindrun.files.regular_files import open_regular
from mindrun.graph.bundle import Bundle
from mindrun.graph.draws import drawn_in_words, drawn_numbers
from mindrun.graph.recording_header import MAX_HEADER_BYTES, About
from mindrun.graph.tasks import robots_in
from mindrun.robot.recording import RecordingError, read, read_growing

from mindlang.run.recording import measured_in, recorded_task, running_bundle
from mindlang.view.viewed import Viewed
from mindlang.view.viewed_rows import Filled, Rows, viewed_rows

if TYPE_CHECKING:
    from mindlang.breakpoints.watch import RecordingWatcher

CHUNK_TICKS = 1000
NOTHING = np.float32(np.nan)  # the reading of what was not measured
Watching = Callable[[About, Bundle], "RecordingWatcher"]
POLL_SECONDS = 0.005  # from one look at a file to the next
IDLE_SECONDS = 0.5  # after which an empty part says that nothing has come
PART_BYTES = 1 << 20
SSH_END_SECONDS = 2.0
REMOTE = re.compile(r"(?P<host>(?:[A-Za-z0-9_][\w.-]*@)?[A-Za-z0-9_][\w.-]*):(?P<path>.+)", re.ASCII | re.DOTALL)


def viewed_recording(path: Path, bundle: Path, watching: Watching | None = None) -> Viewed:
    """A recording and the bundle that was running; MindError where one cannot be read, or they do not fit.

    `watching` makes what finds its stops. Runs the Python code of the bundle's procedures.
    """
    of, parts = read(path)
    with path.open("rb") as file:
        header = len(file.readline(MAX_HEADER_BYTES))
    ticks = max(0, path.stat().st_size - header) // of.row.itemsize
    return _viewed(path, of, parts, bundle, ticks, watching)


@contextmanager
def followed_recording(name: str, bundle: Path, watching: Watching | None = None) -> Iterator[Viewed]:
    """A recording that still grows, of this machine or as HOST:PATH, and the bundle that is running; as above."""
    with growing_bytes(name) as parts:
        yield _viewed(Path(name), *read_growing(Path(name), parts), bundle, None, watching)


def _viewed(
    path: Path, of: About, parts: Iterator[Rows], bundle: Path, of_ticks: int | None, watching: Watching | None
) -> Viewed:
    found = running_bundle(bundle, of)
    title, source = f"{path.name} with {of.master} in charge", "robot" if of_ticks is None else "recording"
    if (task := recorded_task(of, found)) and of.world:
        title += f", robot {of.world.robot}" * (robots_in(task) > 1)
        title += drawn_in_words(drawn_numbers(task.draws, of.world.seed))
    rows, watch = _measured(of, parts, found), watching(of, found).feed if watching else None
    return viewed_rows(title, source, of, found, task, bundle.absolute().parent, rows, of_ticks, watch)


def _measured(of: About, parts: Iterator[Rows], mind: Bundle) -> Iterator[Filled]:
    """Some rows at a time, with their readings, of which those that nobody measured are no number.

    RecordingError where a row is damaged, behind all that are before it.
    """
    is_measured = measured_in(of, mind)
    for part in parts:
        for first in range(0, max(1, len(part)), CHUNK_TICKS):
            rows = part[first : first + CHUNK_TICKS]
            yield rows, np.where(is_measured, rows["readings"], NOTHING)


def remote(name: str) -> tuple[str, str] | None:
    """The host and the path of HOST:PATH, as scp has it; None for a file of this machine."""
    if "/" in name.partition(":")[0] or ":" not in name or Path(name).exists():
        return None
    found = REMOTE.fullmatch(name)
    if not found or "\0" in name:
        raise RecordingError(f"{name} is no file here, and names no host", "HOST:PATH, as robot.local:day.rec")
    return found["host"], found["path"]


@contextmanager
def growing_bytes(name: str) -> Iterator[Iterator[bytes]]:
    """The bytes of a file, or of HOST:PATH, as they come, without an end; an empty part where for a while none came.

    RecordingError where it cannot be read, is replaced or becomes shorter, or where ssh ends.
    """
    at = remote(name)
    if at is None:
        yield _local(Path(name))
    else:
        with _tail(*at) as process:
            yield _remote(at[0], process)


def _local(path: Path) -> Iterator[bytes]:
    """The parts of a file as they come, and an empty one after IDLE_SECONDS without any."""
    empty = 0
    try:
        with open(open_regular(path), "rb", buffering=0) as file:  # noqa: PTH123
            while True:
                part = _read_on(path, file.fileno())
                empty = 0 if part else empty + 1
                if part or empty * POLL_SECONDS >= IDLE_SECONDS:
                    yield part
                    empty = 0
    except OSError as error:
        raise RecordingError(f"cannot read {path}: {error.strerror}") from error


def _read_on(path: Path, descriptor: int) -> bytes:
    """The next bytes of a growing file, none after a pause; RecordingError where it was cut or replaced."""
    if part := os.read(descriptor, PART_BYTES):
        return part
    own = os.fstat(descriptor)
    if own.st_size < os.lseek(descriptor, 0, os.SEEK_CUR):
        raise RecordingError(f"{path} has become shorter than it was", "follow it anew")
    if own.st_nlink == 0 or not os.path.samestat(own, path.stat()):
        raise RecordingError(f"{path} has been replaced or removed", "follow it anew")
    sleep(POLL_SECONDS)
    return b""


@contextmanager
def _tail(host: str, path: str) -> Iterator[subprocess.Popen[bytes]]:
    command = ["ssh", "-T", "--", host, f"exec tail -c +1 -f -- {shlex.quote(path)}"]
    try:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE)
    except OSError as error:
        raise RecordingError(f"ssh cannot be run: {error.strerror}", "install OpenSSH, or copy the file") from error
    try:
        yield process
    finally:
        process.terminate()
        try:
            process.wait(SSH_END_SECONDS)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def _remote(host: str, process: subprocess.Popen[bytes]) -> Iterator[bytes]:
    """The bytes that ssh brings; before the first of them it may ask for a password, however long that takes."""
    assert process.stdout
    descriptor, has_begun = process.stdout.fileno(), False
    while True:
        ready, _, _ = select([descriptor], [], [], IDLE_SECONDS)
        part = os.read(descriptor, PART_BYTES) if ready else b""
        if ready and not part:
            raise RecordingError(f"the connection to {host} has ended (ssh: exit {process.wait()})", "follow it anew")
        has_begun = has_begun or bool(part)
        if has_begun:
            yield part
