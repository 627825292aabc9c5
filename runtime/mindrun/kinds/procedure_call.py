"""Running procedures: their modules are executed, and their functions called with readings."""

import os
import sys
from collections.abc import Callable
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from shutil import rmtree
from tempfile import mkdtemp
from traceback import walk_tb
from types import CodeType, ModuleType
from typing import Any
from warnings import catch_warnings
from weakref import finalize

import numpy as np

from mindrun.errors import ProcedureError, system_errors_as
from mindrun.kinds.procedure_text import FILES, Sources, examine, file_of, module_of
from mindrun.numbers.arrays import Singles
from mindrun.numbers.given_numbers import number, values


class RunningProcedure:
    """A procedure of one run: its function, from a module that is executed anew for each run."""

    def __init__(self, calls: str, sources: Sources, outputs: int) -> None:
        self.calls, self.sources, self.outputs = calls, sources, outputs
        self.function, self.was_called = load(calls, sources), False

    def reset(self) -> None:
        """Run the module anew, if the function has been called, so that it remembers nothing."""
        if self.was_called:
            self.function, self.was_called = load(self.calls, self.sources), False

    def __call__(self, inputs: Singles) -> Singles:
        """The function's outputs [outputs] for inputs [inputs], before the clamp."""
        self.was_called = True
        return call(self.calls, self.function, self.outputs, inputs)


def load(calls: str, sources: Sources) -> Callable[..., Any]:
    """Run a procedure's module, from its text by dotted name, and give the function."""
    source = sources.get(module_of(calls))
    if not isinstance(source, str):
        raise ProcedureError(f"procedure from {calls}: there is no module {module_of(calls)}")
    files = tuple((name.removeprefix(FILES), data) for name, data in sources.items() if isinstance(data, bytes))
    examine(calls, source, bool(files))
    path, digest = file_of(calls), sha256(source.encode()).hexdigest()[:12]
    module = ModuleType(f"_mind_{module_of(calls).replace('.', '_')}_{digest}")
    sys.modules[module.__name__] = module  # dataclasses look their module up
    if files:
        with system_errors_as(ProcedureError, f"procedure from {calls}: its files cannot be written"):
            module.__file__ = str(_folder_of(files) / path)
    try:
        exec(_code(source, path), module.__dict__)
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        raise ProcedureError(f"procedure from {calls}: its module fails{_error_text(error, path)}") from error
    function = getattr(module, calls.rpartition(".")[2], None)
    if not callable(function):
        raise ProcedureError(f"procedure from {calls}: its module has no such function")
    return function  # type: ignore[no-any-return]


@lru_cache(8)
def _folder_of(files: tuple[tuple[str, bytes], ...]) -> Path:
    """A new folder with these files, which is there until this process ends: the same wherever a mind runs."""
    folder, process = Path(mkdtemp(prefix="mind-files-")), os.getpid()
    finalize(RunningProcedure, _remove, folder, process)
    for name, data in files:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(data)
    return folder


def _remove(folder: Path, process: int) -> None:
    """Remove a folder at the end of the process that made it, and of none that it forked."""
    if os.getpid() == process:
        rmtree(folder, ignore_errors=True)


@lru_cache(64)
def _code(source: str, path: str) -> CodeType:
    with catch_warnings(action="ignore"):
        return compile(source, path, "exec")


def call(calls: str, function: Callable[..., Any], outputs: int, inputs: Singles) -> Singles:
    """The function's outputs for float32 inputs; one without outputs is not called."""
    if outputs == 0:
        return np.zeros(0, np.float32)
    try:
        answer = function(*inputs.tolist())
        found = values(answer)
        given = [number(value) for value in ([answer] if found is None else found)]
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        said = _error_text(error, file_of(calls))
        raise ProcedureError(f"procedure {calls} fails for {inputs.tolist()}{said}") from error
    if len(given) != outputs:
        raise ProcedureError(f"procedure {calls} returned {len(given)} values instead of {outputs}")
    return np.array(given).astype(np.float32)


def _error_text(error: BaseException, path: str) -> str:
    """The line of the module in which an error arose, if it did there, and the error's type and text."""
    lines = [line for frame, line in walk_tb(error.__traceback__) if frame.f_code.co_filename == path]
    where = f" in {path}, line {lines[-1]}" if lines else ""
    try:
        text = str(error)
    except Exception:  # an exception of the user's may fail even here
        text = ""
    return f"{where}: {type(error).__name__}: {text}"
