"""What is known of a task before anything runs: what can change in it, what its words name, what the robot can do."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

from mindrun.graph.graph import Graph

from mindlang.compiler.compile import Compiled
from mindlang.compiler.hierarchy import with_descendants
from mindlang.compiler.model import Mind, Skill, Task
from mindlang.lint.study import AnalysedWorld, Study, readings, study


@dataclass(frozen=True)
class Claws(Study):
    """A mind as a new skill may have it: its claws can close, or, for comparison, cannot."""

    can_close: bool = True

    @cached_property
    def can_hold(self) -> bool:
        """True if there is a claw, and it can close."""
        return self.can_close and any(part.kind.can_hold for part in self.mind.actuators)


@dataclass(frozen=True, slots=True)
class Known:
    """What is known of a task: which sensors can change in it, in the order of the file, and what others always read.

    `things` are those of its world, `named` the sensors that its words name or that are about its things, `actuators`
    those that it can feel. `needs_claw` says that a line of it pays or counts only what a claw can do.
    """

    task: Task
    mind: Mind
    graph: Graph
    changing: tuple[str, ...]
    constants: dict[str, float]
    things: frozenset[str]
    named: frozenset[str]
    actuators: tuple[str, ...]
    needs_claw: bool

    def reads_of(self, skill: str) -> tuple[str, ...]:
        """The sensors that a skill and all below it read and that can change in the task, in the order of the file."""
        below = with_descendants(self.mind.influences, [skill])
        read = {name for each in self.mind.skills if each.name in below for name in each.reads}
        return tuple(name for name in self.changing if name in read)

    def driven_by(self, skills: Iterable[str]) -> frozenset[str]:
        """The actuators that some skills and all below them drive."""
        below, skills_by_name = with_descendants(self.mind.influences, skills), self.skills
        edges = (edge for name in below for edge in skills_by_name[name].edges)
        return frozenset(edge.target for edge in edges if edge.to == "actuator")

    @property
    def skills(self) -> dict[str, Skill]:
        """The skills of the mind by their names."""
        return {each.name: each for each in self.mind.skills}


def known_of(compiled: Compiled, task: str) -> Known:
    """What is known of a task of a mind that compiled, by its name."""
    mind, graph = compiled.whole
    lock = study(compiled).lock
    closing, open_ = Claws(mind, graph, lock), Claws(mind, graph, lock, can_close=False)
    world, without = closing.worlds[task], open_.worlds[task]
    found = next(each for each in mind.tasks if each.name == task)
    changing = tuple(each.name for each in mind.sensors if not world.is_constant(each.name))
    constants = {each.name: world.constant(each.name) for each in mind.sensors if each.name not in changing}
    said = readings(*found.facts)
    about = {name for name in changing if closing.senses.get(name, frozenset()) & world.things}
    needs_claw = _needs_claw(found, world, without, said)
    felt = [part for part in mind.actuators if not part.kind.is_light and (needs_claw or not part.kind.can_hold)]
    return Known(
        found,
        mind,
        graph,
        changing,
        {name: 0.5 if value is None else value for name, value in constants.items()},
        world.things,
        frozenset(about | (said & {*changing})),
        tuple(part.name for part in felt),
        needs_claw,
    )


def _needs_claw(task: Task, world: AnalysedWorld, without: AnalysedWorld, said: set[str]) -> bool:
    """True if something of a task happens, or a reading that it names changes, only where a claw can close."""
    events = [event for event in task.events if event]
    waits = any(event.hindrance(without) and not event.hindrance(world) for event in events)
    return waits or any(without.is_constant(name) and not world.is_constant(name) for name in said)
