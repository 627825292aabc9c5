"""What round bodies have in common."""

from math import pi

from mindrun.bodies.body import BodyKind


class Round(BodyKind):
    """A disc of diameter `size`."""

    __slots__ = ()

    size: float

    @property
    def radius(self) -> float:
        """Half of its size."""
        return self.size / 2

    @property
    def mass(self) -> float:
        """Density times area."""
        return self.density * pi * self.radius**2

    @property
    def moment(self) -> float:
        """The moment of inertia of a disc about its middle."""
        return self.mass * self.radius**2 / 2
