"""What the actuators have in common that push the body."""

from mindrun.kinds.actuators.actuator import STOPPED_COMMAND, ActuatorKind, Row
from mindrun.kinds.bodies.body import BodyKind, Point


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
