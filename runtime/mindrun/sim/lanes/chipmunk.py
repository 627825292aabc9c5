"""Chipmunk from compiled code, through the library that pymunk ships: only pointers, whole numbers and doubles cross.

The robot's body with its shapes, and the boxes and walls of one lane, live in a Space of the lane's own, opened when
something could touch for the first time. `tests/sim` holds it against a loop of plain pymunk, bit for bit.
"""

from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic
from pymunk import _chipmunk

from mindrun.arithmetic import BOX_COLUMNS, HALF_SIDE, SIZE, THING_ROWS, X, Y
from mindrun.sim.codes import FORCE_X, FORCE_Y, TORQUE
from mindrun.sim.compiling import callback, compiled

ffi, lib = _chipmunk.ffi, _chipmunk.lib

ITERATIONS = 8
FRICTION = 0.2  # Box2D's default; elasticity is 0 in both engines
WALL = 1.0  # half the thickness of a wall, outside the arena
HASH_COUNT = 20

# The functions in use. Their addresses travel in a table: compiled code that held them could not be cached.
FUNCTIONS = (
    "cpSpaceNew", "cpSpaceFree", "cpSpaceSetIterations", "cpSpaceUseSpatialHash", "cpSpaceGetStaticBody",
    "cpSpaceAddBody", "cpSpaceAddShape", "cpSpaceRemoveBody", "cpSpaceRemoveShape", "cpSpaceStep", "cpBodyNew",
    "cpBodyFree", "cpPolyShapeNewRaw", "cpShapeFree", "cpShapeSetBody", "cpShapeSetFriction", "cpShapeSetSensor",
    "cpCircleShapeSetRadius", "pmSpaceBodyGetIteratorFuncBatched", "pmSpaceBodySetIteratorFuncBatched",
    "cpBodyEachArbiter",
)  # fmt: skip
(
    SPACE_NEW, SPACE_FREE, SPACE_ITERATIONS, SPACE_HASH, SPACE_STATIC, SPACE_ADD_BODY, SPACE_ADD_SHAPE,
    SPACE_REMOVE_BODY, SPACE_REMOVE_SHAPE, SPACE_STEP, BODY_NEW, BODY_FREE, POLY_NEW, SHAPE_FREE, SHAPE_BODY,
    SHAPE_FRICTION, SHAPE_SENSOR, CIRCLE_RADIUS, BODY_GET, BODY_SET, EACH_ARBITER, COUNT,
) = range(len(FUNCTIONS) + 1)  # fmt: skip


def library() -> Any:
    """The addresses of FUNCTIONS and, last, of a function that counts a body's contacts: uint64."""
    addresses = [int(ffi.cast("uintptr_t", ffi.addressof(lib, name))) for name in FUNCTIONS]
    return np.array([*addresses, _count.address], np.uint64)


@callback(types.void(types.voidptr, types.voidptr, types.CPointer(types.int64)))
def _count(_body: Any, _arbiter: Any, count: Any) -> None:
    count[0] += 1


@intrinsic
def call(typingctx, address, *arguments):
    """Call the C function at an address with whole numbers, pointers and doubles; its result as a uint64."""
    given = tuple(types.float64 if isinstance(a, types.Float) else types.uint64 for a in arguments)
    signature = types.uint64(types.uint64, types.StarArgTuple(given))

    def generate(context, builder, _signature, values):
        double, whole = ir.DoubleType(), ir.IntType(64)
        kinds = [double if kind is types.float64 else whole for kind in given]
        function = builder.inttoptr(values[0], ir.FunctionType(whole, kinds).as_pointer())
        return builder.call(function, [builder.extract_value(values[1], i) for i in range(len(given))])

    return signature, generate


_MOTION = lib.POSITION | lib.ANGLE | lib.VELOCITY | lib.ANGULAR_VELOCITY
_PUSHED = _MOTION | lib.FORCE | lib.TORQUE
ROOM = 16  # floats in a lane's row: a body's nine, and more than pymunk's arrays need to never grow
NUMBERS = ROOM << 32  # num = 0 in the lower half of the first word of a pmFloatArray, max in the upper


def prepare(handles: Any, floats: Any, batch: Any, radius: float, holds: list[float | None]) -> list[Any]:
    """Give every lane its robot's circle and one for each thing that can be held; keep the result alive.

    `handles` [lane, …]: the circles go to column 2 and on; `batch` gets pymunk's structures over the rows of `floats`.
    """
    assert ffi.sizeof("pmBatchedData") == 24, "another pymunk: the layout of its batches has changed"
    assert ffi.sizeof("pmFloatArray") == 16, "another pymunk: the layout of its batches has changed"
    kept = []
    for lane in range(len(handles)):
        for i, hold in enumerate([0.0, *holds]):
            if hold is not None:
                shape = lib.cpCircleShapeNew(ffi.NULL, radius if i == 0 else 1.0, (hold, 0.0))
                lib.cpShapeSetFriction(shape, FRICTION)
                lib.cpShapeSetSensor(shape, i > 0)
                kept.append(ffi.gc(shape, lib.cpShapeFree))
                handles[lane, 2 + i] = int(ffi.cast("uintptr_t", shape))
        batch[lane, 0:2] = NUMBERS, floats[lane].ctypes.data
        batch[lane, 2:5] = 0, batch[lane].ctypes.data, _MOTION
        batch[lane, 5:8] = 0, batch[lane].ctypes.data, _PUSHED
    return kept


@compiled
def open_space(t, s, p):
    """A Space with lane p's obstacles and walls, and its robot with the circles that it can hold."""
    c, world, things = t.library, t.world[0], len(t.things)
    space = call(c[SPACE_NEW])
    call(c[SPACE_ITERATIONS], space, ITERATIONS)
    call(c[SPACE_HASH], space, world.cell, HASH_COUNT)
    static = call(c[SPACE_STATIC], space)
    shape = 3 + things
    for b in range(s.boxes.shape[1] // 3):
        box = BOX_COLUMNS * b
        x, y, half = s.boxes[p, box + X], s.boxes[p, box + Y], s.boxes[p, box + HALF_SIDE]
        s.handles[p, shape + b] = add_box(c, space, static, s.floats[p], x - half, y - half, x + half, y + half)
    shape += s.boxes.shape[1] // 3
    if world.half < 1e300:
        a, b = world.half, world.half + 2 * WALL
        s.handles[p, shape] = add_box(c, space, static, s.floats[p], -b, -b, -a, b)
        s.handles[p, shape + 1] = add_box(c, space, static, s.floats[p], a, -b, b, b)
        s.handles[p, shape + 2] = add_box(c, space, static, s.floats[p], -b, -b, b, -a)
        s.handles[p, shape + 3] = add_box(c, space, static, s.floats[p], -b, a, b, b)
    body = call(c[BODY_NEW], world.mass, world.moment)
    call(c[SPACE_ADD_BODY], space, body)
    for i in range(1 + things):
        circle = s.handles[p, 2 + i]
        if circle != 0:
            call(c[SHAPE_BODY], circle, body)
            call(c[SPACE_ADD_SHAPE], space, circle)
    s.handles[p, 0], s.handles[p, 1] = space, body


@compiled
def add_box(c, space, static, corners, left, low, right, high):
    """A solid rectangle that never moves; its shape. `corners` is room for eight floats."""
    corners[0], corners[1], corners[2], corners[3] = left, low, right, low
    corners[4], corners[5], corners[6], corners[7] = right, high, left, high
    shape = call(c[POLY_NEW], static, 4, corners.ctypes.data, 0.0)
    call(c[SHAPE_FRICTION], shape, 1.0)
    call(c[SPACE_ADD_SHAPE], space, shape)
    return shape


@compiled
def close_space(c, handles, circles):
    """Free a lane's Space; its circles, which stand in `handles` after the Space and the body, stay for the next."""
    space, body = handles[0], handles[1]
    if space == 0:
        return
    for i in range(2, len(handles)):
        if handles[i] != 0:
            call(c[SPACE_REMOVE_SHAPE], space, handles[i])
            if i < 2 + circles:
                call(c[SHAPE_BODY], handles[i], 0)
            else:
                call(c[SHAPE_FREE], handles[i])
                handles[i] = 0
    call(c[SPACE_REMOVE_BODY], space, body)
    call(c[BODY_FREE], body)
    call(c[SPACE_FREE], space)
    handles[0], handles[1] = 0, 0


@compiled
def push_body(t, s, p):
    """Lane p's state, force and torque into its body; what the claw holds becomes solid, what it dropped does not."""
    c, row = t.library, s.floats[p]
    for i in range(6):
        row[i] = s.body[i, p]
    row[6], row[7], row[8] = s.push[FORCE_X, p], s.push[FORCE_Y, p], s.push[TORQUE, p]
    s.batch[p, 0] = NUMBERS
    call(c[BODY_SET], s.handles[p, 1], s.batch[p, 5:].ctypes.data)
    for i in range(len(t.things)):
        circle = s.handles[p, 3 + i]
        if circle != 0:
            call(c[SHAPE_SENSOR], circle, 0 if s.held[p] == i else 1)
            if s.held[p] == i:
                call(c[CIRCLE_RADIUS], circle, s.things[THING_ROWS * i + SIZE, p] / 2)


@compiled
def step_space(t, s, p, dt):
    """Step lane p's Space, take its body's state back, and count the contacts."""
    c = t.library
    call(c[SPACE_STEP], s.handles[p, 0], dt)
    s.batch[p, 0] = NUMBERS
    call(c[BODY_GET], s.handles[p, 1], s.batch[p, 2:].ctypes.data)
    for i in range(6):
        s.body[i, p] = s.floats[p, i]
    s.touches[p] = 0
    call(c[EACH_ARBITER], s.handles[p, 1], c[COUNT], s.touches[p:].ctypes.data)
    return s.touches[p]
