"""The task's rows of the tables: its world, what it contains, its measures, events and rewards."""

from collections.abc import Mapping, Sequence
from itertools import count
from typing import Any

import numpy as np

from mindrun.graph.graph import Graph, Sensor, Task, Thing
from mindrun.graph.tasks import goals, own_name, things_of
from mindrun.kinds.registry import names
from mindrun.kinds.sensors.battery import Battery
from mindrun.kinds.things.thing import OUTCOMES, STAYS, ThingKind
from mindrun.kinds.things.walker import ANYWHERE
from mindrun.numbers.arrays import Array
from mindrun.numbers.quantity import Span
from mindrun.sim import codes
from mindrun.sim.codes import DAMPING, HALF_DIAGONAL, INVERSE, OVER, TIMES, Row, records, span
from mindrun.sim.mind_rows import Programs
from mindrun.sim.numbering import NOWHERE, boxes_by_name, hash_numbers, paid_robots, robot_rows, rows_by_name
from mindrun.sim.parameter_rows import SAME_IN_EVERY_RUN, Parameters, Step

MIN_CELL_UNITS = 20.0  # the side of a cell of Chipmunk's hash, in which what is large takes only so many
CELLS_PER_SHAPE, CELLS_PER_WALL = 4, 64
SLOP_UNITS = float(np.float32(0.1))  # how deep Chipmunk lets things stand in each other, if nobody says anything else
SLOP_SHARE = 0.25  # of their least half side is the most
LEAST_SOLID_UNITS = 1e-3  # half a side that is smaller counts as this
MIN_NEAR_UNITS = 1.0  # beyond the body's rim
EVERY_RUN: Row = {"x_row": SAME_IN_EVERY_RUN, "y_row": SAME_IN_EVERY_RUN}  # a place that is the same in all


def content_rows(graph: Graph, task: Task, master: str, parameters: Parameters, programs: Programs) -> dict[str, Array]:
    """The tables of what a task contains; programs of where it is, and of whether it is there, go to `programs`."""
    things, numbers = things_of(task), graph.skill_numbers
    robots: list[Row] = [{"thing": robot_rows(task)[0], "master": numbers[master], "paid": 1}]
    robots += [
        {"thing": row, "master": numbers[things[row].master or master], "paid": things[row].kind.paid}
        for row in robot_rows(task)[1:]
    ]
    return {
        "things": thing_rows(graph, task, parameters, programs),
        "obstacles": obstacle_rows(task, parameters, programs),
        "presences": presence_rows(task, programs),
        **walker_rows(task, graph.tick, parameters, programs),
        "robots": records(robots, codes.TEAM),
    }


def thing_rows(graph: Graph, task: Task, parameters: Parameters, programs: Programs) -> Array:
    """Rows of THING: all things of the task but obstacles, as in `things_of`."""
    rows: list[Row] = []
    asked = {(event.outcome, event.thing) for event in task.events if event.outcome}
    never = goals(graph, task)
    options = 0
    loose, walkers, zones = count(), count(), [thing.kind for thing in task.things if thing.kind.takes_items]
    zones_stay = all(outcome == STAYS for zone in zones for outcome in zone.outcomes.values())
    first, first_robot = {name: found.start for name, found in rows_by_name(task).items()}, robot_rows(task)[0]
    numbers = hash_numbers(task).things
    for number, thing in enumerate(things_of(task)):
        kind, size = thing.kind, _size(graph, thing.kind)
        copy = number - first[thing.name] - (thing.name == own_name(task))  # −1 of the first robot, which is no copy
        low, high = kind.distances(task.scene)
        x, y = kind.places[copy] if kind.places else (0.0, 0.0)
        is_drawn = bool(kind.options) or (kind.walks and not kind.wanders)
        own = _drawn_places(thing, parameters, programs)[:1] if not kind.ways else []
        if kind.is_loose:  # not in the robot
            low = max(low, graph.body.radius + kind.largest * HALF_DIAGONAL)
        row: dict[str, float] = {
            "kind": codes.THING_CODES[names()[type(kind)]], "first": size.first, "last": size.last,
            "by": size.by or 0.0, "drawn": size.by is None and size.first != size.last, "low": low, "high": high,
            "hold": graph.body.front + kind.largest / 2, "x": x, "y": y,
            "is_fixed": (bool(kind.places) or is_drawn) and number != first_robot,
            "is_round": kind.is_round, "is_area": kind.is_area, "is_goal": thing.name in never,
            "loose": next(loose) if kind.is_loose else -1, "settles": kind.is_loose and zones_stay,
            "walker": next(walkers) if kind.walks else -1, "number": numbers[number],
            "copy": copy, "copies": kind.copies, "option": options, "options": 0 if own else len(kind.options),
            **(_steepness(kind, graph.tick) if kind.is_steep else {}),
            **_region(kind, rows_by_name(task)), **(own[0] if own else EVERY_RUN),
        }  # fmt: skip
        options += len(kind.options) if copy + 1 == kind.copies else 0
        for what in ("reached", "delivered"):
            outcome = kind.outcomes.get(what, STAYS)
            row[what] = OUTCOMES.index(outcome)
            row[f"is_{what}"] = outcome != STAYS or (what, thing.name) in asked
        row["is_delivered"] = row["is_delivered"] and bool(zones)  # elsewhere nobody looks for zones
        rows.append(row)
    return records(rows, codes.THING)


def _size(graph: Graph, kind: ThingKind) -> Span:
    """The sizes of a thing; of a robot that of the circle around it."""
    return Span(2 * graph.body.radius, 2 * graph.body.radius) if kind.is_robot else kind.size


def _steepness(kind: Any, dt: float) -> Row:
    """The columns of a slope: how far an item slides down in a tick, and the force that draws a robot down."""
    (x, y), far = kind.down, kind.slides * dt
    return {"slide_x": x * far, "slide_y": y * far, "pull_x": x * kind.pull, "pull_y": y * kind.pull}


def _region(kind: ThingKind, places: Mapping[str, range]) -> Row:
    """The columns of what a thing is placed within: the rows of a zone's copies, or two corners."""
    if isinstance(kind.within, str):
        return {"is_within": bool(kind.within), **span("inside", places[kind.within])}
    (left, below), (right, above) = kind.within
    return {"is_within": True, "left": left, "right": right, "below": below, "above": above}


def _drawn_places(thing: Thing, parameters: Parameters, programs: Programs) -> list[Row]:
    """The columns of each place of a thing that the task draws, which go to `programs`; none where it does not."""
    rows = [parameters.made(*programs.add(program)) for program in thing.by]
    return [{"x_row": x, "y_row": y} for x, y in zip(rows[::2], rows[1::2], strict=True)]


def presence_rows(task: Task, programs: Programs) -> Array:
    """Rows of PRESENCE, one for each copy, or one for all boxes of a thing; their conditions go to `programs`."""
    rows: list[Row] = []
    places, boxes = rows_by_name(task), boxes_by_name(task)
    for thing in task.things:
        its = (boxes if thing.kind.is_obstacle else places)[thing.name]
        step = len(its) if thing.kind.is_obstacle and not thing.many else 1
        for copy, first in enumerate(its[:: max(1, step)]):
            if program := thing.presence(copy):
                about = {"thing": -1, "box": first, "boxes": step} if thing.kind.is_obstacle else {"thing": first}
                rows.append({**about, **programs.columns(program, "when", "whens")})
    return records(rows, codes.PRESENCE)


def option_rows(task: Task) -> Array:
    """The places of which one is drawn: those of each name among `things_of`, then those of obstacles."""
    apart = sorted(task.things, key=lambda thing: thing.kind.is_obstacle)
    return np.array([place for thing in apart for place in thing.kind.options], np.float64).reshape(-1, 2)


def obstacle_rows(task: Task, parameters: Parameters, programs: Programs) -> Array:
    rows: list[Row] = []
    option = sum(len(thing.kind.options) for thing in task.things if not thing.kind.is_obstacle)
    for thing in (thing for thing in task.things if thing.kind.is_obstacle):
        kind, own = thing.kind, _drawn_places(thing, parameters, programs)
        low, high = kind.distances(task.scene)
        row = {"first": kind.size.first, "last": kind.size.last, "low": low, "high": high, "option": option}
        option += len(kind.options)
        drawn = {**own[0], "options": 0} if own else EVERY_RUN
        rows.extend({**row, **each, **drawn} for each in kind.rows(task.scene))
    return records(rows, codes.OBSTACLE)


def loose_rows(task: Task, dt: float, parameters: Parameters) -> Array:
    """Rows of LOOSE: what can be pushed, in the order of the things that they are rows of."""
    rows: list[Row] = []
    numbers = hash_numbers(task).things
    places = rows_by_name(task)
    for i, thing in enumerate(things_of(task)):
        kind: Any = thing.kind
        if kind.is_loose:
            rows.append({
                "thing": i, "is_round": kind.is_round, "number": numbers[i],
                "density": parameters.row("thing", thing.name, "density", kind.density),
                "friction": parameters.row("thing", thing.name, "friction", kind.friction),
                "slower": parameters.row("thing", thing.name, "damping", kind.damping, (DAMPING, dt)),
            })  # fmt: skip
            if kind.thing:
                step = parameters.row("thing", thing.name, "speed", kind.speed, (TIMES, dt))
                thrust = parameters.row("thing", thing.name, "thrust", kind.thrust)
                rows[-1] = {**rows[-1], "step": step, "thrust": thrust, **_aim(kind, places)}
    return records(rows, codes.LOOSE)


def _aim(kind: Any, places: Mapping[str, range]) -> Row:
    """The columns of what goes to something by itself: the `aim` is 1 of what seeks, −1 of what flees.

    That is the nearest of `afters` things from the thing `after` on, or the robot with none of them.
    """
    aim = bool(kind.seeks) - bool(kind.flees)
    return {"aim": aim, "range": kind.range, **span("after", places.get(kind.thing, NOWHERE))}


def walker_rows(task: Task, dt: float, parameters: Parameters, programs: Programs) -> dict[str, Array]:
    """Rows of WALKING, in the order of the things that they are rows of, and their ways with their corners.

    A direction that drifts by up to √(3·dt)·turning either way in each tick has drifted by `turning` in a second, in
    the root of the mean square. The second of several on one way begins at its second place.
    """
    rows, ways = list[Row](), list[Row]()
    corners = list[Row]()
    places = rows_by_name(task)
    for i, thing in enumerate(things_of(task)):
        kind: Any = thing.kind
        if kind.walks:
            its = kind.ways[:1] if thing.by else kind.ways
            rows.append({
                "thing": i, "way": len(ways), "ways": len(its), "copy": i - places[thing.name].start,
                "is_anywhere": kind.from_ == ANYWHERE, "is_drawn": len(its) > 1 or kind.from_ == ANYWHERE,
                **_aim(kind, places),
                "step": parameters.row("thing", thing.name, "speed", kind.speed, (TIMES, dt)),
                "turn": parameters.row("thing", thing.name, "turning", kind.turning, (TIMES, float(np.sqrt(3 * dt)))),
            })  # fmt: skip
            for along in its if i + 1 == places[thing.name].stop else ():
                first, count = len(corners), len(along)
                ways.append({"first": first, "places": count})
                said = _drawn_places(thing, parameters, programs) or [{**EVERY_RUN, "x": x, "y": y} for x, y in along]
                corners += [{**each, "next": first + (number + 1) % count} for number, each in enumerate(said)]
    return {
        "walkers": records(rows, codes.WALKING),
        "ways": records(ways, codes.WAY),
        "corners": records(corners, codes.CORNER),
    }


def measure_rows(task: Task, parameters: Parameters) -> tuple[Array, int]:
    """Rows of MEASURES, then of tallies and of what the task draws, and how many changes of thrust are remembered."""
    places = rows_by_name(task)
    rows: list[Row] = []
    ring = 0
    for measure in task.measures:
        rows.append({
            "kind": codes.MEASURE_CODES[names()[type(measure)]],
            **span("thing", places[measure.thing]), **span("of", places[measure.other]),
            "over": measure.over, "ring": ring if measure.over else 0, "beyond": measure.beyond,
        })  # fmt: skip
        ring += measure.over
    rows += [{"kind": codes.TALLIED}] * len(task.tallies)
    rows += [{"kind": codes.DRAWN_NUMBER, "row": row} for row in parameters.given]
    return records(rows, codes.MEASURES), ring


def event_rows(task: Task) -> tuple[Array, int, int]:
    """Rows of EVENT, how many patches there are to visit, and how many things that may come to others or leave them."""
    places = rows_by_name(task)
    rows: list[Row] = []
    board = arrivals = windows = 0
    numbers = {event: number for number, event in enumerate(task.events)}
    kinds = {thing.name: thing.kind for thing in task.things}
    for event in task.events:
        own, code = event.row(task.scene), codes.EVENT_CODES[names()[type(event)]]
        about, into = places[event.thing], places[event.other]
        rows.append({
            "kind": code, **span("thing", about), **span("to", into),
            "patch": 1.0, "board": board, **own, "arrival": arrivals, "left": windows,
            "after": numbers[event.within.of] if event.within else -1,
            "window": event.within.ticks + 1 if event.within else 0,
            "is_common": all(each.is_common(kinds) for each in event.single),
        })  # fmt: skip
        board += int(own.get("columns", 0) * own.get("rows", 0))
        arrivals += event.remembered(len(about), len(into))
        windows += event.within is not None
    return records(rows, codes.EVENT), board, arrivals


def first_numbers(task: Task) -> dict[str, int]:
    """The numbers of the measures that its first tally, and the first number that it draws, are to the lanes."""
    return {"tally": len(task.measures), "drawn": len(task.measures) + len(task.tallies)}


def judging_rows(task: Task, programs: Programs) -> dict[str, Array]:
    """The tables of what a task rewards, what ends it and what it tallies; their programs go to `programs`."""
    rewards, ends = reward_rows(task, programs), end_rows(task, programs)
    return {"rewards": rewards, "ends": ends, "tallies": tally_rows(task, programs)}


def end_rows(task: Task, programs: Programs) -> Array:
    """Rows of END; their conditions go to `programs`."""
    rows, boxes = list[Row](), {"": NOWHERE, **boxes_by_name(task)}
    for end in task.ends:
        opened = boxes[end.opens]
        rows.append({
            "event": -1 if end.event is None else end.event, "times": end.times, "succeeds": end.succeeds,
            "is_end": not end.opens, "box": opened.start, "boxes": len(opened),
            **programs.columns(end.when, "when", "whens"),
        })  # fmt: skip
    return records(rows, codes.END)


def tally_rows(task: Task, programs: Programs) -> Array:
    """Rows of TALLY; their conditions go to `programs`."""
    rows: list[Row] = [
        {
            "event": -1 if tally.event is None else tally.event, "row": len(task.measures) + i,
            "longest": tally.longest, **programs.columns(tally.when, "when", "whens"),
            **programs.columns(tally.value, "code", "length"),
        }
        for i, tally in enumerate(task.tallies)
    ]  # fmt: skip
    return records(rows, codes.TALLY)


def reward_rows(task: Task, programs: Programs) -> Array:
    """Rows of REWARD; what they pay, and where, goes to `programs`."""
    rows: list[Row] = []
    for reward in task.rewards:
        each, eachs = reward.each or (0, 0)
        rows.append({
            "on": -1 if reward.on is None else reward.on, "each": each, "eachs": eachs, "last": reward.last,
            **programs.columns(reward.amount, "code", "length"), **programs.columns(reward.when, "when", "whens"),
        })  # fmt: skip
    return records(rows, codes.REWARD)


def world_row(graph: Graph, task: Task, parameters: Parameters, rays: int, used: Sequence[Sensor]) -> Array:
    """The numbers of the body, the battery and the scene."""
    body, scene, begin = graph.body, task.scene, task.start
    numbers = hash_numbers(task)
    start_x, start_y = begin.at or (0.0, 0.0)
    half_x, half_y = (side / 2 for side in scene.sides)
    battery = next((s.kind.battery for s in graph.sensors if s.kind.battery), Battery())
    powered = any(event.is_of_battery for event in task.events) or any(s.kind.battery for s in used)
    held = [thing.kind.largest for thing in task.things if thing.kind.can_be_held]
    # How far the rays reach, or the item in the claw.
    near = body.radius + max([MIN_NEAR_UNITS, *held, *(sensor.kind.reach for sensor in used)])
    row = {
        "dt": graph.tick, **_body_rows(graph, parameters), "radius": body.radius, "front": body.front,
        "side": body.side, **_solidity(graph, task), "is_round": not body.outline, "axles": body.axle_distance,
        "half_x": half_x, "half_y": half_y, "is_placed": begin.at is not None, "start_x": start_x, "start_y": start_y,
        "is_faced": begin.facing is not None, "facing": begin.facing or 0.0, "ticks": task.ticks,
        "start": battery.start if powered else np.nan, "drain": battery.drain, "charge": battery.charge, "rays": rays,
        "slopes": sum(thing.kind.is_steep for thing in task.things),
        "near": near, "claw": graph.claw_reach, "battery": powered,
        "number": numbers.robot, "items": numbers.items, "hash_size": numbers.size,
        "paid": paid_robots(task),
    }  # fmt: skip
    return records([row], codes.WORLD)


def _solidity(graph: Graph, task: Task) -> Row:
    """The columns `arm`, the largest distance from its middle at which the robot's turns swing anything; `least`, the
    least half side of it or of what it can hold; `slop`, the depth to which Chipmunk lets things stand in each other,
    less where something that moves is small; `cell`, the side of a cell of its hash.
    """
    body, kinds = graph.body, [thing.kind for thing in task.things]
    held, loose = [kind for kind in kinds if kind.can_be_held], [kind for kind in kinds if kind.is_loose]
    arm = max([body.radius if body.outline else 0.0, *(body.front + kind.largest / 2 for kind in held)])
    least = min([body.front, body.side, *map(_half, held)])
    least_of_all = max(min([least, *map(_half, loose)]), LEAST_SOLID_UNITS)
    walls = [2 * max(wall.half_x, wall.half_y) for kind in kinds for wall in kind.walls]
    spread = max([*walls, *(task.scene.sides if task.scene.is_bounded else ()), 0.0]) / CELLS_PER_WALL
    sizes = [2 * body.radius, *(kind.largest for kind in kinds if kind.can_be_held or kind.is_solid)]
    cell = max([MIN_CELL_UNITS, spread, *(size / CELLS_PER_SHAPE for size in sizes)])
    return {"arm": arm, "least": least, "slop": min(SLOP_UNITS, SLOP_SHARE * least_of_all), "cell": cell}


def _half(kind: ThingKind) -> float:
    return min(kind.size.first, kind.size.last) / 2


def _body_rows(graph: Graph, parameters: Parameters) -> Row:
    """The rows of how a body is damped, of its friction, its mass and its moment of inertia, and one over both."""
    body, slows = graph.body, (DAMPING, graph.tick)
    mass: tuple[Step, ...] = tuple((TIMES, length) for length in body.area)
    moment: tuple[Step, ...] = (*mass, (TIMES, body.gyration[0]), (OVER, body.gyration[1]))
    of_density: dict[str, tuple[Step, ...]] = {
        "mass": mass,
        "moment": moment,
        "mass_inv": (*mass, (INVERSE, 1.0)),
        "moment_inv": (*moment, (INVERSE, 1.0)),
    }
    return {
        "linear": parameters.row("body", "", "linear_damping", body.linear_damping, slows),
        "angular": parameters.row("body", "", "angular_damping", body.angular_damping, slows),
        "friction": parameters.row("body", "", "friction", body.friction),
        **{key: parameters.row("body", "", "density", body.density, *steps) for key, steps in of_density.items()},
    }
