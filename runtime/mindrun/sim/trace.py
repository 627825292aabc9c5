"""One run, tick by tick, as the lanes record it, for pictures, videos and tests; and ticks with a change in them.

Those are made of the compiled stages one by one, with the changes between them. A reading is replaced after its sensor
and before whatever derives from it, so that all others take it for what the sensor said. Influence is replaced after
all above a skill have sent theirs and before the skill runs.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from mindrun.engine.changes import Change, Changed, ChangeError, calm_ticks, in_tick
from mindrun.engine.think import in_scopes
from mindrun.graph.skill_sets import below
from mindrun.numbers.arithmetic import ANGLE, BOX_COLUMNS, COSINE, LOOSE_ROWS, SINE, SIZE, THING_ROWS, TURN
from mindrun.numbers.arrays import Array, Bools, Doubles, Integers, Singles
from mindrun.numbers.short_repr import ShortRepr
from mindrun.sim.codes import Tables
from mindrun.sim.lanes.advance import before
from mindrun.sim.procedures import Memories
from mindrun.sim.rollout import Rollout, Tile
from mindrun.sim.state import FIXED, ROBOT, ROBOT_SOLIDS, Jobs, State, recorded

Advance = Callable[[Tile, Jobs, int], int]
CHUNK_TICKS, CHUNK_BYTES = 256, 1 << 22  # of a run at once, or fewer where a tick is large
SCALAR_COLUMNS = 3  # held, battery and touching, after the doubles; behind them the angles of all robots
REMEMBERED = ("readings", "before", "measured", "rings", "late", "commands")  # by sensors, memories and actuators
PARTS = ("tick", "body", "sensors", "memories", "actuators")  # of a graph
SENSED = ("lane", "start", "width", "before", "held", "ring", "ray", "number", "is_aside")  # what says where it stands


@dataclass(frozen=True, slots=True, repr=False)
class Ticks(ShortRepr):
    """The world and the mind after each of some ticks; every array has a row for each.

    `body` [6] is x, y, angle and their velocities; `things` [things, 3] is x, y and size of each, and `turned` [things]
    how far each has turned, counterclockwise in radians, or the direction of one that wanders, or of another robot;
    `held` the number of the thing in the claw or −1; `readings` as the skills read them, NaN of sensors that are not
    measured; `influence` NaN of skills that are not below the master; `battery` NaN where nobody asks for it; `acting`
    the commands with the noise of their actuators, and `grip` the share of its force that each kept; `events` how often
    each event happened in the tick; `lines` the sum of each reward line so far.
    """

    body: Doubles
    things: Doubles
    turned: Doubles
    held: Integers
    battery: Doubles
    touching: Bools
    readings: Singles
    influence: Singles
    commands: Singles
    acting: Singles
    grip: Doubles
    events: Integers
    lines: Doubles

    def __len__(self) -> int:
        return len(self.body)


@dataclass(frozen=True, slots=True, repr=False)
class Moment(ShortRepr):
    """The world and the mind after one tick, as a row of `Ticks`; `tick` counts from 1 since the run began."""

    tick: int
    body: Doubles
    things: Doubles
    turned: Doubles
    held: int
    battery: float
    touching: bool
    readings: Singles
    influence: Singles
    commands: Singles
    acting: Singles
    grip: Doubles
    events: Integers
    lines: Doubles


@dataclass(frozen=True, slots=True, repr=False)
class Trace(ShortRepr):
    """A run that is about to begin: the obstacles [boxes, 4] as x, y and half of both sides, and its ticks.

    `drawn` has what each argument that varies is, from which tick on, counted from 0, what fails is stuck, and what the
    task draws. The run is made while `chunks` is gone through, or `moments`, which takes from the same; `state` is its
    lane's by then.
    """

    boxes: Doubles
    begin: Doubles  # the robot's x, y, angle
    things: Doubles
    turned: Doubles
    drawn: Doubles
    chunks: Iterator[Ticks]
    moments: Iterator[Moment]
    jobs: Jobs
    state: State


@dataclass(frozen=True, slots=True)
class Touch:
    """Where a robot has run into what never moves, in world units: `ahead` of its middle and `aside`, to its left.

    `box` is the number of a box or, behind these, of a wall of the arena; `thing` that in the claw that did it, or −1.
    """

    ahead: float
    aside: float
    box: int
    thing: int


def trace(
    rollout: Rollout, seed: int, genome: Singles | None = None, changes: Sequence[Change] = (), robot: int = 0
) -> Trace:
    """The run that `rollout.score` would make of a genome and a seed; with `changes`, the run that these make of it.

    Of several robots in the world one is watched: its mind, its claw, its rewards are those of the ticks, and are
    changed.
    """
    genomes = np.zeros((1, 0), np.float32) if genome is None else genome[None].astype(np.float32)
    tile, jobs = _begun(rollout, genomes, seed, robot)
    return _traced(rollout, tile, jobs, changes)


def take_over(
    rollout: Rollout, seed: int, tick: int, other: Rollout, changes: Sequence[Change] = (), robot: int = 0
) -> Trace:
    """The run of a seed from a tick on, counted from 1, in which `other` has the robots; its outcome is of the whole.

    Memory cells and what is derived of readings go on, and what skills remember where all are declared as before. What
    procedures remember begins anew. ChangeError where the other mind does not fit, or the run is over before.
    """
    _refuse_another_world(rollout, other)
    tile, jobs = _begun(rollout, np.zeros((1, 0), np.float32), seed, robot)
    if tick > 1 and rollout.advance(tile, jobs, tick - 1) == 0:
        raise ChangeError(f"the run is over before tick {tick:,}", "say an earlier one")
    ours, theirs = tile.state.mind, other.tile(1).state.mind
    for name in (*REMEMBERED, *(("recurrent", "influence") if rollout.graph.skills == other.graph.skills else ())):
        getattr(theirs, name)[:] = getattr(ours, name)
    taken = Tile(replace(tile.state, mind=theirs), Memories(other.procedures), tile.kept)
    return _traced(other, taken, jobs, changes)


def joined(chunks: Iterable[Ticks]) -> Ticks:
    """The ticks of some chunks as one."""
    each = list(chunks)
    columns = {name: [getattr(ticks, name) for ticks in each] for name in Ticks.__slots__}
    return Ticks(**{name: np.concatenate(parts) for name, parts in columns.items()})


def things_in(rollout: Rollout, state: State, lane: int) -> Doubles:
    """The x, y and size of each thing in a lane's world [things, 3]."""
    things: Doubles = state.world.things[: THING_ROWS * len(rollout.tables.things), lane]
    return things.reshape(-1, THING_ROWS)[:, : SIZE + 1].copy()


def turned_in(rollout: Rollout, state: State, lane: int) -> Doubles:
    """The angle by which each thing in a lane's world has turned [things]."""
    here, world = slice(lane, lane + 1), state.world
    home = lane - lane % len(rollout.tables.robots)
    angles = world.body[ANGLE, home : home + len(rollout.tables.robots)][None]
    found: Doubles = _turned(rollout, world.loose[:, here].T, world.direction[:, here].T, angles)[0]
    return found


def last_touch(rollout: Rollout, state: State, robot: int = 0) -> Touch | None:
    """The last touch of a robot of the first world with what never moves; None where Chipmunk remembers none."""
    contact, heading, solid = state.contact, state.world.heading[:, robot], ROBOT + ROBOT_SOLIDS * robot
    pairs = contact.pairs[0, contact.order[0, : contact.space[0]["pairs"]]]
    own, other = pairs["own"], pairs["other"]
    pairs = pairs[(np.minimum(own, other) == FIXED) & (np.maximum(own, other) == solid)]
    if not len(pairs):
        return None
    pair = pairs[np.argmax(pairs["used"])]
    points = pair["contacts"][: pair["count"]]
    x, y = (points[name].mean() for name in (("x", "y") if pair["own"] == solid else ("its_x", "its_y")))
    ahead, aside = heading[COSINE] * x + heading[SINE] * y, heading[COSINE] * y - heading[SINE] * x
    box = pair["found"] - ROBOT - ROBOT_SOLIDS * len(rollout.tables.robots) - len(rollout.tables.loose)
    return Touch(float(ahead), float(aside), int(box), int(pair["thing"]))


def _begun(rollout: Rollout, genomes: Singles, seed: int, robot: int) -> tuple[Tile, Jobs]:
    """A tile of one world in which a run begins, watched through a robot."""
    tile, jobs = rollout.tile(1), rollout.jobs(genomes, np.array([seed], np.uint64))
    jobs.watched[0] = robot
    rollout.fill(tile, jobs)
    return tile, jobs


def _traced(rollout: Rollout, tile: Tile, jobs: Jobs, changes: Sequence[Change]) -> Trace:
    """The run of a tile of one world from where it is, written down from now on."""
    world, task, lane = tile.state.world, rollout.task, int(jobs.watched[0])
    wide, narrow = (sum(map(len, arrays)) for arrays in recorded(tile.state))
    wide += SCALAR_COLUMNS + len(rollout.tables.robots)
    ticks = max(1, min(CHUNK_TICKS, CHUNK_BYTES // (8 * wide + 4 * narrow)))
    jobs = replace(jobs, doubles=np.zeros((ticks, wide)), singles=np.zeros((ticks, narrow), np.float32))
    chunks = _chunks(rollout, changed(rollout, changes) if changes else rollout.advance, tile, jobs)
    return Trace(
        boxes=world.boxes[lane].reshape(-1, BOX_COLUMNS).copy(),
        begin=world.body[: ANGLE + 1, lane].copy(),
        things=things_in(rollout, tile.state, lane),
        turned=turned_in(rollout, tile.state, lane),
        drawn=world.numbers[: sum(map(len, (task.varies, task.fails, task.draws))), lane].copy(),
        chunks=chunks,
        moments=_moments(chunks, int(world.tick[0])),
        jobs=jobs,
        state=tile.state,
    )


def _chunks(rollout: Rollout, advance: Advance, tile: Tile, jobs: Jobs) -> Iterator[Ticks]:
    working = 1
    while working:
        try:
            working = advance(tile, jobs, len(jobs.singles))
        finally:
            if jobs.recorded[0]:  # where a procedure fails, too: what was before that happened
                yield _written(rollout, tile.state, jobs)


def _moments(chunks: Iterator[Ticks], number: int) -> Iterator[Moment]:
    """The ticks after tick `number`, one by one."""
    for ticks in chunks:
        for i in range(len(ticks)):
            number += 1
            row = {name: getattr(ticks, name)[i] for name in Ticks.__slots__}
            scalars = {"held": int(row["held"]), "battery": float(row["battery"]), "touching": bool(row["touching"])}
            yield Moment(tick=number, **row | scalars)


def _written(rollout: Rollout, state: State, jobs: Jobs) -> Ticks:
    """The ticks that have been recorded since the last call."""
    count, tables = int(jobs.recorded[0]), rollout.tables
    jobs.recorded[0] = 0
    wide, narrow = recorded(state)
    body, things, loose, direction, grip, lines, events, scalars = _split(jobs.doubles[:count], wide)
    readings, influence, commands, acting, _ = _split(jobs.singles[:count], narrow)
    held, battery, touching, *angles = scalars.T.copy()
    actuators = len(tables.actuators)
    its = below(rollout.graph, int(tables.robots[jobs.watched[0]]["master"]))
    reached = np.isin(np.arange(influence.shape[1]), [rollout.graph.skill_numbers[skill.name] for skill in its])
    slipping = (tables.actuators["is_slipping"] | tables.actuators["is_sticky"]).astype(bool)
    each_thing = things[:, : THING_ROWS * len(tables.things)].reshape(count, len(tables.things), THING_ROWS)
    return Ticks(
        body=body,
        things=each_thing[:, :, : SIZE + 1],
        turned=_turned(rollout, loose, direction, np.column_stack(angles)),
        held=held.astype(np.int64),
        battery=battery,
        touching=touching.astype(bool),
        readings=readings,
        influence=np.where(reached, influence, np.float32(np.nan)),
        commands=commands[:, :actuators],
        acting=acting[:, :actuators],
        grip=np.where(slipping, grip[:, :actuators], 1.0),
        events=events[:, : len(rollout.task.events)].astype(np.int64),
        lines=lines[:, : len(rollout.task.rewards)],
    )


def _split(columns: Array, arrays: Sequence[Array]) -> list[Array]:
    """The columns [ticks, rows] of each array, one after the other, and those behind them."""
    return np.split(columns.copy(), np.cumsum([len(array) for array in arrays]), axis=1)


def _turned(rollout: Rollout, loose: Array, direction: Array, angles: Array) -> Doubles:
    """The angle by which each thing has turned [ticks, things]: of what is loose, of walkers and of other robots."""
    found = np.zeros((len(loose), len(rollout.tables.things)))
    found[:, rollout.tables.loose["thing"]] = loose[:, TURN::LOOSE_ROWS][:, : len(rollout.tables.loose)]
    found[:, rollout.tables.walkers["thing"]] = direction[:, : len(rollout.tables.walkers)]
    rows = rollout.tables.robots["thing"]
    found[:, rows[rows >= 0]] = angles[:, rows >= 0]
    return found


def _refuse_another_world(rollout: Rollout, other: Rollout) -> None:
    """Raise ChangeError where two minds have not the same body, sensors, memories, actuators and task."""
    unlike = [name for name in PARTS if getattr(rollout.graph, name) != getattr(other.graph, name)]
    unlike += [f"task {other.task.name}"] if rollout.task != other.task else []
    ours, theirs = rollout.tables, other.tables
    if unlike:
        said = f"its {unlike[0]} {'are others' if unlike[0].endswith('s') else 'is another'}"
    elif any(ours.sensors[name].tolist() != theirs.sensors[name].tolist() for name in SENSED):
        said = "its skills read other sensors"
    else:
        return
    raise ChangeError(
        f"the other mind cannot take over in the middle: {said}", "leave out --tick: let it begin the run"
    )


def changed(rollout: Rollout, changes: Sequence[Change]) -> Advance:
    """A function that advances a tile of one world and makes changes; without any, the bits of `rollout.advance`."""

    def advance(tile: Tile, jobs: Jobs, ticks: int) -> int:
        working = int(jobs.lanes[0])
        while ticks and working:
            tick = int(tile.state.world.tick[0]) + 1
            made = in_tick(changes, tick)
            count = 1 if made else calm_ticks(changes, tick, ticks)
            working = _tick(rollout, tile, jobs, made) if made else rollout.advance(tile, jobs, count)
            ticks -= count
        return working

    return advance


def _tick(rollout: Rollout, tile: Tile, jobs: Jobs, made: Changed) -> int:
    """Make one tick with its changes; ProcedureError where a procedure fails."""
    readings = tile.state.mind.readings
    for row, value in made["memory"].items():
        readings[row, jobs.watched[0]] = value
    rollout.observe(tile, jobs)
    _sense(rollout.tables, tile.state, jobs, made["reading"])
    _think(rollout, tile, jobs, made["influence"])
    rollout.conclude(tile, jobs)
    return int(jobs.lanes[0])


def _sense(tables: Tables, state: State, jobs: Jobs, replaced: Mapping[int, float]) -> None:
    """Make the first half of a tick in parts of the table of sensors, each of which ends with one that is replaced."""
    starts, widths = tables.sensors["start"], tables.sensors["width"]
    ends = {int(i) + 1 for row in replaced for i in ((starts <= row) & (row < starts + widths)).nonzero()[0]}
    for begin, end in pairwise([0, *sorted({*ends, len(tables.sensors)})]):
        before(replace(tables, sensors=tables.sensors[begin:end]), state, jobs)
        for start, width in zip(starts[end - 1 : end], widths[end - 1 : end], strict=True):
            for row in {*range(start, start + width)} & replaced.keys():
                state.mind.readings[row, jobs.watched[0]] = replaced[row]


def _think(rollout: Rollout, tile: Tile, jobs: Jobs, replaced: Mapping[int, float]) -> None:
    """Run all skills in their order, in parts: each begins with one whose influence is replaced."""
    skills, begin, lane = rollout.tables.skills["index"], 0, int(jobs.watched[0])
    for row in [i for i, index in enumerate(skills) if int(index) in replaced]:
        rollout.think(tile, jobs, begin, row)
        mind, skill = tile.state.mind, int(skills[row])
        scoped = mind.scoped[skill :: len(mind.influence), lane]
        mind.influence[skill, lane], *others = in_scopes(
            np.append(mind.influence[skill, lane], scoped), replaced[skill]
        )
        scoped[:] = others
        begin = row
    rollout.think(tile, jobs, begin, len(skills))
