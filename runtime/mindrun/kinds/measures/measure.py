"""Measures, and what the rest of the program asks of each: it knows none by name."""

from dataclasses import replace
from math import inf
from typing import Annotated

from mindrun.kinds.registry import base, kind, left_out
from mindrun.kinds.things.thing import AboutThing
from mindrun.numbers.quantity import TICKS, Ratio, Reference, ThingName


@base("measure")
class MeasureKind(AboutThing):
    """A measure that can be any number; a kind says what is different about it."""

    __slots__ = ()

    is_outside = False  # whether an environment says what it is
    interval = (-inf, inf)  # its least and its greatest value
    way = 0  # 1 where it is only of the way toward a thing, -1 where only of the way back
    over = 0  # the number of ticks whose changes of commands the lanes keep for it
    beyond = 0.0  # the share of a wheel's travel beyond which such a change counts


@kind("measure", "progress")
class Progress(MeasureKind):
    """Distance to the thing's centre closed in this tick, in world units; negative when moving away.

    With `of` it is the distance of another thing; of several, that of the two that are nearest to each other.
    """

    toward: ThingName
    of: ThingName = left_out("")


@kind("measure", "advance")
class Advance(MeasureKind):
    """The progress toward the thing where it is positive, else 0."""

    toward: ThingName
    of: ThingName = left_out("")

    way = 1
    interval = (0.0, inf)


@kind("measure", "retreat")
class Retreat(MeasureKind):
    """The distance to the thing gained in this tick where it grew, else 0."""

    from_: ThingName
    of: ThingName = left_out("")

    way = -1
    interval = (0.0, inf)


@kind("measure", "distance")
class Apart(MeasureKind):
    """Distance of the robot, or of a thing, to another, from middle to middle; of several, of the two that are nearest.

    In world units; 0 where all of one name have vanished.
    """

    to: ThingName
    of: ThingName = left_out("")

    interval = (0.0, inf)


@kind("measure", "time")
class Time(MeasureKind):
    """How many ticks the run has lasted, this one too: 1 in its first."""

    interval = (1.0, inf)


@kind("measure", "forward")
class Forward(MeasureKind):
    """1 while the robot moves forward, else 0."""

    interval = (0.0, 1.0)


@kind("measure", "change")
class CommandChange(MeasureKind):
    """Sum over the wheels of how much the command changed over the last `over` ticks, beyond a share of its travel."""

    of: Annotated[str, Reference("quantity", ("thrust",))]
    beyond: Ratio = 0.0
    over: Annotated[int, replace(TICKS, low=1.0)] = 10

    interval = (0.0, inf)


@kind("measure", "its reward")
class ItsReward(MeasureKind):
    """The reward that the Gymnasium environment gave for this step."""

    is_outside = True
