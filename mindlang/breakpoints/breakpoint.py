"""What breakpoints say once their names are found: when a run stops."""

from dataclasses import dataclass

from mindrun.graph.graph import Receiver
from mindrun.kinds.events.event import EventKind
from mindrun.kinds.measures.measure import MeasureKind
from mindrun.numbers.expression import Program

from mindlang.breakpoints.robot_events import RobotEvent


@dataclass(frozen=True, slots=True)
class Transmission(MeasureKind):
    """With what weight a skill counts in a target, by their indices: the influence that it sends to a skill, or its
    share of the influence that arrives at an actuator or a memory.
    """

    skill: int
    to: Receiver
    target: int


@dataclass(frozen=True, slots=True)
class Holds:
    """A condition begins to hold. In the program ("measure", i) is what `transmissions[i]` is.

    `named` are the readings, commands and measures in it: how they are written, and the word and the operand that they
    have in the program.
    """

    program: Program
    transmissions: tuple[Transmission, ...]
    named: tuple[tuple[str, tuple[str, int]], ...]


@dataclass(frozen=True, slots=True)
class Happens:
    """An event happens: for the time number `times`, or whenever it does where that is 0."""

    event: EventKind | RobotEvent
    times: int


@dataclass(frozen=True, slots=True)
class Reaches:
    """The run comes to a tick, counted from 1."""

    tick: int


@dataclass(frozen=True, slots=True)
class Breakpoint:
    """A line of a .break file, by its number and its words; `cause` is what stops the run."""

    line: int
    text: str
    cause: Holds | Happens | Reaches
