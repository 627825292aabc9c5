"""Two things, or the robot and one, that are in one place in some runs.

Where sizes are drawn, obstacles stand off their places by a jitter, or the robot faces anywhere, what has a place of
its own can be in something else when a run begins: a box that is pushed out of a wall, an item that no claw reaches. In
every run it would be an error; what has no place of its own is put where it is clear.
"""

from dataclasses import replace
from itertools import chain

from mindlang.compiler.beginning import Beginning
from mindlang.compiler.diagnostic import Label
from mindlang.compiler.source import Span
from mindlang.lint.study import Finding, Found, Study

HALL = """
task Hall in arena size 40
  contains crate is box size {} at 10 0
  contains coin is item size 2 at 13 0
  lasts 9 s
  counts reach of coin
"""
ROCKS = """
task Hall in arena size 60
  contains rock is obstacle grid 20 size 2 to 4 jitter {}
  contains coin is item size 2 at 6 10
  lasts 9 s
  counts reach of coin
"""
GOOD = (HALL.format(4), HALL.format("4 to 2 by 0.5"), ROCKS.format("0.1"))
BAD = (
    HALL.format("2 to 6"),
    ROCKS.format(4),
    HALL.format(2).replace("  lasts", "  starts at 18.9 0\n  lasts") + "body Robot is box size 3 2\n",
)
START = "Write another place for the robot, or which way it faces: starts at 0 0 facing 90 deg."


def check(study: Study) -> Found:
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
