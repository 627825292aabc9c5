"""A recording, seen: what was read, thought and sent, and the world where there was a simulated one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from mindrun.engine.engine import Engine, virtual_sensors
from mindrun.graph.bundle import Bundle
from mindrun.graph.recording_header import MAX_HEADER_BYTES, About
from mindrun.robot.recording import read, read_growing
from mindrun.robot.replay import computed_again

from mindlang.run.recording import measured_in, recorded_task, running_bundle
from mindlang.view.growing_bytes import growing_bytes
from mindlang.view.viewed import Viewed
from mindlang.view.viewed_rows import Filled, Rows, viewed_rows

if TYPE_CHECKING:
    from mindlang.breakpoints.watch import RecordingWatcher

CHUNK_TICKS = 1000
NOTHING = np.float32(np.nan)  # the reading of what was not measured
Watching = Callable[[About, Bundle], "RecordingWatcher"]


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
    rows, watch = _filled(path, of, parts, found), watching(of, found).feed if watching else None
    return viewed_rows(
        title, source, of, found, recorded_task(of, found), bundle.absolute().parent, rows, of_ticks, watch
    )


def _filled(path: Path, of: About, parts: Iterator[Rows], mind: Bundle) -> Iterator[Filled]:
    """Some rows at a time, with the readings that a robot computes and does not record filled in.

    RecordingError where a row is damaged, or is not what the mind computes, behind all that are before it. Where there
    is nothing to fill in nothing is computed again, which would take 30 times as long.
    """
    is_measured = measured_in(of, mind)
    some = (part[first : first + CHUNK_TICKS] for part in parts for first in range(0, max(1, len(part)), CHUNK_TICKS))
    if not of.lacks_readings or not (virtual_sensors(mind.graph) or mind.graph.memories):
        yield from ((rows, np.where(is_measured, rows["readings"], NOTHING)) for rows in some)
        return
    engine, number = Engine(mind.policy, mind.procedures, of.master), 1
    for rows in some:
        readings, known = rows["readings"].copy(), 0
        try:
            for row in computed_again(path, of, rows, engine, number):
                readings[known] = row.readings
                known += 1
        finally:
            yield rows[:known], np.where(is_measured, readings[:known], NOTHING)
        number += known
