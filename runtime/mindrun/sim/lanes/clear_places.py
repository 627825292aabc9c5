"""Whether a place is clear of what stands already."""

from mindrun.arithmetic import BOX_COLUMNS, HALF_X, HALF_Y, SIZE, THING_ROWS, X, Y
from mindrun.sim.compiling import compiled


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
