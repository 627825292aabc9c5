"""What does not change of a hierarchy: its nodes, its edges and its curves, as plain data."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mindrun.engine.virtual_sensors import scene_of
from mindrun.graph.graph import Graph, Skill
from mindrun.graph.named_readings import reading_names
from mindrun.kinds.registry import names

from mindlang.view.columns import Columns
from mindlang.view.texts import shown

Texts = Mapping[tuple[str, str], str]  # what a line says, by the names of its skill and of whom it is for


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
