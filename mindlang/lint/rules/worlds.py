"""Where things stand and go when runs begin."""

from dataclasses import replace
from itertools import chain, product

from mindrun.graph.tasks import is_one_world

from mindlang.compiler.beginning import Beginning, Outline, overlap, rectangle_outline
from mindlang.compiler.diagnostic import Label
from mindlang.compiler.source import Span
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
