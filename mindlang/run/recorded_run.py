"""A run written down tick by tick, as arrays: what pictures, films, traces and answers are made from."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from mindrun.engine.changes import Change
from mindrun.graph.draws import drawn_numbers
from mindrun.graph.graph import Graph, Task, Thing
from mindrun.graph.recording_header import GOES_ON
from mindrun.graph.skill_sets import movers
from mindrun.graph.tasks import things_of
from mindrun.sim.codes import AWAY
from mindrun.sim.numbering import robot_numbers
from mindrun.sim.rollout import Rollout, scores_of
from mindrun.sim.trace import Trace, joined, trace
from numpy.typing import NDArray

from mindlang.run.outcome import run_data, run_names
from mindlang.run.setup import RunSetup

Floats = NDArray[np.float64]
WITH_BEGINNING = ("body", "things", "turned", "held")  # which have a row for the beginning, too
ROWS = (*WITH_BEGINNING, "readings", "influence", "commands", "lines", "touching", "battery", "events")
REAPPEARANCE_UNITS = 0.5  # nothing is moved that far in a tick but what reappears elsewhere


@dataclass(frozen=True, slots=True)
class RecordedRun:
    """A run tick by tick; row 0 of `body` [ticks + 1, 3], `things` [ticks + 1, things, 3], `turned` [ticks + 1, things]
    and `held` [ticks + 1] is the beginning.

    `readings` as its skills read them, `influence`, `commands` before the noise of their actuators, `lines` (the sum of
    each reward line so far), `touching`, `battery`, `events` (how often each has happened so far) and `counts` (of the
    counted ones) have a row per tick. `ended` is what ended it, as in a recording; `acting` are the commands with the
    noise of their actuators and what has failed, None where nobody knows them, as `seed` can be. In environments `body`
    is NaN.
    """

    setup: RunSetup
    boxes: Floats
    body: Floats
    things: Floats
    turned: Floats
    held: NDArray[np.int64]
    readings: NDArray[np.float32]
    influence: NDArray[np.float32]
    commands: NDArray[np.float32]
    lines: Floats
    touching: NDArray[np.bool_]
    battery: Floats
    events: NDArray[np.int64]
    ended: int
    acting: NDArray[np.float32] | None = None
    seed: int | None = None

    @property
    def graph(self) -> Graph:
        return self.setup.ready.policy.graph

    @property
    def task(self) -> Task:
        return self.setup.task

    @property
    def ticks(self) -> int:
        return len(self.body) - 1

    @property
    def drawn(self) -> Mapping[str, float]:
        return {} if self.seed is None else drawn_numbers(self.task.draws, self.seed)

    @property
    def standing(self) -> dict[int, Floats]:
        """The obstacles and walls that are there when it begins: x, y and half sides, by their numbers in `boxes`."""
        return {number: box for number, box in enumerate(self.boxes) if box[0] != AWAY}

    @property
    def counts(self) -> NDArray[np.int64]:
        """How often each counted event has happened so far."""
        return self.events[:, list(self.task.counts)]

    @property
    def contents(self) -> list[Thing]:
        return things_of(self.task)

    @property
    def labels(self) -> list[str]:
        """The names of the `contents`; of a robot, which one it is: `robot 2`."""
        robots = robot_numbers(self.task)
        return [f"robot {robots[i]}" if i in robots else thing.name for i, thing in enumerate(self.contents)]

    @property
    def collisions(self) -> NDArray[np.int64]:
        """The ticks in which the robot began to touch something."""
        return np.flatnonzero(self.touching & ~np.concatenate([[False], self.touching[:-1]])) + 1

    def until(self, tick: int) -> "RecordedRun":
        """The run as it was after a tick."""
        cut: dict[str, Any] = {name: getattr(self, name)[: tick + (name in WITH_BEGINNING)] for name in ROWS}
        acting = None if self.acting is None else self.acting[:tick]
        return replace(self, ended=self.ended if tick >= self.ticks else GOES_ON, acting=acting, **cut)

    def placements(self, thing: int) -> Floats:
        """Every place and size [n, 3] where a thing appeared; neither a claw nor its own speed makes a new place."""
        placed: Floats = self.things[np.concatenate([[0], self._jumps(thing)]), thing]
        return placed[np.isfinite(placed[:, 0])]  # of what is not there in this run none

    def stretches(self, thing: int) -> list[Floats]:
        """The places [n, 2] that a thing came through, apart where it was moved elsewhere, and until it vanished."""
        track = self.things[:, thing, :2]
        parts = np.split(track, self._jumps(thing))
        return [part[np.isfinite(part[:, 0])] for part in parts if np.isfinite(part[:, 0]).sum() > 1]

    def _jumps(self, thing: int) -> NDArray[np.int64]:
        """The ticks after which it stood elsewhere than a claw or its own speed have brought it."""
        kind, name = self.contents[thing].kind, self.contents[thing].name
        varied = (each.high for each in self.setup.task.varies if (each.of, each.argument) == (name, "speed"))
        far = REAPPEARANCE_UNITS + max([kind.speed, *varied]) * self.graph.tick
        moved = np.linalg.norm(np.diff(self.things[:, thing, :2], axis=0), axis=1)
        return np.flatnonzero((moved > far) & (self.held[1:] != thing)) + 1

    def former(self, thing: int) -> Floats:
        """The places and sizes [n, 3] that a thing had and has no more: it has moved since, or vanished."""
        placed = self.placements(thing)
        return placed[:-1] if np.isfinite(self.things[-1, thing, 0]) else placed

    @property
    def movers(self) -> dict[str, int]:
        """The skills under the master that move the robot, with their columns in `influence`."""
        return movers(self.graph, self.setup.master)

    def in_control(self, last: int | None = None) -> NDArray[np.int64]:
        """Per tick, or in so many of the last, the mover that moves it with the most influence, as a place in `movers`.

        Behind all of these where none does. A skill that has influence and sends nothing moves nothing.
        """
        moving = {("actuator", i) for i, each in enumerate(self.graph.actuators) if each.kind.moves_body}
        flows = self.setup.flows(self)
        sent = flows.transmitted(np.arange(self.ticks)[-(last or self.ticks) :])
        nobody = np.full(len(sent), np.finfo(np.float32).smallest_subnormal)
        influence = [nobody]
        for skill in self.movers.values():
            edges = [i for i, link in enumerate(flows.links) if link.source == skill and link.target in moving]
            influence.append(sent[:, edges].max(axis=1))
        chosen: NDArray[np.int64] = np.argmax(np.stack(influence, axis=1), axis=1) - 1
        return np.where(chosen < 0, len(self.movers), chosen)


@dataclass(frozen=True, slots=True)
class RunResult:
    """A run written down, and its outcome (`mindlang.run.outcome.run_data`)."""

    run: RecordedRun
    found: dict[str, Any]


def run_result(setup: RunSetup, rollout: Rollout, seed: int, changes: Sequence[Change] = ()) -> RunResult:
    """The run of a seed, with changes, and its outcome."""
    return result_of_trace(setup, trace(rollout, seed, changes=changes, robot=setup.robot), seed)


def result_of_trace(setup: RunSetup, run: Trace, seed: int) -> RunResult:
    """Make a run of that seed that is about to begin, write it down, and return it with its outcome."""
    written = recorded(setup, run)
    found = run_data(setup.task, scores_of(run.jobs, setup.task))
    return RunResult(written, run_names(setup.task, setup.master, seed, setup.robot) | found)


def record_run(setup: RunSetup, rollout: Rollout, seed: int) -> RecordedRun:
    return recorded(setup, trace(rollout, seed, robot=setup.robot))


def recorded(setup: RunSetup, run: Trace) -> RecordedRun:
    """Make a run that is about to begin, and write it down."""
    ticks = joined(run.chunks)
    body = np.concatenate([run.begin[None], ticks.body[:, :3]])
    return RecordedRun(
        setup,
        run.boxes,
        np.full_like(body, np.nan) if setup.task.scene.environment else body,  # where it is, only the environment knows
        np.concatenate([run.things[None], ticks.things]),
        np.concatenate([run.turned[None], ticks.turned]),
        np.concatenate([[-1], ticks.held]),
        ticks.readings,
        ticks.influence,
        ticks.commands,
        ticks.lines,
        ticks.touching,
        ticks.battery,
        np.cumsum(ticks.events, axis=0),
        int(run.jobs.ended[0]),
        ticks.acting,
        int(run.jobs.seeds[0]),
    )
