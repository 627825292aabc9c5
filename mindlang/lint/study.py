"""`Study`: a mind as the lint rules see it; `Finding`: what a rule returns."""

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from mindrun.graph.graph import Graph
from mindrun.graph.tasks import goals
from mindrun.kinds.sensors.sensor import Physical, SensorKind
from mindrun.kinds.things.thing import STAYS
from mindrun.numbers.intervals import UNIT_INTERVAL, Interval

from mindlang.compiler.beginning import Beginning, task_beginning
from mindlang.compiler.compile import Compiled
from mindlang.compiler.diagnostic import Fix, Label
from mindlang.compiler.hierarchy import reverse_topological_order, topological_order, with_descendants
from mindlang.compiler.model import Edge, End, Mind, Part, Promise, Reward, Skill, Task, source_graph
from mindlang.compiler.names import Mention, mentions
from mindlang.compiler.source import Source, Span, Splice
from mindlang.compiler.syntax import Declaration, Fact, Phrase, Setting, When, expressions_in
from mindlang.editing.insertion import without_declarations, without_line
from mindlang.lint.intervals import Range, interval, why_never
from mindlang.lock import Lock, lock_sources, read_locks

_WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")


@dataclass(frozen=True, slots=True)
class AnalysedWorld:
    """The things in a world that sensors can be about, what stands in the way, and whether the battery charges."""

    study: "Study"
    things: frozenset[str]
    is_solid: bool
    has_fixed: bool  # what is solid and does not give way
    charges: bool
    loose: frozenset[str] = frozenset()  # things that can be pushed
    fleeting: frozenset[str] = frozenset()  # items that are gone as soon as they are reached

    def constant(self, name: str) -> float | None:
        """The reading of a sensor that reads the same in every tick of this world; None where it may vary."""
        kind = self.study.sensors.get(name)
        if kind is None or (isinstance(kind, Physical) and kind.noise):
            return None
        return kind.constant(self)

    def is_constant(self, reading: str) -> bool:
        """True if all that a reading is computed from in the end is constant in this world."""
        return all(self.constant(root) is not None for root in self.study.roots.get(reading, {reading}))

    @property
    def can_hold(self) -> bool:
        """True if a claw may ever close."""
        return self.study.can_hold

    @property
    def tick(self) -> float:
        """The length of a tick in seconds."""
        return self.study.mind.tick

    def reading(self, name: str) -> Interval:
        """The range of a reading in this world."""
        constant = self.constant(name)
        return UNIT_INTERVAL if constant is None else (constant, constant)

    def each(self, of: "Conditional") -> Interval:
        """The range of the readings that a reward goes through."""
        return self.reading(of.each) if isinstance(of, Reward) and of.each else UNIT_INTERVAL

    def range_in(self, of: "Conditional") -> Range:
        """The ranges of the expressions of a sensor, an edge, a promise, an end or a reward."""
        return lambda expression: interval(expression, self.reading, self.each(of))

    def why_never_paid(self, reward: Reward) -> tuple[Span, str, str] | None:
        """Where and why a reward is never paid, and what to do; None of one that may be."""
        fact, value = reward.fact, self.range_in(reward)
        if reward.on and fact.on and (why := reward.on.hindrance(self)):
            return fact.on.span, *why
        if reward.when and (never := why_never(reward.when, value)):
            return reward.when.span, never, "Compare with something that is reached, or take the reward out."
        if value(reward.amount) == (0, 0):
            return fact.amount.span, "its amount is always 0", "Give it another amount, or take it out."
        return None

    @property
    def drains(self) -> bool:
        """True if the battery can become empty."""
        batteries = [kind.battery for kind in self.study.sensors.values() if kind.battery]
        return not all(battery.start and not battery.drain for battery in batteries)


Conditional = Edge | Reward | End | Promise | Part[SensorKind]
Condition = tuple[When, Conditional, AnalysedWorld]  # what it is a condition of, and the world in which it is


@dataclass(frozen=True)
class Study:
    """A mind that compiled, and what its locks say."""

    mind: Mind
    graph: Graph
    lock: Lock

    @cached_property
    def skills(self) -> dict[str, Skill]:
        return {skill.name: skill for skill in self.mind.skills}

    @cached_property
    def edges(self) -> tuple[tuple[Skill, Edge], ...]:
        """The edges of all skills but those that are like others."""
        return tuple((skill, edge) for skill in self.mind.skills if not skill.like for edge in skill.edges)

    @cached_property
    def tasks(self) -> dict[str, Task]:
        return {task.name: task for task in self.mind.tasks}

    @cached_property
    def sensors(self) -> dict[str, SensorKind]:
        return {sensor.name: sensor.kind for sensor in self.mind.sensors}

    @cached_property
    def children_first(self) -> tuple[Skill, ...]:
        """The skills, each after all that it influences."""
        return tuple(self.skills[name] for name in reversed(topological_order(self.mind.influences)))

    @cached_property
    def active(self) -> set[str]:
        """The skills that a master reaches, the mind's or that of a lesson."""
        masters = {self.mind.master, *(lesson.master for lesson in self.mind.lessons)}
        return with_descendants(self.mind.influences, masters)

    @cached_property
    def acting(self) -> set[str]:
        """The skills that a master reaches, and those whose weights these use."""
        return self.active | {self.skills[name].owner for name in self.active}

    @cached_property
    def learning(self) -> set[str]:
        """The skills that lessons can teach: those with weights that are not frozen."""
        return {each.name for each in self.mind.skills if each.function.learns and not each.frozen and not each.like}

    @cached_property
    def can_hold(self) -> bool:
        """True if a claw may ever close: a skill that a master reaches drives it, or it closes where none does."""
        driven = {edge.target for name in self.active for edge in self.skills[name].edges if edge.to == "actuator"}
        claws = (part for part in self.mind.actuators if part.kind.can_hold)
        return any(claw.name in driven or claw.kind.acts_at_rest for claw in claws)

    @cached_property
    def roots(self) -> dict[str, frozenset[str]]:
        """The sensors and memories that each sensor is computed from at last; of one that is not computed, itself."""
        graph, found = source_graph(self.mind.sensors), dict[str, frozenset[str]]()
        for name in reverse_topological_order(graph):
            found[name] = frozenset[str]().union(*(found[source] for source in graph[name])) or frozenset({name})
        return found

    @cached_property
    def senses(self) -> dict[str, frozenset[str]]:
        """The things that each sensor, or what it is computed from, is about."""
        return {
            name: frozenset(thing for root in roots if root in self.sensors for thing in self.sensors[root].things)
            for name, roots in self.roots.items()
        }

    @cached_property
    def mentions(self) -> tuple[Mention, ...]:
        """Every name in the files."""
        return tuple(mentions(self.mind.files, self.mind.names))

    @cached_property
    def is_exhausted(self) -> bool:
        """True if a task asks for exhaustion, an event of the battery that does not name it."""
        events = (event for task in self.mind.tasks for event in task.events if event)
        return any(single.is_of_battery for event in events for single in event.single)

    @cached_property
    def used(self) -> set[tuple[str, str]]:
        """The names that stand anywhere but in their own declaration, each with its noun before it."""
        return {(mention.noun, mention.name.text) for mention in self.mentions if not mention.is_own}

    @property
    def main(self) -> Source:
        """The file that is linted."""
        return self.mind.files[0].source

    @cached_property
    def worlds(self) -> dict[str, AnalysedWorld]:
        """The world of each task by its name."""
        return {task.name: self._world(task) for task in self.mind.tasks}

    def _world(self, task: Task) -> AnalysedWorld:
        solid = [thing for thing in task.things if thing.kind.is_solid]
        loose = frozenset(thing.name for thing in solid if thing.kind.is_loose)
        fixed = [thing for thing in solid if not (thing.kind.is_loose or thing.kind.is_robot)]
        items = (thing for thing in task.things if thing.kind.can_be_held)
        fleeting = frozenset(thing.name for thing in items if thing.kind.outcomes.get("reached", STAYS) != STAYS)
        is_solid, has_fixed = task.scene.is_bounded or bool(solid), task.scene.is_bounded or bool(fixed)
        return AnalysedWorld(self, _named([task]), is_solid, has_fixed, _charges([task]), loose, fleeting)

    @cached_property
    def any_world(self) -> AnalysedWorld:
        """A world in which there is everything that any task has."""
        tasks = self.mind.tasks
        return AnalysedWorld(self, _named(tasks), True, True, not tasks or _charges(tasks))

    @property
    def computed(self) -> "tuple[Part[SensorKind] | Edge, ...]":
        """What may be said by an expression, under a condition: sensors, and edges."""
        return (*self.mind.sensors, *(edge for _, edge in self.edges))

    @property
    def conditions(self) -> Iterator[Condition]:
        """Every condition of what sensors read, skills send and promise, of rewards and of ends."""
        for sent in self.computed:
            if sent.gate:
                yield sent.gate.when, sent, self.any_world
        for promise in (promise for skill in self.mind.skills for promise in skill.promises):
            yield promise.when, promise, self.any_world
        for task in self.mind.tasks:
            judging: tuple[Reward | End, ...] = (*task.rewards, *task.ends)
            for each in judging:
                if each.when:
                    yield each.when, each, self.worlds[task.name]

    def beginning(self, task: Task) -> Beginning:
        """The world of a task when a run begins."""
        return task_beginning(task.scene, task.things, task.start, self.mind.body.kind, self.graph.claw_reach)

    def goals(self, task: Task) -> frozenset[str]:
        """The things on which no run of a task begins."""
        return goals(self.graph, next(each for each in self.graph.tasks if each.name == task.name))


@dataclass(frozen=True, slots=True)
class Finding:
    """A finding of a rule: where, what is wrong in the user's words, and what to do; `fix` does it."""

    span: Span
    message: str
    hint: str
    labels: tuple[Label, ...] = ()
    fix: Fix | None = None


Found = Iterator[Finding]


def _named(tasks: Iterable[Task]) -> frozenset[str]:
    """The names of the things that sensors can be about."""
    things = ((thing, task.scene) for task in tasks for thing in task.things)
    return frozenset(thing.name for thing, scene in things if not thing.kind.is_obstacle or thing.kind.obstacles(scene))


def _charges(tasks: Iterable[Task]) -> bool:
    return any(thing.kind.charges for task in tasks for thing in task.things)


def study(compiled: Compiled) -> Study:
    """The study of a mind that compiled; LockError where a lock is damaged."""
    assert compiled.mind is not None
    assert compiled.graph is not None
    lock = read_locks(lock_sources(compiled.sources))
    return Study(compiled.mind, compiled.graph, lock)


Check = Callable[[Study], Found]


@dataclass(frozen=True, slots=True)
class Rule:
    """A rule and its code. What is of no use here may be of use `elsewhere`, in a mind that uses this one.

    One that is told `once_a_line` speaks of lines that several tasks can have.
    """

    code: str
    check: Check
    elsewhere: bool
    once_a_line: bool


RULES: dict[str, Rule] = {}  # of the modules that have been imported


def rule(elsewhere: bool = False, once_a_line: bool = False) -> Callable[[Check], Check]:
    """Make a function a rule, whose code is its name with dashes."""

    def register(check: Check) -> Check:
        code = check.__name__.replace("_", "-")
        RULES[code] = Rule(code, check, elsewhere, once_a_line)
        return check

    return register


def removal(what: Declaration | Fact | Setting, title: str = "", is_safe: bool = False) -> Fix:
    """The fix that takes out a declaration, or the line of a fact or a setting."""
    if isinstance(what, Declaration):
        return Fix(title or f"Remove {what.header.name.text}", without_declarations([what]), is_safe)
    return Fix(title or "Remove the line", (without_line(what),), is_safe)


def saying(phrases: Iterable[Phrase], text: str) -> Fix:
    """The fix that writes an argument behind each of some kinds. It is not safe: the robot becomes another one."""
    ends = dict.fromkeys((phrase.span.source, phrase.span.end) for phrase in phrases)
    return Fix(f"Say {text}", tuple(Splice(source, end, end, f" {text}") for source, end in ends), is_safe=False)


def is_zero_influence(edge: Edge) -> bool:
    """True if an edge is an influence that is 0, whatever is read."""
    return edge.to == "skill" and bool(edge.at) and all(interval(value)[1] <= 0 for value in edge.values)


def name_words(name: str) -> list[str]:
    """The words of a name in lower case, whether underscores or capitals part them: left_wheel, LeftWheel."""
    return [word.lower() for word in _WORD.findall(name)]


def readings(*nodes: Any) -> set[str]:
    """The names of the readings in some expressions and conditions."""
    return {term.operand for expression in expressions_in(*nodes) for term in expression.found("reading")}
