"""A dry run in words: what it is when it begins, how it stands while it drives, and what came of it."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from math import isfinite
from threading import Event, Thread
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.driver import DeviceError
from mindrun.errors import MindError
from mindrun.graph.graph import Graph, Task
from mindrun.graph.skill_sets import driving, movers
from mindrun.robot.drivers.simulated import status
from mindrun.robot.loop import Loop
from mindrun.terminal.status_line import StatusLine
from mindrun.terminal.tick_count import ticks as in_words

SHOW_SECONDS = 0.25  # from one state of the line to the next
MAX_SILENT_QUESTIONS = 8  # in a row, after which the world is gone
MAX_THINGS_NAMED = 6
MAX_ACTING_NAMED, LEAST_ACTING_INFLUENCE = 2, 0.01


def refuse_environment(task: Task) -> None:
    """MindError where no world of a task can be simulated beside the robot."""
    if name := task.scene.environment:
        said = f"there is no dry run of {task.name}, which is in the environment {name}"
        raise MindError(said, "mindc run and mindc view step it, from the source of this bundle")


def beginning(graph: Graph, task: Task, master: str, seed: int) -> list[str]:
    """What is run, in which world, that nothing real moves, and what ends it."""
    seconds = task.ticks * graph.tick
    return [
        f"dry run: {task.name} with {master} in charge, in {_scene(task)}{_contents(task)}, seed {seed}",
        "no device is touched: the world is simulated, in real time",
        f"it ends with its run, after {in_words(task.ticks)} ({seconds:,.0f} s) at the latest; Ctrl-C ends it now",
    ]


def _scene(task: Task) -> str:
    if not task.scene.is_bounded:
        return "a world without walls"
    return "a world of " + " x ".join(f"{side:g}" for side in task.scene.sides)


def _contents(task: Task) -> str:
    known = list(dict.fromkeys(thing.name for thing in task.things))
    more = len(known) - MAX_THINGS_NAMED
    shown = [*known[:MAX_THINGS_NAMED], *([f"{more} more"] if more > 0 else [])]
    return f" with {', '.join(shown)}" if shown else ""


class DryRun:
    """Says on a status line how a run in the world at a socket stands, from a thread of its own.

    The loop only leaves the influence of its last tick here: it waits neither for the world nor for a terminal.
    """

    def __init__(self, graph: Graph, task: Task, master: str, socket: str, line: StatusLine) -> None:
        self._graph, self._task, self._socket, self._line = graph, task, socket, line
        self._acting_skills = movers(graph, master) or driving(graph, master, range(len(graph.actuators)))
        self._influence: NDArray[np.float32] | None = None
        self._is_over = False
        self._lost: DeviceError | None = None
        self._stop = Event()

    def watch(self, loop: Loop) -> bool:
        """After each tick: whether the run in the world goes on; DeviceError where there is no world any more."""
        self._influence = loop.engine.influence
        if self._lost:
            raise self._lost
        return not self._is_over

    @contextmanager
    def shown(self) -> Iterator[None]:
        """Show how the run stands as long as this lasts."""
        thread = Thread(target=self._show, name="dry_run", daemon=True)
        thread.start()
        try:
            yield
        finally:
            self._stop.set()
            thread.join()
            self._line.clear()

    def _show(self) -> None:
        silent = 0
        while not self._stop.wait(SHOW_SECONDS):
            try:
                run = status(self._socket)
            except DeviceError as error:  # most often it answers next time
                silent += 1
                self._lost = error if silent >= MAX_SILENT_QUESTIONS else None
                continue
            silent, self._lost = 0, None
            self._line.show(self.state(run))
            self._is_over = bool(run["ended"])

    def state(self, run: Mapping[str, Any]) -> str:
        """The line for the status of a world: time, who acts, what has happened and been paid, and the commands.

        What matters less comes last, where a narrow terminal cuts.
        """
        parts = [
            f"{run['tick'] * self._graph.tick:.1f} s, tick {run['tick']:,} of {self._task.ticks:,}",
            self._acting(),
            *(f"{times} × {event}" for event, times in run["events"].items() if times),
            f"score {run['score']:,.2f}",
            *(f"{name} {value:.2f}" for name, value in run["commands"].items()),
        ]
        return "  ".join(part for part in parts if part)

    def _acting(self) -> str:
        """The skills with the most influence of those that move the robot, or drive anything where none does."""
        if self._influence is None:
            return ""
        influence = [(float(self._influence[index]), name) for name, index in self._acting_skills.items()]
        strongest = sorted(influence, key=lambda each: -each[0])
        acting = [f"{name} {value:.2f}" for value, name in strongest if value >= LEAST_ACTING_INFLUENCE]
        return ", ".join(acting[:MAX_ACTING_NAMED]) or "nobody acts"


def outcome(task: Task, master: str, run: Mapping[str, Any]) -> list[str]:
    """What came of a run, as `mindc run` says it: how it ended, what it counted, what each reward line paid."""
    facts = [("seed", str(run["seed"]))]
    for number, (event, times) in enumerate(run["events"].items()):
        facts.append(("" if number else "events", f"{times} × {event}"))
    facts.append(("ticks", f"{run['tick']:,} of {task.ticks:,}, {_ending(run['ended'])}"))
    paid = [(_number(value), text) for text, value in [*run["by_line"].items(), ("score", run["score"])]]
    return [f"{task.name} with {master} in charge", *_aligned(facts), "", *_aligned(paid)]


def _ending(ended: str | None) -> str:
    match ended:
        case None:
            return "ended before it was over"
        case "time":
            return "lasted its time"
        case event if event.startswith("success: "):
            return f"ended by {event.removeprefix('success: ')}, a success"
        case event:
            return f"ended by {event}"


def _number(value: float) -> str:
    return f"{value:,.2f}" if isfinite(value) else "not a number"


def _aligned(rows: Sequence[tuple[str, str]]) -> list[str]:
    """A line per row, the first column to the right."""
    width = max(len(first) for first, _ in rows)
    return [f"{first:>{width}}  {second}" for first, second in rows]
