"""What tests of units share: lanes written for a test, and where their machine code goes."""

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType

import pytest
from mindrun.sim import cache, compiling
from mindrun.sim.units import UNITS, Unit

Write = Callable[..., ModuleType]
NEEDED = """
from dataclasses import dataclass
from types import ModuleType
from typing import Any
import numpy as np
from mindrun.sim.arrays import Block, array
from mindrun.sim.units import AddressOf, Form, Pointer, unit, unit_where
"""


@pytest.fixture
def write(monkeypatch: pytest.MonkeyPatch) -> Iterator[Write]:
    """A function that makes a module of a text, as at the start of a process; its units are gone after the test."""

    def written(text: str, file: str = "written.py") -> ModuleType:
        module = ModuleType("written")
        monkeypatch.setitem(sys.modules, "written", module)
        exec(compile(NEEDED + text, file, "exec"), vars(module))
        return module

    before = dict(UNITS)
    yield written
    UNITS.clear()
    UNITS.update(before)


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder of machine code; nothing was shipped."""
    folder = tmp_path / cache.FOLDER
    folder.mkdir()
    monkeypatch.setattr(cache, "folder", lambda: folder)
    monkeypatch.setattr(cache, "SHIPPED", tmp_path / "shipped")
    return folder


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The names of the units that this process compiles, in their order."""
    names, compile_unit = list[str](), compiling.compile_unit

    def noted(unit: Unit) -> bytes:
        names.append(unit.name)
        return compile_unit(unit)

    monkeypatch.setattr(compiling, "compile_unit", noted)
    return names
