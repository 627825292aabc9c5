"""Plain data of a run for a page: its hierarchy and its world, which do not change, and the events of its world."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from mindrun.engine.engine import scene_of
from mindrun.graph.graph import Graph, Skill, Task
from mindrun.graph.named_readings import reading_names
from mindrun.kinds.registry import names
from mindrun.kinds.things.thing import ThingKind
from mindrun.sim.task_rows import things_of
from numpy.typing import NDArray

from mindlang.pictures.scene import half_sides, thing_colours
from mindlang.pictures.theme import NIGHT, PAPER, Colour
from mindlang.run import outcome
from mindlang.view.rows import Columns, Doubles
from mindlang.view.texts import shown

Texts = Mapping[tuple[str, str], str]  # what a line says, by the names of its skill and of whom it is for
TOUCH, COLLISION = "touch", "collision"  # kinds of events


@dataclass(frozen=True, slots=True)
class HierarchyData:
    """The hierarchy below a master: `skills` are those that it reaches, in the order of the graph."""

    graph: Graph
    master: str
    skills: Sequence[Skill]
    columns: Columns

    def data(self, texts: Texts) -> dict[str, Any]:
        """`nodes`, `edges` and `reads`."""
        numbers = node_numbers(self.graph, self.skills)
        places = {name: ("skill", place) for name, place in self.graph.skill_numbers.items()}
        inputs = [*self._inputs()]
        return {
            "nodes": [self._node(noun, place) for noun, place in numbers],
            "edges": [
                {
                    "from": numbers[places[skill.name]],
                    "to": numbers[edge.to, edge.target],
                    "text": shown(texts.get((skill.name, self.graph.named(edge.to, edge.target)), "").strip()),
                }
                for skill in self.skills
                for edge in skill.edges
            ],
            "reads": [
                [numbers[source], numbers[places[skill.name]]]
                for skill in self.skills
                for source in dict.fromkeys(inputs[reading] for reading in skill.inputs)
            ],
        }

    def _node(self, noun: str, place: int) -> dict[str, Any]:
        graph = self.graph
        match noun:
            case "sensor":
                sensor = graph.sensors[place]
                read = range(sensor.start, sensor.start + sensor.width)
                return self._node_data(noun, sensor.name, sensor.kind, "readings", read)
            case "memory":
                memory = graph.memories[place]
                return self._node_data(noun, memory.name, memory.kind, "readings", [memory.start])
            case "skill":
                skill = graph.skills[place]
                return self._node_data(noun, skill.name, skill.function, "influence", [place])
        actuator = graph.actuators[place]
        return self._node_data(noun, actuator.name, actuator.kind, "commands", [place])

    def _node_data(self, noun: str, name: str, kind: object, group: str, places: Sequence[int]) -> dict[str, Any]:
        return {
            "name": shown(name),
            "kind": noun,
            "says": names().get(type(kind), ""),
            "columns": [self.columns[group].column(place) for place in places],
            "master": noun == "skill" and name == self.master,
        }

    def _inputs(self) -> Iterator[tuple[str, int]]:
        """For each reading, of which sensor or memory it is."""
        for place, sensor in enumerate(self.graph.sensors):
            for _ in range(sensor.width):
                yield "sensor", place
        for place, _ in enumerate(self.graph.memories):
            yield "memory", place

    def curves(self, rewards: Sequence[str] = (), has_robot: bool = True) -> list[dict[str, Any]]:
        """Every column that can be drawn over time, by name; of rewards where there are any, and of a robot.

        Those of directions are `circular`: no line leads from 1 to 0.
        """
        graph, reached, scene = self.graph, {skill.name for skill in self.skills}, scene_of(self.graph)
        circular = {scene.starts[name] for name in scene.directions}
        named: list[tuple[str, str, list[tuple[int, str]]]] = [
            ("reading", "readings", [*enumerate(reading_names(graph))]),
            ("influence", "influence", [(i, s.name) for i, s in enumerate(graph.skills) if s.name in reached]),
            ("command", "commands", [*enumerate(actuator.name for actuator in graph.actuators)]),
            ("command", "sent", [*enumerate(f"{actuator.name}, sent" for actuator in graph.actuators)]),
            ("reward", "rewards", [*enumerate(rewards)]),
            ("world", "robot", [*enumerate(("x", "y", "angle"))]),
            ("world", "battery", [(0, "battery")]),
        ]
        return [
            {"name": shown(name), "group": group, "column": self.columns[of].column(place)}
            | {"circular": of == "readings" and place in circular}
            for group, of, each in named
            if of in self.columns.groups and (has_robot or group != "world")
            for place, name in each
        ]


def node_numbers(graph: Graph, skills: Sequence[Skill]) -> dict[tuple[str, int], int]:
    """The number of each node by its noun and its place there: sensors, memories, the skills reached, actuators."""
    reached = {skill.name for skill in skills}
    nodes = [
        *(("sensor", place) for place in range(len(graph.sensors))),
        *(("memory", place) for place in range(len(graph.memories))),
        *(("skill", place) for place, skill in enumerate(graph.skills) if skill.name in reached),
        *(("actuator", place) for place in range(len(graph.actuators))),
    ]
    return {node: number for number, node in enumerate(nodes)}


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


@dataclass(slots=True)
class WorldEvents:
    """The events of a task's world, found in the rows of its recording one part after the other."""

    task: Task
    _counts: NDArray[np.uint64] = field(init=False)
    _touched: bool = False

    def __post_init__(self) -> None:
        self._counts = np.zeros(len(self.task.events), np.uint64)

    def data(self) -> list[dict[str, str]]:
        """Their texts and kinds."""
        kinds = self._kinds()
        found = [
            {"text": shown(text), "kind": kind} for text, kind in zip(outcome.events(self.task), kinds, strict=True)
        ]
        return found if self._knows_touch() else [*found, {"text": "touch", "kind": TOUCH}]

    def in_rows(self, rows: NDArray[Any]) -> NDArray[np.bool_]:
        """Which of them happen [ticks, events] in rows that follow those of the call before."""
        world = rows["world"]
        counts = np.concatenate([self._counts[None], world["events"]])
        touching = np.concatenate([[self._touched], world["touching"] != 0])
        self._counts, self._touched = counts[-1], bool(touching[-1])
        happened = [counts[1:] != counts[:-1]]
        if not self._knows_touch():
            happened.append((touching[1:] & ~touching[:-1])[:, None])
        return np.concatenate(happened, axis=1)

    def _knows_touch(self) -> bool:
        """Whether touching goes without saying: an event says it, or there is nothing to touch."""
        return COLLISION in self._kinds() or bool(self.task.scene.environment)

    def _kinds(self) -> list[str]:
        return [names()[type(event)] for event in self.task.events]
