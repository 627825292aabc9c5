"""The task's rows of the tables: its world, what it contains, its measures, events and rewards."""

from collections.abc import Sequence
from math import ceil, inf, pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun import actuators, events, measures, sensors, world
from mindrun.graph import Graph, Reward, Sensor, Task, Thing
from mindrun.quantity import Span
from mindrun.sim.codes import (
    ADVANCE,
    CHANGE,
    COLLISION,
    COMPARES,
    DELIVERY,
    EXHAUSTION,
    FORWARD,
    ITEM,
    POWER,
    PROGRESS,
    REACH,
    RETREAT,
    STAYS,
    VISIT,
    WORLD,
    ZONE,
)  # fmt: skip
from mindrun.sim.programs import Programs

Array = NDArray[Any]
MIN_CELL_UNITS = 20.0  # the side of a cell of Chipmunk's hash, in which what is large takes only so many
CELLS_PER_SHAPE, CELLS_PER_WALL = 4, 64


def things_of(task: Task) -> list[Thing]:
    """What the task contains but its obstacles."""
    return [thing for thing in task.things if not isinstance(thing.kind, world.Obstacle)]


def obstacles_of(task: Task) -> list[world.Obstacle]:
    """The obstacles of a task."""
    return [thing.kind for thing in task.things if isinstance(thing.kind, world.Obstacle)]


def box_count(task: Task) -> int:
    """How many square obstacles the task's world has."""
    return sum(world.obstacle_count(obstacle, task.scene) for obstacle in obstacles_of(task))


def thing_rows(graph: Graph, task: Task) -> list[Any]:
    """Rows of THING, the items, zones and powers in the order of the source."""
    rows = []
    asked = {(type(event), event.of) for event in task.events if isinstance(event, events.Reach | events.Delivery)}
    for thing in things_of(task):
        kind = thing.kind
        assert not isinstance(kind, world.Obstacle)
        code = {world.Item: ITEM, world.Zone: ZONE, world.Power: POWER}[type(kind)]
        size, away = kind.size, kind.away
        drawn = size.by is None and size.first != size.last
        hold = graph.body.size / 2 + max(size.first, size.last) / 2
        reached = world.OUTCOMES.index(kind.reached)
        delivered = world.OUTCOMES.index(kind.delivered) if isinstance(kind, world.Item) else STAYS
        rows.append((
            code, size.first, size.last, size.by or 0.0, *_away(away, task, 10.0), hold, drawn, reached, delivered,
            reached != STAYS or (events.Reach, thing.name) in asked,
            delivered != STAYS or (events.Delivery, thing.name) in asked,
        ))  # fmt: skip
    return rows


def obstacle_rows(task: Task) -> list[Any]:
    """Rows of OBSTACLE."""
    rows = []
    for obstacle in obstacles_of(task):
        away, size = obstacle.away, obstacle.size
        count = 0 if obstacle.grid else obstacle.count
        lines = world.grid_lines(obstacle, task.scene)
        rows.append((size.first, size.last, obstacle.grid, obstacle.jitter, lines, count, *_away(away, task, 0.0)))
    return rows


def _away(away: Span, task: Task, nearest: float) -> tuple[float, float]:
    """How far from the robot something is placed; in an arena that does not say so at least `nearest`."""
    if away.first >= 0:
        return away.first, away.last
    return (nearest, inf) if isinstance(task.scene, world.Arena) else (10.0, 40.0)


def measure_rows(task: Task) -> tuple[list[Any], int]:
    """Rows of MEASURES, and how many changes of thrust are remembered."""
    names = [thing.name for thing in things_of(task)]
    rows: list[Any] = []
    ring = 0
    for measure in task.measures:
        match measure:
            case measures.Progress(toward=thing):
                rows.append((PROGRESS, names.index(thing), 0.0, 0, 0))
            case measures.Advance(toward=thing):
                rows.append((ADVANCE, names.index(thing), 0.0, 0, 0))
            case measures.Retreat(from_=thing):
                rows.append((RETREAT, names.index(thing), 0.0, 0, 0))
            case measures.Forward():
                rows.append((FORWARD, -1, 0.0, 0, 0))
            case measures.Change(beyond=beyond, over=over):
                rows.append((CHANGE, -1, beyond, max(1, over), ring))
                ring += max(1, over)
    return rows, ring


def event_rows(task: Task) -> tuple[list[Any], int]:
    """Rows of EVENT, and how many patches there are to visit."""
    names = [thing.name for thing in things_of(task)]
    rows: list[Any] = []
    board = 0
    for i, event in enumerate(task.events):
        kind, thing, columns, patch = COLLISION, -1, 0, 1.0
        match event:
            case events.Reach(of=of):
                kind, thing = REACH, names.index(of)
            case events.Delivery(of=of):
                kind, thing = DELIVERY, names.index(of)
            case events.Visit(size=size):
                assert isinstance(task.scene, world.Arena)
                kind, patch, columns = VISIT, size, ceil(task.scene.size / size)
            case events.Collision():
                kind = COLLISION
            case events.Exhaustion():
                kind = EXHAUSTION
        rows.append((kind, thing, columns, patch, board, i in task.ends))
        board += columns * columns
    return rows, board


def reward_row(reward: Reward, codes: Programs) -> tuple[int, ...]:
    """A row of REWARD; its programs go to `codes`."""
    first, length = codes.add(reward.amount)
    each, eachs = reward.each or (0, 0)
    left, right, compare = (0, 0), (0, 0), -1
    if reward.when:
        left, right = codes.add(reward.when.left), codes.add(reward.when.right)
        compare = COMPARES[reward.when.compare]
    return first, length, -1 if reward.on is None else reward.on, each, eachs, compare, *left, *right


def world_row(graph: Graph, task: Task, rays: int, used: Sequence[Sensor], master: int) -> Array:
    """The numbers of the body, the battery and the scene."""
    body, dt = graph.body, graph.tick
    radius = body.size / 2
    mass = body.density * pi * radius**2
    moment = mass * radius**2 / 2
    battery = next((s.kind for s in graph.sensors if isinstance(s.kind, sensors.Battery)), sensors.Battery())
    half = task.scene.size / 2 if isinstance(task.scene, world.Arena) else inf
    sizes = [max(t.kind.size.first, t.kind.size.last) for t in task.things if isinstance(t.kind, world.Item)]
    ranges = [s.kind.range for s in used if isinstance(s.kind, sensors.RangeFinder)]
    near = radius + max([1.0, *sizes, *ranges])  # how far the rays reach, or the item in the claw, and no less than 1
    drained = any(isinstance(event, events.Exhaustion) for event in task.events)
    powered = drained or any(isinstance(s.kind, sensors.Battery) for s in used)
    claw = next((a.kind.reach for a in graph.actuators if isinstance(a.kind, actuators.Gripper)), 1.5)
    solid = [
        max(t.kind.size.first, t.kind.size.last) for t in task.things if isinstance(t.kind, world.Item | world.Obstacle)
    ]
    spread = 0.0 if half == inf else 2 * half / CELLS_PER_WALL
    cell = max([MIN_CELL_UNITS, spread, *(size / CELLS_PER_SHAPE for size in (body.size, *sizes, *solid))])
    row = (
        dt, 1.0 / (1.0 + dt * body.linear_damping), 1.0 / (1.0 + dt * body.angular_damping), mass, moment,
        1.0 / mass, 1.0 / moment, radius, half, task.ticks, battery.start, battery.drain, battery.charge,
        rays, near, master, claw, powered, cell,
    )  # fmt: skip
    return np.array([row], WORLD)
