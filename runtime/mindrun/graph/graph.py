"""The compiled hierarchy as plain data: names as indices, units converted, skills in the order of influence."""

from dataclasses import dataclass
from typing import Annotated, Literal

from mindrun.graph.draws import Draw
from mindrun.kinds.actuators.actuator import REACH_UNITS, ActuatorKind
from mindrun.kinds.bodies.body import BodyKind
from mindrun.kinds.events.event import EventKind
from mindrun.kinds.functions.function import Function
from mindrun.kinds.learners import Learner, Share
from mindrun.kinds.measures.measure import MeasureKind
from mindrun.kinds.memory import MemoryKind
from mindrun.kinds.registry import left_out, phrase
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.sensors.sensor import SensorKind
from mindrun.kinds.things.thing import ThingKind
from mindrun.numbers.expression import Program as Program
from mindrun.numbers.quantity import ANGLE, COORDINATE, Place, Ratio
from mindrun.numbers.short_repr import ShortRepr

Receiver = Literal["skill", "actuator", "memory"]  # of what a skill sends
Sink = tuple[Receiver, int]  # which one of its kind
Varying = Literal["actuator", "sensor", "body", "thing"]  # what an argument can be of that varies
VARIED_NOUNS: tuple[Varying, ...] = ("actuator", "sensor", "body")  # those of the robot


@dataclass(frozen=True, slots=True)
class Sensor:
    """A sensor and its place in the vector of readings: `width` readings from `start` on."""

    name: str
    kind: SensorKind
    start: int
    width: int

    @property
    def place(self) -> slice:
        """The place of its readings in that vector."""
        return slice(self.start, self.start + self.width)


@dataclass(frozen=True, slots=True)
class Memory:
    """A memory; it reads like a sensor from `start` on. Behind its readings stands what it keeps beside them."""

    name: str
    kind: MemoryKind
    start: int

    @property
    def place(self) -> slice:
        """The place of all that it keeps in the vector of readings; of its readings only the first `kind.width` are."""
        return slice(self.start, self.start + self.kind.kept)


@dataclass(frozen=True, slots=True)
class Actuator:
    """An actuator; its place in the tuple is its place in the vector of commands."""

    name: str
    kind: ActuatorKind


@dataclass(frozen=True, slots=True)
class Gate:
    """The condition of an edge. Where `when` does not hold it sends `otherwise`, or nothing where that is None."""

    when: Program
    otherwise: Program | None = None

    @property
    def programs(self) -> tuple[Program, ...]:
        """Both programs, or the one that there is."""
        return (self.when,) if self.otherwise is None else (self.when, self.otherwise)


@dataclass(frozen=True, slots=True)
class Edge:
    """An edge of the hierarchy: a skill sends a value to the skill, actuator or memory with index `target`.

    The value is the function's output number `output`, or where that is None the `value` program, clamped to 0..1;
    `gate` says when. An influence that is smaller than `cuts` when it arrives is none. One that is `over` some sinks,
    each an actuator or memory with its index, in rising order, counts for these alone.
    """

    to: Receiver
    target: int
    output: int | None
    value: Program = ()
    gate: Gate | None = None
    cuts: float = 0.0
    over: tuple[Sink, ...] = left_out(())

    @property
    def programs(self) -> tuple[Program, ...]:
        """The programs that are computed beside the function."""
        return ((self.value,) if self.output is None else ()) + (self.gate.programs if self.gate else ())


@dataclass(frozen=True, slots=True)
class Promise:
    """A condition of readings that a skill `requires`, `maintains` or `achieves`; `text` is its line as written."""

    word: Literal["requires", "maintains", "achieves"]
    text: str
    when: Program


@dataclass(frozen=True, slots=True)
class Skill:
    """A skill: `inputs` are indices into the readings, `edges` in the order of the source.

    Among a function's outputs number i belongs to the i-th edge without `at`. One that is `frozen` is not taught. One
    that is `like` another has the same function, which sends the same, and shares its weights for ever. One that
    `chooses` sends 1 over the influence that is greatest before the clamp, of equals the first, and 0 over its others.
    What it `promises` changes nothing in what it computes (`mindrun.engine.promises`).
    `files` are the paths of those that its procedure uses, in rising order, below the folder of the mind.
    """

    name: str
    function: Function
    inputs: tuple[int, ...]
    edges: tuple[Edge, ...]
    frozen: bool = False
    like: str = ""
    chooses: bool = left_out(False)
    promises: tuple[Promise, ...] = left_out(())
    files: tuple[str, ...] = left_out(())

    @property
    def owner(self) -> str:
        """The skill under whose name its weights stand: itself, or the one that it is like."""
        return self.like or self.name

    @property
    def outputs(self) -> int:
        """The number of outputs of its internal function."""
        return sum(edge.output is not None for edge in self.edges)


@dataclass(frozen=True, slots=True)
class Thing:
    """Something that a task's world contains, in the runs in which `when` holds, or in all where that is empty.

    `by` are its x and its y, or all of its way, where the task draws them: programs of numbers alone and of those that
    the task draws. Its kind is then at every place that this may be, or on every way. Of its copies there are as many
    as the task draws with number `many` of its `draws`, from 1 on, and its kind has the most that this may be; all
    are there where it is 0. Of a robot the skill `master` is in charge, or that which is of the first where it is "".
    """

    name: str
    kind: ThingKind
    when: Program = left_out(())
    by: tuple[Program, ...] = left_out(())
    many: int = left_out(0)
    master: str = left_out("")

    @property
    def programs(self) -> tuple[Program, ...]:
        """The programs of where it is, and of whether it is there."""
        return (*self.by, self.when)

    def presence(self, copy: int) -> Program:
        """The condition under which one of its copies is there; empty where it always is."""
        counted: Program = (("drawn", self.many - 1), ("number", float(copy)), (">", 0)) if self.many else ()
        return (*self.when, *counted, ("and", 0)) if self.when and counted else self.when or counted


@dataclass(frozen=True, slots=True)
class Reward:
    """One reward line. `on` is an index into the task's events, or None for "per tick"; `when` is a condition.

    With `each`, a sensor's (start, width), the amount is added once for each of those readings, which the programs
    read as ("each", 0). One that is `last` is worth what its amount is in the last tick in which it is paid.
    """

    text: str
    amount: Program
    on: int | None
    each: tuple[int, int] | None = None
    when: Program | None = None
    last: bool = left_out(False)

    @property
    def programs(self) -> tuple[Program, ...]:
        """The programs of a reward: the amount, and the condition if it has one."""
        return (self.amount,) if self.when is None else (self.amount, self.when)


@dataclass(frozen=True, slots=True)
class End:
    """An end of a run: the `times`th time that an event, by its index, happens; or the condition `when`.

    One that `succeeds` ends it as a success. `text` is the condition as it is written. One that `opens` an obstacle,
    wall or map, by its name, does not end it: for the rest of the run that is not there.
    """

    event: int | None
    times: int = 1
    when: Program | None = None
    succeeds: bool = False
    text: str = ""
    opens: str = left_out("")


@dataclass(frozen=True, slots=True)
class Tally:
    """How often an event, by its index, has happened in a run while a condition held, or in how many ticks that held.

    With `longest`, in how many one after the other at the most; with a `value`, the sum of that in these ticks. Its
    programs may be about the tallies before it.
    """

    event: int | None
    when: Program | None = None
    longest: bool = False
    value: Program | None = None

    @property
    def programs(self) -> tuple[Program, ...]:
        """The programs of a tally: its value and its condition, if it has them."""
        return tuple(program for program in (self.value, self.when) if program is not None)


@dataclass(frozen=True, slots=True)
class Start:
    """The place where the robot begins a run, and the direction that it faces; None where one is drawn."""

    at: Annotated[Place | None, COORDINATE] = None
    facing: Annotated[float | None, ANGLE] = None


@dataclass(frozen=True, slots=True)
class Variation:
    """An argument that is drawn anew for each run, between `low` and `high`.

    It is of the body, or of the actuator, sensor or thing called `of`; whole numbers are drawn of what is whole.
    """

    noun: Varying
    of: str
    argument: str
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Failure:
    """An actuator that fails in each tick with the probability `rate`, and is neutral from then on."""

    actuator: str
    rate: Ratio


@dataclass(frozen=True, slots=True)
class Task:
    """A task: its world, its ends, its rewards. `counts` are indices into `events`.

    What of the world and the robot `varies` is drawn for each run, and so is when what `fails` does, and what it
    `draws`: programs have it as ("drawn", index), and what it `tallies` as ("tally", index).
    """

    name: str
    scene: SceneKind
    things: tuple[Thing, ...]
    ticks: int
    measures: tuple[MeasureKind, ...]
    events: tuple[EventKind, ...]
    ends: tuple[End, ...]
    rewards: tuple[Reward, ...]
    counts: tuple[int, ...]
    start: Start = Start()
    varies: tuple[Variation, ...] = ()
    fails: tuple[Failure, ...] = ()
    draws: tuple[Draw, ...] = left_out(())
    tallies: tuple[Tally, ...] = left_out(())

    @property
    def programs(self) -> tuple[Program, ...]:
        """The programs of its rewards, its ends and its tallies."""
        ends = (end.when for end in self.ends if end.when is not None)
        judging: tuple[Reward | Tally, ...] = (*self.rewards, *self.tallies)
        return (*(program for each in judging for program in each.programs), *ends)

    @property
    def can_succeed(self) -> bool:
        """True if any of the task's ends is a success."""
        return any(end.succeeds for end in self.ends)


@dataclass(frozen=True, slots=True)
class Need:
    """A need of a lesson, or its end, on fresh layouts: a mean `score` or a share of `success` `above` a number.

    Or that an `event` of its task happens at least so often in the mean of all runs.
    """

    measure: Literal["score", "success", "event"]
    above: float
    event: EventKind | None = left_out(None)

    def is_met(self, reached: float) -> bool:
        """True if so much is enough."""
        return reached >= self.above if self.event else reached > self.above

    def __str__(self) -> str:
        """The need in the words of the language."""
        if self.event:
            return f"{self.above:g} {phrase(self.event)}"
        return f"{self.measure} > " + (f"{100 * self.above:g}%" if self.measure == "success" else f"{self.above:g}")


@dataclass(frozen=True, slots=True)
class HardLayouts:
    """Layouts on which genomes of a lesson are scored instead of a `share` of any, as the `seeds` of their runs.

    The seeds are digits: a whole number up to 2^64 is more than what every reader of JSON takes.
    """

    share: Share
    seeds: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Lesson:
    """A lesson: which `skill` learns, on which task, driven by which master, for how long, and how (`learner`).

    With `with_subskills`, all that learn below the skill and are not frozen learn with it, as one genome. `number` is
    its place in its curriculum, from 1; 0 in what was made before lessons had one. One that `starts_from` another skill
    begins with a copy of its weights. One with `needs` has failed where its last attempt does not meet them all: it
    ends with the first attempt that does, and what has failed is not taught. One with `until` ends an attempt once its
    champion does so well, before it has had its generations. With `hard` a share of its layouts are some of these.
    """

    curriculum: str
    skill: str
    task: str
    master: str
    generations: int
    from_scratch: bool
    with_subskills: bool
    learner: Learner
    number: int = 0
    starts_from: str = ""
    needs: tuple[Need, ...] = ()
    until: Need | None = left_out(None)
    hard: HardLayouts | None = left_out(None)

    @property
    def all_needs(self) -> tuple[Need, ...]:
        """What it needs, and what it goes on until."""
        return (*self.needs, *([self.until] if self.until else []))

    @property
    def name(self) -> str:
        """The skill; and the task where it has another name, and that its subskills learn where they do."""
        where = "" if self.skill == self.task else f"-on-{self.task}"
        return f"{self.skill}{where}{'-with-subskills' * self.with_subskills}"


@dataclass(frozen=True, slots=True, repr=False)
class Graph(ShortRepr):
    """A whole mind, compiled. `tick` is in seconds; `skills` stand in topological order, parents first."""

    tick: float
    body: BodyKind
    master: str
    sensors: tuple[Sensor, ...]
    memories: tuple[Memory, ...]
    actuators: tuple[Actuator, ...]
    skills: tuple[Skill, ...]
    tasks: tuple[Task, ...]
    lessons: tuple[Lesson, ...]

    @property
    def width(self) -> int:
        """How many readings there are: those of the sensors, then all that memories keep."""
        return sum(sensor.width for sensor in self.sensors) + sum(memory.kind.kept for memory in self.memories)

    @property
    def readings(self) -> list[tuple[str, int]]:
        """The sensor or memory of each reading, and which of its own it is."""
        wide = [(sensor.name, number) for sensor in self.sensors for number in range(sensor.width)]
        return wide + [(memory.name, number) for memory in self.memories for number in range(memory.kind.kept)]

    @property
    def skill_numbers(self) -> dict[str, int]:
        """The place of each skill in `skills`, by its name."""
        return {skill.name: number for number, skill in enumerate(self.skills)}

    @property
    def claw_reach(self) -> float:
        """How far ahead of the body things come into reach, with a claw or without."""
        return next((each.kind.reach for each in self.actuators if each.kind.reach is not None), REACH_UNITS)

    def named(self, noun: Receiver, index: int) -> str:
        """The name of the "skill", "actuator" or "memory" that an edge goes to by its index."""
        parts: tuple[Skill | Actuator | Memory, ...] = self.skills if noun == "skill" else self.memories
        return (self.actuators if noun == "actuator" else parts)[index].name
