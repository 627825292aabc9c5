"""Kinds of bodies."""

from dataclasses import dataclass
from math import pi
from typing import Annotated

from mindrun.quantity import Quantity
from mindrun.registry import kind

DIAMETER = Quantity("a length in world units", {"": 1.0}, low=0.01, high=1000.0)
DENSITY = Quantity("a density", {"": 1.0}, low=1e-3, high=1e6)
DAMPING = Quantity("a damping", {"": 1.0}, low=0.0, high=1e6)


@kind("body", "disc")
@dataclass(frozen=True, slots=True)
class Disc:
    """A round body of diameter `size`; every tick of length dt its velocity is divided by 1 + dt·damping."""

    size: Annotated[float, DIAMETER] = 2.0
    density: Annotated[float, DENSITY] = 2.0
    linear_damping: Annotated[float, DAMPING] = 5.0
    angular_damping: Annotated[float, DAMPING] = 20.0

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
