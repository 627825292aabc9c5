"""One run, tick by tick: what the pictures, the videos and the tests look at."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mindrun.arithmetic import ANGLE, BOX_COLUMNS, LOOSE_ROWS, SIZE, THING_ROWS, TURN
from mindrun.changes import Change
from mindrun.sim.changed_ticks import changed
from mindrun.sim.rollout import Rollout
from mindrun.sim.state import Jobs, World


@dataclass(frozen=True, slots=True)
class Moment:
    """The world and the mind after one tick; `tick` counts from 1.

    `body` is x, y, angle and their velocities; `things` [things, 3] is x, y and size of each, and
    `turned` [things] how far each has turned, counterclockwise in radians, or the direction of one that wanders;
    `held` the number of the thing in the claw or −1; `acting` the commands with the noise of their actuators, and
    `grip` the share of its force that each kept; `events` how often each event happened; `lines` the sum of each
    reward line so far.
    """

    tick: int
    body: NDArray[np.float64]
    things: NDArray[np.float64]
    turned: NDArray[np.float64]
    held: int
    battery: float
    touching: bool
    readings: NDArray[np.float32]
    influence: NDArray[np.float32]
    commands: NDArray[np.float32]
    acting: NDArray[np.float32]
    grip: NDArray[np.float64]
    events: NDArray[np.int64]
    lines: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Trace:
    """A run that is about to begin: the obstacles [boxes, 4] as x, y and half of both sides, and its moments.

    `drawn` has what each argument that varies is, and from which tick on, counted from 0, what fails is stuck.
    """

    boxes: NDArray[np.float64]
    begin: NDArray[np.float64]  # the robot's x, y, angle
    things: NDArray[np.float64]
    turned: NDArray[np.float64]
    drawn: NDArray[np.float64]
    moments: Iterator[Moment]
    jobs: Jobs


def trace(
    rollout: Rollout, seed: int, genome: NDArray[np.float32] | None = None, changes: Sequence[Change] = ()
) -> Trace:
    """The run that `rollout.score` would make of that genome and seed; with changes, what had become of it then."""
    advance = changed(rollout, changes) if changes else rollout.advance
    genomes = np.zeros((1, 0), np.float32) if genome is None else genome[None].astype(np.float32)
    jobs = rollout.jobs(genomes, np.array([seed], np.uint64))
    tile = rollout.tile(1)
    rollout.fill(tile, jobs)
    world, mind, judge = tile.state.world, tile.state.mind, tile.state.judge
    boxes = world.boxes[0].reshape(-1, BOX_COLUMNS).copy()
    things, turned = _things(world, rollout), _turned(world, rollout)
    rows = rollout.tables.actuators
    rough, slipping = (np.array([bool(row[name]) for row in rows], bool) for name in ("is_rough", "is_slipping"))
    count = len(rows)
    drawn = world.numbers[: len(rollout.task.varies) + len(rollout.task.fails), 0].copy()

    def moments() -> Iterator[Moment]:
        working = 1
        while working:
            working = advance(tile, jobs, 1)
            yield Moment(
                tick=int(world.tick[0]),
                body=world.body[:, 0].copy(),
                things=_things(world, rollout),
                turned=_turned(world, rollout),
                held=int(world.held[0]),
                battery=float(world.battery[0]),
                touching=bool(tile.state.contact.touching[0] & 1),
                readings=mind.readings[:, 0].copy(),
                influence=mind.influence[:, 0].copy(),
                commands=mind.commands[:, 0].copy(),
                acting=np.where(rough, world.acting[:count, 0], mind.commands[:count, 0]),
                grip=np.where(slipping, world.grip[:count, 0], 1.0),
                events=judge.events[: len(rollout.task.events), 0].astype(np.int64),
                lines=judge.lines[: len(rollout.task.rewards), 0].copy(),
            )

    return Trace(boxes, world.body[: ANGLE + 1, 0].copy(), things, turned, drawn, moments(), jobs)


def _turned(world: World, rollout: Rollout) -> NDArray[np.float64]:
    turned = np.zeros(len(rollout.tables.things))
    for i, row in enumerate(rollout.tables.loose):
        turned[int(row["thing"])] = world.loose[LOOSE_ROWS * i + TURN, 0]
    for i, row in enumerate(rollout.tables.walkers):
        turned[int(row["thing"])] = world.direction[i, 0]
    return turned


def _things(world: World, rollout: Rollout) -> NDArray[np.float64]:
    rows = world.things[: THING_ROWS * len(rollout.tables.things), 0].reshape(-1, THING_ROWS)
    return rows[:, : SIZE + 1].copy()
