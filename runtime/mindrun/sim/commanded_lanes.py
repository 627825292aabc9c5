"""Runs side by side whose robots are commanded from outside, tick by tick; each stays in its lane until it is replaced.

A tick is `command` or `play`, then `act`, then `sense`; between the last two a run that is over may make room for
another (`begin`). Under the commands that a mind computes, a run is bit for bit what `Rollout` makes of its seed.
"""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.recording_header import GOES_ON
from mindrun.graph.run_scores import score_of
from mindrun.kinds.functions.function import Rule
from mindrun.numbers.arithmetic import ANGLE, BOX_COLUMNS
from mindrun.sim.codes import GOING_ON, LOST
from mindrun.sim.lanes.stages import after, before, begin_again, send, wake
from mindrun.sim.rollout import Rollout
from mindrun.sim.state import Jobs, State
from mindrun.sim.trace import things_in, turned_in

BY_LANE_FIRST = {"boxes"}  # [lane, column], where all others that are sensed are [row, lane] or [lane]
ENDLESS_TICKS = 1 << 62


class CommandedLanes:
    """A number of runs of a rollout's task. All begin with the seed 0; `begin` replaces them."""

    def __init__(self, rollout: Rollout, lanes: int) -> None:
        self.rollout, self.count = rollout, lanes
        self.tile = rollout.tile(lanes)
        self.state: State = self.tile.state
        genome = np.zeros((1, rollout.genome_length), np.float32)
        self.jobs: Jobs = rollout.jobs(genome, np.zeros(lanes, np.uint64))
        world = rollout.tables.world.copy()
        world["ticks"] = ENDLESS_TICKS  # a run that has lasted its time stays, and what it reads then can be asked
        self._endless = rollout.tables._replace(world=world)
        self._aside: State | None = None
        rollout.compile(before, after, begin_again, wake, send)  # now, not in the first ticks
        rollout.fill(self.tile, self.jobs)
        self._lost = np.zeros(lanes, np.bool_)

    def begin(self, lanes: NDArray[np.bool_], seeds: ArrayLike) -> None:
        """Begin the runs of these seeds in the marked lanes [lanes], one for each; `sense` takes their readings."""
        self.jobs.seeds[lanes] = np.asarray(seeds, np.uint64)
        self.jobs.lanes[0] = self.count
        begin_again(self.rollout.tables, self.state, self.jobs, lanes)
        self._lost[lanes] = False
        self.tile.memories.forget({*np.flatnonzero(~lanes).tolist()})

    def sense(self) -> None:
        """Take the robots' readings; once in each tick, for noise draws random numbers."""
        before(self.rollout.tables, self.state, self.jobs)

    def command(self, commands: NDArray[np.float32]) -> None:
        """Set the commands [lanes, actuators] of this tick; one that is not finite is neutral."""
        mind, count = self.state.mind, commands.shape[1]
        # Eq. 3 with the influence 1 gives back the command itself.
        mind.command_sums[:count, : self.count] = commands.T
        mind.influence_sums[:count, : self.count] = 1.0

    def play(self, row: int, outputs: NDArray[np.float32]) -> None:
        """Set the outputs [lanes, outputs] of the skill in this row of the tables; all other skills compute theirs."""
        tables, state, lanes = self.rollout.tables, self.state, int(self.jobs.lanes[0])
        self.rollout.think(self.tile, self.jobs, 0, row)
        count = wake(tables, state, lanes, row)
        if count:
            state.mind.hidden[: outputs.shape[1], :count] = outputs[state.mind.active[:count].astype(np.int64)].T
            send(tables, state, row, 0, count, lanes)
        self.rollout.think(self.tile, self.jobs, row + 1, len(tables.skills))

    def act(self) -> None:
        """Make the rest of the tick. A run that is over goes on in its lane, unseen, until another begins there."""
        # A robot beyond all places leaves its lane at once: another run takes it, or it stays empty where it is alone.
        self.jobs.next[0] = 0 if self.count > 1 else 1
        after(self._endless, self.state, self.jobs, False)
        self._lost |= (self.state.world.tick == 0) | (self.state.run.job < 0)

    def sensed_aside(self, lanes: NDArray[np.bool_]) -> State:
        """Another state whose first lanes have what the marked lanes [lanes] would read now; nothing here changes."""
        if self._aside is None:
            self._aside = self.rollout.tile(self.count).state
        chosen = np.flatnonzero(lanes)
        for part in ("world", "sight", "mind"):
            _copy(getattr(self.state, part), chosen, getattr(self._aside, part), self.count)
        jobs = self.jobs._replace(lanes=np.array([len(chosen)], np.int64))
        before(self.rollout.tables, self._aside, jobs)
        return self._aside

    @property
    def terminated(self) -> NDArray[np.bool_]:
        """True for the lanes [lanes] in which an end was met, or the robot is beyond all places."""
        return np.asarray((self.state.run.met != GOING_ON) | self._lost)

    @property
    def timed_out(self) -> NDArray[np.bool_]:
        """True for the lanes [lanes] in which the run has lasted its time."""
        return np.asarray(self.state.world.tick >= self.rollout.task.ticks)

    @property
    def ended_by(self) -> NDArray[np.int64]:
        """The end that each run has met [lanes], as `Scores.ended_by`: GOING_ON where none, also when time is up."""
        return np.asarray(np.where(self._lost, LOST, self.state.run.met))

    @property
    def lines(self) -> NDArray[np.float64]:
        """The sum that each reward line has paid in each run [lanes, lines]."""
        paid = self.state.judge.lines[:, : self.count].T.copy()
        if self._lost.any():
            paid[self._lost] = self.jobs.lines[self._lost]
        return paid

    @property
    def scores(self) -> NDArray[np.float64]:
        """The sum that all reward lines have paid in each run [lanes]."""
        return np.asarray(score_of(self.lines))

    @property
    def counts(self) -> NDArray[np.int64]:
        """The number of times that each event of the task has happened in each run [lanes, events]."""
        happened = self.state.judge.counts[: len(self.rollout.task.events), : self.count].T.copy()
        if self._lost.any():
            happened[self._lost] = self.jobs.counts[self._lost, : happened.shape[1]]
        return happened

    def world_columns(self, lane: int) -> dict[str, Any]:
        """The world of a lane after its last tick, by the columns that a recording has of it."""
        world = self.state.world
        things, angles = (columns(self.rollout, self.state, lane) for columns in (things_in, turned_in))
        is_over = self.terminated[lane] or self.timed_out[lane]
        return {
            "pose": world.body[: ANGLE + 1, lane],
            "things": np.column_stack([things, angles]),
            "battery": world.battery[lane],
            "rewards": self.lines[lane, : len(self.rollout.task.rewards)],
            "events": self.counts[lane],
            "held": world.held[lane],
            "touching": self.state.contact.touching[lane] & 1,
            "ended": self.ended_by[lane] if is_over else GOES_ON,
        }

    def boxes(self, lane: int) -> NDArray[np.float64]:
        """The obstacles of a lane [boxes, 4] as x, y and half of both sides."""
        return np.array(self.state.world.boxes[lane].reshape(-1, BOX_COLUMNS))


def commanded_lanes(graph: Graph, task: str, master: str, lanes: int = 1) -> CommandedLanes:
    """Lanes in which no skill runs, so that none needs weights or procedures: only the readings count.

    As in training, a sensor that neither a skill below the master nor a reward reads is not measured and reads NaN: its
    noise would draw random numbers.
    """
    silent = replace(graph, skills=tuple(replace(skill, function=Rule()) for skill in graph.skills))
    return CommandedLanes(Rollout(Policy(silent, {}), task, master), lanes)


def _copy(source: Any, lanes: NDArray[np.int64], target: Any, count: int) -> None:
    """Copy some lanes of a part of the state to the first ones of another."""
    for name, rows, others in zip(source._fields, source, target, strict=True):
        if name in BY_LANE_FIRST:
            others[: len(lanes)] = rows[lanes]
        elif rows.ndim == 2:
            others[:, : len(lanes)] = rows[:, lanes]
        elif len(rows) == count:
            others[: len(lanes)] = rows[lanes]
