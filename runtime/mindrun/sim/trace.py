"""One run, tick by tick: what the pictures, the videos and the tests look at."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mindrun.engine.changes import Change
from mindrun.numbers.arithmetic import ANGLE, BOX_COLUMNS, SIZE, THING_ROWS
from mindrun.numbers.short_repr import ShortRepr
from mindrun.sim.changed_ticks import Advance, changed
from mindrun.sim.rollout import Rollout, Tile
from mindrun.sim.state import Jobs
from mindrun.sim.ticks import Ticks, turned, with_room, written


@dataclass(frozen=True, slots=True, repr=False)
class Moment(ShortRepr):
    """The world and the mind after one tick, as a row of `Ticks`; `tick` counts from 1 since the run began."""

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


@dataclass(frozen=True, slots=True, repr=False)
class Trace(ShortRepr):
    """A run that is about to begin: the obstacles [boxes, 4] as x, y and half of both sides, and its ticks.

    `drawn` has what each argument that varies is, and from which tick on, counted from 0, what fails is stuck. The run
    is made while `chunks` is gone through, or `moments`, which takes from the same.
    """

    boxes: NDArray[np.float64]
    begin: NDArray[np.float64]  # the robot's x, y, angle
    things: NDArray[np.float64]
    turned: NDArray[np.float64]
    drawn: NDArray[np.float64]
    chunks: Iterator[Ticks]
    moments: Iterator[Moment]
    jobs: Jobs


def trace(
    rollout: Rollout, seed: int, genome: NDArray[np.float32] | None = None, changes: Sequence[Change] = ()
) -> Trace:
    """The run that `rollout.score` would make of that genome and seed; with changes, what had become of it then."""
    advance = changed(rollout, changes) if changes else rollout.advance
    genomes = np.zeros((1, 0), np.float32) if genome is None else genome[None].astype(np.float32)
    tile = rollout.tile(1)
    jobs = with_room(rollout.jobs(genomes, np.array([seed], np.uint64)), tile.state)
    rollout.fill(tile, jobs)
    return traced(rollout, tile, jobs, advance)


def traced(rollout: Rollout, tile: Tile, jobs: Jobs, advance: Advance) -> Trace:
    """The run of a tile of one lane from where it is; its jobs have room to be written down."""
    world, things = tile.state.world, len(rollout.tables.things)
    chunks = _chunks(rollout, advance, tile, jobs)
    return Trace(
        boxes=world.boxes[0].reshape(-1, BOX_COLUMNS).copy(),
        begin=world.body[: ANGLE + 1, 0].copy(),
        things=world.things[: THING_ROWS * things, 0].reshape(-1, THING_ROWS)[:, : SIZE + 1].copy(),
        turned=turned(rollout, world.loose[:, :1].T, world.direction[:, :1].T)[0],
        drawn=world.numbers[: len(rollout.task.varies) + len(rollout.task.fails), 0].copy(),
        chunks=chunks,
        moments=_moments(chunks, int(world.tick[0])),
        jobs=jobs,
    )


def _chunks(rollout: Rollout, advance: Advance, tile: Tile, jobs: Jobs) -> Iterator[Ticks]:
    working = 1
    while working:
        try:
            working = advance(tile, jobs, len(jobs.singles))
        finally:
            if jobs.recorded[0]:  # where a procedure fails, too: what was before that happened
                yield written(rollout, tile.state, jobs)


def _moments(chunks: Iterator[Ticks], number: int) -> Iterator[Moment]:
    """The ticks after tick `number`, one by one."""
    for ticks in chunks:
        for i in range(len(ticks)):
            number += 1
            row = {name: getattr(ticks, name)[i] for name in Ticks.__slots__}
            scalars = {"held": int(row["held"]), "battery": float(row["battery"]), "touching": bool(row["touching"])}
            yield Moment(tick=number, **row | scalars)
