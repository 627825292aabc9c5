"""The subject of breakpoints: a run of the simulator, or a robot's recording."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mindrun.graph.draws import Draw
from mindrun.graph.graph import Graph, Task
from mindrun.graph.measured import measured_in_world, measured_on_robot
from mindrun.graph.named_readings import named_places, physical
from mindrun.kinds.registry import names as kind_names

from mindlang.compiler import lower, model
from mindlang.compiler.compile import Compiled, load
from mindlang.compiler.names import Names
from mindlang.compiler.resolve.kinds import Scope
from mindlang.compiler.resolve.worlds import ResolvedWorld
from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import Declaration, Header, Name
from mindlang.run.chosen_task import master_of, task_of

if TYPE_CHECKING:
    from mindrun.graph.bundle import Bundle

    from mindlang.run.setup import RunSetup

NOWHERE = Span(Source("", ""), 0, 0)  # where what is in a graph was declared


@dataclass(frozen=True)
class BreakpointSubject:
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
    def of_run(cls, names: Names, setup: "RunSetup") -> "BreakpointSubject":
        """A run that is set up: its skills and readings stand where its lock has them, not where they are declared."""
        return cls(names, setup.ready.policy.graph, setup.master, setup.task)

    @classmethod
    def of_recording(
        cls, graph: Graph, master: str, sensors: tuple[str, ...], task: Task | None = None
    ) -> "BreakpointSubject":
        """The recording of a robot with these wired sensors and the graph of a bundle, in a world if any."""
        return cls(names_in(graph), graph, master, task, sensors, is_recorded=True)

    @cached_property
    def draws(self) -> Mapping[str, Draw]:
        return {draw.name: draw for draw in self.task.draws} if self.task else {}

    @cached_property
    def places(self) -> lower.Places:
        """The places of the readings and the commands in a row, and of the numbers that are drawn for the run."""
        readings = {name: (rows.start, len(rows)) for name, rows in named_places(self.graph).items()}
        actuators = {each.name: place for place, each in enumerate(self.graph.actuators)}
        return lower.Places(readings, actuators, draws={draw: place for place, draw in enumerate(self.draws.values())})

    @cached_property
    def unmeasured(self) -> set[str]:
        """The sensors that neither a run of the task measures nor a robot with those that are wired."""
        in_world = measured_in_world(self.graph, self.master, self.task) if self.task else []
        known = [*in_world, *measured_on_robot(self.graph, self.sensors or ())]
        return {sensor.name for sensor in self.graph.sensors} - {sensor.name for sensor in known}

    @cached_property
    def world(self) -> ResolvedWorld | None:
        if self.task is None:
            return None
        things: dict[str, set[str]] = {}
        for thing in self.task.things:
            things.setdefault(thing.name, set()).add(kind_names()[type(thing.kind)])
        parts = tuple(model.Thing(thing.name, thing.kind, NOWHERE) for thing in self.task.things)
        battery = any(sensor.kind.battery for sensor in self.graph.sensors)
        scope = Scope(self.names, things, f"task {self.task.name}")
        return ResolvedWorld(self.task.scene, parts, scope, battery, self.task.can_succeed)


def names_in(graph: Graph) -> Names:
    """The names of a compiled mind, of which only the graph is there; those of its numbers are not known."""
    nouns: dict[str, Sequence[Any]] = {
        "sensor": graph.sensors,
        "memory": graph.memories,
        "actuator": graph.actuators,
        "skill": graph.skills,
        "task": graph.tasks,
    }

    def declared(noun: str, name: str) -> Declaration:
        return Declaration(Header(Name(noun, NOWHERE), Name(name, NOWHERE), None, NOWHERE), ())

    return Names({noun: {each.name: declared(noun, each.name) for each in found} for noun, found in nouns.items()})


def mind_of(path: str, given: Mapping[str, Compiled]) -> Compiled | None:
    """The mind that a .break file is about: the only one of those that are given, else that of its name beside it.

    None where there is none, or where it does not compile.
    """
    minds = [compiled for compiled in given.values() if compiled.graph]
    beside = Path(path).with_suffix(".mind")
    found = minds[0] if len(minds) == 1 else load(beside) if beside.exists() else None
    return found if found and found.graph else None


def subject_of_mind(compiled: Compiled, task: str | None = None, master: str | None = None) -> BreakpointSubject:
    """The subject of a mind's run, with the task and the master of these names or those of a run by default.

    Events of the task and of a robot count both: a file may be for both. SetupError where there is none of that name.
    """
    assert compiled.mind
    assert compiled.graph
    graph, sensors = compiled.graph, tuple(physical(compiled.graph))
    chosen = task_of(graph, task)[0] if graph.tasks or task else None
    return BreakpointSubject(compiled.mind.names, graph, master_of(graph, chosen, master), chosen, sensors)


def subject_of_bundle(bundle: "Bundle", task: str | None = None, master: str | None = None) -> BreakpointSubject:
    """The subject of a robot's recording with this bundle, or of a task's dry run; SetupError for an unknown name."""
    graph = bundle.graph
    wired = [wire.sensor for wire in bundle.wiring.sensors] if bundle.wiring and not task else physical(graph)
    chosen = task_of(graph, task)[0] if task else None
    return BreakpointSubject.of_recording(graph, master_of(graph, None, master), tuple(wired), chosen)
