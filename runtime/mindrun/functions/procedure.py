"""A procedure: a Python function of the readings."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.quantity import FUNCTION
from mindrun.registry import kind


@kind("skill", "procedure")
@dataclass(frozen=True, slots=True)
class Procedure:
    """A Python function `module.function`: one float per reading in, one float (or a tuple) per output out.

    The module stands beside the source. Its code is imported by `train`, `run` and `bench` only, never by `check`.
    """

    from_: Annotated[str, FUNCTION]
