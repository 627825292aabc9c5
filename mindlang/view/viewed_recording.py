"""What a robot has recorded, seen: what was read, thought and sent, and nothing of the world that it was in."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from mindrun.bundle import Bundle, digest, read_bundle
from mindrun.engine import Engine
from mindrun.robot.growing_recording import read_growing
from mindrun.robot.recording import MAX_HEADER_BYTES, About, read
from mindrun.robot.replay import computed_again
from mindrun.virtual_sensors import virtual_sensors
from numpy.typing import NDArray

from mindlang.view.about_hierarchy import HierarchyData
from mindlang.view.columns import FLOW, Columns
from mindlang.view.growing_bytes import growing_bytes
from mindlang.view.row_blocks import Chunk, Singles
from mindlang.view.stop_texts import stop_texts
from mindlang.view.texts import shown
from mindlang.view.viewed import SeenMind, Viewed

if TYPE_CHECKING:
    from mindlang.breakpoints.recorded import RecordingWatcher

CHUNK_TICKS = 1000
BEGIN_COLUMN = 1  # of the events: stopped, began anew, and a fault of each sensor
Rows = NDArray[Any]
Watching = Callable[[About, Bundle], "RecordingWatcher"]
Filled = tuple[Rows, Singles]  # rows, and their readings with those that a robot computes


def viewed_recording(path: Path, bundle: Path, watching: Watching | None = None) -> Viewed:
    """A recording and the bundle that was running; MindError where one cannot be read, or they do not fit.

    `watching` makes what finds its stops. Runs the Python code of the bundle's procedures.
    """
    of, parts = read(path)
    return viewed_rows(path, of, parts, bundle, _row_count(path, of), watching)


@contextmanager
def followed_recording(name: str, bundle: Path, watching: Watching | None = None) -> Iterator[Viewed]:
    """A recording that still grows, of this machine or as HOST:PATH, and the bundle that is running; as above."""
    with growing_bytes(name) as parts:
        path = Path(name)
        yield viewed_rows(path, *read_growing(path, parts), bundle, None, watching)


def viewed_rows(
    path: Path, of: About, parts: Iterator[Rows], bundle: Path, of_ticks: int | None, watching: Watching | None = None
) -> Viewed:
    """The rows of a recording with its bundle; those of one that still grows come without being asked for.

    `of_ticks` says how many there are, None that it still grows. MindError where both do not fit.
    """
    found = read_bundle(bundle)
    of.refuse_another(digest(bundle), found.graph)
    begins: set[int] = set()  # filled while the rows come
    mind = SeenMind.of(found.policy, found.procedures, of.master, begins)
    columns = recording_columns(found, of, mind.edges)
    below = HierarchyData(found.graph, of.master, mind.skills, columns)
    about = {
        "title": shown(f"{path.name} with {of.master} in charge"),
        "task": None,
        "master": shown(of.master),
        "source": "robot" if of_ticks is None else "recording",
        "seed": None,
        "tick": of.tick,
        "of_ticks": of_ticks,
        "events": [
            {"text": "stopped", "kind": "stopped"},
            {"text": "began anew", "kind": "begin"},
            *({"text": shown(f"fault of {name}"), "kind": "fault"} for name in of.sensors),
        ],
        "rewards": [],
        "ends": [],
        "world": None,
        "curves": below.curves(),
        **below.data({}),
    }
    watcher = watching(of, found) if watching else None
    chunks = recording_chunks(_filled(path, of, parts, found), of, columns, begins, watcher)
    return Viewed(about, columns, chunks, mind, is_live=of_ticks is None)


def recording_columns(mind: Bundle, of: About, edges: int) -> Columns:
    """The columns of a recording."""
    commands = len(of.actuators)
    return Columns.of(
        {"time": 1},
        {
            "readings": mind.graph.width,
            "influence": len(of.skills),
            "commands": commands,
            "sent": commands,
            "stopped": 1,
            "armed": 1,
            "faults": len(of.sensors),
            FLOW: edges,
        },
    )


def recording_chunks(
    parts: Iterator[Filled], of: About, columns: Columns, begins: set[int], watcher: RecordingWatcher | None = None
) -> Iterator[Chunk]:
    """Its rows; `begins` gets the ticks in which the mind was begun anew."""
    yield Chunk(np.full((1, 1), np.nan), np.zeros((1, columns.kept_singles), np.float32))
    number, start, before = 0, 0.0, np.zeros(2 + len(of.sensors), bool)
    for rows, readings in parts:
        if not len(rows):  # nothing has come for a while
            yield Chunk(np.zeros((0, 1)), np.zeros((0, columns.kept_singles), np.float32))
            continue
        start = start if number else float(rows["time"][0])
        begins |= {number + 1 + int(row) for row in np.flatnonzero(rows["tick"] == 0)}
        facts = np.column_stack([rows["stopped"], rows["tick"] == 0, rows["faults"]]) != 0
        facts[0, BEGIN_COLUMN] &= number > 0
        happened = np.argwhere(facts & ~np.concatenate([before[None], facts[:-1]]))
        yield Chunk(
            (rows["time"] - start)[:, None],
            _singles(rows, readings),
            tuple((number + 1 + int(row), int(event)) for row, event in happened),
            stops=stop_texts(watcher.feed(rows, readings) if watcher else ()),
        )
        number, before = number + len(rows), facts[-1]


def _filled(path: Path, of: About, parts: Iterator[Rows], mind: Bundle) -> Iterator[Filled]:
    """Some rows at a time, with the readings that a robot computes and does not record filled in.

    RecordingError where a row is damaged, or is not what the mind computes, behind all that are before it. Where there
    is nothing to fill in nothing is computed again, which would take 30 times as long.
    """
    engine, number = Engine(mind.policy, mind.procedures, of.master), 1
    nothing = not virtual_sensors(mind.graph) and not mind.graph.memories
    for part in parts:
        for first in range(0, max(1, len(part)), CHUNK_TICKS):
            rows = part[first : first + CHUNK_TICKS]
            readings, known = rows["readings"].copy(), len(rows) if nothing else 0
            try:
                for row in () if nothing else computed_again(path, of, rows, engine, number):
                    readings[known] = row.readings
                    known += 1
            finally:
                yield rows[:known], readings[:known]
            number += known


def _singles(rows: Rows, readings: Singles) -> Singles:
    states = [rows[name][:, None] for name in ("stopped", "armed")]
    each = [readings, rows["influence"], rows["commands"], rows["sent"], *states, rows["faults"]]
    return np.concatenate(each, axis=1).astype(np.float32)


def _row_count(path: Path, of: About) -> int:
    with path.open("rb") as file:
        header = len(file.readline(MAX_HEADER_BYTES))
    return max(0, path.stat().st_size - header) // of.row.itemsize
