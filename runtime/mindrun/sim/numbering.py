"""The numbers of what a world contains: rows of things and robots, boxes, and shapes in Chipmunk's hash."""

from collections.abc import Sequence
from itertools import accumulate
from typing import NamedTuple

from mindrun.graph.graph import Task, Thing
from mindrun.graph.tasks import own_name, things_of
from mindrun.sim.codes import WALL_COUNT

NOWHERE = range(-1, -1)  # rows of a thing that the task does not contain
HASH_SIZES = 5, 13, 23, 47, 97, 193, 389, 769, 1543, 3079, 6151, 12289  # of the hashes of Chipmunk


def rows_by_name(task: Task) -> dict[str, range]:
    """The rows of `things_of` that each name has; NOWHERE of the empty name, and of robots of which there are none."""
    found = {"": NOWHERE, **{thing.name: NOWHERE for thing in task.things if thing.kind.is_robot}}
    for row, thing in enumerate(things_of(task)):
        known = found.get(thing.name) or range(row, row)
        found[thing.name] = range(known.start, row + 1)
    return found


def boxes_by_name(task: Task) -> dict[str, range]:
    """The boxes that each name has in every lane, as they are drawn: walls, what has a place or a grid, all others."""
    obstacles = [thing for thing in task.things if thing.kind.is_obstacle]

    def turn(thing: Thing) -> int:
        return 0 if thing.kind.walls else 1 + any(row["count"] for row in thing.kind.rows(task.scene))

    found, last = {}, 0
    for thing in sorted(obstacles, key=turn):
        found[thing.name] = range(last, last + thing.kind.obstacles(task.scene))
        last = found[thing.name].stop
    return found


def opened_boxes(task: Task) -> set[int]:
    """The boxes of what opens in some runs of a task."""
    boxes = boxes_by_name(task)
    return {box for end in task.ends if end.opens for box in boxes[end.opens]}


def robot_rows(task: Task) -> list[int]:
    """The row of `things_of` that each robot of the world is to the others; −1 for a first one that is none."""
    own = rows_by_name(task)[own_name(task)].start
    others = (row for row, thing in enumerate(things_of(task)) if thing.kind.is_robot and row != own)
    return [own, *others]


def robot_numbers(task: Task) -> dict[int, int]:
    """The number of the robot that each row of `things_of` that is one; in its own world it is nowhere."""
    return {row: number for number, row in enumerate(robot_rows(task)) if row >= 0}


def paid_robots(task: Task) -> int:
    """The number of robots of a task's world to which happens what counts."""
    things = things_of(task)
    return 1 + sum(things[row].kind.paid for row in robot_rows(task)[1:])


class HashNumbers(NamedTuple):
    """The numbers that Chipmunk would give to shapes, in the order in which they are added: boxes, walls, the robots,
    what the first may hold, what the next may …, what is loose.

    That of what a robot holds is by `items` more than that of the robot before it. The hash has shapes in the order of
    these numbers modulo its `size`.
    """

    robot: int  # of the first one
    things: Sequence[int]
    items: int
    size: int


def hash_numbers(task: Task) -> HashNumbers:
    things, robots = [thing.kind for thing in things_of(task)], len(robot_rows(task))
    robot = sum(each.kind.obstacles(task.scene) for each in task.things) + WALL_COUNT * task.scene.is_bounded
    items = sum(kind.can_be_held for kind in things)
    held = [*accumulate((kind.can_be_held for kind in things), initial=robot + robots - 1)]
    loose = [*accumulate((kind.is_loose for kind in things), initial=robot + robots - 1 + robots * items)]
    numbers = [b if kind.is_loose else a for kind, a, b in zip(things, held[1:], loose[1:], strict=True)]
    return HashNumbers(robot, numbers, items, next(prime for prime in HASH_SIZES if prime > 1 + loose[-1] - robot))
