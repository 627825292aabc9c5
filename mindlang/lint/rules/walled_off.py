"""A part of the floor to which no way leads from where the robot starts.

Walls stand between, or a passage that is narrower than the robot, in all runs or where an obstacle is as large as it
may be. Where the robot starts or a thing appears is drawn anywhere: in some runs one is here and the other there, and
nobody can succeed. Open the wall, widen the passage, or fill with `#` what nobody is to enter.
"""

from collections.abc import Iterator, Sequence
from math import inf

from mindrun.kinds.things.thing import Rectangle, ThingKind

from mindlang.compiler.beginning import PLAIN_START, beginning
from mindlang.compiler.model import Task
from mindlang.compiler.source import Span
from mindlang.lint.floor import Floor, floor
from mindlang.lint.study import Finding, Found, Study

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
    HALL.format(15, " at 0 10\n  starts at 5 -5\n  contains plug is obstacle at 17.5 0 size 1 to 5"),
    """
task Cell in arena size 40
  contains goal is zone size 1 at 10 0
  contains left is wall from 9 -1 to 9 1
  contains right is wall from 11 -1 to 11 1
  contains top is wall from 9 1 to 11 1
  contains bottom is wall from 9 -1 to 11 -1
  lasts 9 s
  succeeds on reach of goal
""",
    """
task Pen in plain
  contains goal is zone size 2
  contains left is wall from -5 -5 to -5 5
  contains right is wall from 5 -5 to 5 5
  contains top is wall from -5 5 to 5 5
  contains bottom is wall from -5 -5 to 5 -5
  lasts 9 s
  succeeds on reach of goal
""",
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
    for task in study.mind.tasks:
        for finding in _of_task(study, task):
            if finding.span not in told:
                told.add(finding.span)
                yield finding


def _of_task(study: Study, task: Task) -> Iterator[Finding]:
    """What is walled off in every run, and then what is in some."""
    body, before = study.mind.body.kind, list[Rectangle]()
    for may in (False, True):
        walls = [
            wall for each in task.things for wall in each.kind.standing(task.scene, may and _stays(task, each.kind))
        ]
        if walls == before or task.scene.environment:
            return
        before = walls
        if whole := floor(_sides(task, walls, 4 * body.radius), walls, min(body.side, body.front)):
            yield from _findings(study, task, whole, "In some runs no way" if may else "No way")


def _stays(task: Task, kind: ThingKind) -> bool:
    """Whether it is a single obstacle, of which no more than the size is drawn."""
    return len(kind.places) == 1 and not any(row["jitter"] for row in kind.rows(task.scene))


def _sides(task: Task, walls: Sequence[Rectangle], beyond: float) -> tuple[float, float]:
    """The sides of an arena, or, in a plain scene, of what has a place, and so far beyond."""
    if task.scene.is_bounded:
        return task.scene.sides
    places = [task.start.at or PLAIN_START, *(place for thing in task.things for place in thing.kind.places)]
    x = max(*(abs(x) for x, _ in places), *(abs(wall.x) + wall.half_x for wall in walls))
    y = max(*(abs(y) for _, y in places), *(abs(wall.y) + wall.half_y for wall in walls))
    return 2 * (x + beyond), 2 * (y + beyond)


def _findings(study: Study, task: Task, whole: Floor, no_way: str) -> Iterator[Finding]:
    """What is said of a floor in parts: of a thing that is out of reach, of a part that something may be drawn in."""
    begun = beginning(task.scene, task.things, task.start, study.mind.body.kind, study.graph.claw_reach)
    at = begun.at or (None if task.scene.is_bounded else PLAIN_START)
    there = whole.parts_near(at, 0.0) if at else {*range(len(whole.areas))}
    origin = " from where the robot starts" if at else ""
    reach = study.mind.body.kind.front + study.graph.claw_reach
    for thing in (each for each in task.things if not each.kind.is_obstacle and not each.kind.walks):
        half = thing.kind.begins[1] / 2 + (0.0 if thing.kind.is_area else reach)
        if any(not whole.parts_near(place, half) & there for place in thing.kind.places):
            yield Finding(thing.span, f"{no_way} leads{origin} to {thing.name}.", HINT)
    is_drawn = at is None or any(not each.kind.places for each in task.things if not each.kind.is_obstacle)
    if is_drawn and (part := _part_without_way(task, whole, there if at else None)):
        message = f"{no_way} leads{origin or ' from the rest'} to {part}, where something may be drawn."
        yield Finding(task.declaration.header.name.span, message, HINT)


def _part_without_way(task: Task, whole: Floor, there: set[int] | None) -> str:
    """What no way leads to from some parts, or from the largest; empty where that is hardly anything."""
    if not task.scene.is_bounded:
        return "" if there is None or whole.parts[0][0] in there else "what lies outside of the walls"
    there = {max(range(len(whole.areas)), key=whole.areas.__getitem__, default=0)} if there is None else there
    share = 1 - sum(whole.areas[part] for part in there) / (sum(whole.areas) or inf)
    return f"{share:.0%} of the floor of {task.name}" if share >= LEAST_SHARE and whole.areas else ""
