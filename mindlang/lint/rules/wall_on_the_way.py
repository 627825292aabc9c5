"""A walker whose way leads through something solid.

It touches nothing and goes on in a straight line, so that the robot meets somebody who comes out of a wall, and cannot
follow. Lead the way around it, place by place.
"""

from itertools import product

from mindlang.compiler.beginning import Outline, overlap, rectangle_outline
from mindlang.compiler.diagnostic import Label
from mindlang.lint.study import Finding, Found, Study, once_a_line

HALL = """
task Hall in arena size 40
  contains fence is wall from -10 0 to 10 0
  contains cat is walker along {}
  lasts 9 s
  counts reach of cat
"""
GOOD = (HALL.format("-12 -5 to 12 -5"), HALL.format("0 -5 to 15 -5 to 15 5 to 15 -5"))
BAD = (HALL.format("0 -5 to 0 5"), HALL.format("0 -5 to 15 -5 to 15 5"), HALL.format("-12 5 to 12 5 or 0 -5 to 0 5"))


@once_a_line
def check(study: Study) -> Found:
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
