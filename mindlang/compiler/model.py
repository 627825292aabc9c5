"""A mind: names resolved, units converted, every part with the place where it was written."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Generic, NamedTuple, TypeVar

from mindrun.graph import graph
from mindrun.graph.draws import Draw
from mindrun.graph.graph import Failure, Receiver, Sensor, Start, Variation
from mindrun.kinds.actuators.actuator import ActuatorKind
from mindrun.kinds.bodies.body import BodyKind
from mindrun.kinds.events.event import EventKind
from mindrun.kinds.functions.function import Function
from mindrun.kinds.memory import MemoryKind
from mindrun.kinds.registry import names as kind_names
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.sensors.sensor import SensorKind
from mindrun.kinds.things.thing import ThingKind
from mindrun.numbers.expression import Program
from msgspec import Struct
from networkx import DiGraph

from mindlang.compiler import syntax
from mindlang.compiler.families import said
from mindlang.compiler.format import spaced
from mindlang.compiler.names import Names
from mindlang.compiler.source import Span

K = TypeVar("K")


class Part(Struct, Generic[K], frozen=True):
    """Something with a name and a kind: a sensor, an actuator, a memory, a body, a thing of a task.

    `width` is how many readings a sensor has; one that is computed has the value `at`, where its `gate` is open.
    """

    name: str
    kind: K
    span: Span
    width: int = 1
    at: syntax.Expression | None = None
    gate: syntax.Gate | None = None


class Thing(Part[ThingKind], frozen=True):
    """A thing of a task. It is there in the runs in which the condition `when` holds, or in all.

    `by` and `many` say where it is and how many there are, where that is drawn, and of a robot its `master`
    which skill is in charge, as in `graph.Thing`.
    """

    when: syntax.When | None = None
    by: tuple[Program, ...] = ()
    many: int = 0
    master: str = ""

    @property
    def is_always_there(self) -> bool:
        """True if it is there in every run, with all of its copies."""
        return not self.when and not self.many


class Edge(Struct, frozen=True):
    """An edge of a skill: it sends an output of its function, or the value of `at`; an influence below `cuts` is 0.

    One that is `over` some actuators and memories, by name, counts for these alone.
    """

    to: Receiver
    target: str
    at: syntax.Expression | None
    fact: syntax.Drives | syntax.Influences
    gate: syntax.Gate | None = None
    cuts: float = 0.0
    over: tuple[str, ...] = ()

    @property
    def values(self) -> tuple[syntax.Expression, ...]:
        """The expressions that its line sends: after `at`, and after `otherwise`."""
        otherwise = self.gate.otherwise if self.gate else None
        return tuple(value for value in (self.at, otherwise) if value)


class Promise(Struct, frozen=True):
    """A condition that a skill promises, and the line that says it."""

    when: syntax.Promise
    fact: syntax.Promise

    @property
    def text(self) -> str:
        """The line that says the promise, with single spaces."""
        return spaced(said(self.fact))


class Skill(Struct, frozen=True):
    """A skill; `reads` are names of sensors and memories; one that is `frozen` is not taught, one may `chooses` one.

    What it `promises` is of any readings, and changes nothing that is computed. `files` are those that its procedure
    uses.

    One that is `like` another has that one's function and weights; what it reads and sends stands in that one's order,
    and the lines of its edges are that one's.
    """

    name: str
    function: Function
    reads: tuple[str, ...]
    edges: tuple[Edge, ...]
    frozen: bool
    declaration: syntax.Declaration
    like: str = ""
    chooses: bool = False
    promises: tuple[Promise, ...] = ()
    files: tuple[str, ...] = ()

    @property
    def span(self) -> Span:
        """Where its name is declared."""
        return self.declaration.header.name.span

    @property
    def owner(self) -> str:
        """The skill under whose name its weights stand: itself, or the one that it is like."""
        return self.like or self.name

    def place_of(self, edge: Edge) -> Span:
        """The line that says where an edge leads: of a skill that is like another its own, where it has one."""
        own = syntax.of_form(self.declaration.facts, syntax.Sends)
        return next((fact.span for fact in own if fact.stands_for and fact.name.text == edge.target), edge.fact.span)

    @property
    def subskills(self) -> tuple[str, ...]:
        """The skills that it influences."""
        return tuple(edge.target for edge in self.edges if edge.to == "skill")


class Reward(Struct, frozen=True):
    """A reward, per tick where `on` is None; `each` is the sensor that it goes through."""

    amount: syntax.Expression
    on: EventKind | None
    each: str | None
    when: syntax.When | None
    fact: syntax.Rewards


class End(Struct, frozen=True):
    """An end of a run, as a success or not: the `times`th occurrence of an event, or a condition.

    One that `opens` something in the way ends no run: it takes that out of the world.
    """

    event: EventKind | None
    times: int
    when: syntax.When | None
    succeeds: bool
    fact: syntax.Ends | syntax.Succeeds | syntax.Opens
    opens: str = ""


class Task(Struct, frozen=True):
    """A task: its world, its end, its rewards and what its benchmark counts.

    Its `facts` are those of its scene, too, or of the task that it is like; `declaration` has its own.
    """

    name: str
    scene: SceneKind
    things: tuple[Thing, ...]
    start: Start
    varies: tuple[Variation, ...]
    fails: tuple[Failure, ...]
    draws: tuple[Draw, ...]
    ticks: int
    ends: tuple[End, ...]
    rewards: tuple[Reward, ...]
    counts: tuple[EventKind, ...]
    facts: tuple[syntax.Fact, ...]
    declaration: syntax.Declaration

    @property
    def span(self) -> Span:
        """Where its name is declared."""
        return self.declaration.header.name.span

    @property
    def events(self) -> list[EventKind | None]:
        """The events that end its runs, are rewarded or counted; None where a line has none."""
        return [*(end.event for end in self.ends), *(reward.on for reward in self.rewards), *self.counts]


@dataclass(frozen=True, slots=True)
class Lesson(graph.Lesson):
    """A lesson and the line that says it."""

    fact: syntax.Teaches = field(kw_only=True)


@dataclass(frozen=True)
class Mind:
    """A whole mind, in the order of its sources. `tick` is in seconds; `names` are all declarations, as written.

    `influences` is who influences whom, a DAG; `numbers` what the names of numbers stand for, each with its unit.
    `unit_metres` is how long a unit of the world is on a robot, None where that is not said.
    """

    tick: float
    master: str
    body: Part[BodyKind]
    sensors: tuple[Part[SensorKind], ...]
    memories: tuple[Part[MemoryKind], ...]
    actuators: tuple[Part[ActuatorKind], ...]
    skills: tuple[Skill, ...]
    tasks: tuple[Task, ...]
    lessons: tuple[Lesson, ...]
    files: tuple[syntax.File, ...]
    names: Names
    influences: DiGraph = field(repr=False, compare=False)
    numbers: Mapping[str, tuple[float, str, str]] = field(default_factory=dict)
    unit_metres: float | None = None

    @cached_property
    def hierarchy(self) -> DiGraph:
        """All parts and what flows between them, as a graph of networkx."""
        return hierarchy_graph(self)


class Node(NamedTuple):
    """A part of a mind in its hierarchy; a sensor, an actuator and a skill may have one name."""

    noun: str
    name: str

    def __str__(self) -> str:
        return f"{self.noun} {self.name}"


def influence_graph(skills: Iterable[Skill]) -> DiGraph:
    """The skills by name in the order of the text, an edge for each line `influences`, with its `span`."""
    return DiGraph({
        skill.name: {edge.target: {"span": skill.place_of(edge)} for edge in skill.edges if edge.to == "skill"}
        for skill in skills
    })  # fmt: skip


def source_graph(sensors: Iterable[Part[Any] | Sensor]) -> DiGraph:
    """The sensors by name in the order of the text, an edge to each sensor or memory that one is computed from."""
    return DiGraph({sensor.name: {source: {} for source in sensor.kind.sources} for sensor in sensors})


def hierarchy_graph(mind: Mind) -> DiGraph:
    """All parts of a mind, and what flows between them from the sensors to the actuators.

    A node has its `kind`, a skill also `like`, `frozen` and whether it is the `master`, and one that does `chooses`
    "one"; an edge has its `relation` (reads, influences, drives, computes), the `file` and `line` that say it, and the
    names that it is `over`, if any. Skills alone are a DAG; a memory that is read and driven closes a circle, over one
    tick.
    """
    graph, read = DiGraph(), dict[str, Node]()

    def connect(start: Node, end: Node, relation: str, span: Span, over: tuple[str, ...] = ()) -> None:
        more = {"over": list(over)} if over else {}
        graph.add_edge(start, end, relation=relation, file=span.source.name, line=span.line, **more)

    for noun, parts in (("sensor", mind.sensors), ("memory", mind.memories), ("actuator", mind.actuators)):
        for part in parts:
            graph.add_node(Node(noun, part.name), kind=kind_names()[type(part.kind)])
            if noun != "actuator":
                read[part.name] = Node(noun, part.name)
    for skill in mind.skills:
        about = {"kind": kind_names()[type(skill.function)], "like": skill.like, "frozen": skill.frozen}
        about |= {"chooses": "one"} if skill.chooses else {}
        graph.add_node(Node("skill", skill.name), **about, master=skill.name == mind.master)
    for sensor in mind.sensors:
        for source in dict.fromkeys(sensor.kind.sources):
            connect(read[source], read[sensor.name], "computes", sensor.span)
    skills = {skill.name: skill for skill in mind.skills}
    for skill in mind.skills:
        here = Node("skill", skill.name)
        lines = {fact.name.text: fact.span for fact in syntax.of_form(_facts(skill, skills), syntax.Reads)}
        for name in skill.reads:
            connect(read[name], here, "reads", lines[name])
        for edge in skill.edges:
            relation = "influences" if edge.to == "skill" else "drives"
            connect(here, Node(edge.to, edge.target), relation, skill.place_of(edge), edge.over)
    return graph


def _facts(skill: Skill, skills: Mapping[str, Skill]) -> tuple[syntax.Fact, ...]:
    """The facts of a skill, behind those of the one that it is like."""
    like = skill.declaration.header.like
    return (*(_facts(skills[like.text], skills) if like else ()), *skill.declaration.facts)
