"""The compiler of units: a function of the lanes with all that it calls, as one piece of machine code.

The lanes are plain Python. Here every function that one of them calls becomes a function of numba's, a unit a call
through its slot, and what stands for sixteen lanes a vector; numba lowers them, LLVM makes machine code of the whole.
"""

from collections.abc import Callable
from functools import cache
from types import FunctionType
from typing import Any

import numba
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.typing.templates import AttributeTemplate
from numba.extending import infer_getattr, intrinsic, lower_getattr_generic, models, register_model
from numba.np.numpy_support import from_dtype

from mindrun.numbers import arithmetic
from mindrun.sim import units, vector
from mindrun.sim.arrays import WORD_BYTES, Block, Room
from mindrun.sim.dependencies import used
from mindrun.sim.machine_code import machine_code
from mindrun.sim.numba_internals import InnerCompiler, lowered, rare_collections
from mindrun.sim.units import AddressOf, Form, Kind, Pointer, Unit

# They own no array and make none. With `_nrt` numba would count the references of all that they are handed, at every
# call: half of the time of a tick.
OPTIONS = {"nogil": True, "error_model": "numpy", "_nrt": False}
PIPELINE = {"pipeline_class": InnerCompiler, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
INLINED = {
    arithmetic.bearing, arithmetic.clamp, arithmetic.finite, arithmetic.nearest, arithmetic.sine_cosine,
    arithmetic.short_way, arithmetic.wrapped,
}  # fmt: skip
WORD, BYTES = ir.IntType(64), ir.IntType(8).as_pointer()


def compile_unit(unit: Unit) -> bytes:
    """The machine code of a unit, an object file with a function of the unit's name."""
    with rare_collections():
        signature = _numba_type(unit.form.gives)(*map(_numba_type, unit.form.takes))
        module = lowered(_compiled(unit.function), signature, lambda *given: _for_c(unit, *given))
        return machine_code(module, unit.name)


def _for_c(unit: Unit, context: Any, module: Any, description: Any) -> None:
    """Add a function of C to a module, which calls a function of numba's; where that raises, the process ends."""
    kinds = [context.get_value_type(kind) for kind in description.argtypes]
    gives = ir.VoidType() if unit.form.gives is None else context.get_value_type(description.restype)
    convention = context.call_conv.get_function_type(description.restype, description.argtypes)
    callee = ir.Function(module, convention, description.llvm_func_name)
    builder = ir.IRBuilder(ir.Function(module, ir.FunctionType(gives, kinds), unit.name).append_basic_block())
    given = builder.function.args
    status, result = context.call_conv.call_function(builder, callee, description.restype, description.argtypes, given)
    with builder.if_then(status.is_error, likely=False):  # it has raised, which nobody would notice
        builder.call(builder.module.declare_intrinsic("llvm.trap", (), ir.FunctionType(ir.VoidType(), [])), [])
    builder.ret_void() if unit.form.gives is None else builder.ret(result)


@cache
def _compiled(function: Any) -> Any:
    """A function of the lanes as numba's, with all that it calls."""
    terms = {name: _term(value) for name, value in used(function) if value is not function}
    plain = FunctionType(function.__code__, terms, function.__name__, function.__defaults__)
    plain.__module__, plain.__qualname__ = function.__module__, function.__qualname__
    if function in INLINED:
        return numba.njit(inline="always", **OPTIONS)(plain)
    return numba.njit(**PIPELINE, **OPTIONS)(plain)


def _term(value: Any) -> Any:
    """The value that compiled code has for a name of the lanes."""
    match value:
        case Unit():
            return _calling(value.form, value)
        case AddressOf():
            return _address_of(value)
        case Form():
            return _calling(value, None)
        case FunctionType():
            found = VECTORS.get(value, value)
            return _compiled(found) if isinstance(found, FunctionType) else found
    return value


# Types


class BlockType(types.Type):  # type: ignore[misc]
    """The type of a pointer to a block; its name is a part of every name in the machine code, and short."""

    def __init__(self, kind: type[Block]) -> None:
        self.kind = kind
        super().__init__(kind.__name__)

    @property
    def key(self) -> Any:
        """By this numba tells types apart: two kinds may have one name."""
        return self.kind


@register_model(BlockType)
class _BlockModel(models.PrimitiveModel):  # type: ignore[misc]
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, BYTES)


@cache
def _numba_type(kind: Kind) -> Any:
    """Numba's type of a kind of argument."""
    if kind is None:
        return types.none
    if kind is Pointer:
        return types.CPointer(types.int64)
    if isinstance(kind, Room):
        return types.Array(from_dtype(kind.dtype), kind.dimensions, "C")
    if isinstance(kind, type) and issubclass(kind, Block):
        return BlockType(kind)
    return {int: types.int64, float: types.float64}.get(kind) or from_dtype(kind)


@infer_getattr
class _BlockAttributes(AttributeTemplate):  # type: ignore[misc]
    key = BlockType

    def generic_resolve(self, kind: Any, name: str) -> Any:
        found = kind.kind.layout().get(name)
        return _numba_type(found[1]) if found else None


@lower_getattr_generic(BlockType)  # type: ignore[untyped-decorator]
def _get(context: Any, builder: Any, kind: Any, value: Any, name: str) -> Any:
    """An array made of its words, or the place of an inner block."""
    place, what = kind.kind.layout()[name]
    start = builder.gep(value, [ir.Constant(WORD, place * WORD_BYTES)])
    if not isinstance(what, Room):
        return start
    address, *shape = (_word(builder, start, number) for number in range(what.words))
    made, size = _numba_type(what), ir.Constant(WORD, what.dtype.itemsize)
    strides, step = list[Any](), size
    for count in reversed(shape):
        strides.insert(0, step)
        step = builder.mul(step, count)
    array = cgutils.create_struct_proxy(made)(context, builder)
    array.data = builder.inttoptr(address, array.data.type)
    array.shape, array.strides = (cgutils.pack_array(builder, each) for each in (shape, strides))
    array.itemsize, array.nitems = size, builder.sdiv(step, size) if len(shape) > 1 else shape[0]
    array.meminfo, array.parent = (ir.Constant(each.type, None) for each in (array.meminfo, array.parent))
    return array._getvalue()


def _word(builder: Any, start: Any, number: int) -> Any:
    """A word of a block, which nothing changes."""
    place = builder.gep(start, [ir.Constant(WORD, number * WORD_BYTES)])
    word = builder.load(builder.bitcast(place, WORD.as_pointer()))
    word.set_metadata("invariant.load", builder.module.add_metadata([]))
    return word


# Calls


def _address_in_slot(builder: Any, unit: Unit) -> Any:
    known = builder.module.globals
    return builder.load(known.get(unit.slot_name) or ir.GlobalVariable(builder.module, WORD, unit.slot_name))


@cache
def _calling(form: Form, unit: Unit | None) -> Any:
    """A call of a unit, or of the one of which the first argument is the address of its slot."""

    @intrinsic  # type: ignore[untyped-decorator]
    def call_unit(typingctx: Any, *given: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            each = [builder.extract_value(values[0], number) for number in range(len(given))]
            if unit is None:
                address = builder.load(builder.inttoptr(each.pop(0), WORD.as_pointer()))
            else:
                address = _address_in_slot(builder, unit)
            return _call(context, builder, address, form, given[-len(each) :], each)

        return _numba_type(form.gives)(types.StarArgTuple(given)), generate

    return call_unit


@cache
def _address_of(of: AddressOf) -> Any:
    """The address of a unit."""

    @intrinsic  # type: ignore[untyped-decorator]
    def address(typingctx: Any) -> Any:
        return types.uint64(), lambda context, builder, signature, values: _address_in_slot(builder, of.unit)

    return address


def _call(context: Any, builder: Any, address: Any, form: Form, given: Any, values: Any) -> Any:
    """Call the function of C at an address with some values, whose types are `given`."""
    kinds = map(_numba_type, form.takes)
    cast = [context.cast(builder, *each) for each in zip(values, given, kinds, strict=True)]
    gives = ir.VoidType() if form.gives is None else context.get_value_type(_numba_type(form.gives))
    function = ir.FunctionType(gives, [value.type for value in cast]).as_pointer()
    result = builder.call(builder.inttoptr(address, function), cast)
    return context.get_dummy_value() if form.gives is None else result


def _c_function(gives: Any, of_result: Any) -> Any:
    """A call of the C function at an address with whole numbers, pointers and doubles."""

    @intrinsic  # type: ignore[untyped-decorator]
    def call_address(typingctx: Any, address: Any, *arguments: Any) -> Any:
        given = tuple(types.float64 if isinstance(a, types.Float) else types.uint64 for a in arguments)

        def generate(context: Any, builder: Any, _signature: Any, values: Any) -> Any:
            double = ir.DoubleType()
            kinds = [double if kind is types.float64 else WORD for kind in given]
            function = builder.inttoptr(values[0], ir.FunctionType(of_result, kinds).as_pointer())
            return builder.call(function, [builder.extract_value(values[1], i) for i in range(len(given))])

        return gives(types.uint64, types.StarArgTuple(given)), generate

    return call_address


VECTORS: dict[Callable[..., Any], Any] = {
    units.call: _c_function(types.uint64, WORD),
    units.call_double: _c_function(types.float64, ir.DoubleType()),
    arithmetic.sigmoids: vector.sigmoids,
    arithmetic.splat: vector.splat,
    arithmetic.load: vector.load,
    arithmetic.store: vector.store,
    arithmetic.highest: vector.highest,
    arithmetic.lowest: vector.lowest,
    arithmetic.nearer: vector.nearer,
}
