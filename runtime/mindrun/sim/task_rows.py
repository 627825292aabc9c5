"""The task's rows of the tables: its world, what it contains, its measures, events and rewards."""

from collections.abc import Sequence
from itertools import count
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.graph import End, Graph, Reward, Sensor, Task, Thing
from mindrun.graph.tasks import goals
from mindrun.kinds.registry import names
from mindrun.kinds.sensors.battery import Battery
from mindrun.kinds.things.thing import OUTCOMES, STAYS, ThingKind
from mindrun.numbers.arithmetic import BOX_COLUMNS, NAN
from mindrun.sim.codes import (
    DAMPING,
    EVENT,
    EVENT_CODES,
    INVERSE,
    MEASURE_CODES,
    MEASURES,
    OBSTACLE,
    OVER,
    THING,
    THING_CODES,
    TIMES,
    WORLD,
)  # fmt: skip
from mindrun.sim.parameter_rows import Parameters, Step
from mindrun.sim.programs import Programs
from mindrun.sim.records import Row, records

Array = NDArray[Any]
MIN_CELL_UNITS = 20.0  # the side of a cell of Chipmunk's hash, in which what is large takes only so many
CELLS_PER_SHAPE, CELLS_PER_WALL = 4, 64
SLOP_UNITS = float(np.float32(0.1))  # how deep Chipmunk lets things stand in each other, if nobody says anything else
SLOP_SHARE = 0.25  # of their least half side is the most
LEAST_SOLID_UNITS = 1e-3  # half a side that is smaller counts as this
MIN_NEAR_UNITS = 1.0  # beyond the body's rim
HALF_DIAGONAL = 0.7072  # of a square with side 1, and a little more
NOWHERE = range(-1, -1)  # rows of a thing that the task does not contain


def things_of(task: Task) -> list[Thing]:
    """What the task contains but its obstacles, in rows of the lanes: each as many times as there are copies of it."""
    return [thing for thing in task.things if not thing.kind.is_obstacle for _ in range(thing.kind.copies)]


def rows_by_name(task: Task) -> dict[str, range]:
    """The rows of `things_of` that a name has. A name that is not there has none, as has the empty one: NOWHERE."""
    found = {"": NOWHERE}
    for row, thing in enumerate(things_of(task)):
        found[thing.name] = range(found[thing.name].start if thing.name in found else row, row + 1)
    return found


def box_count(task: Task) -> int:
    """How many square obstacles the task's world has."""
    return sum(thing.kind.obstacles(task.scene) for thing in task.things)


def boxes_by_name(task: Task) -> dict[str, range]:
    """The boxes that each name has in every lane, as they are drawn: walls, what has a place or a grid, all others."""
    obstacles = [thing for thing in task.things if thing.kind.is_obstacle]

    def turn(thing: Thing) -> int:
        return 0 if thing.kind.walls else 1 + any(row["count"] for row in thing.kind.rows(task.scene))

    found, last = {}, 0
    for thing in sorted(obstacles, key=turn):
        found[thing.name] = range(last, last + thing.kind.obstacles(task.scene))
        last = found[thing.name].stop
    return found


def thing_rows(graph: Graph, task: Task) -> Array:
    """Rows of THING, the items, zones and powers in the order of the source."""
    rows: list[Row] = []
    asked = {(event.outcome, event.thing) for event in task.events if event.outcome}
    never = goals(graph, task)
    loose, walkers, zones = count(), count(), [thing.kind for thing in task.things if thing.kind.takes_items]
    zones_stay = all(outcome == STAYS for zone in zones for outcome in zone.outcomes.values())
    first = {name: found.start for name, found in rows_by_name(task).items()}
    for number, thing in enumerate(things_of(task)):
        kind, size, copy = thing.kind, thing.kind.size, number - first[thing.name]
        low, high = kind.distances(task.scene)
        x, y = kind.places[copy] if kind.places else (0.0, 0.0)
        if kind.is_loose:  # not in the robot
            low = max(low, graph.body.radius + kind.largest * HALF_DIAGONAL)
        row: dict[str, float] = {
            "kind": THING_CODES[names()[type(kind)]], "first": size.first, "last": size.last, "by": size.by or 0.0,
            "low": low, "high": high, "hold": graph.body.front + kind.largest / 2,
            "drawn": size.by is None and size.first != size.last, "is_fixed": bool(kind.places), "x": x, "y": y,
            "is_round": kind.is_round,
            "is_area": kind.is_area, "loose": next(loose) if kind.is_loose else -1,
            "settles": kind.is_loose and zones_stay, "walker": next(walkers) if kind.walks else -1,
            "is_goal": thing.name in never,
        }  # fmt: skip
        for what in ("reached", "delivered"):
            outcome = kind.outcomes.get(what, STAYS)
            row[what] = OUTCOMES.index(outcome)
            row[f"is_{what}"] = outcome != STAYS or (what, thing.name) in asked
        row["is_delivered"] = row["is_delivered"] and bool(zones)  # elsewhere nobody looks for zones
        rows.append(row)
    return records(rows, THING)


def obstacle_rows(task: Task) -> Array:
    """Rows of OBSTACLE."""
    rows: list[Row] = []
    for kind in (thing.kind for thing in task.things if thing.kind.is_obstacle):
        low, high = kind.distances(task.scene)
        row = {"first": kind.size.first, "last": kind.size.last, "low": low, "high": high}
        rows.extend({**row, **own} for own in kind.rows(task.scene))
    return records(rows, OBSTACLE)


def wall_rows(task: Task) -> Array:
    """The middle and half of the sides of what is solid in the same places in every run, [walls, BOX_COLUMNS]."""
    walls = [wall for thing in task.things for wall in thing.kind.walls]
    return np.array(walls, np.float64).reshape(-1, BOX_COLUMNS)


def measure_rows(task: Task) -> tuple[Array, int]:
    """Rows of MEASURES, and how many changes of thrust are remembered."""
    places = rows_by_name(task)
    rows: list[Row] = []
    ring = 0
    for measure in task.measures:
        code, over = MEASURE_CODES[names()[type(measure)]], measure.remembered
        about = places[measure.thing]
        row = {"kind": code, "thing": about.start, "things": len(about), "over": over, "ring": ring if over else 0}
        rows.append({**row, **measure.row()})
        ring += over
    return records(rows, MEASURES), ring


def event_rows(task: Task) -> tuple[Array, int, int]:
    """Rows of EVENT, how many patches there are to visit, and how many items that may come into a certain zone."""
    places = rows_by_name(task)
    rows: list[Row] = []
    board = arrivals = 0
    for event in task.events:
        own, code = event.row(task.scene), EVENT_CODES[names()[type(event)]]
        about, into = places[event.thing], places[getattr(event, "to", "")]
        row = {
            "kind": code,
            "thing": about.start,
            "things": len(about),
            "to": into.start,
            "tos": len(into),
            "patch": 1.0,
            "board": board,
        }
        rows.append({**row, **own, "arrival": arrivals})
        board += int(own.get("columns", 0) * own.get("rows", 0))
        arrivals += len(about) if into else 0
    return records(rows, EVENT), board, arrivals


def end_row(end: End, codes: Programs) -> tuple[int, ...]:
    """A row of END; its condition goes to `codes`."""
    return -1 if end.event is None else end.event, end.times, *codes.add(end.when or ()), end.succeeds


def reward_row(reward: Reward, codes: Programs) -> tuple[int, ...]:
    """A row of REWARD; its programs go to `codes`."""
    first, length = codes.add(reward.amount)
    each, eachs = reward.each or (0, 0)
    return first, length, -1 if reward.on is None else reward.on, each, eachs, *codes.add(reward.when or ())


def world_row(
    graph: Graph, task: Task, parameters: Parameters, rays: int, used: Sequence[Sensor], master: str
) -> Array:
    """The numbers of the body, the battery and the scene."""
    body, dt, scene, begin = graph.body, graph.tick, task.scene, task.start
    index = [skill.name for skill in graph.skills].index(master)
    battery = next((s.kind.battery for s in graph.sensors if s.kind.battery), Battery().battery)
    powered = any(event.is_of_battery for event in task.events) or any(s.kind.battery for s in used)
    held = [thing.kind.largest for thing in task.things if thing.kind.can_be_held]
    # How far the rays reach, or the item in the claw.
    near = body.radius + max([MIN_NEAR_UNITS, *held, *(sensor.kind.reach for sensor in used)])
    solid = [thing.kind.largest for thing in task.things if thing.kind.is_solid]
    walls = [2 * max(wall.half_x, wall.half_y) for thing in task.things for wall in thing.kind.walls]
    spread = max([*walls, *(scene.sides if scene.is_bounded else ()), 0.0]) / CELLS_PER_WALL
    cell = max([MIN_CELL_UNITS, spread, *(size / CELLS_PER_SHAPE for size in (2 * body.radius, *held, *solid))])
    row = (
        dt, *_body_rows(graph, parameters), body.radius, body.front, body.side, *_solidity(graph, task),
        not body.outline, body.axle_distance, *(side / 2 for side in scene.sides),
        begin.at is not None, *(begin.at or (0.0, 0.0)), begin.facing is not None, begin.facing or 0.0, task.ticks,
        battery.start if powered else NAN, battery.drain, battery.charge, rays, near, index, graph.claw_reach, powered,
        cell,
    )  # fmt: skip
    return np.array([row], WORLD)


def _solidity(graph: Graph, task: Task) -> tuple[float, float, float]:
    """How far from the robot's middle its turns swing anything, the least half side of it or of what it can hold, and
    how deep Chipmunk lets things stand in each other: less than by itself where something that moves is small.
    """
    body, loose = graph.body, [thing.kind for thing in task.things if thing.kind.is_loose]
    held = [thing.kind for thing in task.things if thing.kind.can_be_held]
    arm = max([body.radius if body.outline else 0.0, *(body.front + kind.largest / 2 for kind in held)])
    least = min([body.front, body.side, *(_half(kind) for kind in held)])
    least_of_all = max(min([least, *(_half(kind) for kind in loose)]), LEAST_SOLID_UNITS)
    return arm, least, min(SLOP_UNITS, SLOP_SHARE * least_of_all)


def _half(kind: ThingKind) -> float:
    return min(kind.size.first, kind.size.last) / 2


def _body_rows(graph: Graph, parameters: Parameters) -> tuple[int, ...]:
    """The rows of how a body is damped, of its friction, its mass and its moment of inertia, and one over both."""
    body, slows = graph.body, (DAMPING, graph.tick)
    mass: tuple[Step, ...] = tuple((TIMES, length) for length in body.area)
    moment: tuple[Step, ...] = (*mass, (TIMES, body.gyration[0]), (OVER, body.gyration[1]))

    def of_density(*steps: Step) -> int:
        return parameters.row("body", "", "density", body.density, *steps)

    return (
        parameters.row("body", "", "linear_damping", body.linear_damping, slows),
        parameters.row("body", "", "angular_damping", body.angular_damping, slows),
        parameters.row("body", "", "friction", body.friction),
        of_density(*mass),
        of_density(*moment),
        of_density(*mass, (INVERSE, 1.0)),
        of_density(*moment, (INVERSE, 1.0)),
    )
