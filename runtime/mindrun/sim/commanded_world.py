"""One simulated world whose robot is commanded from outside, by an engine that runs elsewhere, as in a dry run."""

from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mindrun.errors import MindError
from mindrun.graph.graph import Graph, Task
from mindrun.graph.run_scores import paid_by_text
from mindrun.kinds.events.event import EventKind
from mindrun.kinds.registry import names
from mindrun.numbers.arithmetic import ANGLE
from mindrun.sim.commanded_lanes import commanded_lanes

TIME = "time"  # what ends a run that nothing else has ended
ONE_LANE = np.ones(1, np.bool_)


class CommandedWorld:
    """A task's world in one lane, for a mind with `master` (default: its own) in charge.

    Under the commands that this mind computes from `readings`, it is bit for bit the run that `Rollout` makes of the
    seed. As there, a sensor that nobody reads is not measured and reads NaN: its noise would draw random numbers.
    """

    def __init__(self, graph: Graph, task: str, seed: int, master: str | None = None) -> None:
        master = master or graph.master
        _check("task", task, [known.name for known in graph.tasks])
        _check("skill", master, [skill.name for skill in graph.skills])
        self.graph = graph
        self._lanes = commanded_lanes(graph, task, master)
        self._state = self._lanes.state
        self.task = self._lanes.rollout.task
        self._begin(seed)

    def begin(self, seed: int) -> None:
        """Begin the run of a seed; RuntimeError where the last one has not ended."""
        if self.ended is None:
            raise RuntimeError("a run begins while another goes on")
        self._begin(seed)

    def _begin(self, seed: int) -> None:
        self.seed = seed
        self._lanes.begin(ONE_LANE, [seed])
        self._lanes.sense()

    def readings(self) -> NDArray[np.float32]:
        """The readings of all sensors [graph.width], NaN where nobody reads them; the last ones when the run has ended.

        Memories and what derives from them are the engine's to fill in.
        """
        return self._state.mind.readings[: self.graph.width, 0].copy()

    def step(self, commands: ArrayLike) -> None:
        """Make a tick under commands [actuators]; one that is not finite is neutral. Nothing once it has ended."""
        if self.ended is not None:
            return
        self._lanes.command(np.asarray(commands, np.float32)[None])
        self._lanes.act()
        if self.ended is None:
            self._lanes.sense()

    @property
    def tick(self) -> int:
        """The number of ticks that the run has lasted."""
        return int(self._state.world.tick[0])

    @property
    def pose(self) -> tuple[float, float, float]:
        """The robot's x, y and angle."""
        x, y, angle = self._state.world.body[: ANGLE + 1, 0].tolist()
        return x, y, angle

    @property
    def events(self) -> dict[str, int]:
        """The number of times that each event of the task has happened in this run, by its text."""
        counts: Counter[str] = Counter()
        for event, happened in zip(self.task.events, self._lanes.counts[0].tolist(), strict=True):
            counts[_written(event)] += happened
        return dict(counts)

    @property
    def boxes(self) -> NDArray[np.float64]:
        """The obstacles [boxes, 4] as x, y and half of both sides."""
        return self._lanes.boxes(0)

    def columns(self) -> dict[str, Any]:
        """The world after the last tick, by the columns that a recording has of it."""
        return self._lanes.world_columns(0)

    @property
    def by_line(self) -> dict[str, float]:
        """The sum that each reward line has paid in this run, by its text."""
        return {text: float(paid) for text, paid in paid_by_text(self.task.rewards, self._lanes.lines[0]).items()}

    @property
    def score(self) -> float:
        """The sum that all reward lines have paid in this run."""
        return float(self._lanes.scores[0])

    @property
    def ended(self) -> str | None:
        """The event or condition that has ended the run, in words, or "time"; None while it goes on."""
        if not (self._lanes.terminated[0] or self._lanes.timed_out[0]):
            return None
        return ended_by(self.task, int(self._lanes.ended_by[0]))


def ended_by(task: Task, number: int) -> str:
    """The end of a run in words, by its `Scores.ended_by`."""
    if number < 0:
        return TIME
    end = task.ends[number]
    said = end.text if end.event is None else _written(task.events[end.event])
    return f"success: {said}" if end.succeeds else said


def _written(event: EventKind) -> str:
    """An event as a mind writes it, without its numbers: "reach of ball"."""
    words = [f" {word} {getattr(event, word)}" for word in ("of", "to") if getattr(event, word, "")]
    return names()[type(event)] + "".join(words)


def _check(noun: str, name: str, known: Sequence[str]) -> None:
    if name not in known:
        raise MindError(f"there is no {noun} {name}", f"There is {', '.join(known)}." if known else "")
