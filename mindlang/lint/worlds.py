"""What can be read and what can happen in the world of a task."""

from collections.abc import Iterable
from dataclasses import dataclass

from mindrun.kinds.sensors.sensor import Physical
from mindrun.kinds.things.thing import STAYS

from mindlang.compiler.model import Expression, Reward, Task
from mindlang.lint.intervals import UNIT_INTERVAL, Interval, interval
from mindlang.lint.study import Study


@dataclass(frozen=True, slots=True)
class AnalysedWorld:
    """The things in a world that sensors can be about, what stands in the way, and whether the battery charges."""

    study: Study
    things: frozenset[str]
    is_solid: bool
    has_fixed: bool  # what is solid and does not give way
    charges: bool
    loose: frozenset[str]  # things that can be pushed
    fleeting: frozenset[str]  # items that are gone as soon as they are reached

    def constant(self, name: str) -> float | None:
        """What a sensor always reads in this world; None where that varies, or nobody knows."""
        kind = self.study.sensors.get(name)
        if kind is None or (isinstance(kind, Physical) and kind.noise):
            return None
        return kind.constant(self)

    def is_constant(self, reading: str) -> bool:
        """Whether what a reading comes from in the end always reads the same."""
        return all(self.constant(root) is not None for root in self.study.roots.get(reading, {reading}))

    @property
    def can_hold(self) -> bool:
        """Whether a claw may ever close."""
        return self.study.can_hold

    @property
    def tick(self) -> float:
        """The length of a tick in seconds."""
        return self.study.mind.tick

    def reading(self, name: str) -> Interval:
        """The range of a reading in this world."""
        constant = self.constant(name)
        return UNIT_INTERVAL if constant is None else (constant, constant)

    def range_of(self, of: Expression) -> Interval:
        """The range of an expression in this world."""
        return interval(of, self.reading)

    def value(self, of: Expression, reward: Reward) -> Interval:
        """The range of an expression of a reward."""
        return interval(of, self.reading, self.each(reward))

    def each(self, reward: Reward) -> Interval:
        """The range of the readings that a reward goes through."""
        return self.reading(reward.each) if reward.each else UNIT_INTERVAL

    @property
    def drains(self) -> bool:
        """Whether the battery can become empty."""
        batteries = [kind.battery for kind in self.study.sensors.values() if kind.battery]
        return not all(battery.start and not battery.drain for battery in batteries)


def world(study: Study, task: Task) -> AnalysedWorld:
    """The world of a task."""
    solid = [thing for thing in task.things if thing.kind.is_solid]
    loose = frozenset(thing.name for thing in solid if thing.kind.is_loose)
    is_solid, has_fixed = task.scene.is_bounded or bool(solid), task.scene.is_bounded or len(solid) > len(loose)
    items = (thing for thing in task.things if thing.kind.can_be_held)
    fleeting = {thing.name for thing in items if thing.kind.outcomes.get("reached", STAYS) != STAYS}
    return AnalysedWorld(study, _named([task]), is_solid, has_fixed, _charges([task]), loose, frozenset(fleeting))


def any_world(study: Study) -> AnalysedWorld:
    """A world in which there is everything that any task has."""
    tasks = study.mind.tasks
    return AnalysedWorld(
        study,
        _named(tasks),
        is_solid=True,
        has_fixed=True,
        charges=not tasks or _charges(tasks),
        loose=frozenset(),
        fleeting=frozenset(),
    )


def _named(tasks: Iterable[Task]) -> frozenset[str]:
    """The things that sensors can be about."""
    things = ((thing, task.scene) for task in tasks for thing in task.things)
    return frozenset(thing.name for thing, scene in things if not thing.kind.is_obstacle or thing.kind.obstacles(scene))


def _charges(tasks: Iterable[Task]) -> bool:
    return any(thing.kind.charges for task in tasks for thing in task.things)
