"""The base classes of actuators: the rest of the program asks a kind for these, and knows none by name."""

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
        """True if it belongs to an environment."""
        return self.slot is not None

    @property
    def moves_body(self) -> bool:
        """True if it can move the robot."""
        return self.drive is not None

    @property
    def mounted(self) -> Side | None:
        """The side of the body that it is on, where that says what it does."""
        return None

    @property
    def reach(self) -> float | None:
        """The distance ahead of the body within which it takes items, in world units; None where it takes none."""
        return None

    @property
    def can_hold(self) -> bool:
        """True if it can close around an item."""
        return self.reach is not None

    @property
    def acts_at_rest(self) -> bool:
        """True if its neutral command does something in the world."""
        return False

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


class Pushing(ActuatorKind):
    """Pushes with the force (2v − 1)·thrust: 0 full reverse, 0.5 stopped, 1 full forward."""

    __slots__ = ()

    thrust: float
    noise: float
    slip: float

    varying = ("thrust", "delay", "noise", "slip")

    def place(self, body: BodyKind) -> Point:
        """The point of the body that it pushes."""
        return 0.0, 0.0

    @property
    def direction(self) -> Point:
        """The direction in which it pushes, of length 1, in the body's frame."""
        return 1.0, 0.0

    @property
    def acts_at_rest(self) -> bool:
        """True if it pushes at its neutral command, or may with its noise."""
        return (self.neutral != STOPPED_COMMAND or self.noise > 0) and self.thrust != 0.0

    def row(self, body: BodyKind) -> Row:
        """The columns of what pushes: thrust, direction, lever arm, side, noise and slip."""
        (x, y), (ahead, aside) = self.place(body), self.direction
        return {
            "thrust": self.thrust, "ahead": ahead, "aside": aside, "arm": x * aside - y * ahead, "is_right": y < 0,
            "noise": self.noise, "slip": self.slip,
        }  # fmt: skip
