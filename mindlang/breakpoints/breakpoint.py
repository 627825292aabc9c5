"""Breakpoints whose names are found: each says when a run, or a robot's recording, stops."""

from collections.abc import Sequence
from dataclasses import dataclass

from mindrun.graph.graph import Receiver
from mindrun.kinds.events.event import EventKind
from mindrun.kinds.measures.measure import MeasureKind
from mindrun.numbers.expression import Program

STOPPED, FAULT, OF = "stopped", "fault", "of"
ROBOT_WORDS = (STOPPED, FAULT)


@dataclass(frozen=True, slots=True)
class RobotEvent:
    """An event that the simulator does not know: `stopped` where all actuators become neutral, or a `fault`.

    That is of the `sensor` of a name, or where it is empty of any that is wired.
    """

    word: str
    sensor: str = ""


def robot_events(sensors: Sequence[str]) -> tuple[RobotEvent, ...]:
    """All events of a robot with these wired sensors: that it stops, any fault, the fault of each."""
    return RobotEvent(STOPPED), *(RobotEvent(FAULT, sensor) for sensor in ("", *sensors))


@dataclass(frozen=True, slots=True)
class Transmission(MeasureKind):
    """The weight with which a skill counts in a target, by their indices.

    That is the influence that it sends to a skill, or its share of the influence that arrives at an actuator or a
    memory.
    """

    skill: int
    to: Receiver
    target: int


@dataclass(frozen=True, slots=True)
class Holds:
    """The cause that a condition begins to hold. In the program ("measure", i) is what `transmissions[i]` is.

    `named` are the readings, commands and measures in it: how they are written, and the word and the operand that they
    have in the program.
    """

    program: Program
    transmissions: tuple[Transmission, ...]
    named: tuple[tuple[str, tuple[str, int]], ...]


@dataclass(frozen=True, slots=True)
class Happens:
    """The cause that an event happens: for the time number `times`, or whenever it does where that is 0."""

    event: EventKind | RobotEvent
    times: int


@dataclass(frozen=True, slots=True)
class Reaches:
    """The cause that the run comes to a tick, counted from 1."""

    tick: int


@dataclass(frozen=True, slots=True)
class Breakpoint:
    """A line of a .break file, by its number and its words; `cause` is what stops the run."""

    line: int
    text: str
    cause: Holds | Happens | Reaches
