"""A world in which its things hardly fit.

What has no place of its own is put down where a try finds one that is clear of all other things, and by the robot's
width of walls and obstacles. Where they leave hardly any, the last of them stands in another thing or in an obstacle,
and nothing says so. Worlds of the task are drawn here as training draws them.
"""

from collections import Counter
from random import Random

from mindlang.compiler.model import Task
from mindlang.compiler.syntax import Contains, of_form
from mindlang.lint.drawn_world import ROBOT, DrawnWorld
from mindlang.lint.study import Finding, Found, Study, first_of_each

MAX_WORLDS, MAX_LOOKS = 100, 200_000  # as many worlds as cost no more than that

BINS = """
sensor bin_bearing is bearing of bin
task Sort in arena size {}
  contains bin is zone size 5 count 12 away 0 to 100
  contains rock is obstacle count {} size 3
  lasts 9 s
  rewards 10 on reach of bin
"""
GOOD = BINS.format(60, 10)
BAD = (BINS.format(30, 10), BINS.format(60, 100))


HINT = "Make the arena larger, or what is in it smaller or fewer, or say where it stands: at 10 -5."


def check(study: Study) -> Found:
    """Tasks of which some worlds that are drawn lack a place for something."""
    return first_of_each(_found(study))


def _found(study: Study) -> Found:
    for task in study.mind.tasks:
        lacking, worlds = _lacking(study, task)
        if lacking:
            name = lacking.most_common(1)[0][0]
            said = f"{name[0].upper()}{name[1:]}" if name == ROBOT else name
            message = f"{said} finds no place in {lacking[name]} of {worlds} worlds of {task.name} that were drawn."
            things = (fact.name.span for fact in of_form(task.facts, Contains) if fact.name.text == name)
            yield Finding(next(things, task.span), message, HINT)


def _lacking(study: Study, task: Task) -> tuple[Counter[str], int]:
    """In how many worlds something is the first to find no place, by its name, and how many were drawn."""
    found, looks, random = Counter[str](), 0, Random(1)
    body, claw, never = study.mind.body.kind, study.graph.claw_reach, study.goals(task)
    for number in range(MAX_WORLDS if not task.scene.environment else 0):
        world = DrawnWorld(task.scene, body, claw, never, random)
        if name := world.draw(task):
            found[name] += 1
        looks += world.looks
        if looks > MAX_LOOKS:
            return found, number + 1
    return found, MAX_WORLDS
