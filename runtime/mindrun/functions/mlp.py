"""The multi-layer perceptron of the paper (4.1): no biases, sigmoid hidden layers, a linear last layer in 0..1."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.quantity import COUNT, Quantity
from mindrun.registry import kind

WIDTH = Quantity("a whole number", {"": 1.0}, low=0, whole=True)


@kind("skill", "mlp")
@dataclass(frozen=True, slots=True)
class Mlp:
    """A perceptron with `hidden` layers of `width` neurons (0: Eq. 5, max(inputs, outputs) + 2)."""

    hidden: Annotated[int, COUNT] = 2
    width: Annotated[int, WIDTH] = 0
