"""The internals of Chipmunk and of the library that pymunk ships, held against pymunk 7.2 and 7.3 (`versions`).

Compiled code calls its functions by their addresses, and pymunk's batches carry a body's state there and back: only
pointers, whole numbers and doubles cross. `tests/sim` holds it against a loop of plain pymunk, bit for bit.
"""

import ctypes
from collections.abc import Mapping
from typing import Any

import numpy as np
from pymunk import _chipmunk

from mindrun.errors import MindError
from mindrun.kinds.bodies.body import FRICTION_COEFFICIENT, BodyKind
from mindrun.sim.units import AddressOf, Pointer, call, unit
from mindrun.sim.versions import remedy

ffi, lib = _chipmunk.ffi, _chipmunk.lib

UNMOVED_TRANSFORM = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)  # leaves a shape where it is
PERSISTENCE_TICKS = 3  # for which Chipmunk remembers a contact that is no more
LAYOUT: Mapping[str, tuple[int, Mapping[str, int]]] = {  # the size of a structure and where its fields stand, in bytes
    "pmFloatArray": (16, {"num": 0, "max": 4, "arr": 8}),
    "pmIntArray": (16, {"num": 0, "max": 4, "arr": 8}),
    "pmBatchedData": (24, {"intArray": 0, "floatArray": 8, "fields": 16}),
}

# The functions in use. Their addresses travel in a table: compiled code that held them could not be cached.
FUNCTIONS = (
    "cpSpaceNew", "cpSpaceFree", "cpSpaceSetIterations", "cpSpaceUseSpatialHash", "cpSpaceGetStaticBody",
    "cpSpaceAddBody", "cpSpaceAddShape", "cpSpaceRemoveBody", "cpSpaceRemoveShape", "cpSpaceStep", "cpBodyNew",
    "cpBodyFree", "cpPolyShapeNewRaw", "cpShapeFree", "cpShapeSetBody", "cpShapeSetFriction", "cpShapeSetSensor",
    "cpCircleShapeSetRadius", "pmSpaceBodyGetIteratorFuncBatched", "pmSpaceBodySetIteratorFuncBatched",
    "cpBodyEachArbiter", "cpArbiterGetBodies", "cpCircleShapeNew", "cpPolyShapeSetVertsRaw", "cpBodySetMass",
    "cpBodySetMoment", "cpSpaceSetCollisionSlop",
)  # fmt: skip
C_FUNCTIONS = ("pow", "sincos")  # which Chipmunk calls
(
    SPACE_NEW, SPACE_FREE, SPACE_ITERATIONS, SPACE_HASH, SPACE_STATIC, SPACE_ADD_BODY, SPACE_ADD_SHAPE,
    SPACE_REMOVE_BODY, SPACE_REMOVE_SHAPE, SPACE_STEP, BODY_NEW, BODY_FREE, POLY_NEW, SHAPE_FREE, SHAPE_BODY,
    SHAPE_FRICTION, SHAPE_SENSOR, CIRCLE_RADIUS, BODY_GET, BODY_SET, EACH_ARBITER,
    ARBITER_BODIES, CIRCLE_NEW, POLY_CORNERS, BODY_MASS, BODY_MOMENT, SPACE_SLOP, POWER, SINE_COSINE,
) = range(len(FUNCTIONS) + 2)  # fmt: skip

# Columns of `handles`; after the shapes that can be held come the boxes, then the walls.
SPACE, BODY, ROBOT, FIRST_HELD = range(4)
LOOSE_BODY, LOOSE_SHAPE, LOOSE_HANDLES = range(3)  # of each loose thing, and how many
WALL_COUNT = 4
BODY_FLOATS = 16  # of a lane: a body has nine, in the order of its fields; with so many pymunk's arrays never grow
MOTION_FIELDS = ("POSITION", "ANGLE", "VELOCITY", "ANGULAR_VELOCITY")  # six floats, as the rows of a body
PUSH_FIELDS = ("FORCE", "TORQUE")
MOTION_FLOATS = 6
FLOAT_FORCE_X, FLOAT_FORCE_Y, FLOAT_TORQUE = 6, 7, 8  # where they stand behind the motion
# Words of a lane's `batch`: a pmFloatArray, then a pmBatchedData over it for what is got and one for what is set.
ARRAY_NUMBERS, ARRAY_FLOATS, GET_BATCH, SET_BATCH, BATCH_WORDS = 0, 1, 2, 5, 8
EMPTY_ARRAY = BODY_FLOATS << 32  # num = 0 in the lower half of an array's first word, max in the upper
# Words of a lane's `tally`: contacts with what never moves, the function that says which bodies an arbiter is of, where
# it puts them, the addresses of these two places, and the body that never moves.
TALLIED, BODIES_OF, FIRST_BODY, SECOND_BODY, FIRST_PLACE, SECOND_PLACE, FIXED_BODY, TALLY_WORDS = range(8)


def refuse_another() -> None:
    """Raise MindError where the library that pymunk ships is not the one that is known here."""
    names = (*FUNCTIONS, *MOTION_FIELDS, *PUSH_FIELDS)
    if not (
        all(hasattr(lib, name) for name in names)
        and all(_layout(structure) == known for structure, known in LAYOUT.items())
        and lib.cpSpaceGetCollisionPersistence(ffi.gc(lib.cpSpaceNew(), lib.cpSpaceFree)) == PERSISTENCE_TICKS
    ):
        raise MindError("the Chipmunk that pymunk ships here is not the one that the simulator knows", remedy("pymunk"))


def _layout(structure: str) -> tuple[int, Mapping[str, int]] | None:
    try:
        return ffi.sizeof(structure), {name: field.offset for name, field in ffi.typeof(structure).fields}
    except (ffi.error, TypeError):  # there is none, or nobody may see its fields
        return None


def library() -> Any:
    """The addresses of FUNCTIONS, and of those of the C library, 0 where it has none: uint64."""
    refuse_another()
    addresses = [int(ffi.cast("uintptr_t", ffi.addressof(lib, name))) for name in FUNCTIONS]
    return np.array([*addresses, *map(_address_in_c, C_FUNCTIONS)], np.uint64)


def _address_in_c(name: str) -> int:
    try:
        return ctypes.cast(getattr(ctypes.CDLL(None), name), ctypes.c_void_p).value or 0
    except (AttributeError, OSError, TypeError):
        return 0


@unit
def count(_body: int, arbiter: int, tally: Pointer) -> None:
    """Count a contact of a body with what never moves, for Chipmunk, which calls it for each."""
    call(tally[BODIES_OF], arbiter, tally[FIRST_PLACE], tally[SECOND_PLACE])
    if tally[FIRST_BODY] == tally[FIXED_BODY] or tally[SECOND_BODY] == tally[FIXED_BODY]:
        tally[TALLIED] += 1


count_address = AddressOf(count)


def prepare(handles: Any, floats: Any, batch: Any, tally: Any, body: BodyKind, holds: list[float | None]) -> list[Any]:
    """Give every lane its robot's shape and a circle for each thing that can be held; keep the result alive.

    `handles` [lane, …]: the shapes go to column ROBOT and on; `batch` gets pymunk's structures over `floats`, and
    `tally` [lane, TALLY_WORDS] what it takes to count.
    """
    kept, motion = [], _fields(MOTION_FIELDS)
    for lane in range(len(handles)):
        for number, hold in enumerate([0.0, *holds]):
            if hold is not None:
                shape = lib.cpCircleShapeNew(ffi.NULL, 1.0, (hold, 0.0)) if number else _outline(body)
                lib.cpShapeSetFriction(shape, FRICTION_COEFFICIENT if number else body.friction)
                lib.cpShapeSetSensor(shape, number > 0)
                kept.append(ffi.gc(shape, lib.cpShapeFree))
                handles[lane, ROBOT + number] = int(ffi.cast("uintptr_t", shape))
        here = batch[lane].ctypes.data
        batch[lane, ARRAY_NUMBERS], batch[lane, ARRAY_FLOATS] = EMPTY_ARRAY, floats[lane].ctypes.data
        batch[lane, GET_BATCH : GET_BATCH + 3] = 0, here, motion
        batch[lane, SET_BATCH : SET_BATCH + 3] = 0, here, motion | _fields(PUSH_FIELDS)
        tally[lane, BODIES_OF] = int(ffi.cast("uintptr_t", ffi.addressof(lib, "cpArbiterGetBodies")))
        tally[lane, FIRST_PLACE] = tally[lane, FIRST_BODY:].ctypes.data
        tally[lane, SECOND_PLACE] = tally[lane, SECOND_BODY:].ctypes.data
    return kept


def _outline(body: BodyKind) -> Any:
    """A new Chipmunk shape of a body, in no Space yet."""
    if not body.outline:
        return lib.cpCircleShapeNew(ffi.NULL, body.radius, (0.0, 0.0))
    return lib.cpPolyShapeNew(ffi.NULL, len(body.outline), body.outline, UNMOVED_TRANSFORM, 0.0)


def _fields(names: tuple[str, ...]) -> int:
    return sum(getattr(lib, name) for name in names)  # a bit each
