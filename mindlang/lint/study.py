"""What a lint rule looks at, and what it finds."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from mindrun.graph.graph import Graph, Lesson
from mindrun.kinds.events.event import EventKind
from mindrun.kinds.sensors.sensor import SensorKind

from mindlang.compiler.compile import Compiled
from mindlang.compiler.diagnostic import Fix, Label
from mindlang.compiler.hierarchy import below, ends_first, in_order
from mindlang.compiler.model import Mind, Skill, Task, source_graph
from mindlang.compiler.references import Mention, mentions
from mindlang.compiler.source import Source, Span
from mindlang.lock import Lock, lock_sources, read_locks

_WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")


@dataclass(frozen=True)
class Study:
    """A mind that compiled, and what its locks say."""

    mind: Mind
    graph: Graph
    lock: Lock

    @cached_property
    def skills(self) -> dict[str, Skill]:
        """The skills by name."""
        return {skill.name: skill for skill in self.mind.skills}

    @cached_property
    def tasks(self) -> dict[str, Task]:
        """The tasks by name."""
        return {task.name: task for task in self.mind.tasks}

    @cached_property
    def sensors(self) -> dict[str, SensorKind]:
        """The kinds of the sensors by name."""
        return {sensor.name: sensor.kind for sensor in self.mind.sensors}

    @cached_property
    def children_first(self) -> tuple[Skill, ...]:
        """The skills in an order in which a table that a skill has from its subskills can be filled."""
        return tuple(self.skills[name] for name in reversed(in_order(self.mind.influences)))

    @cached_property
    def masters(self) -> set[str]:
        """The skills that are ever in charge: the mind's master, and those of its lessons."""
        return {self.mind.master, *(lesson.master for lesson in self.mind.lessons)}

    @cached_property
    def active(self) -> set[str]:
        """The skills that a master reaches."""
        return below(self.mind.influences, self.masters)

    @cached_property
    def acting(self) -> set[str]:
        """The skills that a master reaches, and those whose weights act in them."""
        return self.active | {self.skills[name].owner for name in self.active}

    @cached_property
    def learning(self) -> set[str]:
        """The skills that lessons can teach: those with weights that are not frozen."""
        return {each.name for each in self.mind.skills if each.function.learns and not each.frozen and not each.like}

    @cached_property
    def can_hold(self) -> bool:
        """Whether a claw may ever close: a skill that a master reaches drives it, or it is closed where none does."""
        driven = {edge.target for name in self.active for edge in self.skills[name].edges if edge.to == "actuator"}
        claws = (part for part in self.mind.actuators if part.kind.can_hold)
        return any(claw.name in driven or claw.kind.acts_at_rest for claw in claws)

    @cached_property
    def roots(self) -> dict[str, frozenset[str]]:
        """What each sensor comes from in the end: itself, or what stands at the end of all that it is computed from."""
        graph, found = source_graph(self.mind.sensors), dict[str, frozenset[str]]()
        for name in ends_first(graph):
            found[name] = frozenset[str]().union(*(found[source] for source in graph[name])) or frozenset({name})
        return found

    @cached_property
    def senses(self) -> dict[str, str]:
        """The thing that each sensor is about, those left out that are about none or several."""
        things = {
            name: {self.sensors[root].thing for root in roots if root in self.sensors} - {""}
            for name, roots in self.roots.items()
        }
        return {name: next(iter(about)) for name, about in things.items() if len(about) == 1}

    @cached_property
    def mentions(self) -> tuple[Mention, ...]:
        """Every name in the files."""
        return tuple(mentions(self.mind.files, self.mind.names))

    @cached_property
    def is_exhausted(self) -> bool:
        """Whether a task asks for exhaustion, which is of the battery without naming it."""
        events = (event for task in self.mind.tasks for event in (*_ending(task), *task.counts, *_paid(task)))
        return any(event.is_of_battery for event in events)

    @cached_property
    def used(self) -> dict[str, set[str]]:
        """The names that stand anywhere but in their own declaration, by noun."""
        found: dict[str, set[str]] = {}
        for mention in self.mentions:
            if not mention.is_own:
                found.setdefault(mention.noun, set()).add(mention.name.text)
        return found

    @property
    def main(self) -> Source:
        """The file that is linted."""
        return self.mind.files[0].source

    def goals(self, task: Task) -> frozenset[str]:
        """The things on which no run of a task begins."""
        from mindrun.graph.tasks import goals

        return goals(self.graph, next(each for each in self.graph.tasks if each.name == task.name))

    def learners(self, lesson: Lesson) -> tuple[str, ...]:
        """The skills that a lesson of the graph teaches."""
        from mindrun.graph.skill_sets import learners

        return learners(self.graph, lesson)


@dataclass(frozen=True, slots=True)
class Finding:
    """What a rule finds: where, what is wrong in the user's words, and what to do; `fix` does it."""

    span: Span
    message: str
    hint: str
    labels: tuple[Label, ...] = ()
    fix: Fix | None = None


Found = Iterator[Finding]


def _paid(task: Task) -> Iterator[EventKind]:
    return (reward.on for reward in task.rewards if reward.on)


def _ending(task: Task) -> Iterator[EventKind]:
    return (end.event for end in task.ends if end.event)


def study(compiled: Compiled) -> Study:
    """The study of a mind that compiled; LockError where a lock is damaged."""
    assert compiled.mind is not None
    assert compiled.graph is not None
    lock = read_locks(lock_sources(compiled.sources))
    return Study(compiled.mind, compiled.graph, lock)


def words(name: str) -> list[str]:
    """The words of a name in lower case, whether underscores or capitals part them: left_wheel, LeftWheel."""
    return [word.lower() for word in _WORD.findall(name)]
