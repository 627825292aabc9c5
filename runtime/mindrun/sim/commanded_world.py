"""One world whose robot is commanded from outside: what training simulates, for an engine that runs elsewhere."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mindrun.arithmetic import ANGLE, BOX_COLUMNS, SIZE, THING_ROWS
from mindrun.errors import MindError
from mindrun.events import EventKind
from mindrun.functions import Rule
from mindrun.graph import Graph, Task
from mindrun.policy import Policy
from mindrun.registry import names
from mindrun.reward_sums import paid_by_text, score_of
from mindrun.robot.recording_header import GOES_ON
from mindrun.sim.lanes.stages import after, before
from mindrun.sim.rollout import Rollout
from mindrun.sim.state import Jobs
from mindrun.sim.ticks import turned

TIME = "time"  # what ends a run that nothing else has ended


class World:
    """A task's world in one lane, for a mind with `master` (default: its own) in charge.

    Under the commands that this mind computes from `readings`, it is bit for bit the run that `Rollout` makes of the
    seed. As there, a sensor that nobody reads is not measured and reads 0: its noise would draw random numbers.
    """

    def __init__(self, graph: Graph, task: str, seed: int, master: str | None = None) -> None:
        master = master or graph.master
        _check("task", task, [known.name for known in graph.tasks])
        _check("skill", master, [skill.name for skill in graph.skills])
        if next(each for each in graph.tasks if each.name == task).scene.environment:
            message = f"the task {task} is in an environment of Gymnasium, which the simulator is not"
            raise MindError(message, f"Run it with mindc run --task {task}, or bench.")
        # No skill runs in here, so none needs its weights or its procedure: what they read is all that counts.
        silent = replace(graph, skills=tuple(replace(skill, function=Rule()) for skill in graph.skills))
        self.graph = graph
        self._rollout = Rollout(Policy(silent, {}), task, master)
        self._tables = self._rollout.tables
        self._tile = self._rollout.tile(1)
        self._state = self._tile.state
        self._jobs = self._begun([])
        before(self._tables, self._state, self._jobs)  # both compile now, not in the first ticks
        after(self._tables, self._state, self._jobs, True)
        self.begin(seed)

    def begin(self, seed: int) -> None:
        """Begin the run of a seed; RuntimeError where the last one has not ended."""
        if self._jobs.lanes[0] > 0:
            raise RuntimeError("a run begins while another goes on")
        self.seed = seed
        self._happened = np.zeros(len(self._rollout.task.events), np.int64)
        self._jobs = self._begun([seed])
        before(self._tables, self._state, self._jobs)

    def readings(self) -> NDArray[np.float32]:
        """What every sensor reads now [graph.width]; memories and what derives from them are the engine's to fill in.

        When the run has ended: what they read last.
        """
        return self._state.mind.readings[: self.graph.width, 0].copy()

    def step(self, commands: ArrayLike) -> None:
        """One tick under these commands [actuators]; one that is not finite is neutral. Nothing once it has ended."""
        if self.ended is not None:
            return
        state, given = self._state, np.asarray(commands, np.float32)
        state.mind.command_sums[: len(given), 0] = given  # Eq. 3 with the influence 1 gives back the command itself
        state.mind.influence_sums[: len(given), 0] = 1.0
        after(self._tables, state, self._jobs, True)
        self._happened += state.judge.events[: len(self._happened), 0].astype(np.int64)
        if self.ended is None:
            before(self._tables, state, self._jobs)

    @property
    def tick(self) -> int:
        """How many ticks the run has lasted."""
        return int(self._state.world.tick[0])

    @property
    def pose(self) -> tuple[float, float, float]:
        """The robot's x, y and angle."""
        x, y, angle = self._state.world.body[: ANGLE + 1, 0].tolist()
        return x, y, angle

    @property
    def events(self) -> dict[str, int]:
        """How often each event of the task has happened in this run."""
        counts: Counter[str] = Counter()
        for event, happened in zip(self._rollout.task.events, self._happened.tolist(), strict=True):
            counts[_written(event)] += happened
        return dict(counts)

    @property
    def task(self) -> Task:
        """What the world is of."""
        return self._rollout.task

    @property
    def boxes(self) -> NDArray[np.float64]:
        """The obstacles [boxes, 4] as x, y and half of both sides."""
        standing: NDArray[np.float64] = self._state.world.boxes[0].reshape(-1, BOX_COLUMNS)
        return standing.copy()

    def columns(self) -> dict[str, Any]:
        """The world after the last tick, by the columns that a recording has of it."""
        world, things = self._state.world, len(self._tables.things)
        places = world.things[: THING_ROWS * things, 0].reshape(-1, THING_ROWS)[:, : SIZE + 1]
        angles = turned(self._rollout, world.loose[:, :1].T, world.direction[:, :1].T)[0]
        return {
            "pose": self.pose,
            "things": np.column_stack([places, angles]),
            "battery": world.battery[0],
            "rewards": self._lines()[: len(self.task.rewards)],
            "events": self._happened,
            "held": world.held[0],
            "touching": self._state.contact.touching[0] & 1,
            "ended": GOES_ON if self.ended is None else self._state.run.ended[0],
        }

    @property
    def by_line(self) -> dict[str, float]:
        """What each reward line has paid in this run, by its text."""
        return {text: float(paid) for text, paid in paid_by_text(self._rollout.task.rewards, self._lines()).items()}

    @property
    def score(self) -> float:
        """What all reward lines have paid in this run."""
        return float(score_of(self._lines()))

    def _lines(self) -> NDArray[np.float64]:
        return self._state.judge.lines[:, 0] if self.ended is None else self._jobs.lines[0]

    @property
    def ended(self) -> str | None:
        """What has ended the run: an event or a condition, or "time"; None while it goes on."""
        if self._jobs.lanes[0] > 0:
            return None
        number, task = int(self._state.run.ended[0]), self._rollout.task
        if number < 0:
            return TIME
        end = task.ends[number]
        said = end.text if end.event is None else _written(task.events[end.event])
        return f"success: {said}" if end.succeeds else said

    def _begun(self, seeds: Sequence[int]) -> Jobs:
        jobs = self._rollout.jobs(np.zeros((len(seeds), 0), np.float32), np.array(seeds, np.uint64))
        self._rollout.fill(self._tile, jobs)
        return jobs


def _written(event: EventKind) -> str:
    """An event as a mind writes it, without its numbers: "reach of ball"."""
    words = [f" {word} {getattr(event, word)}" for word in ("of", "to") if getattr(event, word, "")]
    return names()[type(event)] + "".join(words)


def _check(noun: str, name: str, known: Sequence[str]) -> None:
    if name not in known:
        raise MindError(f"there is no {noun} {name}", f"There is {', '.join(known)}." if known else "")
