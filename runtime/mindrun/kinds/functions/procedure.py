"""A procedure: a Python function of the readings."""

from __future__ import annotations

from collections.abc import Mapping
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from mindrun.errors import ProcedureError, reason
from mindrun.files.regular_files import read_regular
from mindrun.kinds.functions.function import Function
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import FUNCTION

if TYPE_CHECKING:
    from mindrun.numbers.arrays import Compute, Weights

MAX_SOURCE_BYTES = 1 << 20  # of source


@kind("skill", "procedure")
class Procedure(Function):
    """A Python function `module.function`: one float per reading in, one float (or a tuple) per output out.

    The module stands beside the source, in one file. Its code is run by `train`, `run` and `bench` only, never by
    `check`.
    """

    from_: Annotated[str, FUNCTION]

    opaque = "is Python code"

    @property
    def calls(self) -> str:
        """The Python function that it calls, as `module.function`."""
        return self.from_

    def ready(self, inputs: int, outputs: int, weights: Weights, sources: Mapping[str, str]) -> Compute:
        """The Python function, in a module of its own."""
        from mindrun.kinds.procedure_call import RunningProcedure

        return RunningProcedure(self.from_, sources, outputs)


def module_source(calls: str, folder: Path) -> str:
    """The text of a procedure's module, `a.b.f` being in `folder`/a/b.py; nothing is run."""
    parts = calls.split(".")
    if len(parts) < 2 or not all(part.isidentifier() for part in parts):
        raise ProcedureError(f"procedure from {calls}: write it as module.function")
    path = folder.joinpath(*parts[:-1]).with_suffix(".py")
    try:
        if not path.resolve().is_relative_to(folder.resolve()):
            raise ProcedureError(f"procedure from {calls}: {path} lies outside {folder}")
        if len(data := read_regular(path, MAX_SOURCE_BYTES + 1)) > MAX_SOURCE_BYTES:
            raise ProcedureError(f"procedure from {calls}: {path} is larger than 1 MiB")
        return StringIO(data.decode("utf-8-sig"), newline=None).read()
    except (OSError, RuntimeError, UnicodeError) as error:  # a loop of links is a RuntimeError
        raise ProcedureError(f"procedure from {calls}: cannot read {path} ({reason(error)})") from error
