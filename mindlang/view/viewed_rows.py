"""Rows of a recording as a page sees them, whoever makes them: a simulator now, a robot, or one who wrote them down."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from mindrun.engine.promises import BY_SKILL, PromiseWatcher
from mindrun.engine.think import hierarchy
from mindrun.graph.bundle import Bundle
from mindrun.graph.graph import Graph, Task
from mindrun.graph.recording_header import GOES_ON, POSE_COLUMNS, THING_COLUMNS, About
from numpy.typing import NDArray

from mindlang.pictures.environments import seen_episode
from mindlang.run import outcome
from mindlang.run.promises import VERDICTS, judged
from mindlang.view.about import PROMISE_COLUMNS, Texts, about_data, robot_event_data, world_event_data
from mindlang.view.messages import shown
from mindlang.view.rows import DOUBLE_BLOCK, FLOW, Columns, Doubles, Singles
from mindlang.view.viewed import Viewed

if TYPE_CHECKING:
    from mindlang.breakpoints.watch import Stop

Rows = NDArray[Any]
Filled = tuple[Rows, Singles]  # rows, and their readings: no number where nobody measured
Watch = Callable[[Rows, Singles], Sequence["Stop"]]  # finds where breakpoints stop the rows that follow
NOTHING_HELD = -1
BEGIN_COLUMN = 1  # of the events of a robot: stopped, began anew, and a fault of each sensor
RUN = "simulation"  # the source of a run that is simulated while it is seen
UNKNOWN_AT_FIRST = "readings", "commands", "sent"


def viewed_rows(
    title: str,
    source: str,
    of: About,
    mind: Bundle,
    task: Task | None,
    folder: Path,
    rows: Iterator[Filled],
    of_ticks: int | None,
    watch: Watch | None = None,
    texts: Texts | None = None,
) -> Viewed:
    """The rows of a mind of this folder, of which there will be so many; None where they still come, unasked.

    The rows of a task have its world. `texts` are what the edges say.
    """
    ready = hierarchy(mind.policy, mind.procedures, of.master)
    skills = [mind.graph.skills[skill.index] for skill in ready.skills]
    promises = ViewedPromises(mind.graph, of.master)
    edges = sum(len(skill.edges) for skill in skills)
    columns = columns_of(of, mind, source == RUN, len(promises.texts), edges)
    drawing = None
    if of.world and task and task.scene.environment:
        drawing = partial(seen_episode, mind.graph, task, folder, of.world.seed)
    happens = [
        *([] if source == RUN else robot_event_data(of)),
        *({"text": shown(f"broken: {text}"), "kind": "broken"} for text in promises.texts),
        *(world_event_data(task) if task else []),
    ]
    about = {
        "title": shown(title),
        "source": source,
        "of_ticks": of_ticks,
        "drawn": drawing is not None,
        "events": happens,
        **about_data(of, mind.policy, task, skills, columns, texts or {}),
    }
    growth = partial(_growth, rows, of, task, promises, len(happens), watch)
    return Viewed(about, columns, growth, mind.graph, ready, drawing, of_ticks is None)


def columns_of(of: About, mind: Bundle, is_run: bool, promises: int, edges: int) -> Columns:
    """The columns of rows; of a run that is simulated while it is seen, those that differ from tick to tick."""
    doubles: dict[str, int] = {} if is_run else {"time": 1}
    singles: dict[str, int] = {}
    commands = len(of.actuators)
    if of.world:
        doubles |= {"robot": POSE_COLUMNS, "things": THING_COLUMNS * of.world.things}
        doubles |= {"battery": 1, "rewards": of.world.rewards}
        singles |= {"held": 1, "touching": 1}
    singles |= {"readings": mind.graph.width, "influence": len(of.skills), "commands": commands}
    if not is_run:
        singles |= {"sent": commands, "stopped": 1, "armed": 1, "faults": len(of.sensors)}
    return Columns.of(doubles, {**singles, "promises": PROMISE_COLUMNS * promises, FLOW: edges})


def _growth(
    parts: Iterator[Filled],
    of: About,
    task: Task | None,
    promises: "ViewedPromises",
    events: int,
    watch: Watch | None,
    viewed: Viewed,
) -> Iterator[bool]:
    """Add rows with what happened in them to what is viewed, a part each time."""
    columns = viewed.columns
    viewed.blocks.append(*_beginning(columns, of))
    yield True
    is_run = "time" not in columns
    number, start, before = 0, 0.0, np.zeros((1, events), np.uint64)
    for rows, readings in parts:
        begins = np.flatnonzero(rows["tick"] == 0).tolist()
        kept, broken = promises.feed(readings, rows["influence"], begins)
        doubles, singles = _blocks(rows, columns, {"readings": readings, "promises": kept})
        if not len(rows):  # nothing has come for a while
            yield True
            continue
        viewed.begins |= {number + 1 + row for row in begins}
        levels = _levels(rows, is_run, task, broken)[:, :events]
        if not is_run:
            start = start if number else float(rows["time"][0])
            levels[0, BEGIN_COLUMN] *= number > 0  # the first beginning is no event
            with np.errstate(invalid="ignore", over="ignore"):  # a recording may hold any number
                doubles[:, columns["time"].first] -= start
        happened = np.argwhere(levels > np.concatenate([before, levels[:-1]]))
        ended = int(rows["world"]["ended"][-1]) if task else GOES_ON
        by = outcome.ended_by(task, ended) if task else None
        viewed.happened += [(number + 1 + int(row), int(event)) for row, event in happened]
        stops = watch(rows, readings) if watch else ()
        viewed.stops += [(each.tick, shown(f"line {each.breakpoint.line}: {each.breakpoint.text}")) for each in stops]
        viewed.blocks.append(doubles, singles)
        viewed.ended_by, viewed.over = by and shown(by), is_run and ended != GOES_ON
        yield True
        number, before = number + len(rows), levels[-1:]


def _levels(rows: Rows, is_run: bool, task: Task | None, broken: NDArray[np.bool_]) -> NDArray[np.uint64]:
    """The numbers [rows, events] of which each rise is an event."""
    robot = [] if is_run else [rows["stopped"] != 0, rows["tick"] == 0, rows["faults"] != 0]
    world = [rows["world"]["events"], rows["world"]["touching"] != 0] if task else []
    return np.column_stack([*robot, broken, *world]).astype(np.uint64)


def _beginning(columns: Columns, of: About) -> tuple[Doubles, Singles]:
    """The row of tick 0, in which nothing has been read, thought or sent."""
    doubles = np.full((1, columns.width(DOUBLE_BLOCK)), np.nan)
    singles = np.zeros((1, columns.kept_singles), np.float32)
    for name in UNKNOWN_AT_FIRST:
        if name in columns:
            singles[0, columns[name].places] = np.nan
    if of.world:
        begin = np.array(of.world.begin, np.float64)  # None becomes NaN
        values = (*begin, np.nan, *np.zeros(of.world.rewards))
        doubles[0, columns["robot"].first :][: len(values)] = values
        singles[0, columns["held"].first] = NOTHING_HELD
    return doubles, singles


def _blocks(rows: Rows, columns: Columns, found: Mapping[str, NDArray[Any]]) -> tuple[Doubles, Singles]:
    doubles = np.empty((len(rows), columns.width(DOUBLE_BLOCK)))
    singles = np.empty((len(rows), columns.kept_singles), np.float32)  # bits of readings stay what they are
    for name, group in columns.items():
        if name != FLOW:
            value = found[name] if name in found else _value(name, rows)
            block = doubles if group.block == DOUBLE_BLOCK else singles
            block[:, group.places] = value.reshape(len(rows), group.count)
    return doubles, singles


def _value(name: str, rows: Rows) -> NDArray[Any]:
    match name:
        case "robot":
            return rows["world"]["pose"]
        case "things":  # those of no size, which nobody could draw, are nowhere
            things = rows["world"]["things"]
            has_size = (things[:, :, 2] >= 0) & np.isfinite(things[:, :, 2])
            return np.where(has_size[:, :, None], things, np.nan)
        case "battery" | "rewards" | "held" | "touching":
            return rows["world"][name]
    return rows[name]


class ViewedPromises:
    """The promises below a master, and what became of them in all rows so far."""

    def __init__(self, graph: Graph, master: str) -> None:
        self._watcher = PromiseWatcher(graph, master)
        self.texts = [f"{skill} {promise.text}" for skill, promise in self._watcher.promises]
        self._times = np.zeros((1, len(self.texts), len(VERDICTS)), np.int64)

    def feed(
        self, readings: Singles, influence: Singles, begins: Collection[int]
    ) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
        """The columns [rows, promises · PROMISE_COLUMNS] of the next rows, and where each is broken [rows, promises].

        In the rows of `begins` the mind begins anew.
        """
        verdict = judged(self._watcher, readings, influence, begins)[:, :, None]
        times = self._times + np.cumsum(verdict == [*VERDICTS.values()], axis=0)
        self._times = np.concatenate([self._times, times])[-1:]
        return np.concatenate([verdict, times], axis=2).reshape(
            len(verdict), PROMISE_COLUMNS * len(self.texts)
        ), verdict[:, :, 0] >= BY_SKILL
