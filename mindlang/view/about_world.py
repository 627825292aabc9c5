"""What does not change of a simulated world and of the robot in it, as plain data."""

from __future__ import annotations

from typing import Any

from mindrun.graph.graph import Graph, Task
from mindrun.kinds.registry import names
from mindrun.kinds.things.thing import ThingKind
from mindrun.sim.task_rows import things_of

from mindlang.pictures.scene import half_sides, thing_colours
from mindlang.pictures.theme import NIGHT, PAPER, Colour
from mindlang.run import outcome
from mindlang.view.columns import Columns
from mindlang.view.row_blocks import Doubles
from mindlang.view.texts import shown


def run_data(graph: Graph, task: Task, seed: int, boxes: Doubles, columns: Columns) -> dict[str, Any]:
    """The task of a run, its seed, its rewards and ends, and its world, None where it is an environment."""
    return {
        "task": shown(task.name),
        "seed": str(seed),
        "rewards": [shown(reward.text) for reward in task.rewards],
        "ends": [shown(text) for text in outcome.ends(task)],
        "world": None if task.scene.environment else world_data(graph, task, boxes, columns),
    }


def world_data(graph: Graph, task: Task, boxes: Doubles, columns: Columns) -> dict[str, Any]:
    """The arena, what stands in it, its things with their colours, and the robot; lengths in units, angles in rad."""
    contents = things_of(task)
    colours = zip(thing_colours(contents, PAPER), thing_colours(contents, NIGHT), strict=True)
    return {
        "arena": [*half_sides(task.scene)] if task.scene.is_bounded else None,
        "boxes": boxes.tolist(),
        "things": [
            {
                "name": shown(thing.name),
                "kind": names()[type(thing.kind)],
                "shape": _shape(thing.kind),
                "light": _code(light),
                "dark": _code(dark),
            }
            for thing, (light, dark) in zip(contents, colours, strict=True)
        ],
        "robot": _body(graph) | _sensing(graph, columns) | _acting(graph, columns),
    }


def _shape(kind: ThingKind) -> str:
    return "area" if kind.is_area else "disc" if kind.is_round else "square"


def _code(colour: Colour) -> str:
    blue, green, red = colour
    return f"#{red:02x}{green:02x}{blue:02x}"


def _body(graph: Graph) -> dict[str, Any]:
    body = graph.body
    return {
        "radius": body.radius,
        "outline": [[*corner] for corner in body.outline],
        "front": body.front,
        "side": body.side,
        "axles": body.axle_distance,
    }


def _sensing(graph: Graph, columns: Columns) -> dict[str, Any]:
    """Rays, points of the floor, switches on the rim, and directions of things, each with the column it reads."""
    group = columns["readings"]
    rays, spots, switches, bearings = [], [], [], []
    for sensor in graph.sensors:
        kind, name, body = sensor.kind, shown(sensor.name), graph.body
        for number, angle in enumerate(kind.rays):
            column, only = group.column(sensor.start + number), bool(kind.thing)
            rays.append(
                {"angle": angle, "rim": body.rim(angle), "reach": kind.reach, "column": column, "name": name}
                | {"sees": only}
            )
        for number, (x, y) in enumerate(kind.spots):
            spots.append({"x": x, "y": y, "column": group.column(sensor.start + number)})
        for number, angle in enumerate(kind.directions if kind.sector else ()):
            switches.append({"angle": angle, "width": kind.sector, "column": group.column(sensor.start + number)})
        if kind.circular and kind.thing:
            bearings.append({"name": name, "column": group.column(sensor.start)})
    return {"rays": rays, "spots": spots, "switches": switches, "bearings": bearings}


def _acting(graph: Graph, columns: Columns) -> dict[str, Any]:
    """The claw, the wheels that turn, lamps and thrusters, each with the column of its command."""
    lamps, jets, claw, steering = [], [], None, None
    for number, actuator in enumerate(graph.actuators):
        kind, column = actuator.kind, columns["commands"].column(number)
        if kind.is_light:
            lamps.append(column)
        if (push := kind.push(graph.body)) is not None:
            jets.append({"at": [*push[0]], "way": [*push[1]], "column": column})
        if kind.can_hold:
            claw = column
        if kind.drive == "steering":
            steering = {"column": column, "turn": kind.row(graph.body)["turn"]}
    return {"claw": claw, "steering": steering, "lamps": lamps, "jets": jets}
