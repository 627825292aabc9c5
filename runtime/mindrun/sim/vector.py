"""A numba type of sixteen float32 lanes as one value: sums stay in registers while a layer is computed.

LLVM makes of it what the processor has: one AVX-512 register, two of AVX2, four of NEON. Every operation rounds like
its scalar twin, so a result does not depend on the width.
"""

import operator
from collections.abc import Callable
from functools import partial
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, models, overload, register_model

from mindrun.numbers.arithmetic import DENOMINATOR, HALF, LANES, LIMIT, NUMERATOR

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


def _address(context: Any, builder: Any, kind: Any, array: Any, row: Any, lane: Any) -> Any:
    return builder.bitcast(_pointer(context, builder, kind, array, row, lane), _VECTOR.as_pointer())


@intrinsic
def load(typingctx, array, row, lane):
    """Sixteen lanes of a row of a float32 array [row, lane], from `lane` on; of a flat one an element, in all lanes."""

    def generate(context, builder, signature, args):
        if array.ndim == 1:
            return _splat(builder, builder.load(_pointer(context, builder, array, *args[:2])))
        return builder.load(_address(context, builder, array, *args), align=4)

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
lowest = _operation(lambda builder, a, b: _chosen(builder, "<", a, b))
highest = _operation(lambda builder, a, b: _chosen(builder, ">", a, b))


@intrinsic
def nearer(typingctx, enter, leave, nearest):
    """`enter` in the lanes where 0 <= enter <= leave and enter < nearest; `nearest` elsewhere, and beside a NaN."""

    def generate(context, builder, signature, args):
        begin, end, known = args
        ahead = builder.fcmp_ordered("<=", ir.Constant(_VECTOR, [0.0] * LANES), begin)
        meets, first = builder.fcmp_ordered("<=", begin, end), builder.fcmp_ordered("<", begin, known)
        return builder.select(builder.and_(builder.and_(ahead, meets), first), begin, known)

    return vector(vector, vector, vector), generate


@intrinsic
def sigmoids(typingctx, *values):
    """1 / (1 + e^−x) of vectors, a rational function of x/2: the arithmetic of `numbers.arithmetic.sigmoid`.

    All vectors take each step before the next one: a step takes the processor four cycles, in which it begins eight.
    """

    def generate(context, builder, signature, args):
        xs = [builder.extract_value(args[0], number) for number in range(len(values))]
        return context.make_tuple(builder, signature.return_type, _sigmoids(builder, xs))

    several = types.UniTuple(vector, len(values))
    return several(types.StarArgTuple(values)), generate


def _sigmoids(builder: Any, xs: Any) -> Any:
    def each(make: Any, *columns: Any) -> Any:
        return [make(*values) for values in zip(*columns, strict=True)]

    def all_of(value: Any) -> Any:
        return [ir.Constant(_VECTOR, [float(value)] * LANES)] * len(xs)

    def polynomial(*coefficients: Any) -> Any:
        top, *rest = map(all_of, reversed(coefficients))
        for coefficient in rest:
            top = each(builder.fadd, each(builder.fmul, top, ys), coefficient)
        return top

    xs = each(builder.fmul, xs, all_of(HALF))
    xs = each(partial(_chosen, builder, ">"), xs, all_of(-LIMIT))
    xs = each(partial(_chosen, builder, "<"), xs, all_of(LIMIT))
    ys = each(builder.fmul, xs, xs)
    above, below = each(builder.fmul, polynomial(*NUMERATOR), xs), polynomial(*DENOMINATOR)
    return each(builder.fadd, all_of(HALF), each(builder.fmul, all_of(HALF), each(builder.fdiv, above, below)))


def _chosen(builder: Any, sign: str, left: Any, right: Any) -> Any:
    """The left number in the lanes where it is larger, or smaller, as the sign says; else the right one."""
    return builder.select(builder.fcmp_ordered(sign, left, right), left, right)
