"""What round bodies have in common."""

from math import pi

from mindrun.kinds.bodies.body import BodyKind


class Round(BodyKind):
    """A disc of diameter `size`."""

    __slots__ = ()

    size: float

    @property
    def radius(self) -> float:
        """Half of its size."""
        return self.size / 2

    @property
    def area(self) -> tuple[float, float]:
        """Of a disc: π·r²."""
        return pi, self.radius**2

    @property
    def gyration(self) -> tuple[float, float]:
        """Of a disc: r² / 2."""
        return self.radius**2, 2.0
