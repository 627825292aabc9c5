"""What the machine code of a unit depends on: the functions that it calls, what these name, and the compiler.

Of another unit that it calls only how that is called. So what is changed elsewhere, a comment or a docstring leaves its
machine code as it is.
"""

import sys
from collections.abc import Iterable, Mapping
from dis import get_instructions
from functools import cache
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np

from mindrun.numbers import arithmetic
from mindrun.sim.arrays import Block, Room
from mindrun.sim.units import UNITS, AddressOf, Form, Unit

VERSIONS = "numba", "llvmlite", "numpy"
COMPILER = "arrays", "compiling", "machine_code", "numba_internals", "vector"  # files of this folder
CONSTANTS = (int, float, np.generic, np.ndarray, tuple, list, type)  # of a module
HASH_DIGITS = 16  # hexadecimal


def needed_units(entries: Iterable[Unit], tables: Any) -> list[Unit]:
    """These units and all that they call under some tables, those of kinds among them."""
    skills = tables.skills["lane"][tables.skills["address"] == 0]
    rows = np.concatenate([tables.sensors["lane"], skills, tables.memories["lane"]])
    places, found, waiting = {*rows.tolist()}, dict[Unit, None](), [*entries]
    waiting += [each for each in [*UNITS.values()] if each.place in places]
    while waiting:
        each = waiting.pop()
        if each not in found and each.needed(tables):
            found[each] = None
            waiting += called(each)
    return [*found]


@cache
def called(unit: Unit) -> tuple[Unit, ...]:
    """The units that a unit calls, or hands to a library."""
    values = [value for function in functions(unit.function) for _, value in used(function)]
    return tuple(v.unit if isinstance(v, AddressOf) else v for v in values if isinstance(v, Unit | AddressOf))


@cache
def functions(function: FunctionType) -> tuple[FunctionType, ...]:
    """A function and all functions that it calls, each once."""
    found, waiting = dict[FunctionType, None](), [function]
    while waiting:
        each = waiting.pop()
        if each not in found:
            found[each] = None
            waiting += [value for _, value in used(each) if isinstance(value, FunctionType)]
    return tuple(found)


@cache
def used(function: FunctionType) -> tuple[tuple[str, Any], ...]:
    """The global names that a function uses, with their values: its file's, else those of `numbers.arithmetic`."""
    known = vars(arithmetic) | function.__globals__
    return tuple((name, known[name]) for name in sorted(_names(function.__code__) & known.keys()))


def _names(code: CodeType) -> set[str]:
    """The names of global variables in some code, and in what is written inside of it."""
    inner = [each for each in code.co_consts if isinstance(each, CodeType)]
    return {each.argval for each in get_instructions(code) if each.opname == "LOAD_GLOBAL"}.union(*map(_names, inner))


@cache
def fingerprint(unit: Unit) -> str:
    """A hash of all that its machine code depends on but the processor."""
    said = [_compiler(), unit.name, _form(unit.form), *map(_of_function, functions(unit.function))]
    return sha256("\n".join(said).encode()).hexdigest()[:HASH_DIGITS]


@cache
def _compiler() -> str:
    sources = [Path(__file__).with_name(f"{name}.py").read_text("utf-8") for name in COMPILER]
    return "\n".join([str(sys.implementation.cache_tag), *map(version, VERSIONS), *sources])


@cache
def _of_function(function: FunctionType) -> str:
    """The code of a function, and what it names; of a function among these the name alone."""
    values = [f"{name} {_value(value, function)}" for name, value in used(function)]
    code = _code(function.__code__, function.__doc__)
    return f"{function.__module__}.{function.__qualname__} {function.__defaults__} {code} {values}"


def _code(code: CodeType, docstring: str | None = None) -> str:
    """Some code without its docstring, its lines and its file."""
    constants = [_code(each) if isinstance(each, CodeType) else repr(each) for each in code.co_consts]
    if docstring is not None and code.co_consts[0] == docstring:
        constants[0] = ""
    return f"{code.co_code.hex()} {constants} {code.co_names} {code.co_varnames}"


def _value(value: Any, function: FunctionType) -> str:
    match value:
        case FunctionType():
            return value.__qualname__
        case Unit():
            return f"{value.name} {_form(value.form)}"
        case AddressOf():
            return value.unit.name
        case Form():
            return _form(value)
        case ModuleType():  # its numbers and types
            named = {name: getattr(value, name, None) for name in sorted({*function.__code__.co_names})}
            return str({name: _value(found, function) for name, found in named.items() if isinstance(found, CONSTANTS)})
        case np.generic():
            return f"{value.dtype} {value}"
        case np.ndarray():
            return f"{value.dtype} {value.shape} {sha256(value.tobytes()).hexdigest()}"
        case tuple() | list():
            return str([_value(each, function) for each in value])
    return repr(value)


def _form(form: Form) -> str:
    return f"{[*map(_kind, form.takes)]} {_kind(form.gives)}"


@cache
def _kind(kind: Any) -> str:
    """An argument's kind, with where everything stands in it."""
    if isinstance(kind, Room):
        return f"{_kind(kind.dtype)} {kind.dimensions}"
    if isinstance(kind, np.dtype):
        return str(kind)
    if isinstance(kind, type) and issubclass(kind, Block):
        fields: Mapping[str, tuple[int, Any]] = kind.layout()
        return str({name: (place, _kind(each)) for name, (place, each) in fields.items()})
    return str(kind)
