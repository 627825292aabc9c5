"""What every kind of internal function says of itself (Eq. 1); the rest of the program asks, and knows no kind."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol, Self, runtime_checkable

from mindrun.kinds.registry import base

if TYPE_CHECKING:
    import numpy as np

    from mindrun.numbers.arrays import Compute, Layers, Weights


@runtime_checkable
class Stateful(Protocol):
    """A function made ready that remembers from one tick to the next."""

    def reset(self) -> None:
        """As before the first tick of a run."""
        ...


@base("skill")
class Function:
    """A function that learns nothing and whose outputs are 0; a kind says what is different about it.

    `inputs` and `outputs` are how many its skill has.
    """

    __slots__ = ()

    learns = False
    has_outputs = True  # whether edges without `at` can send one
    opaque = ""  # why nothing can be proved of its outputs, even with its weights

    @property
    def calls(self) -> str | None:
        """The Python function that it calls, `module.function`, whose text belongs to the mind, if it calls one."""
        return None

    @property
    def derived(self) -> tuple[str, ...]:
        """The arguments that nobody has said and that follow from what its skill reads and sends."""
        return ()

    def explicit(self, inputs: int, outputs: int) -> Self:
        """The function with every argument said that follows from its inputs and outputs."""
        return self

    def layers(self, inputs: int, outputs: int) -> Layers:
        """The layers of a feed-forward network without biases; none where it is something else."""
        return ()

    def matrix_shapes(self, inputs: int, outputs: int) -> Layers:
        """The matrices in which its genome lies, row by row, where it is a network: sigmoid but for the last one.

        The first reads the inputs and, behind them, what it remembers: the values of its hidden neurons.
        """
        return self.layers(inputs, outputs)

    def row(self, inputs: int, outputs: int) -> Mapping[str, int]:
        """What its lane function is told: the `hidden` layers and their `width`."""
        return {}

    def state_length(self, inputs: int, outputs: int) -> int:
        """How many numbers it remembers from one tick to the next, 0 at the beginning of a run."""
        return 0

    @staticmethod
    def lane(t: Any, s: Any, skill: Any, n: int) -> int:
        """Write its outputs in n simulated worlds into rows of `s.hidden`; return the first of these rows.

        Compiled, in the terms of `numbers.arithmetic`, which it is given then. The inputs stand in `s.gathered`, the
        weights from `skill.weights` on: with `skill.own` in the rows of `s.genome`, else in `t.weights`. World number k
        is lane `s.active[k]`; what it remembers stands in `s.recurrent` from `skill.state` on.
        """
        return 0

    def genome_length(self, inputs: int, outputs: int) -> int:
        """How many weights it learns."""
        return 0

    def draw(self, inputs: int, outputs: int, count: int, rng: np.random.Generator) -> Weights:
        """Random genomes [count, weights] for learning to begin with."""
        import numpy as np

        return np.empty((count, 0), np.float32)

    def widened(self, weights: Weights, before: tuple[int, int], now: Self, after: tuple[int, int]) -> Weights | None:
        """Weights with which `now`, of more inputs or outputs, does the same, 0 for what is new; None if it cannot."""
        return None

    def reordered(self, weights: Weights, inputs: Sequence[int], outputs: Sequence[int]) -> Weights:
        """Weights that do the same with its inputs and outputs in this order: the first is now number `inputs[0]`."""
        return weights

    def ready(self, inputs: int, outputs: int, weights: Weights, sources: Mapping[str, str]) -> Compute:
        """Its float32 inputs to its float32 outputs, not yet clamped; `sources` are the texts of modules by name."""
        import numpy as np

        return lambda values: np.zeros(outputs, np.float32)
