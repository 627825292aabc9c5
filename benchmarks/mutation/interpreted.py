"""The lanes in plain Python, as a plugin for pytest: the same bits, and nothing is compiled.

To compile a mutant takes long, to interpret it no time. Compiled numbers differ from Python's in one way that matters:
one with a point is a float64, whatever stands beside it, so each becomes one here. Rows of tables become objects.
"""

import ast
import importlib.abc
import importlib.machinery
import sys
from collections.abc import Sequence
from copy import copy
from dataclasses import replace
from types import ModuleType
from typing import Any

import numpy as np

LANES = "mindrun.sim.lanes."


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
    """Loads a module of the lanes with its numbers as compiled code has them."""

    def exec_module(self, module: ModuleType) -> None:
        doubles = Doubles()
        tree = doubles.visit(ast.parse(self.get_data(self.path)))
        vars(module).update(doubles.values)
        exec(compile(ast.fix_missing_locations(tree), self.path, "exec"), vars(module))


class Finder(importlib.abc.MetaPathFinder):
    """Finds the modules of the lanes."""

    def find_spec(self, name: str, path: Sequence[str] | None, target: ModuleType | None = None) -> Any:
        spec = importlib.machinery.PathFinder.find_spec(name, path) if name.startswith(LANES) else None
        if spec and spec.origin:
            spec.loader = Loader(name, spec.origin)
        return spec


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


def _install() -> None:
    sys.meta_path.insert(0, Finder())
    from mindrun.kinds.registry import kinds
    from mindrun.numbers import arithmetic
    from mindrun.sim import cache, rollout
    from mindrun.sim.units import Unit

    for noun in ("sensor", "skill"):
        for kind in kinds(noun).values():  # their files import what they name for checkers of types alone
            named = kind.lane.__globals__
            named.update(vars(arithmetic) | named)
    Unit.__call__ = lambda unit, *given: unit.function(*given)
    Unit.load = lambda unit: unit.function
    cache.find, cache.is_native = lambda unit: b"", lambda unit: True  # nothing has to be compiled
    build = rollout.build

    def build_rows(*given: Any) -> Any:
        tables, sizes = build(*given)
        records = {name: table for name, table in vars(tables).items() if table.dtype.names}
        return replace(tables, **{name: Rows(map(Row, table)) for name, table in records.items()}), sizes

    rollout.build = build_rows


_install()
