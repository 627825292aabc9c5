"""What `view`, `why` and `whatif` say of a recording that cannot be used."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from mindrun.errors import MindError, ProcedureError
from mindrun.robot.replay import DifferenceError

from mindlang.cli._terminal import FINDINGS, MISUSE, fail, procedures_talk


@contextmanager
def refusing_recordings() -> Iterator[None]:
    """End the program with one message: where a recording is not what its bundle computes with 1, else with 2."""
    try:
        with procedures_talk():
            yield
    except MindError as error:
        is_found = isinstance(error, (DifferenceError, ProcedureError))
        fail(str(error), error.hint, FINDINGS if is_found else MISUSE)
