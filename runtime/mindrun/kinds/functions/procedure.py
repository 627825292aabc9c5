"""A procedure: a Python function of the readings."""

from __future__ import annotations

from io import StringIO
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Annotated

from mindrun.errors import ProcedureError, reason
from mindrun.files.regular_files import read_regular, read_whole
from mindrun.kinds.functions.function import Function
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import FUNCTION

if TYPE_CHECKING:
    from mindrun.kinds.procedure_text import Sources
    from mindrun.numbers.arrays import Compute, Weights

MAX_SOURCE_BYTES = 1 << 20  # of source
MAX_FILE_BYTES = 32 << 20  # of a file that a procedure uses


@kind("skill", "procedure")
class Procedure(Function):
    """A Python function `module.function`: one float per reading in, one float (or a tuple) per output out.

    The module stands beside the source, in one file. Its code is run by `train`, `run` and `bench` only, never by
    `check`.
    """

    from_: Annotated[str, FUNCTION]

    opaque = "is Python code"

    @property
    def calls(self) -> str:  # type: ignore[override]
        return self.from_

    def ready(self, inputs: int, outputs: int, weights: Weights, sources: Sources) -> Compute:
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


def is_inside(name: str) -> bool:
    """True if a path that a skill uses is one below a folder, written as everywhere: models/policy.pt."""
    parts = PurePosixPath(name).parts
    return "/".join(parts) == name and not {"/", "..", "."} & {*parts} and "\\" not in name and name.isprintable()


def used_file(calls: str, name: str, folder: Path) -> bytes:
    """The contents of a file that a procedure uses, in a folder or below it; ProcedureError where it has none."""
    path = folder / name
    try:
        if not (is_inside(name) and path.resolve().is_relative_to(folder.resolve())):
            raise ProcedureError(f"procedure from {calls}: {name!r:.200} lies outside {folder}")
        return read_whole(path, MAX_FILE_BYTES)
    except (OSError, RuntimeError, ValueError) as error:
        hint = "What a skill uses is in the folder of the mind, or below it."
        raise ProcedureError(f"procedure from {calls}: cannot read {path} ({reason(error)})", hint) from error
