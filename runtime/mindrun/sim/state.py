"""The arrays that the lanes change: the state of every world in parts, the jobs to run and their results.

Every array is declared with its room: `rows` [row, lane], `columns` [lane, column], `each` [lane]; what no lane has for
itself says its `shape`. What stands under "for this tick" is computed anew in each.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, make_dataclass
from typing import Any, TypeVar

import numpy as np

from mindrun.kinds.sensors.motion import TRAIL_TICKS
from mindrun.numbers.arithmetic import BOX_COLUMNS, FIRST_RAY, FRAME_ROWS, LOOSE_ROWS, SIDES, THING_ROWS, X, Y
from mindrun.numbers.arrays import Array
from mindrun.sim.arrays import Block, columns, each, rows, shape
from mindrun.sim.codes import AWAY, PAIR, PUSH_ROWS, SOLID, SPACE, WALL_COUNT, Tables

Part = TypeVar("Part", bound=Block)
PLACE_ROWS = 2  # x and y
FAILED_SKILL, FAILED_COLUMN = range(2)  # of `failed`
# What is solid: a box or wall that never moves, the robot, what it holds, the same of each other robot, what is loose.
FIXED, ROBOT, HELD = range(3)
ROBOT_SOLIDS = 2
MOST_PAIRS, PAIRS_EACH, SPARE_PAIRS = 64, 16, 16  # in a lane, more for each loose thing, and for what is let go
F4, F8, I8, U1, U8 = np.float32, np.float64, np.int64, np.uint8, np.uint64


@dataclass(frozen=True)
class WorldState(Block):
    """Places and motions of everything."""

    body: Array = rows(6)  # x, y, angle, their velocities
    heading: Array = rows(2)  # cosine and sine of the angle
    boxes: Array = columns("boxes", BOX_COLUMNS)  # x, y, half of both sides of each
    things: Array = rows("things", THING_ROWS)  # x, y, size, distance to the robot when the tick began
    loose: Array = rows("loose", LOOSE_ROWS)  # how far each loose thing has turned, its velocity and spin
    still: Array = rows("loose", kind=I8)  # for how many ticks each has not moved, up to SETTLED_TICKS
    restless: Array = each()  # how many have not settled
    direction: Array = rows("walkers")  # of each that wanders, an angle
    goal: Array = rows("walkers", kind=I8)  # the corner of its way that each goes to
    swivel: Array = rows("actuators")  # of each servo, the angle by which it is turned to the left
    held: Array = each()  # the thing that the claw holds, or −1
    reached: Array = rows("things", kind=U1)  # bit 0 while it is in reach, bit 1 if it was in the tick before
    delivered: Array = rows("things", kind=U1)  # the same of items that lie in a zone
    battery: Array = each(F8)
    seed: Array = each(U8)  # of the run
    random: Array = each(U8)  # the generator
    random_aside: Array = each(U8)  # the generator of what no skill reads: a reward changes nothing
    tick: Array = each()  # how many the run has lasted
    numbers: Array = rows("parameters")  # what may differ from run to run
    trail: Array = rows(TRAIL_TICKS, PLACE_ROWS)  # where the robot was in the last ticks
    # for this tick
    push: Array = rows(PUSH_ROWS)  # force along the heading, torque, the force's x and y, force to the left
    drive: Array = rows("loose", PLACE_ROWS)  # the force that each loose thing drives itself with
    acting: Array = rows("actuators", kind=F4)  # the commands as they act, after noise and failures
    grip: Array = rows("actuators")  # the share of its force that each keeps
    said: Array = rows("robots", kind=F4)  # what each robot has said in the tick before
    begun_at: Array = rows(PLACE_ROWS)  # where the robot was when the tick began


@dataclass(frozen=True)
class SightState(Block):
    """The boxes that each robot can see or touch, and the distances along its rays."""

    nearby: Array = rows("boxes", BOX_COLUMNS)  # what its rays or robot can meet; others are AWAY
    nearby_count: Array = each()
    nearby_most: Array = shape(1)  # of any lane
    anchor: Array = rows(PLACE_ROWS)  # where they were chosen
    # for this tick
    sides: Array = rows("boxes", SIDES, kind=F4)  # those of the boxes nearby, relative to the robot
    nearest: Array = rows(THING_ROWS)  # of several things of one name
    nearest_of: Array = shape(1)  # which these are, −3 − the first box, −2 of none, −1 before any sensor asks
    frame: Array = rows(FRAME_ROWS, kind=F4)  # of the thing that is looked at
    sight: Array = rows("sight", kind=F4)  # heading and place, then how far each ray goes


@dataclass(frozen=True)
class MindState(Block):
    """Readings, memories, influence and commands."""

    readings: Array = rows("readings", kind=F4)
    before: Array = rows("before", kind=F4)  # of a derivative what its source read before
    measured: Array = rows("rough", kind=F4)  # what was measured last
    rings: Array = rows("rings", kind=F4)  # what was measured and is not seen yet
    genome: Array = rows("genome", kind=F4)  # of the learner
    recurrent: Array = rows("recurrent", kind=F4)  # what skills remember
    influence: Array = rows("skills", kind=F4)
    scoped: Array = rows("scoped", kind=F4)  # that of all skills in each scope but the first
    command_sums: Array = rows("sinks", kind=F4)  # of the commands times the influence behind them
    influence_sums: Array = rows("sinks", kind=F4)  # of this influence
    commands: Array = rows("actuators", kind=F4)  # as they act
    late: Array = rows("delays", kind=F4)  # commands that wait
    # for this tick, of one skill: side by side for the lanes in which it has influence
    active: Array = each(U8)  # which lanes these are
    gathered: Array = rows("inputs", kind=F4)
    sound: Array = each(F4)  # 0 where all inputs are finite, else NaN
    hidden: Array = rows("scratch", kind=F4)
    stack: Array = rows("depth")  # of expressions
    values: Array = each(F4)  # of an edge with `at`
    opened: Array = each(F4)  # of an edge with `when`, 1 where that holds
    other: Array = each(F4)  # what it sends otherwise
    gated: Array = each(F4)  # which of the two it sends
    sent: Array = each(F4)  # the values of an edge, −1 where nothing is sent
    chosen: Array = each()  # the edge that a skill chooses, −1 for none
    greatest: Array = each(F4)  # its value


@dataclass(frozen=True)
class ContactState(Block):
    """What touches in each lane, what is remembered of it, and the motion in a tick in which something could touch."""

    near: Array = each()  # ticks for which a lane is still made like that
    touching: Array = each()  # bit 0 while something touches, bit 1 if something did in the tick before
    mates: Array = rows(2, kind=I8)  # which robots touch, a bit for each, now and in the tick before
    space: Array = each(SPACE)  # its steps
    solids: Array = columns("solids", kind=SOLID)  # all that moves, and room for one that does not
    pairs: Array = columns("pairs", kind=PAIR)  # what touches, or did a few steps ago
    order: Array = columns("pairs", kind=I8)  # their numbers: first of those that touch, last of no pairs
    last: Array = each(F8)  # seconds of its last step, infinitely many where nothing can have touched
    # for this tick
    gap: Array = each(F8)  # from the robot's next centre to what is nearest
    swift: Array = each()  # 1 where something is so fast that it could pass something, until the tick is made
    awake: Array = columns("solids", kind=I8)  # the solids that take part, as the hash has them
    close: Array = columns("close", kind=I8)  # the boxes and walls that come close to one solid


@dataclass(frozen=True)
class JudgeState(Block):
    """Measures, events and rewards of a task."""

    last_commands: Array = rows("actuators", kind=F4)  # of the tick before
    left_changes: Array = rows("changes")  # how much the left wheel's command changed
    right_changes: Array = rows("changes")
    visited: Array = columns("board", kind=U1)
    arrived: Array = rows("arrivals", kind=U1)  # as `delivered`, of zones or things of one name
    lines: Array = rows("rewards")  # the sum of each reward line
    counts: Array = rows("events", kind=I8)  # how often each happened in this run
    tallies: Array = rows("tallies")
    stretches: Array = rows("tallies")  # how often what each counts has happened while its condition went on to hold
    left: Array = rows("windows", kind=I8)  # in how many ticks, this one too, an event may come after another
    # for this tick
    measures: Array = rows("measures")
    apart: Array = rows("measures")  # how far two things were from each other as the tick began
    events: Array = rows("events")  # how often it happened
    happened: Array = shape("happened")  # in how many lanes
    paid: Array = each(F8)  # whether a line pays, or an end has come; before that, room for a measure


@dataclass(frozen=True)
class RunState(Block):
    """The job of each lane, and its end."""

    job: Array = each()  # the number of its job, −1 for none
    ended: Array = each()  # what ended it, by its place among the task's ends, or GOING_ON, or LOST
    met: Array = each()  # the end that came first, or GOING_ON; where nothing interrupts, the run goes on
    faults: Array = each()  # values that were not sent
    failed: Array = shape(2)  # the skill whose procedure failed, or −1, and the column of `gathered`


# What the lane function of a sensor's kind sees of the state, and where it writes: arrays of its parts.
SENSED: Mapping[str, tuple[type[Block], tuple[str, ...]]] = {
    "mind": (MindState, ("readings", "before", "stack", "active", "influence")),
    "sight": (SightState, ("nearest", "nearest_of", "frame", "sight", "nearby", "nearby_count")),
    "world": (WorldState, (
        "body", "heading", "things", "said", "held", "battery", "tick", "trail", "loose", "boxes", "seed", "swivel",
    )),
}  # fmt: skip
Senses = make_dataclass(
    "Senses",
    [
        (each.name, Array, field(metadata=each.metadata))
        for part, names in SENSED.values()
        for each in fields(part)
        if each.name in names
    ],
    bases=(Block,),
    frozen=True,
)


@dataclass(frozen=True)
class State(Block):
    """Everything that changes; a lane is one robot in its world, of which the first lane has the things."""

    world: WorldState
    sight: SightState
    mind: MindState
    contact: ContactState
    judge: JudgeState
    run: RunState
    senses: Senses = field(init=False)  # type: ignore[valid-type]

    def __post_init__(self) -> None:
        of = {name: getattr(getattr(self, part), name) for part, (_, names) in SENSED.items() for name in names}
        object.__setattr__(self, "senses", Senses(**of))


@dataclass(frozen=True)
class Jobs(Block):
    """The jobs to run, genome by layout, and their results."""

    genomes: Array = shape(0, 0, kind=F4)  # [genomes, weights]
    seeds: Array = shape(0, kind=U8)
    genome: Array = shape("jobs")  # index
    seed: Array = shape("jobs")  # index
    most: Array = shape(1)  # ticks that a run lasts
    next: Array = shape(1)  # the next job to start
    lanes: Array = shape(1)  # how many lanes are at work
    clock: Array = shape(1)  # ticks since the beginning, for the rings
    lines: Array = shape("jobs", "lines", kind=F8)
    counts: Array = shape("jobs", "events")
    ticks: Array = shape("jobs")
    ended: Array = shape("jobs")
    met: Array = shape("jobs")  # the end that came first, whatever ended the run
    faults: Array = shape("jobs")
    watched: Array = shape(1)  # which robot of the first world is written down
    doubles: Array = shape(0, 0, kind=F8)  # its world after each tick, in as many as there is room for
    singles: Array = shape(0, 0, kind=F4)  # its mind (lanes/advance)
    recorded: Array = shape(1)  # how many ticks have been written down


def empty_state(tables: Tables, sizes: Mapping[str, int], lanes: int) -> State:
    """A state with room for so many lanes, all idle."""
    n = _counts(tables, sizes)
    parts: Mapping[str, Any] = State.layout()
    state = State(**{name: _empty(part, n, lanes) for name, (_, part) in parts.items() if part is not Senses})
    nearby = state.sight.nearby
    nearby[X::BOX_COLUMNS] = nearby[Y::BOX_COLUMNS] = AWAY
    state.mind.readings[: len(tables.measured)][~tables.measured] = np.nan  # the lanes write none of these
    state.run.failed[:] = -1
    return state


def unbegun(genomes: Array, seeds: Array, most: Array, genome: Array, seed: Array, lines: int, events: int) -> Jobs:
    """Jobs that have not begun, of `most` [1] ticks: a genome and a seed of each, by their numbers."""
    n = {"jobs": len(genome), "lines": max(1, lines), "events": events}
    genome, seed = np.ascontiguousarray(genome, I8), np.ascontiguousarray(seed, I8)
    return _empty(Jobs, n, 0, genomes=genomes, seeds=seeds, most=most, genome=genome, seed=seed)


def recorded(state: State) -> tuple[tuple[Array, ...], tuple[Array, ...]]:
    """The arrays whose rows are the columns of `jobs.doubles`, and those of `jobs.singles`."""
    world, mind, judge = state.world, state.mind, state.judge
    return (
        (world.body, world.things, world.loose, world.direction, world.grip, judge.lines, judge.events),
        (mind.readings, mind.influence, mind.commands, world.acting),
    )


def _empty(part: type[Part], n: Mapping[str, int], lanes: int, **known: Array) -> Part:
    """A part of the state, or jobs: zeros in all that is not known."""
    layout: Mapping[str, Any] = part.layout()
    return part(**{
        name: known[name] if name in known else room.empty(n, lanes)
        for name, (_, room) in layout.items()
    })  # fmt: skip


def _counts(tables: Tables, sizes: Mapping[str, int]) -> dict[str, int]:
    """The numbers that arrays say their rows or columns by: lengths of tables, Sizes, and sums of these."""
    n = {name: len(getattr(tables, name)) for name in tables.layout()} | dict(sizes)
    movers, fixed = ROBOT_SOLIDS * n["robots"] + n["loose"], n["boxes"] + WALL_COUNT
    return n | {
        "sinks": n["actuators"] + n["memories"],
        "sight": FIRST_RAY + n["ray_row"],
        "board": max(1, n["patches"]),
        "happened": max(1, n["events"]),
        "windows": sum(1 for event in tables.events if event["after"] >= 0),
        "close": fixed,
        "solids": ROBOT + movers,
        "pairs": min(MOST_PAIRS + PAIRS_EACH * (n["loose"] + n["robots"] - 1), movers * (movers + fixed) + SPARE_PAIRS),
    }
