"""Kinds of memory: driven like an actuator, read like a sensor on the next tick."""

from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import DECAY, Ratio


@kind("memory", "cell")
class Cell:
    """One number: decay·cell + (1 − decay)·command where a skill drives it, decay·cell where none has influence."""

    decay: Annotated[float, DECAY]
    start: Ratio = 0.0
