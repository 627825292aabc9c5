"""Actuators, and what the rest of the program asks of each: it knows none by name."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import pi
from typing import Annotated, Literal, get_args

from mindrun.kinds.bodies.body import BodyKind, Drive, Point
from mindrun.kinds.environment import OfEnvironment, Slot
from mindrun.kinds.registry import base, kind, left_out
from mindrun.numbers.quantity import (
    UNSAID,
    Angle,
    Indices,
    Length,
    PartName,
    Place,
    Quantity,
    Range,
    Ratio,
    Reference,
    Ticks,
)
from mindrun.numbers.trigonometry import cosine, sine

Side = Literal["left", "right"]
Row = Mapping[str, float]  # columns of the lanes' table of actuators

THRUST = Quantity("a force", {"": 1.0}, low=-1e6, high=1e6)
Thrust = Annotated[float, THRUST]
STOPPED_COMMAND = 0.5  # command, at which what drives does not push


@base("actuator")
class ActuatorKind(OfEnvironment):
    """An actuator that does nothing in the simulated world; a kind says what is different about it.

    Every kind has the arguments `neutral`, a command in 0..1, and `delay`, in ticks.
    """

    __slots__ = ()

    neutral: float
    delay: int

    varying: tuple[str, ...] = ("delay",)  # the arguments that can differ from run to run
    drive: Drive | None = None  # what it does to a body, where it can move one
    is_motor = False  # whether its command is a speed, for which friction may let it need a least one
    carries = False  # whether a sensor can sit on it and turn with it
    is_light = False  # whether it shines with its command
    is_said = False  # whether other robots read its command
    reach: float | None = None  # ahead of the body, within which it takes items, in world units; None where none
    mounted: Side | None = None  # the side of the body that it is on, where that says what it does
    acts_at_rest = False  # whether its neutral command does something in the world

    @property
    def moves_body(self) -> bool:
        """True if it can move the robot."""
        return self.drive is not None

    @property
    def can_hold(self) -> bool:
        """True if it can close around an item."""
        return self.reach is not None

    @property
    def zero(self) -> float:
        """The command from which a gauge of it begins."""
        return self.neutral

    def push(self, body: BodyKind) -> tuple[Point, Point] | None:
        """The point of a body that it pushes and the direction, of length 1; None where it pushes no single point."""
        return None

    def row(self, body: BodyKind) -> Row:
        """The columns of an actuator in the lanes' table, on a body: reach, noise, how it pushes or steers."""
        return {}


@dataclass(frozen=True, slots=True, kw_only=True)
class Pushing(ActuatorKind):
    """Pushes with the force (2v − 1)·thrust: 0 full reverse, 0.5 stopped, 1 full forward.

    A command acts `delay` ticks after the tick that computed it, with up to `noise` more or less; up to `slip` of the
    force is lost, anew in every tick.
    """

    thrust: Thrust = 80.0
    delay: Ticks = 0
    noise: Ratio = 0.0
    slip: Ratio = 0.0

    varying = tuple[str, ...](("thrust", "delay", "noise", "slip"))
    is_motor = True

    def place(self, body: BodyKind) -> Point:
        """The point of the body that it pushes."""
        return 0.0, 0.0

    @property
    def direction(self) -> Point:
        """The direction in which it pushes, of length 1, in the body's frame."""
        return 1.0, 0.0

    @property
    def acts_at_rest(self) -> bool:  # type: ignore[override]
        return (self.neutral != STOPPED_COMMAND or self.noise > 0) and self.thrust != 0.0

    def row(self, body: BodyKind) -> Row:
        (x, y), (ahead, aside) = self.place(body), self.direction
        return {
            "thrust": self.thrust, "ahead": ahead, "aside": aside, "arm": x * aside - y * ahead, "is_right": y < 0,
            "noise": self.noise, "slip": self.slip,
        }  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class Rolling(Pushing):
    """Pushes by rolling.

    As long as it stands still, it does not push for a command that is less than the share `starts` of the way from 0.5
    to 0 or 1.
    """

    starts: Ratio = left_out(0.0)

    varying = (*Pushing.varying, "starts")

    def row(self, body: BodyKind) -> Row:
        own = Pushing.row(self, body)
        return {**own, "starts": self.starts} if self.starts > 0 else own


SIDE = Reference("side", get_args(Side))


@kind("actuator", "wheel")
class Wheel(Rolling):
    """A wheel on the body's rim: 0 full reverse, 0.5 stopped, 1 full forward; (2v − 1)·thrust along the heading."""

    side: Annotated[Side, SIDE]
    neutral: Ratio

    drive = "wheel"

    @property
    def mounted(self) -> Side:  # type: ignore[override]
        return self.side

    def place(self, body: BodyKind) -> Point:
        return 0.0, body.side if self.side == "left" else -body.side


PLACE = Quantity("a place on the body in world units", {"": 1.0}, low=-1000.0, high=1000.0)


@kind("actuator", "thruster")
class Thruster(Pushing):
    """A force (2v − 1)·thrust `at` a point of the body, x ahead of its middle and y to its left: 0.5 is none.

    It pushes the body to where it is `facing`, counterclockwise from straight ahead.
    """

    neutral: Ratio
    at: Annotated[Place, PLACE] = (0.0, 0.0)
    facing: Angle = 0.0

    drive = "thruster"

    def place(self, body: BodyKind) -> Point:
        return self.at

    @property
    def direction(self) -> Point:
        return cosine(self.facing), sine(self.facing)

    def push(self, body: BodyKind) -> tuple[Point, Point]:
        return self.at, self.direction


@kind("actuator", "motor")
class Motor(Rolling):
    """The drive of a car: 0 full reverse, 0.5 stopped, 1 full forward; force (2v − 1)·thrust along the heading."""

    neutral: Ratio
    thrust: Thrust = field(default=160.0, kw_only=True)

    drive = "motor"


DEGREE = pi / 180
HALF_TURN = Quantity("an angle between 0 and 180 degrees", {"deg": DEGREE}, low=0.0, high=180 * DEGREE)
TURNING = Quantity("an angle for each tick", {"deg": DEGREE}, low=0.0, high=360 * DEGREE, rate="added")
TURN = Quantity("an angle between 0 and 80 degrees", {"deg": DEGREE}, low=0.0, high=80 * DEGREE)


@kind("actuator", "steering")
class Steering(ActuatorKind):
    """The front wheels of a car: 0 is `range` to the left, 0.5 straight ahead, 1 `range` to the right, as a bearing.

    A command acts `delay` ticks after the tick that computed it, with up to `noise` more or less.
    """

    neutral: Ratio
    range: Annotated[float, TURN] = 30 * DEGREE
    delay: Ticks = 0
    noise: Ratio = 0.0

    varying = ("range", "delay", "noise")
    drive = "steering"

    @property
    def acts_at_rest(self) -> bool:  # type: ignore[override]
        return (self.neutral != STOPPED_COMMAND or self.noise > 0) and self.range != 0.0

    def row(self, body: BodyKind) -> Row:
        return {"turn": self.range, "noise": self.noise}


REACH_UNITS = 1.5
CLOSED_COMMAND = 0.5  # command, above which it closes


@kind("actuator", "gripper")
class Gripper(ActuatorKind):
    """A claw at the front of the body: closed above 0.5. It takes an item ahead of it whose rim is within `reach`.

    It takes none through a wall, and none for which a wall leaves no room in front of it.
    A command acts `delay` ticks after the tick that computed it, with up to `noise` more or less.
    """

    neutral: Ratio
    reach: Length = REACH_UNITS
    delay: Ticks = 0
    noise: Ratio = 0.0

    varying = ("delay", "noise")
    zero = 0.0

    @property
    def acts_at_rest(self) -> bool:  # type: ignore[override]
        return self.neutral + self.noise > CLOSED_COMMAND

    def row(self, body: BodyKind) -> Row:
        return {"reach": self.reach, "noise": self.noise}


@kind("actuator", "servo")
class Servo(ActuatorKind):
    """A servo on the body: 0 is `range` to the left, 0.5 straight ahead, 1 `range` to the right, as a bearing.

    It turns towards its command with `speed`, and what is `on` it turns with it. It is at its neutral when a run
    begins. A command acts `delay` ticks after the tick that computed it.
    """

    neutral: Ratio
    delay: Ticks = 0
    range: Annotated[float, HALF_TURN] = left_out(90 * DEGREE)
    speed: Annotated[float, TURNING] = left_out(360 * DEGREE)

    varying = ("delay", "range", "speed")
    carries = True

    def row(self, body: BodyKind) -> Row:
        return {"turn": self.range, "speed": self.speed}


@kind("actuator", "lamp")
class Lamp(ActuatorKind):
    """A lamp: 0 dark, 1 bright. It changes nothing in the simulated world, and pictures show it."""

    neutral: Ratio
    delay: Ticks = 0

    zero = 0.0
    is_light = True


@kind("actuator", "signal")
class Signal(ActuatorKind):
    """What the robot says to the other robots of its world, a number; their sensors `signal` read it a tick later."""

    neutral: Ratio
    delay: Ticks = 0

    zero = 0.0
    is_said = True

    @property
    def acts_at_rest(self) -> bool:  # type: ignore[override]
        return self.neutral > 0.0  # others hear it


@kind("actuator", "action")
class Action(ActuatorKind):
    """One number of a Gymnasium environment's action: a command of 0 is the low end of its range, 1 the high end.

    The first number is 0; of an array, one index for each axis; of a `Dict`, the name of the part goes before them,
    of a `Tuple` its number.
    The `range` is what the environment says, unless it is given, and has to be where the environment says none.
    """

    action: Indices
    neutral: Ratio
    range: Range = UNSAID
    part: PartName = ""
    delay: Ticks = 0

    @property
    def slot(self) -> Slot:  # type: ignore[override]
        return Slot(self.part, self.action, None if self.range == UNSAID else self.range)


@kind("actuator", "choice")
class Choice(ActuatorKind):
    """One of the actions of a Gymnasium environment that takes one of a few, by its number; the first is 0.

    In each tick that whose command is the largest is taken; of equal ones, the first that is declared. Where the
    environment takes several at once (`MultiDiscrete`), the place stands before the number.
    """

    choice: Indices
    neutral: Ratio
    part: PartName = ""
    delay: Ticks = 0

    @property
    def slot(self) -> Slot:  # type: ignore[override]
        return Slot(self.part, self.choice[:-1] or (0,), chosen=self.choice[-1])
