"""A recording, seen: what was read, thought and sent, and the world where there was a simulated one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from mindrun.engine.engine import Engine, virtual_sensors
from mindrun.graph.bundle import Bundle
from mindrun.graph.graph import Graph, Task
from mindrun.graph.recording_header import BOX_COLUMNS, MAX_HEADER_BYTES, About, RecordedWorld
from mindrun.robot.growing_recording import read_growing
from mindrun.robot.recording import read
from mindrun.robot.replay import computed_again
from numpy.typing import NDArray

from mindlang.run import outcome
from mindlang.run.running_bundle import measured_in, running_bundle, task_of
from mindlang.view.about import HierarchyData, WorldEvents, run_data
from mindlang.view.growing_bytes import growing_bytes
from mindlang.view.rows import FLOW, Chunk, Columns, Singles, beginning, blocks, world_columns
from mindlang.view.texts import shown, stop_texts
from mindlang.view.viewed import SeenMind, Viewed, drawing_of

if TYPE_CHECKING:
    from mindlang.breakpoints.watch import RecordingWatcher

CHUNK_TICKS = 1000
NOTHING = np.float32(np.nan)  # the reading of what was not measured
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
    found = running_bundle(bundle, of)
    title = f"{path.name} with {of.master} in charge"
    rows = _filled(path, of, parts, found)
    source = "robot" if of_ticks is None else "recording"
    return viewed_mind(title, source, found, bundle.absolute().parent, of, rows, of_ticks, watching)


def viewed_mind(
    title: str,
    source: str,
    found: Bundle,
    folder: Path,
    of: About,
    rows: Iterator[Filled],
    of_ticks: int | None,
    watching: Watching | None = None,
) -> Viewed:
    """The same of rows that have all readings; `folder` is that of the mind."""
    task = task_of(of, found)
    begins: set[int] = set()  # filled while the rows come
    mind = SeenMind.of(found.policy, found.procedures, of.master, begins)
    columns = recording_columns(found, of, mind.edges)
    below = HierarchyData(found.graph, of.master, mind.skills, columns)
    drawing = drawing_of(found.graph, task, folder, of.world.seed) if of.world else None
    about = {
        "drawn": drawing is not None,
        "title": shown(title),
        "master": shown(of.master),
        "source": source,
        "tick": of.tick,
        "of_ticks": of_ticks,
        "events": [*_robot_events(of), *(WorldEvents(task).data() if task else [])],
        **_run_data(found.graph, of.world, task, columns),
        "curves": below.curves(
            [reward.text for reward in task.rewards] if task else [], not (task and task.scene.environment)
        ),
        **below.data({}),
    }
    watcher = watching(of, found) if watching else None
    chunks = recording_chunks(rows, of, task, columns, begins, watcher)
    return Viewed(about, columns, chunks, mind, is_live=of_ticks is None, drawing=drawing)


def _run_data(graph: Graph, world: RecordedWorld | None, task: Task | None, columns: Columns) -> dict[str, Any]:
    if world is None or task is None:
        return {"task": None, "seed": None, "rewards": [], "ends": [], "world": None}
    return run_data(graph, task, world.seed, np.array(world.boxes).reshape(-1, BOX_COLUMNS), columns)


def recording_columns(mind: Bundle, of: About, edges: int) -> Columns:
    """The columns of a recording."""
    doubles, singles = world_columns(of.world.things, of.world.rewards) if of.world else ({}, {})
    commands = len(of.actuators)
    return Columns.of(
        {"time": 1, **doubles},
        {
            **singles,
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


def _robot_events(of: About) -> list[dict[str, str]]:
    return [
        {"text": "stopped", "kind": "stopped"},
        {"text": "began anew", "kind": "begin"},
        *({"text": shown(f"fault of {name}"), "kind": "fault"} for name in of.sensors),
    ]


def recording_chunks(
    parts: Iterator[Filled],
    of: About,
    task: Task | None,
    columns: Columns,
    begins: set[int],
    watcher: RecordingWatcher | None = None,
) -> Iterator[Chunk]:
    """Its rows, with the world of the task if it has one; `begins` gets the ticks in which the mind was begun anew."""
    yield beginning(columns, of.world)
    world = WorldEvents(task) if task else None
    number, start, before = 0, 0.0, np.zeros(2 + len(of.sensors), bool)
    for rows, readings in parts:
        if not len(rows):  # nothing has come for a while
            yield Chunk(*blocks(rows, columns, readings))
            continue
        start = start if number else float(rows["time"][0])
        begins |= {number + 1 + int(row) for row in np.flatnonzero(rows["tick"] == 0)}
        facts = np.column_stack([rows["stopped"], rows["tick"] == 0, rows["faults"]]) != 0
        facts[0, BEGIN_COLUMN] &= number > 0
        happened = facts & ~np.concatenate([before[None], facts[:-1]])
        if world:
            happened = np.concatenate([happened, world.in_rows(rows)], axis=1)
        doubles, singles = blocks(rows, columns, readings)
        with np.errstate(invalid="ignore", over="ignore"):  # a recording may hold any number
            doubles[:, columns["time"].first] -= start
        ended = outcome.ended_by(task, int(rows["world"]["ended"][-1])) if task else None
        yield Chunk(
            doubles,
            singles,
            tuple((number + 1 + int(row), int(event)) for row, event in np.argwhere(happened)),
            ended and shown(ended),
            stops=stop_texts(watcher.feed(rows, readings) if watcher else ()),
        )
        number, before = number + len(rows), facts[-1]


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


def _row_count(path: Path, of: About) -> int:
    with path.open("rb") as file:
        header = len(file.readline(MAX_HEADER_BYTES))
    return max(0, path.stat().st_size - header) // of.row.itemsize
