"""The types of arrays that kinds, engine and learning exchange, and of functions between them."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Readings = NDArray[np.float32]
Reader = Callable[[int, Readings, Readings | None], Readings | np.float32]  # the tick's number, readings now and before
Weights = NDArray[np.float32]  # of one skill: [genes]
Layers = tuple[tuple[int, int], ...]  # of a network: (values in, values out) of each
Compute = Callable[[NDArray[np.float32]], NDArray[np.float32]]  # a skill's inputs to its outputs
Frame = NDArray[np.uint8]  # of a camera: [row, column, blue green red]
