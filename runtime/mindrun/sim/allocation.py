"""Room for the state of so many lanes."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.kinds.sensors.inertial import TRAIL_TICKS
from mindrun.numbers.arithmetic import BOX_COLUMNS, HALF_X, HALF_Y, LOOSE_ROWS, THING_ROWS, X, Y
from mindrun.sim import chipmunk_internals as chipmunk
from mindrun.sim.codes import AWAY, PUSH_ROWS
from mindrun.sim.state import (
    FIRST_RAY,
    FRAME_ROWS,
    PLACE_ROWS,
    SIDES,
    WAY,
    Contact,
    Judge,
    Mind,
    Run,
    Sight,
    State,
    World,
)
from mindrun.sim.tables import Sizes, Tables
from mindrun.sim.vector import VECTOR_LANES

Array = NDArray[Any]


def empty_state(tables: Tables, sizes: Sizes, lanes: int) -> State:
    """Room for so many lanes, all idle."""
    room = _Room(lanes)
    return State(
        _world(tables, sizes, room),
        _sight(tables, sizes, room),
        _mind(tables, sizes, room),
        _contact(tables, sizes, room),
        _judge(tables, sizes, room),
        Run(job=room.each(), ended=room.each(), met=room.each(), faults=room.each(), failed=np.full(2, -1, np.int64)),
    )


@dataclass(frozen=True, slots=True)
class _Room:
    """Arrays of zeros for so many lanes."""

    lanes: int

    def rows(self, count: int, kind: Any = np.float64) -> Array:
        """[row, lane], and at least one row: whole vectors of lanes, as the perceptrons take sixteen at a time."""
        return np.zeros((max(1, count), -(-self.lanes // VECTOR_LANES) * VECTOR_LANES), kind)

    def columns(self, count: int, kind: Any = np.float64) -> Array:
        """[lane, column]."""
        return np.zeros((self.lanes, count), kind)

    def each(self, kind: Any = np.int64) -> Array:
        """[lane]."""
        return np.zeros(self.lanes, kind)


def _world(tables: Tables, sizes: Sizes, room: _Room) -> World:
    things = len(tables.things)
    return World(
        body=room.rows(6),
        heading=room.rows(2),
        boxes=room.columns(BOX_COLUMNS * sizes.boxes),
        things=room.rows(THING_ROWS * things),
        loose=room.rows(LOOSE_ROWS * len(tables.loose)),
        still=room.rows(len(tables.loose), np.int64),
        restless=room.each(),
        direction=room.rows(len(tables.walkers)),
        goal=room.rows(len(tables.walkers), np.int64),
        held=room.each(),
        reached=room.rows(things, np.uint8),
        delivered=room.rows(things, np.uint8),
        battery=room.each(np.float64),
        random=room.each(np.uint64),
        random_aside=room.each(np.uint64),
        tick=room.each(),
        numbers=room.rows(len(tables.parameters)),
        trail=room.rows(PLACE_ROWS * TRAIL_TICKS),
        push=room.rows(PUSH_ROWS),
        acting=room.rows(len(tables.actuators), np.float32),
        grip=room.rows(len(tables.actuators)),
        begun_at=room.rows(PLACE_ROWS),
    )


def _sight(tables: Tables, sizes: Sizes, room: _Room) -> Sight:
    nearby = room.rows(BOX_COLUMNS * max(1, sizes.boxes))
    nearby[X::BOX_COLUMNS] = nearby[Y::BOX_COLUMNS] = AWAY
    nearby[HALF_X::BOX_COLUMNS] = nearby[HALF_Y::BOX_COLUMNS] = 0.0
    return Sight(
        nearby=nearby,
        nearby_count=room.each(),
        nearby_most=np.zeros(1, np.int64),
        anchor=room.rows(PLACE_ROWS),
        sides=room.rows(SIDES * sizes.boxes, np.float32),
        nearest=room.rows(THING_ROWS),
        nearest_of=np.zeros(1, np.int64),
        frame=room.rows(FRAME_ROWS, np.float32),
        sight=room.rows(FIRST_RAY + len(tables.ray_row), np.float32),
    )


def _mind(tables: Tables, sizes: Sizes, room: _Room) -> Mind:
    actuators = len(tables.actuators)
    sinks = actuators + len(tables.memories)
    readings = room.rows(sizes.readings, np.float32)
    readings[: len(sizes.measured)][~sizes.measured] = np.nan  # the lanes write none of these
    return Mind(
        readings=readings,
        before=room.rows(sizes.before, np.float32),
        measured=room.rows(sizes.rough, np.float32),
        rings=room.rows(sizes.rings, np.float32),
        genome=room.rows(sizes.genome, np.float32),
        recurrent=room.rows(sizes.recurrent, np.float32),
        influence=room.rows(sizes.skills, np.float32),
        command_sums=room.rows(sinks, np.float32),
        influence_sums=room.rows(sinks, np.float32),
        commands=room.rows(actuators, np.float32),
        late=room.rows(sizes.delays, np.float32),
        active=room.each(np.uint64),
        gathered=room.rows(sizes.inputs, np.float32),
        sound=room.each(np.float32),
        hidden=room.rows(sizes.scratch, np.float32),
        stack=room.rows(sizes.depth),
        values=room.each(np.float32),
        opened=room.each(np.float32),
        other=room.each(np.float32),
        gated=room.each(np.float32),
        sent=room.each(np.float32),
    )


def _contact(tables: Tables, sizes: Sizes, room: _Room) -> Contact:
    shapes = len(tables.things) + sizes.boxes + chipmunk.WALL_COUNT
    return Contact(
        near=room.each(),
        touching=room.each(),
        handles=room.columns(chipmunk.FIRST_HELD + shapes, np.uint64),
        loose=room.columns(chipmunk.LOOSE_HANDLES * len(tables.loose), np.uint64),
        sizes=room.columns(len(tables.loose)),
        placed=room.columns(len(tables.loose), np.uint8),
        last=room.each(np.float64),
        gap=room.each(np.float64),
        swift=room.each(),
        ways=room.columns(WAY * (2 + len(tables.loose))),
        floats=room.columns(chipmunk.BODY_FLOATS),
        batch=room.columns(chipmunk.BATCH_WORDS, np.int64),
        tally=room.columns(chipmunk.TALLY_WORDS, np.int64),
    )


def _judge(tables: Tables, sizes: Sizes, room: _Room) -> Judge:
    events = len(tables.events)
    return Judge(
        last_commands=room.rows(len(tables.actuators), np.float32),
        left_changes=room.rows(sizes.changes),
        right_changes=room.rows(sizes.changes),
        visited=room.columns(max(1, sizes.patches), np.uint8),
        arrived=room.rows(sizes.arrivals, np.uint8),
        lines=room.rows(len(tables.rewards)),
        counts=room.rows(events, np.int64),
        measures=room.rows(len(tables.measures)),
        events=room.rows(events),
        happened=np.zeros(max(1, events), np.int64),
        paid=room.each(np.float64),
    )
