"""A numba type of sixteen float32 lanes as one value: sums stay in registers while a layer is computed.

LLVM makes of it what the processor has: one AVX-512 register, two of AVX2, four of NEON. Every operation rounds like
its scalar twin, so a result does not depend on the width.
"""

import operator
from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, models, overload, register_model

from mindrun.numbers.arithmetic import A1, A3, A5, A7, A9, A11, A13, B0, B2, B4, B6, HALF, LANES, SIGMOID_LIMIT

_FLOAT = ir.FloatType()
_VECTOR = ir.VectorType(_FLOAT, LANES)


class Vector(types.Type):
    """The type of sixteen float32 lanes."""

    def __init__(self) -> None:
        super().__init__("Vector")


vector = Vector()


@register_model(Vector)
class _VectorModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, _VECTOR)


def _splat(builder: Any, value: Any) -> Any:
    first = builder.insert_element(ir.Constant(_VECTOR, ir.Undefined), value, ir.Constant(ir.IntType(32), 0))
    zeros = ir.Constant(ir.VectorType(ir.IntType(32), LANES), [0] * LANES)
    return builder.shuffle_vector(first, ir.Constant(_VECTOR, ir.Undefined), zeros)


@intrinsic
def splat(typingctx, value):
    """A vector with one number in every lane."""
    return vector(types.float32), lambda context, builder, signature, args: _splat(builder, args[0])


def _pointer(context: Any, builder: Any, kind: Any, array: Any, *indices: Any) -> Any:
    """A pointer to an element of an array; indices are not checked for being negative."""
    view = context.make_array(kind)(context, builder, array)
    return cgutils.get_item_pointer(context, builder, kind, view, indices, wraparound=False)


@intrinsic
def broadcast(typingctx, array, index):
    """An element of a flat float32 array in every lane."""

    def generate(context, builder, signature, args):
        return _splat(builder, builder.load(_pointer(context, builder, signature.args[0], *args)))

    return vector(array, types.intp), generate


def _address(context: Any, builder: Any, kind: Any, array: Any, row: Any, lane: Any) -> Any:
    return builder.bitcast(_pointer(context, builder, kind, array, row, lane), _VECTOR.as_pointer())


@intrinsic
def load(typingctx, array, row, lane):
    """Sixteen lanes of a row of a float32 array [row, lane], from `lane` on."""

    def generate(context, builder, signature, args):
        where = _address(context, builder, signature.args[0], *args)
        return builder.load(where, align=4)

    return vector(array, types.intp, types.intp), generate


@intrinsic
def store(typingctx, array, row, lane, value):
    """Write sixteen lanes into a row of a float32 array [row, lane], from `lane` on."""

    def generate(context, builder, signature, args):
        where = _address(context, builder, signature.args[0], *args[:3])
        builder.store(args[3], where, align=4)
        return context.get_dummy_value()

    return types.void(array, types.intp, types.intp, vector), generate


def _operation(make: Callable[[Any, Any, Any], Any], sign: Any = None) -> Any:
    """An operation on two vectors; compiled code may write it as `sign`."""

    @intrinsic
    def operate(typingctx, left, right):
        return vector(vector, vector), lambda context, builder, signature, args: make(builder, *args)

    def choose(left, right):
        return (lambda left, right: operate(left, right)) if left is vector and right is vector else None

    if sign:
        overload(sign)(choose)
    return operate


_operation(lambda builder, a, b: builder.fadd(a, b), operator.add)
_operation(lambda builder, a, b: builder.fmul(a, b), operator.mul)
_operation(lambda builder, a, b: builder.fdiv(a, b), operator.truediv)
_operation(lambda builder, a, b: builder.fsub(a, b), operator.sub)
lowest = _operation(lambda builder, a, b: builder.select(builder.fcmp_ordered("<", a, b), a, b))
highest = _operation(lambda builder, a, b: builder.select(builder.fcmp_ordered(">", a, b), a, b))


@intrinsic
def where_ordered(typingctx, low, high, yes, no):
    """`yes` in the lanes where low <= high, `no` in the others and where either is NaN."""

    def generate(context, builder, signature, args):
        return builder.select(builder.fcmp_ordered("<=", args[0], args[1]), args[2], args[3])

    return vector(vector, vector, vector, vector), generate


def sigmoids(x):
    """1 / (1 + e^−x) in sixteen lanes, a rational function of x/2: the arithmetic of `numbers.arithmetic.sigmoid`."""
    half = splat(HALF)
    x = x * half
    x = highest(x, splat(-SIGMOID_LIMIT))
    x = lowest(x, splat(SIGMOID_LIMIT))
    y = x * x
    p = splat(A13)
    p = p * y + splat(A11)
    p = p * y + splat(A9)
    p = p * y + splat(A7)
    p = p * y + splat(A5)
    p = p * y + splat(A3)
    p = p * y + splat(A1)
    p = p * x
    q = splat(B6)
    q = q * y + splat(B4)
    q = q * y + splat(B2)
    q = q * y + splat(B0)
    return half + half * (p / q)
