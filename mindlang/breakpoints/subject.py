"""What breakpoints are about: a run of the simulator, or what a robot has recorded."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from mindrun.graph.graph import Graph, Task
from mindrun.graph.measured import measured_in_world, measured_on_robot
from mindrun.kinds.registry import names as kind_names

from mindlang.compiler import lower, model
from mindlang.compiler.names import Names
from mindlang.compiler.resolve.kinds import Scope
from mindlang.compiler.resolve.tasks import World
from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import Declaration, Header, Name

if TYPE_CHECKING:
    from mindlang.run.setup import RunSetup

NOWHERE = Span(Source("", ""), 0, 0)  # where what is in a graph was declared


@dataclass(frozen=True)
class Subject:
    """The names of a mind and its graph, who is in charge, and the task, None where nobody noticed its events.

    `sensors` are those that a robot has wired, which can be faulty; None where there was no robot. What `is_recorded`
    has no other events than those that were noticed, and no names of numbers: it is known by its bundle.
    """

    names: Names
    graph: Graph
    master: str
    task: Task | None
    sensors: tuple[str, ...] | None = None
    is_recorded: bool = False

    @classmethod
    def of_run(cls, names: Names, setup: RunSetup) -> Subject:
        """A run that is set up: its skills and readings stand where its lock has them, not where they are declared."""
        return cls(names, setup.ready.policy.graph, setup.master, setup.task)

    @classmethod
    def of_recording(cls, graph: Graph, master: str, sensors: tuple[str, ...], task: Task | None = None) -> Subject:
        """What a robot with these wired sensors recorded with the graph of a bundle, in the world of a task if any."""
        return cls(names_in(graph), graph, master, task, sensors, is_recorded=True)

    @cached_property
    def places(self) -> lower.Places:
        """Where the readings and the commands stand in a row."""
        readings = {each.name: (each.start, each.width) for each in self.graph.sensors}
        readings |= {each.name: (each.start, 1) for each in self.graph.memories}
        return lower.Places(readings, {each.name: place for place, each in enumerate(self.graph.actuators)})

    @cached_property
    def unmeasured(self) -> set[str]:
        """The sensors that neither a run of the task measures nor a robot with those that are wired."""
        in_world = measured_in_world(self.graph, self.master, self.task) if self.task else []
        known = [*in_world, *measured_on_robot(self.graph, self.sensors or ())]
        return {sensor.name for sensor in self.graph.sensors} - {sensor.name for sensor in known}

    @cached_property
    def world(self) -> World | None:
        """What the task says of its world."""
        if self.task is None:
            return None
        things: dict[str, set[str]] = {}
        for thing in self.task.things:
            things.setdefault(thing.name, set()).add(kind_names()[type(thing.kind)])
        parts = tuple(model.Part(thing.name, thing.kind, NOWHERE) for thing in self.task.things)
        battery = any(sensor.kind.battery for sensor in self.graph.sensors)
        scope = Scope(self.names, things, f"task {self.task.name}")
        return World(self.task.scene, parts, scope, battery, self.task.can_succeed)


def names_in(graph: Graph) -> Names:
    """The names of a compiled mind, of which only the graph is there; those of its numbers are not known."""
    nouns = {
        "sensor": [each.name for each in graph.sensors],
        "memory": [each.name for each in graph.memories],
        "actuator": [each.name for each in graph.actuators],
        "skill": [each.name for each in graph.skills],
        "task": [each.name for each in graph.tasks],
    }
    return Names({noun: {name: _declared(noun, name) for name in names} for noun, names in nouns.items()})


def _declared(noun: str, name: str) -> Declaration:
    return Declaration(Header(Name(noun, NOWHERE), Name(name, NOWHERE), None, NOWHERE), ())
