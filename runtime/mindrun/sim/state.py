"""What the lanes change: the state of every world in parts, the jobs to run and their results.

Arrays are [row, lane] where nothing else is said, and [lane] where they have one row. What stands under "for this tick"
is computed anew in each.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
PLACE_ROWS = 2  # x and y
SIGHT_COSINE, SIGHT_SINE, SIGHT_X, SIGHT_Y, FIRST_RAY = range(5)  # rows of `sight`
LEFT, RIGHT, LOW, HIGH, SIDES = range(5)  # rows of a box in `sides`, and how many
LOOSE_COSINE, LOOSE_SINE, LOOSE_X, LOOSE_Y, LOOSE_HALF, FRAME_ROWS = range(6)  # of the frame of a loose thing
FAILED_SKILL, FAILED_COLUMN = range(2)  # of `failed`
BEGIN_X, BEGIN_Y, FROM_X, FROM_Y, FROM_ANGLE, TO_X, TO_Y, HALF, WAY = range(9)  # columns of each way in `ways`


class World(NamedTuple):
    """Where everything is, and how it moves."""

    body: Array  # [6] float64: x, y, angle, their velocities
    heading: Array  # [2] float64: cosine and sine of the angle
    boxes: Array  # [lane, BOX_COLUMNS·boxes] float64: x, y, half of both sides of each
    things: Array  # [THING_ROWS·things] float64: x, y, size, distance to the robot when the tick began
    loose: Array  # [LOOSE_ROWS·loose] float64: how far each loose thing has turned, its velocity and spin
    still: Array  # [loose] int64: for how many ticks each has not moved, up to SETTLED_TICKS
    restless: Array  # int64: how many have not settled
    direction: Array  # [walkers] float64: in which each wanders
    goal: Array  # [walkers] int64: the place of its way that each goes to
    held: Array  # int64: the thing that the claw holds, or −1
    reached: Array  # [things] uint8: bit 0 while it is in reach, bit 1 if it was in the tick before
    delivered: Array  # [things] uint8: the same of items that were carried into a zone and have not left
    battery: Array  # float64
    random: Array  # uint64: the generator
    random_aside: Array  # uint64: the generator of what no skill reads
    tick: Array  # int64: how many the run has lasted
    numbers: Array  # [parameters] float64: what may differ from run to run
    trail: Array  # [PLACE_ROWS·TRAIL_TICKS] float64: where the robot was in the last ticks
    # for this tick
    push: Array  # [PUSH_ROWS] float64: force along the heading, torque, the force's x and y, force to the left
    acting: Array  # [actuators] float32: the commands of what is rough, with its noise
    grip: Array  # [actuators] float64: the share of its force that each keeps that slips
    begun_at: Array  # [PLACE_ROWS] float64: where the robot was when the tick began


class Sight(NamedTuple):
    """What each robot can see or touch, and how far its rays go."""

    nearby: Array  # [BOX_COLUMNS·boxes] float64: the boxes that a lane's rays or robot can meet, the others AWAY
    nearby_count: Array  # int64
    nearby_most: Array  # [1] int64: of any lane
    anchor: Array  # [PLACE_ROWS] float64: where they were chosen
    # for this tick
    sides: Array  # [SIDES·boxes] float32: those of the boxes nearby, relative to the robot
    nearest: Array  # [THING_ROWS] float64: of several things of one name
    nearest_of: Array  # [1] int64: the first row of these, −2 − the first box, −1 before any sensor has asked
    frame: Array  # [FRAME_ROWS] float32: of the thing that is looked at: how it is turned, where it is, its size
    sight: Array  # [FIRST_RAY + rays] float32: heading and place, then how far each ray goes


class Mind(NamedTuple):
    """What is read, remembered and sent."""

    readings: Array  # [readings] float32
    before: Array  # [what virtual sensors remember] float32: of a derivative what its source read before
    measured: Array  # [rough readings] float32: what was measured last
    rings: Array  # [rough readings · delay] float32: what was measured and is not seen yet
    genome: Array  # [weights] float32, of the learner
    recurrent: Array  # [numbers that skills remember] float32
    influence: Array  # [skills] float32
    command_sums: Array  # [actuators + memories] float32: of the commands times the influence behind them
    influence_sums: Array  # [actuators + memories] float32: of this influence
    commands: Array  # [actuators] float32, as they act
    late: Array  # [delays] float32: commands that wait
    # for this tick, of one skill: side by side for the lanes in which it has influence
    active: Array  # uint64: which lanes these are
    gathered: Array  # [inputs] float32
    sound: Array  # float32: 0 where all inputs are finite, else NaN
    hidden: Array  # [scratch] float32
    stack: Array  # [depth] float64, of expressions
    values: Array  # float32: of an edge with `at`
    opened: Array  # float32: of an edge with `when`, 1 where that holds
    other: Array  # float32: what it sends otherwise
    gated: Array  # float32: which of the two it sends
    sent: Array  # float32: the values of an edge, −1 where nothing is sent


class Contact(NamedTuple):
    """What Chipmunk has to do with a lane."""

    near: Array  # int64: ticks for which it still steps this lane
    touching: Array  # int64: bit 0 while something touches, bit 1 if something did in the tick before
    handles: Array  # [lane, …] uint64: space, body, robot's shape, held shapes, boxes' shapes, walls' shapes
    loose: Array  # [lane, LOOSE_HANDLES·loose] uint64: body and shape of each loose thing
    sizes: Array  # [lane, loose] float64: of which size these are
    placed: Array  # [lane, loose] uint8: 1 where a body stands still just where its settled thing does
    last: Array  # float64: the seconds of Chipmunk's last step, infinitely many where nothing can have touched
    # for this tick
    gap: Array  # float64: to what is nearest after it
    swift: Array  # int64: 1 where something is so fast that it could pass something, until the tick is made
    ways: Array  # [lane, WAY·(2 + loose)] float64: where what moves was and is (lanes/hold_back)
    floats: Array  # [lane, …] float64: a body's state on its way to Chipmunk and back
    batch: Array  # [lane, …] int64: pymunk's structures that point at `floats`
    tally: Array  # [lane, TALLY_WORDS] int64: contacts of the last step, and what it takes to count them


class Judge(NamedTuple):
    """What a task notices and pays."""

    last_commands: Array  # [actuators] float32: of the tick before
    left_changes: Array  # [changes] float64: how much the left wheel's command changed
    right_changes: Array
    visited: Array  # [lane, patches] uint8
    arrived: Array  # [items by event] uint8: as `delivered`, of zones of one name
    lines: Array  # [rewards] float64: the sum of each reward line
    counts: Array  # [events] int64: how often each happened in this run
    # for this tick
    measures: Array  # [measures] float64
    events: Array  # [events] float64: how often it happened
    happened: Array  # [events] int64: in how many lanes
    paid: Array  # float64: whether a reward line pays, or an end has come; before that, room for a measure


class Run(NamedTuple):
    """How the run of each lane stands."""

    job: Array  # int64: which it is, −1 for none
    ended: Array  # int64: what ended it, by its place among the task's ends, or GOING_ON, or LOST
    met: Array  # int64: the end that came first, or GOING_ON; where nothing interrupts, the run goes on
    faults: Array  # int64: values that were not sent
    failed: Array  # [2] int64: the skill whose procedure failed, −1 where none did, and the column of `gathered`


class State(NamedTuple):
    """Everything that changes; a lane is one world with one robot in it."""

    world: World
    sight: Sight
    mind: Mind
    contact: Contact
    judge: Judge
    run: Run


class Senses(NamedTuple):
    """What the lane function of a sensor's kind sees of the state, and where it writes."""

    readings: Array
    before: Array
    body: Array
    heading: Array
    things: Array
    held: Array
    battery: Array
    tick: Array
    trail: Array
    loose: Array
    nearest: Array
    nearest_of: Array
    frame: Array
    sight: Array
    boxes: Array
    nearby: Array
    nearby_count: Array
    stack: Array
    active: Array


class Jobs(NamedTuple):
    """What to run, genome by layout, and what came of it."""

    genomes: Array  # [genomes, weights] float32
    seeds: Array  # uint64
    genome: Array  # [jobs] index
    seed: Array  # [jobs] index
    next: Array  # [1]: the next job to start
    lanes: Array  # [1]: how many lanes are at work
    clock: Array  # [1]: ticks since the beginning, for the rings
    lines: Array  # [jobs, lines]
    counts: Array  # [jobs, events]
    ticks: Array
    ended: Array
    met: Array  # the end that came first, which is not what ended the run where nothing interrupts one
    faults: Array
    doubles: Array  # [ticks, columns] float64: the first lane after each tick, in as many as there is room for
    singles: Array  # [ticks, columns] float32: its mind (lanes/record)
    recorded: Array  # [1]: how many ticks have been written down


def unbegun(genomes: Array, seeds: Array, genome: Array, seed: Array, lines: int, events: int) -> Jobs:
    """Jobs that have not begun: a genome and a seed of each, by their numbers."""
    count = len(genome)
    return Jobs(
        genomes=genomes,
        seeds=seeds,
        genome=np.ascontiguousarray(genome, np.int64),
        seed=np.ascontiguousarray(seed, np.int64),
        next=np.zeros(1, np.int64),
        lanes=np.zeros(1, np.int64),
        clock=np.zeros(1, np.int64),
        lines=np.zeros((count, max(1, lines))),
        counts=np.zeros((count, events), np.int64),
        ticks=np.zeros(count, np.int64),
        ended=np.zeros(count, np.int64),
        met=np.zeros(count, np.int64),
        faults=np.zeros(count, np.int64),
        doubles=np.zeros((0, 0)),
        singles=np.zeros((0, 0), np.float32),
        recorded=np.zeros(1, np.int64),
    )
