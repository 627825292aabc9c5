"""What every kind of actuator says of itself: the rest of the program asks, and knows no kind by name."""

from collections.abc import Mapping
from typing import Literal

from mindrun.kinds.bodies.body import BodyKind, Drive, Point
from mindrun.kinds.environment import Slot
from mindrun.kinds.registry import base
from mindrun.numbers.quantity import Quantity

Side = Literal["left", "right"]
Row = Mapping[str, float]  # columns of the lanes' table of actuators

THRUST = Quantity("a force", {"": 1.0}, low=-1e6, high=1e6)
STOPPED_COMMAND = 0.5  # command, at which what drives does not push


@base("actuator")
class ActuatorKind:
    """An actuator that does nothing in the simulated world; a kind says what is different about it.

    Every kind has the arguments `neutral`, a command in 0..1, and `delay`, in ticks.
    """

    __slots__ = ()

    neutral: float
    delay: int

    varying: tuple[str, ...] = ("delay",)  # the arguments that can differ from run to run
    drive: Drive | None = None  # what it does to a body, where it can move one
    is_light = False  # whether it shines with its command

    @property
    def slot(self) -> Slot | None:
        """The number of an environment's action that it sets; None outside of environments."""
        return None

    @property
    def is_outside(self) -> bool:
        """Whether it belongs to an environment."""
        return self.slot is not None

    @property
    def moves_body(self) -> bool:
        """Whether it can move the robot."""
        return self.drive is not None

    @property
    def mounted(self) -> Side | None:
        """The side of the body that it is on, where that says what it does."""
        return None

    @property
    def reach(self) -> float | None:
        """How far ahead of the body it takes items, in world units; None where it takes none."""
        return None

    @property
    def can_hold(self) -> bool:
        """Whether it can close around an item."""
        return self.reach is not None

    @property
    def acts_at_rest(self) -> bool:
        """Whether its neutral command does something in the world."""
        return False

    @property
    def zero(self) -> float:
        """The command from which a gauge of it begins."""
        return self.neutral

    def push(self, body: BodyKind) -> tuple[Point, Point] | None:
        """Where on a body it pushes and to where, a vector of length 1; None where no single point is pushed."""
        return None

    def row(self, body: BodyKind) -> Row:
        """What the lanes are told of it on a body: its reach, its noise, how it pushes or steers."""
        return {}


class Pushing(ActuatorKind):
    """Pushes with the force (2v − 1)·thrust: 0 full reverse, 0.5 stopped, 1 full forward."""

    __slots__ = ()

    thrust: float
    noise: float
    slip: float

    varying = ("thrust", "delay", "noise", "slip")

    def place(self, body: BodyKind) -> Point:
        """Where on the body it pushes."""
        return 0.0, 0.0

    @property
    def direction(self) -> Point:
        """Where it pushes to, as a vector of length 1."""
        return 1.0, 0.0

    @property
    def acts_at_rest(self) -> bool:
        """Whether it pushes."""
        return (self.neutral != STOPPED_COMMAND or self.noise > 0) and self.thrust != 0.0

    def row(self, body: BodyKind) -> Row:
        """How strongly it pushes ahead and aside, with which arm, and on which side."""
        (x, y), (ahead, aside) = self.place(body), self.direction
        return {
            "thrust": self.thrust, "ahead": ahead, "aside": aside, "arm": x * aside - y * ahead, "is_right": y < 0,
            "noise": self.noise, "slip": self.slip,
        }  # fmt: skip
