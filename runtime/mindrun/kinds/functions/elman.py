"""A recurrent network: what its hidden neurons said in the tick before is among their inputs (Elman, 1990)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.functions.function import Function
from mindrun.kinds.functions.mlp import WIDTH, Mlp, dense, dense_own
from mindrun.kinds.registry import kind

if TYPE_CHECKING:  # a lane is given its terms when it is compiled
    import numpy as np
    from numpy.typing import NDArray

    from mindrun.numbers.arithmetic import ZERO
    from mindrun.numbers.arrays import Compute, Layers, Weights


@kind("skill", "elman")
class Elman(Function):
    """A recurrent network with one hidden layer of `width` neurons (0: Eq. 5, max(inputs, outputs) + 2), no biases.

    Its neurons read the skill's inputs and what they all said when the skill last computed, 0 at the beginning of a
    run. A skill without influence does not compute, and remembers.
    """

    width: Annotated[int, WIDTH] = 0

    learns = True
    opaque = "remembers what it computed"

    @property
    def derived(self) -> tuple[str, ...]:
        """The width, where Eq. 5 says it."""
        return () if self.width else ("width",)

    def explicit(self, inputs: int, outputs: int) -> Elman:
        """The network with its width said."""
        return replace(self, width=self.state_length(inputs, outputs)) if inputs and outputs else self

    def state_length(self, inputs: int, outputs: int) -> int:
        """What its hidden neurons said."""
        return (self.width or max(inputs, outputs) + 2) if inputs and outputs else 0

    def matrix_shapes(self, inputs: int, outputs: int) -> Layers:
        """That of the hidden neurons, which read the inputs and what they said, and that of the outputs."""
        return self._unrolled(inputs, outputs).layers(inputs + self.state_length(inputs, outputs), outputs)

    def genome_length(self, inputs: int, outputs: int) -> int:
        """One weight per connection: each hidden neuron reads the inputs and all hidden ones, each output these."""
        return self._unrolled(inputs, outputs).genome_length(inputs + self.state_length(inputs, outputs), outputs)

    def draw(self, inputs: int, outputs: int, count: int, rng: np.random.Generator) -> Weights:
        """Random genomes as those of a perceptron that has the hidden neurons among its inputs."""
        return self._unrolled(inputs, outputs).draw(inputs + self.state_length(inputs, outputs), outputs, count, rng)

    def widened(
        self, weights: Weights, before: tuple[int, int], now: Function, after: tuple[int, int]
    ) -> Weights | None:
        """The genome in a larger one whose other weights are 0; None where anything is smaller."""
        import numpy as np

        from mindrun.numbers.network import genome

        old, new = (self.state_length(*before), *before), (now.state_length(*after), *after)
        if any(more < less for more, less in zip(new, old, strict=True)):
            return None
        (small, inputs, _), (large, more, outputs) = old, new
        hidden, last = self._matrices(weights, *before)
        into, out = np.zeros((large, more + large), np.float32), np.zeros((outputs, large), np.float32)
        into[:small, :inputs], into[:small, more : more + small] = hidden[:, :inputs], hidden[:, inputs:]
        out[: before[1], :small] = last
        return genome((into, out))

    def reordered(self, weights: Weights, inputs: Sequence[int], outputs: Sequence[int]) -> Weights:
        """As a perceptron that has the hidden neurons among its inputs, which stay where they are."""
        if not inputs or not outputs:
            return weights
        hidden = range(len(inputs), len(inputs) + self.state_length(len(inputs), len(outputs)))
        return self._unrolled(len(inputs), len(outputs)).reordered(weights, [*inputs, *hidden], outputs)

    def ready(self, inputs: int, outputs: int, weights: Weights, sources: Mapping[str, str]) -> Compute:
        """Eq. 1 with these weights, from tick to tick."""
        from mindrun.numbers.network import Recurrent

        if not self.state_length(inputs, outputs):
            return Function.ready(self, inputs, outputs, weights, sources)
        return Recurrent(*self._matrices(weights, inputs, outputs))

    def row(self, inputs: int, outputs: int) -> Mapping[str, int]:
        """Its width."""
        return {"hidden": 1, "width": self.state_length(inputs, outputs)}

    @staticmethod
    def lane(t: Any, s: Any, skill: Any, n: int) -> int:
        """As a perceptron that has the hidden neurons among its inputs; what is not sound is not remembered."""
        half: int = s.hidden.shape[0] // 2
        inputs, width = skill.inputs, skill.width
        for j in range(width):
            for k in range(n):
                s.gathered[inputs + j, k] = s.recurrent[skill.state + j, s.active[k]]
        first, last = s.hidden[:half], s.hidden[half:]
        place = skill.weights + (inputs + width) * width
        if skill.own:
            dense_own(s.genome[skill.weights :], s.gathered, inputs + width, first, width, False, n)
            dense_own(s.genome[place:], first, width, last, skill.outputs, True, n)
        else:
            dense(t.weights[skill.weights :], s.gathered, inputs + width, first, width, False, n)
            dense(t.weights[place:], first, width, last, skill.outputs, True, n)
        for j in range(width):
            for k in range(n):
                if s.sound[k] == ZERO and s.influence[skill.index, s.active[k]] != ZERO:
                    s.recurrent[skill.state + j, s.active[k]] = first[j, k]
        return half

    def _matrices(self, weights: Weights, inputs: int, outputs: int) -> tuple[NDArray[np.float32], ...]:
        """Those of the hidden neurons [width, inputs + width] and of the outputs [outputs, width]."""
        from mindrun.numbers.network import matrices

        return matrices(weights, self.matrix_shapes(inputs, outputs))

    def _unrolled(self, inputs: int, outputs: int) -> Mlp:
        return Mlp(1, self.state_length(inputs, outputs))
