"""Whether a place is clear of what stands already, and whether a robot would begin in something or on a goal."""

from mindrun.graph.beginning import meets_robot
from mindrun.numbers.arithmetic import BOX_COLUMNS, HALF_X, HALF_Y, SIZE, THING_ROWS, X, Y
from mindrun.sim.compiling import compiled

meets = compiled(meets_robot)


@compiled
def clear_of_all(tables, world, x, y, margin, lane):
    """Whether nothing solid that stands already comes within `margin` of a point, along the axes."""
    return clear(world.boxes, x, y, margin, lane) and clear_of_loose(tables, x, y, margin)


@compiled
def clear(boxes, x, y, margin, lane):
    """Whether no obstacle comes within `margin` of a point, along the axes."""
    for b in range(boxes.shape[1] // BOX_COLUMNS):
        box = BOX_COLUMNS * b
        wide, high = boxes[lane, box + HALF_X] + margin, boxes[lane, box + HALF_Y] + margin
        if abs(boxes[lane, box + X] - x) < wide and abs(boxes[lane, box + Y] - y) < high:
            return False
    return True


@compiled
def clear_of_loose(tables, x, y, margin):
    """Whether no box or ball with a place of its own comes within `margin` of a point, along the axes."""
    for i in range(len(tables.loose)):
        thing = tables.things[tables.loose[i].thing]
        gap = max(thing.first, thing.last) / 2 + margin
        if thing.is_fixed and abs(thing.x - x) < gap and abs(thing.y - y) < gap:
            return False
    return True


@compiled
def clear_of_things(things, x, y, extent, but, lane):
    """Whether something of that half size would cover no thing at a place, thing number `but` aside."""
    for i in range(things.shape[0] // THING_ROWS):
        thing = THING_ROWS * i
        gap = extent + things[thing + SIZE, lane] / 2
        if i != but and abs(things[thing + X, lane] - x) < gap and abs(things[thing + Y, lane] - y) < gap:
            return False
    return True


@compiled
def is_open(tables, x, y):
    """Whether nothing with a place of its own keeps a robot from beginning at a point."""
    for i in range(len(tables.things)):
        thing = tables.things[i]
        size = max(thing.first, thing.last) if thing.drawn else thing.first
        if thing.is_fixed and stands_on(tables, i, size, thing.x - x, thing.y - y):
            return False
    return True


@compiled
def stands_on(tables, i, size, dx, dy):
    """Whether the robot, so far from the middle of thing i, would be in it, or would have reached it as a goal."""
    thing, constants = tables.things[i], tables.world[0]
    is_area, is_round, is_goal = thing.is_area == 1, thing.is_round == 1, thing.is_goal == 1
    return meets(is_area, is_round, is_goal, size, dx, dy, constants.radius, constants.front + constants.claw)
