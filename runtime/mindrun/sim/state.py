"""What the lanes change: the state of every world, its scratch rows, the jobs to run and their results."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mindrun.sensors.inertial import TRAIL_TICKS
from mindrun.sim.codes import AWAY
from mindrun.sim.tables import Sizes, Tables
from mindrun.sim.vector import VECTOR_LANES

Array = NDArray[Any]


class State(NamedTuple):
    """Arrays [row, lane]; a lane is one world with one robot in it."""

    # the world
    body: Array  # [6] float64: x, y, angle, their velocities
    heading: Array  # [2] float64: cosine and sine of the angle
    boxes: Array  # [lane, 3·boxes] float64: x, y, half side of each
    things: Array  # [4·things] float64: x, y, size, distance to the robot when the tick began
    held: Array  # the thing that the claw holds, or −1
    reached: Array  # [things] uint8: bit 0 while it is in reach, bit 1 if it was in the tick before
    delivered: Array  # [things] uint8: the same of items that were carried into a zone and have not left
    battery: Array
    random: Array  # uint64
    aside: Array  # uint64: the generator of what no skill reads
    # the mind
    readings: Array  # [readings] float32
    before: Array  # [derivatives] float32: what they read in the tick before
    measured: Array  # [rough readings] float32: what was measured last
    rings: Array  # [rough readings · delay] float32: what was measured and is not seen yet
    genome: Array  # [weights] float32, of the learner
    recurrent: Array  # [numbers that skills remember] float32
    influence: Array  # [skills] float32
    sums: Array  # [2·(actuators + memories)] float32: command sums, then influence sums
    commands: Array  # [actuators] float32, as they act
    late: Array  # [delays] float32: commands that wait
    # the judge
    trail: Array  # [2·20] float64: where the robot was
    changes: Array  # [2·changes] float64: how much each side's wheel command changed
    last: Array  # [actuators] float32: the commands of the tick before
    board: Array  # [lane, patches] uint8: visited
    measures: Array  # float64
    events: Array  # float64: how often each happened in this tick
    happened: Array  # [events]: in how many lanes
    lines: Array  # float64: the sum of each reward line
    counts: Array  # [events] int64: how often each happened in this run
    tick: Array
    ended: Array  # the event that ended the run, or GOING_ON, or LOST
    faults: Array
    job: Array
    failed: Array  # [2]: the skill whose procedure failed, −1 where none did, and the column of `gathered`
    # contact
    near: Array  # ticks for which Chipmunk still steps this lane
    touching: Array
    handles: Array  # [lane, …] uint64: space, body, robot's shape, held shapes, boxes' shapes, walls' shapes
    floats: Array  # [lane, 16] float64: a body's state on its way to Chipmunk and back
    batch: Array  # [lane, 8] int64: pymunk's batch structures that point at `floats`
    touches: Array  # [lane] int64: contacts of the last step
    # scratch
    gathered: Array  # [inputs] float32
    hidden: Array  # [2·width] float32
    stack: Array  # [depth] float64, of expressions
    push: Array  # [4] float64: force along the heading, torque, and the force's x and y
    was: Array  # [2] float64: x and y when the tick began
    gap: Array  # float64: to what is nearest after this tick
    paid: Array  # float64: whether a reward line pays
    limit: Array  # float64: the right side of its condition
    sight: Array  # [4 + rays] float32: heading and place, then how far each ray goes
    slots: Array  # [4·boxes] float32: the sides of the boxes that a lane's rays can meet, relative to the robot
    nearby: Array  # [3·boxes] float64: the boxes that a lane's rays or robot can meet, the others AWAY
    slot_count: Array
    slot_most: Array  # [1]: of any lane
    anchor: Array  # [2] float64: where the slots were chosen
    active: Array  # [lanes] uint64: which lanes a skill runs in
    sound: Array  # float32: 0 where all inputs of a skill are finite, else NaN
    values: Array  # float32: of an edge with `at`
    sent: Array  # float32: the values of an edge, −1 where nothing is sent


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
    faults: Array


HANDLES = 3


def empty_state(tables: Tables, sizes: Sizes, lanes: int) -> State:
    """Room for so many lanes, all idle."""
    whole = -(-lanes // VECTOR_LANES) * VECTOR_LANES  # the perceptrons take sixteen lanes at a time
    things, boxes, rays, events = len(tables.things), sizes.boxes, len(tables.ray_row), len(tables.events)
    actuators = len(tables.actuators)
    doubles = {
        "body": 6, "heading": 2, "things": 4 * things, "trail": 2 * TRAIL_TICKS,
        "changes": 2 * sizes.changes, "measures": len(tables.measures), "events": events,
        "lines": len(tables.rewards), "stack": sizes.depth, "push": 4, "was": 2, "anchor": 2,
    }  # fmt: skip
    singles = {
        "readings": sizes.readings, "before": sizes.before, "measured": sizes.rough, "rings": sizes.rings,
        "genome": sizes.genome, "recurrent": sizes.recurrent, "influence": sizes.skills,
        "sums": 2 * (actuators + len(tables.memories)), "commands": actuators, "late": sizes.delays,
        "last": actuators, "gathered": sizes.inputs, "hidden": 2 * sizes.width, "sight": 4 + rays,
        "slots": 4 * boxes,
    }  # fmt: skip
    numbers = (
        "held", "tick", "ended", "faults", "job", "near", "touching", "touches", "slot_count"
    )  # fmt: skip
    return State(
        **{name: np.zeros((max(1, rows), whole)) for name, rows in doubles.items()},
        **{name: np.zeros((max(1, rows), whole), np.float32) for name, rows in singles.items()},
        **{name: np.zeros(lanes, np.int64) for name in numbers},
        **{name: np.zeros(lanes) for name in ("battery", "gap", "paid", "limit")},
        **{name: np.zeros(whole, np.float32) for name in ("sound", "values", "sent")},
        failed=np.full(2, -1, np.int64),
        **{name: np.zeros(lanes, np.uint64) for name in ("random", "aside", "active")},
        **{name: np.zeros((max(1, things), whole), np.uint8) for name in ("reached", "delivered")},
        board=np.zeros((lanes, max(1, sizes.patches)), np.uint8),
        slot_most=np.zeros(1, np.int64),
        happened=np.zeros(max(1, events), np.int64),
        handles=np.zeros((lanes, HANDLES + things + boxes + 4), np.uint64),
        floats=np.zeros((lanes, 16)),
        batch=np.zeros((lanes, 8), np.int64),
        boxes=np.zeros((lanes, 3 * boxes)),
        nearby=np.tile(np.array([[AWAY], [AWAY], [0.0]]), (max(1, boxes), whole)),
        counts=np.zeros((max(1, events), whole), np.int64),
    )
