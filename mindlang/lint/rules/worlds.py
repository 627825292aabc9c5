"""Where things stand and go when runs begin, and runs that are decided or paid for nothing in their first tick."""

from dataclasses import dataclass, replace
from itertools import chain, product
from math import pi

from mindrun.graph.tasks import is_one_world
from mindrun.kinds.events.event import EventKind
from mindrun.numbers.intervals import UNIT_INTERVAL, Interval

from mindlang.compiler.beginning import Beginning, Outline, first_tick_hint, overlap, rectangle_outline
from mindlang.compiler.diagnostic import Label
from mindlang.compiler.model import Task
from mindlang.compiler.source import Span
from mindlang.lint.intervals import interval, why_always
from mindlang.lint.study import Finding, Found, Study, rule

START = "Write another place for the robot, or which way it faces: starts at 0 0 facing 90 deg."


@rule()
def chance_meeting(study: Study) -> Found:
    met = (_met(replace(study.beginning(task), may=True), task.span) for task in study.mind.tasks)
    yield from dict.fromkeys(chain.from_iterable(met))  # several tasks can have one from the same line


def _met(begun: Beginning, here: Span) -> Found:
    hint = "Write places that are farther apart, smaller sizes or a smaller jitter."
    for one, other in begun.overlapping():
        labels = (Label(other.span, "this one"),) if one is not other else ()
        yield Finding(one.span, f"{one.name} is in {other.name} when some runs begin.", hint, labels)
    if thing := begun.on_robot():
        yield Finding(thing.span, f"The robot starts in {thing.name} in some runs.", START, (Label(here, "here"),))
    if not begun.is_inside:
        yield Finding(here, "The robot starts in the border in some runs, as it happens to face.", START)


HINT = "Let something be drawn: leave facing out, or write at 10 0 or 0 10, or varies thrust of left_wheel 70 to 90."


@rule()
def nothing_drawn(study: Study) -> Found:
    for written, task in zip(study.mind.tasks, study.graph.tasks, strict=True):
        masters = {lesson.master for lesson in study.mind.lessons if lesson.task == task.name} or {study.mind.master}
        if all(is_one_world(study.graph, task, master) for master in masters):
            yield Finding(written.span, f"Nothing is drawn in {task.name}: all of its runs are one.", HINT)


@rule(once_a_line=True)
def wall_on_the_way(study: Study) -> Found:
    """Stretches of ways, the last of which leads back to the first place, that are in what is fixed."""
    for task in study.mind.tasks:
        there = [each for each in task.things if each.is_always_there]
        fixed = [(each, [rectangle_outline(wall) for wall in each.kind.standing(task.scene)]) for each in there]
        for thing in (each for each in task.things if each.kind.walks and not each.kind.wanders):
            radius = thing.kind.begins[0] / 2
            stretches = (pair for way in thing.kind.ways for pair in zip(way, (*way[1:], *way[:1]), strict=True))
            way = [Outline(stretch, radius) for stretch in stretches]
            wall = next((each for each, its in fixed if any(overlap(*both) for both in product(way, its))), None)
            if wall:
                message = f"The way of {thing.name} leads through {wall.name}."
                yield Finding(thing.span, message, "Name places around it.", (Label(wall.span, "this one"),))


LEAST_SHARE = 0.01  # of runs that are worth a word


@rule(once_a_line=True)
def paid_at_once(study: Study) -> Found:
    for task in study.mind.tasks:
        yield from _FirstTick(study, task, study.beginning(task)).found()


@dataclass(frozen=True, slots=True)
class _FirstTick:
    study: Study
    task: Task
    begun: Beginning

    def found(self) -> Found:
        """The lines of a task that end a run or pay in the first tick."""
        for end in self.task.ends:
            does = f"opens {end.opens} in" if end.opens else "ends"
            if end.event and (often := self._often(end.event, end.times)):
                yield Finding(end.fact.span, f"This {does} {often} in the first tick.", self._hint(end.event))
            if end.when and (why := why_always(end.when, lambda of: interval(of, self.first))):
                yield Finding(end.fact.span, f"This {does} every run in its first tick: {why}.", "Compare otherwise.")
        for reward in self.task.rewards:
            if reward.on and (often := self._often(reward.on, 1) or self._often_drawn(reward.on)):
                message = f"This is paid in the first tick of {often}, for nothing."
                yield Finding(reward.fact.span, message, self._hint(reward.on))

    def _hint(self, event: EventKind) -> str:
        """The hint for an event that comes at once: which way a robot faces changes what its claw has reached."""
        kinds = [each.kind for each in self.task.things if each.name == event.thing]
        faces = event.outcome == "reached" and not any(kind.is_area for kind in kinds)
        return first_tick_hint(event) + (" Or write which way the robot faces." if faces else "")

    def _often(self, event: EventKind, times: int) -> str:
        """The words "every run" or "some runs" if an event comes so often in their first tick, else empty."""
        sensors = [*self.study.sensors.values()]
        if self.begun.first_tick_count(event, sensors) >= times:
            return "every run"
        return "some runs" if replace(self.begun, may=True).first_tick_count(event, sensors) >= times else ""

    def _often_drawn(self, event: EventKind) -> str:
        """The share of runs in which the robot's place, which is drawn, is in what is rewarded, and no goal."""
        is_placed = self.begun.at is not None or event.thing in self.study.goals(self.task)
        if is_placed or event.within or event.outcome != "reached":
            return ""
        radius = self.study.mind.body.kind.radius
        width, depth = (max(side - 6 * radius, radius) for side in self.task.scene.sides)
        kinds = [each.kind for each in self.task.things if each.name == event.thing]
        share = sum(self._size(kind.begins[1], kind.is_area) * kind.copies for kind in kinds if kind.spots)
        share = min(1.0, share / (width * depth))
        return f"about {share:.0%} of the runs" if share >= LEAST_SHARE else ""

    def _size(self, size: float, is_area: bool) -> float:
        """The area, in square units, of the places where a robot, facing anywhere, has reached a thing."""
        return size**2 if is_area else pi / 2 * (self.begun.claw + size / 2) ** 2

    def first(self, name: str) -> Interval:
        """The interval of a sensor's or a memory's reading in the first tick."""
        if kind := self.study.sensors.get(name):
            if kind.formula:
                low, high = interval(kind.formula, self.first)
                return max(0.0, min(low, 1.0)), max(0.0, min(high, 1.0))
            return kind.first(self) or UNIT_INTERVAL
        start = next(each.kind.start for each in self.study.mind.memories if each.name == name)
        return start, start

    def is_within(self, thing: str) -> bool | None:
        """True if the robot begins inside a thing; None where that is drawn at random."""
        if self.begun.at is None:
            return None
        if self.begun.reached(thing):
            return True
        is_drawn = any(each.name == thing and not each.kind.places for each in self.task.things)
        return None if is_drawn or replace(self.begun, may=True).reached(thing) else False
