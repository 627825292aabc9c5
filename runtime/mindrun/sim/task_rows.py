"""The task's rows of the tables: its world, what it contains, its measures, events and rewards."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.graph import Graph, Reward, Sensor, Task, Thing
from mindrun.registry import names
from mindrun.sensors import Battery
from mindrun.sim.codes import COMPARES, EVENT_CODES, MEASURE_CODES, THING_CODES, WORLD
from mindrun.sim.programs import Programs
from mindrun.things import OUTCOMES, STAYS

Array = NDArray[Any]
MIN_CELL_UNITS = 20.0  # the side of a cell of Chipmunk's hash, in which what is large takes only so many
CELLS_PER_SHAPE, CELLS_PER_WALL = 4, 64
MIN_NEAR_UNITS = 1.0  # beyond the body's rim


def things_of(task: Task) -> list[Thing]:
    """What the task contains but its obstacles."""
    return [thing for thing in task.things if not thing.kind.is_obstacle]


def box_count(task: Task) -> int:
    """How many square obstacles the task's world has."""
    return sum(thing.kind.obstacles(task.scene) for thing in task.things)


def thing_rows(graph: Graph, task: Task) -> list[Any]:
    """Rows of THING, the items, zones and powers in the order of the source."""
    rows = []
    asked = {(event.outcome, event.thing) for event in task.events if event.outcome}
    for thing in things_of(task):
        kind, size = thing.kind, thing.kind.size
        drawn = size.by is None and size.first != size.last
        hold = graph.body.radius + kind.largest / 2
        becomes = {what: kind.outcomes.get(what, STAYS) for what in ("reached", "delivered")}
        noticed = [how != STAYS or (what, thing.name) in asked for what, how in becomes.items()]
        rows.append((
            THING_CODES[names()[type(kind)]], size.first, size.last, size.by or 0.0, *kind.distances(task.scene),
            hold, drawn, *map(OUTCOMES.index, becomes.values()), *noticed,
        ))  # fmt: skip
    return rows


def obstacle_rows(task: Task) -> list[Any]:
    """Rows of OBSTACLE."""
    rows = []
    for thing in task.things:
        if thing.kind.is_obstacle:
            size, row = thing.kind.size, thing.kind.row(task.scene)
            said = (row.get(column, 0.0) for column in ("grid", "jitter", "lines", "count"))
            rows.append((size.first, size.last, *said, *thing.kind.distances(task.scene)))
    return rows


def measure_rows(task: Task) -> tuple[list[Any], int]:
    """Rows of MEASURES, and how many changes of thrust are remembered."""
    places = _places(task)
    rows: list[Any] = []
    ring = 0
    for measure in task.measures:
        code, beyond = MEASURE_CODES[names()[type(measure)]], measure.row().get("beyond", 0.0)
        over = measure.remembered
        rows.append((code, places[measure.thing], beyond, over, ring if over else 0))
        ring += over
    return rows, ring


def event_rows(task: Task) -> tuple[list[Any], int]:
    """Rows of EVENT, and how many patches there are to visit."""
    places = _places(task)
    rows: list[Any] = []
    board = 0
    for i, event in enumerate(task.events):
        row = event.row(task.scene)
        columns = int(row.get("columns", 0))
        code, patch = EVENT_CODES[names()[type(event)]], row.get("patch", 1.0)
        rows.append((code, places[event.thing], columns, patch, board, i in task.ends))
        board += columns * columns
    return rows, board


def _places(task: Task) -> dict[str, int]:
    """The rows of the things, by name; −1 for what is about none."""
    return {"": -1} | {thing.name: place for place, thing in enumerate(things_of(task))}


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
    body, dt, scene = graph.body, graph.tick, task.scene
    battery = next((s.kind.battery for s in graph.sensors if s.kind.battery), Battery().battery)
    powered = any(event.is_of_battery for event in task.events) or any(s.kind.battery for s in used)
    held = [thing.kind.largest for thing in task.things if thing.kind.can_be_held]
    # How far the rays reach, or the item in the claw.
    near = body.radius + max([MIN_NEAR_UNITS, *held, *(sensor.kind.reach for sensor in used)])
    solid = [thing.kind.largest for thing in task.things if thing.kind.is_solid]
    spread = scene.side / CELLS_PER_WALL if scene.is_bounded else 0.0
    cell = max([MIN_CELL_UNITS, spread, *(size / CELLS_PER_SHAPE for size in (body.size, *held, *solid))])
    row = (
        dt, 1.0 / (1.0 + dt * body.linear_damping), 1.0 / (1.0 + dt * body.angular_damping), body.mass, body.moment,
        1.0 / body.mass, 1.0 / body.moment, body.radius, scene.side / 2, task.ticks,
        battery.start, battery.drain, battery.charge, rays, near, master, graph.claw_reach, powered, cell,
    )  # fmt: skip
    return np.array([row], WORLD)
