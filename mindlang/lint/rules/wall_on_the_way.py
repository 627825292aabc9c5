"""A walker whose way leads through something solid.

It touches nothing and goes on in a straight line, so that the robot meets somebody who comes out of a wall, and cannot
follow. Lead the way around it, place by place.
"""

from collections.abc import Iterator

from mindrun.kinds.things.thing import ThingKind
from mindrun.numbers.quantity import Place

from mindlang.compiler.beginning import Outline, meet, rectangle
from mindlang.compiler.diagnostic import Label
from mindlang.compiler.model import Part
from mindlang.compiler.source import Span
from mindlang.lint.study import Finding, Found, Study

HALL = """
task Hall in arena size 40
  contains fence is wall from -10 0 to 10 0
  contains cat is walker along {}
  lasts 9 s
  counts reach of cat
"""
GOOD = (HALL.format("-12 -5 to 12 -5"), HALL.format("0 -5 to 15 -5 to 15 5 to 15 -5"))
BAD = (HALL.format("0 -5 to 0 5"), HALL.format("0 -5 to 15 -5 to 15 5"), HALL.format("-12 0.9 to 12 0.9"))


def check(study: Study) -> Found:
    """Stretches of ways, the last of which leads back to the first place, that are in what is fixed."""
    told: set[Span] = set()
    for task in study.mind.tasks:
        fixed = [(each, [*each.kind.standing(task.scene)]) for each in task.things]
        for thing in (each for each in task.things if each.kind.walks and each.span not in told):
            swept = [Outline(stretch, thing.kind.begins[0] / 2) for stretch in _stretches(thing)]
            wall = next((each for each, its in fixed if any(meet(a, rectangle(b)) for a in swept for b in its)), None)
            if wall:
                told.add(thing.span)
                message = f"The way of {thing.name} leads through {wall.name}."
                yield Finding(thing.span, message, "Name places around it.", (Label(wall.span, "this one"),))


def _stretches(thing: Part[ThingKind]) -> Iterator[tuple[Place, Place]]:
    """The places of a way by two, if it is one: whoever wanders has none."""
    way = thing.kind.places if not thing.kind.wanders else ()
    return zip(way, (*way[1:], *way[:1]), strict=True)
