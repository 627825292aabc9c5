"""Runs side by side, or a single one, whose robots are commanded from outside, tick by tick.

Each stays in its lanes, one for each robot of its world, until it is replaced. A tick is `command` or `play`, then
`act`, then `sense`; between the last two a run that is over may make room for another (`begin`). Under the commands
that a mind computes, a run is bit for bit what `Rollout` makes of its seed.
"""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mindrun.errors import MindError
from mindrun.graph.graph import Graph, Task
from mindrun.graph.named_readings import kept_rows
from mindrun.graph.policy import Policy
from mindrun.graph.recording_header import GOES_ON
from mindrun.graph.run_scores import paid_by_text, score_of
from mindrun.kinds.events.event import EventKind
from mindrun.kinds.functions.function import Rule
from mindrun.kinds.registry import arguments, names
from mindrun.numbers.arithmetic import ANGLE, BOX_COLUMNS
from mindrun.numbers.arrays import Array, Bools, Doubles, Integers, Singles
from mindrun.sim.arrays import whole_vectors
from mindrun.sim.codes import GOING_ON, LOST
from mindrun.sim.lanes.advance import after, before
from mindrun.sim.lanes.runs import begin_again
from mindrun.sim.lanes.think import send, wake
from mindrun.sim.rollout import Rollout
from mindrun.sim.state import Jobs, State
from mindrun.sim.trace import things_in, turned_in

BY_LANE_FIRST = {"boxes"}  # [lane, column], where all others that are sensed are [row, lane] or [lane]
ENDLESS_TICKS = 1 << 62
TIME = "time"  # what ends a run that nothing else has ended
ONE_LANE = np.ones(1, np.bool_)


class CommandedLanes:
    """A number of runs of a rollout's task, `count`. All begin with the seed 0; `begin` replaces them.

    The `robots` of each run are neighbours among all `lanes`.
    """

    def __init__(self, rollout: Rollout, runs: int) -> None:
        self.rollout, self.count = rollout, runs
        self.robots, is_paid = len(rollout.tables.robots), rollout.tables.robots["paid"] == 1
        self._paid, self._unpaid = np.flatnonzero(is_paid), np.flatnonzero(np.tile(~is_paid, runs))
        self.lanes = runs * self.robots
        self.tile = rollout.tile(runs)
        self.state: State = self.tile.state
        # Of the first robot of each run [runs], and so of all.
        self._met, self._tick, self._job = (
            each[:: self.robots] for each in (self.state.run.met, self.state.world.tick, self.state.run.job)
        )
        genome = np.zeros((1, rollout.genome_length), np.float32)
        self.jobs: Jobs = rollout.jobs(genome, np.zeros(runs, np.uint64))
        self.jobs.most[0] = ENDLESS_TICKS  # a run that has lasted its time stays, and what it reads then can be asked
        rollout.compile(*rollout.entries, begin_again)  # now, not in the first ticks
        rollout.fill(self.tile, self.jobs)
        self._lost = np.zeros(runs, np.bool_)

    def begin(self, runs: Bools, seeds: ArrayLike) -> None:
        """Begin the runs of these seeds in place of those marked [runs], one for each; `sense` takes their readings."""
        self.jobs.seeds[runs] = np.asarray(seeds, np.uint64)
        self.jobs.lanes[0] = self.lanes
        for run in np.flatnonzero(runs):
            begin_again(self.rollout.tables, self.state, self.jobs, run * self.robots)
        self._lost[runs] = False
        self.tile.memories.forget({*np.flatnonzero(~runs).tolist()})

    def sense(self) -> None:
        """Take the robots' readings; once in each tick, for noise draws random numbers."""
        before(self.rollout.tables, self.state, self.jobs)

    def command(self, commands: Singles) -> None:
        """Set the commands [lanes, actuators] of this tick; one that is not finite is neutral."""
        mind, count = self.state.mind, commands.shape[1]
        # Eq. 3 with the influence 1 gives back the command itself.
        mind.command_sums[:count, : self.lanes] = commands.T
        mind.influence_sums[:count, : self.lanes] = 1.0

    def play(self, row: int, outputs: Singles) -> None:
        """Set the outputs [lanes, outputs] of the skill in this row of the tables; all other skills compute theirs."""
        tables, state, lanes = self.rollout.tables, self.state, int(self.jobs.lanes[0])
        self.rollout.think(self.tile, self.jobs, 0, row)
        count = wake(tables, state, lanes, row)
        if count:
            state.mind.hidden[: outputs.shape[1], :count] = outputs[state.mind.active[:count].astype(np.int64)].T
            send(tables, state, row, 0, count, lanes)
        self.rollout.think(self.tile, self.jobs, row + 1, len(tables.skills))

    def act(self) -> None:
        """Make the rest of the tick. A run that is over goes on in its lanes, unseen, until another begins there."""
        # A robot beyond all places leaves its lane at once: another run takes it, or it stays empty where it is alone.
        self.jobs.next[0] = 0 if self.count > 1 else 1
        after(self.rollout.tables, self.state, self.jobs, False)
        self._lost |= (self._tick == 0) | (self._job < 0)

    def sensed_aside(self, runs: Bools) -> State:
        """Another state whose first lanes have what the robots marked [runs] would read now; nothing here changes."""
        chosen = np.flatnonzero(np.repeat(runs, self.robots))
        places = np.resize(chosen, whole_vectors(len(chosen)))
        aside = replace(self.state, **{
            name: _of_lanes(getattr(self.state, name), places, self.lanes) for name in ("world", "sight", "mind")
        })  # fmt: skip
        before(self.rollout.tables, aside, replace(self.jobs, lanes=np.array([len(chosen)], np.int64)))
        return aside

    @property
    def terminated(self) -> Bools:
        """True for the runs [runs] in which an end was met, or a robot is beyond all places."""
        return np.asarray((self._met != GOING_ON) | self._lost)

    @property
    def timed_out(self) -> Bools:
        """True for the runs [runs] that have lasted their time."""
        return np.asarray(self._tick >= self.rollout.task.ticks)

    @property
    def ended_by(self) -> Integers:
        """The end that each run has met [runs], as `Scores.ended_by`: GOING_ON where none, also when time is up."""
        return np.asarray(np.where(self._lost, LOST, self._met))

    @property
    def lines(self) -> Doubles:
        """The sum that each reward line has paid in each run [runs, lines]: the mean over the robots that are paid."""
        written, paid = self.jobs.lines, self._paid
        return np.where(self._lost[:, None], written, self._summed(self.state.judge.lines, written, paid) / len(paid))

    @property
    def scores(self) -> Doubles:
        """The sum that all reward lines have paid in each run [runs]."""
        return np.asarray(score_of(self.lines))

    @property
    def paid(self) -> Doubles:
        """The sum that all reward lines have paid each robot [lanes]; 0 for one that is not paid."""
        found = np.asarray(score_of(self._of_robots(self.state.judge.lines, self.jobs.lines)))
        found[self._unpaid] = 0.0
        return found

    @property
    def counts(self) -> Integers:
        """The number of times that each event of the task has happened to the robots of each run [runs, events]."""
        written = self.jobs.counts
        each = range(self.robots)
        found = np.where(self._lost[:, None], written, self._summed(self.state.judge.counts, written, each))
        return found[:, : len(self.rollout.task.events)]

    def _summed(self, rows: Array, written: Array, numbers: Iterable[int]) -> Array:
        """The sums over these robots of each run [runs, columns], in their order, as they would be `written` down."""
        each = rows[: written.shape[1], : self.lanes].T
        found = np.zeros_like(written)
        for number in numbers:
            found += each[number :: self.robots]
        return found

    def _of_robots(self, rows: Array, written: Array) -> Array:
        """What is known of each robot [lanes, columns].

        Where a run was lost and another has taken its lanes, it is what was `written` down of all of its robots.
        """
        found = rows[: written.shape[1], : self.lanes].T
        if self.count > 1 and self._lost.any():
            runs = np.arange(self.lanes) // self.robots
            found = np.where(self._lost[runs, None], written[runs], found)
        return found

    def world_columns(self, lane: int) -> dict[str, Any]:
        """The world of a lane after its last tick, and its robot, by the columns that a recording has of them."""
        world, judge, run = self.state.world, self.state.judge, lane // self.robots
        things, angles = (columns(self.rollout, self.state, lane) for columns in (things_in, turned_in))
        is_over = self.terminated[run] or self.timed_out[run]
        return {
            "pose": world.body[: ANGLE + 1, lane],
            "things": np.column_stack([things, angles]),
            "battery": world.battery[lane],
            "rewards": self._of_robots(judge.lines, self.jobs.lines)[lane, : len(self.rollout.task.rewards)],
            "events": self._of_robots(judge.counts, self.jobs.counts)[lane, : len(self.rollout.task.events)],
            "held": world.held[lane],
            "touching": self.state.contact.touching[lane] & 1,
            "ended": self.ended_by[run] if is_over else GOES_ON,
        }

    def boxes(self, lane: int) -> Doubles:
        """The obstacles of a lane [boxes, 4] as x, y and half of both sides."""
        return np.array(self.state.world.boxes[lane].reshape(-1, BOX_COLUMNS))


def commanded_lanes(graph: Graph, task: str, master: str, runs: int = 1) -> CommandedLanes:
    """Runs in which no skill acts, so that none needs weights or procedures: only the readings count.

    As in training, a sensor that neither a skill below the master nor a reward reads is not measured and reads NaN: its
    noise would draw random numbers.
    """
    silent = replace(graph, skills=tuple(replace(skill, function=Rule()) for skill in graph.skills))
    return CommandedLanes(Rollout(Policy(silent, {}), task, master), runs)


class CommandedWorld:
    """A task's world in a single lane of `commanded_lanes`, for an engine that runs elsewhere, as in a dry run.

    The `master` in charge is the mind's own where none is given. MindError where the task has several robots.
    """

    def __init__(self, graph: Graph, task: str, seed: int, master: str | None = None) -> None:
        master = master or graph.master
        _check("task", task, [known.name for known in graph.tasks])
        _check("skill", master, [skill.name for skill in graph.skills])
        self.graph = graph
        self._lanes = commanded_lanes(graph, task, master)
        if self._lanes.robots > 1:
            said = f"{task} has {self._lanes.robots} robots, and only one can be commanded here"
            raise MindError(said, "name a task in which the robot is alone")
        self._state = self._lanes.state
        self.task = self._lanes.rollout.task
        self.seed = seed
        self._lanes.begin(ONE_LANE, [seed])
        self._lanes.sense()

    def readings(self) -> Singles:
        """The readings of all sensors [graph.width], NaN where nobody reads them; the last ones when the run has ended.

        Memories and what derives from them are the engine's to fill in.
        """
        return self._state.mind.readings[: self.graph.width, 0].copy()

    def order(self, name: str, value: float) -> bool:
        """Let an order be this from the next tick on, whatever the task draws; False where this is no order."""
        kinds: dict[int, Any] = {s.start: s.kind for s in self.graph.sensors if s.name == name and s.kind.is_order}
        tables = self._lanes.rollout.tables
        rows = [row for row in tables.sensors if row["start"] in kinds]
        for row in rows:  # all that is drawn is lost, and reads what stands there for it
            kind, first = kinds[row["start"]], row["number"]
            if kind.refusal(value):
                return False
            tables.numbers[first : first + 1 + row["width"]] = 1.0, *kind.readings(value)
        return bool(rows)

    def remember(self, cells: Mapping[str, float]) -> None:
        """Let what memories keep be this in the tick that comes, by `kept_rows`: the engine that commands has it."""
        rows = kept_rows(self.graph)
        for name, value in cells.items():
            self._state.mind.readings[rows[name], 0] = value

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
    def boxes(self) -> Doubles:
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


def _of_lanes(part: Any, lanes: Integers, count: int) -> Any:
    """A copy of some lanes of a part of the state, and of what no lane has for itself."""

    def taken(name: str, rows: Array) -> Array:
        if rows.ndim == 1:
            return rows.take(lanes) if len(rows) == count else rows.copy()
        return rows.take(lanes, axis=0 if name in BY_LANE_FIRST else 1)

    return type(part)(**{name: taken(name, getattr(part, name)) for name in part.layout()})


def _written(event: EventKind) -> str:
    """An event as a mind writes it, without its numbers: "reach of ball"."""
    said = ((each.key, getattr(event, each.field)) for each in arguments(type(event)))
    words = [f" {word} {name}" for word, name in said if isinstance(name, str) and name]
    soon = f" within {event.within.ticks} ticks of {_written(event.within.of)}" if event.within else ""
    return names()[type(event)] + "".join(words) + soon


def _check(noun: str, name: str, known: Sequence[str]) -> None:
    if name not in known:
        raise MindError(f"there is no {noun} {name}", f"There is {', '.join(known)}." if known else "")
