"""Units of machine code: functions of the lanes that are each compiled by themselves, and called by their addresses.

A unit is a function of C of blocks and numbers. Python calls it as any function; another unit calls it through its
**slot**, where its address stands. Where nobody has compiled it before, its first call does.
"""

import ctypes
import inspect
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass
from threading import RLock
from typing import Any, ClassVar, Protocol

import numpy as np

from mindrun.sim.arrays import Block

FAILED_CODE = 70  # EX_SOFTWARE of sysexits.h
WORD_BITS = 64
LOCK = RLock()  # of the threads of this process: one at a time finds or makes machine code
Kind = Any  # of an argument: int, float, Pointer, a class of blocks, or the dtype of a table for one of its rows
Needed = Callable[[Any], bool]  # of tables


class Pointer(Protocol):
    """The kind of an argument that is the address of whole numbers."""

    def __getitem__(self, place: int, /) -> int: ...
    def __setitem__(self, place: int, number: int, /) -> None: ...


C_TYPES: dict[Any, Any] = {
    int: ctypes.c_int64, float: ctypes.c_double, None: None, Pointer: ctypes.POINTER(ctypes.c_int64),
}  # fmt: skip


@dataclass(frozen=True)
class Form:
    """How a unit is called: the kinds of its arguments and of its result. Calls one by the address of its slot."""

    takes: tuple[Kind, ...]
    gives: Kind

    def __call__(self, place: Any, *given: Any) -> Any:
        return next(each for each in UNITS.values() if each.place == int(place)).function(*given)


class Unit:
    """A function that is compiled by itself. It is called with blocks and numbers; no row can be handed to it."""

    address_of: "ClassVar[Callable[[Unit], int]]"  # of machine code, loaded now: `cache`, which imports this, says how

    def __init__(self, function: Any, form: Form, needed: Needed) -> None:
        self.function, self.form, self.needed = function, form, needed
        self.name = f"{function.__module__}.{function.__qualname__}"
        self.slot_name = f"slot of {self.name}"  # in the machine code of others
        self._prototype = ctypes.CFUNCTYPE(C_TYPES[form.gives], *(C_TYPES.get(k, ctypes.c_void_p) for k in form.takes))
        self._loaded: Any = None
        self._loads = self._prototype(self._load_and_call)
        # Here stands the address of its machine code, and before that is loaded of a function that loads and calls it.
        self._slot = np.array([ctypes.cast(self._loads, ctypes.c_void_p).value], np.uint64)
        self.place = int(self._slot.ctypes.data)
        UNITS[self.name] = self

    def __call__(self, *given: Any) -> Any:
        function = self._loaded or self.load()
        return function(*[_handed(*pair) for pair in zip(given, self.form.takes, strict=True)])

    def load(self) -> Any:
        """The machine code as a function of C; it is made where it is not kept."""
        with LOCK:
            if self._loaded is None:
                self._slot[0] = address = Unit.address_of(self)
                self._loaded = self._prototype(address)
        return self._loaded

    def _load_and_call(self, *given: Any) -> Any:
        try:
            return self.load()(*given)
        except BaseException as error:  # C knows no exceptions, and to go on would be wrong
            try:
                print(f"{self.name} cannot be compiled: {error!r}", file=sys.stderr, flush=True)
            finally:  # though nobody may hear it
                os._exit(FAILED_CODE)


@dataclass(frozen=True)
class AddressOf:
    """The address of a unit, to be handed to a library that calls it."""

    unit: Unit

    def __call__(self) -> int:
        return ctypes.c_uint64.from_address(self.unit.place).value


UNITS: dict[str, Unit] = {}


def _handed(given: Any, kind: Kind) -> Any:
    """An argument as C takes it. TypeError where it is of another kind, or would be cut off."""
    if kind is float:
        return float(given)
    if kind is int:
        if (number := int(given)) != given or number.bit_length() >= WORD_BITS:
            raise TypeError(f"{given} is no whole number of {WORD_BITS} bits")
        return number
    if isinstance(kind, type) and issubclass(kind, Block):
        if not isinstance(given, kind):
            raise TypeError(f"{type(given).__name__} where {kind.__name__} is declared")
        return given.address
    return given


def unit(function: Any) -> Any:
    """A unit of a function, whose annotations say how it is called."""
    return unit_where(lambda tables: True)(function)


def seldom(tables: Any) -> bool:
    """No tables need it: it is compiled where it is called."""
    return False


def unit_where(needed: Needed) -> Callable[[Any], Any]:
    """A unit that only some tables need: it is not compiled ahead for others."""

    def make(function: Any) -> Unit:
        said = inspect.get_annotations(function)
        gives = said.pop("return", None)
        return Unit(function, Form(tuple(said.values()), gives), needed)

    return make


def call(address: Any, *arguments: Any) -> int:
    """Call the C function at an address with whole numbers, pointers and doubles; its result as a whole number."""
    kinds = [ctypes.c_double if isinstance(a, float) else ctypes.c_uint64 for a in arguments]
    function = ctypes.CFUNCTYPE(ctypes.c_int64, *kinds)(int(address))
    given = [float(a) if kind is ctypes.c_double else int(a) for a, kind in zip(arguments, kinds, strict=True)]
    return int(function(*given))


def call_double(address: Any, *arguments: Any) -> float:
    """Call the C function of doubles at an address; its result."""
    function = ctypes.CFUNCTYPE(ctypes.c_double, *[ctypes.c_double] * len(arguments))(int(address))
    return float(function(*map(float, arguments)))
