"""A part of the floor to which no way leads from where the robot starts.

Walls stand between, or a passage that is narrower than the robot. Where the robot starts or a thing appears is drawn
anywhere: in some runs one is here and the other there, and nobody can succeed. Open the wall, widen the passage, or
fill with `#` what nobody is to enter.
"""

from collections.abc import Iterator

from mindlang.analysis.floor import Floor, floor
from mindlang.analysis.study import Finding, Found, Study
from mindlang.compiler.beginning import beginning
from mindlang.compiler.model import Task
from mindlang.compiler.source import Span

LEAST_SHARE = 0.01  # of the floor that is worth a word

HALL = """
task Hall in arena size 40
  contains fence is wall from -20 0 to {} 0
  contains goal is zone size 4{}
  lasts 9 s
  succeeds on reach of goal
"""
GOOD = (
    HALL.format(15, ""),
    HALL.format(17.9, ""),
    HALL.format(20, " at 0 10\n  starts at 5 5"),
    HALL.format(15, " at 0 10\n  starts at 15 5"),
)
BAD = (
    HALL.format(20, ""),
    HALL.format("18.1", ""),
    HALL.format(20, " at 0 10\n  starts at 5 -5"),
    """
task Maze in arena size 20
  contains walls is map from "maze.txt"
  contains goal is zone size 2
  lasts 9 s
  succeeds on reach of goal
-- maze.txt --
..#..
..#..
..#g.
..#..
..#..
""",
)
HINT = "Open a wall or widen a passage, or fill with wall what nobody is to enter."


def check(study: Study) -> Found:
    """Tasks in which no way leads from where the robot starts to all of the floor, or to a thing with a place."""
    told: set[Span] = set()
    body = study.mind.body.kind
    for task in study.mind.tasks:
        walls = [wall for thing in task.things for wall in thing.kind.standing(task.scene)]
        if not walls or not task.scene.is_bounded:
            continue
        found = floor(task.scene.sides, walls, min(body.side, body.front))
        for finding in _findings(study, task, found) if found and len(found.areas) > 1 else ():
            if finding.span not in told:
                told.add(finding.span)
                yield finding


def _findings(study: Study, task: Task, whole: Floor) -> Iterator[Finding]:
    """What is said of a floor in parts: of a thing that is out of reach, of a part that something may be drawn in."""
    begun = beginning(task.scene, task.things, task.start, study.mind.body.kind, study.graph.claw_reach)
    largest = {max(range(len(whole.areas)), key=whole.areas.__getitem__)}
    there = whole.parts_near(begun.at, 0.0) if begun.at else largest
    reach = study.mind.body.kind.front + study.graph.claw_reach
    for thing in (each for each in task.things if not each.kind.is_obstacle and not each.kind.walks):
        half = thing.kind.begins[1] / 2 + (0.0 if thing.kind.is_area else reach)
        if begun.at and any(not whole.parts_near(place, half) & there for place in thing.kind.places):
            yield Finding(thing.span, f"No way leads from where the robot starts to {thing.name}.", HINT)
    is_drawn = begun.at is None or any(not each.kind.places for each in task.things if not each.kind.is_obstacle)
    share = 1 - sum(whole.areas[part] for part in there) / sum(whole.areas)
    if is_drawn and share >= LEAST_SHARE:
        where = "where the robot starts" if begun.at else "the rest"
        message = f"No way leads from {where} to {share:.0%} of the floor of {task.name}, where something may be drawn."
        yield Finding(task.declaration.header.name.span, message, HINT)
