"""The lanes in plain Python, as a plugin for pytest: the same bits, and nothing is compiled.

To compile a mutant takes minutes, to interpret it none. Numba's types differ from Python's in one way that matters: a
number with a point is a float64 there, whatever stands beside it, so each becomes one here. Rows of tables become
objects, intrinsics a line of numpy or of ctypes.
"""

import ast
import ctypes
import importlib
import importlib.abc
import importlib.machinery
import sys
from collections.abc import Sequence
from copy import copy
from types import ModuleType
from typing import Any

import numba
import numba.extending
import numpy as np

ROOM = "mindrun.sim."
VECTOR = f"{ROOM}vector"
VECTOR_LANES = 16
F = np.float32


class Doubles(ast.NodeTransformer):
    """Every number with a point becomes a name for that float64."""

    def __init__(self) -> None:
        self.values: dict[str, np.float64] = {}

    def visit_Constant(self, node: ast.Constant) -> ast.expr:
        if not isinstance(node.value, float):
            return node
        name = f"double_{len(self.values)}"
        self.values[name] = np.float64(node.value)
        return ast.copy_location(ast.Name(name, ast.Load()), node)


class Loader(importlib.machinery.SourceFileLoader):
    """Loads a module of the lanes with its numbers as numba has them."""

    def exec_module(self, module: ModuleType) -> None:
        doubles = Doubles()
        tree = doubles.visit(ast.parse(self.get_data(self.path)))
        vars(module).update(doubles.values)
        exec(compile(ast.fix_missing_locations(tree), self.path, "exec"), vars(module))


class Finder(importlib.abc.MetaPathFinder):
    """Finds what is compiled elsewhere: the lanes and their arithmetic; for vectors what stands for them below."""

    def find_spec(self, name: str, path: Sequence[str] | None, target: ModuleType | None = None) -> Any:
        if not name.startswith((f"{ROOM}lanes.", f"{ROOM}arithmetic", VECTOR)):
            return None
        spec = importlib.machinery.PathFinder.find_spec(name, path)
        if spec and spec.origin:
            spec.loader = Vectors() if name == VECTOR else Loader(name, spec.origin)
        return spec


class Vectors(importlib.abc.Loader):
    """In place of `sim.vector`: sixteen lanes are an array of sixteen."""

    def create_module(self, spec: Any) -> ModuleType | None:
        return None

    def exec_module(self, module: ModuleType) -> None:
        from mindrun.numbers import arithmetic

        plain = {name: getattr(arithmetic, name) for name in ("splat", "broadcast", "load", "store", "sigmoids")}
        vars(module).update(
            plain,
            VECTOR_LANES=arithmetic.LANES,
            HIGHEST=lambda a, b: np.where(a > b, a, b),
            LOWEST=lambda a, b: np.where(a < b, a, b),
            where_ordered=lambda low, high, yes, no: np.where(low <= high, yes, no),
        )


class Row:
    """A row of a table: its columns as Python's numbers where they are whole, as numpy's where they are not."""

    def __init__(self, record: np.void) -> None:
        for name in record.dtype.names or ():
            value = record[name]
            setattr(self, name, int(value) if isinstance(value, np.integer) else value)

    def __getitem__(self, name: str) -> Any:
        return getattr(self, name)


class Rows(list[Row]):
    """A table of rows; its columns by their names are arrays."""

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str):
            return np.array([row[key] for row in self] or np.zeros(0, np.int64))
        found = super().__getitem__(key)
        return Rows(found) if isinstance(key, slice) else found

    def __setitem__(self, key: Any, value: Any) -> None:
        if isinstance(key, str):
            for row in self:
                setattr(row, key, value)
        else:
            super().__setitem__(key, value)

    def copy(self) -> "Rows":
        return Rows(copy(row) for row in self)


def call(address: Any, *arguments: Any) -> int:
    """A C function called with whole numbers, pointers and doubles, as `units.call` does."""
    kinds = [ctypes.c_double if isinstance(a, float) else ctypes.c_uint64 for a in arguments]
    function = ctypes.CFUNCTYPE(ctypes.c_int64, *kinds)(int(address))
    given = [float(a) if kind is ctypes.c_double else int(a) for a, kind in zip(arguments, kinds, strict=True)]
    return int(function(*given))


def _plain(*given: Any, **options: Any) -> Any:
    """In place of numba's decorator: the function as it stands."""
    return given[0] if given else _plain


def _install() -> None:
    importlib.import_module("mindrun.sim.exact")  # what formulas call stays compiled, as they are
    numba.njit = _plain
    sys.meta_path.insert(0, Finder())
    from mindrun.sim import compiling

    compiling.keep_code = lambda dispatcher, code: None
    from mindrun.sim import procedures, rollout

    procedures.call = call
    build = rollout.build

    def build_rows(*given: Any) -> Any:
        found, sizes = build(*given)
        return type(found)(*(Rows(Row(row) for row in part) if part.dtype.names else part for part in found)), sizes

    rollout.build = build_rows


_install()
