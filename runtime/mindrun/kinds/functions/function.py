"""The base classes of internal functions (Eq. 1): the rest of the program asks a kind, and knows none by name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any, Protocol, Self, runtime_checkable

from mindrun.kinds.registry import base, kind
from mindrun.numbers.quantity import Quantity

if TYPE_CHECKING:
    import numpy as np

    from mindrun.kinds.procedure_text import Sources
    from mindrun.numbers.arrays import Compute, Layers, Weights
    from mindrun.numbers.network import Terms

Width = Annotated[int, Quantity("a whole number", {"": 1.0}, low=0, high=1000, whole=True)]
# Of the weights that learning begins with, 4: without biases, small weights leave every sigmoid near 1/2. Tried on a
# stand-in for GoToObject, 6 seeds each, until 17 targets: with 1 one seed got there in 100 M ticks, with 2 all by the
# 10th generation, with 4 five in the first; 6 (until 22 targets) was no better than 4.
INITIAL_SPREAD = 4.0


@runtime_checkable
class Stateful(Protocol):
    """A function made ready that remembers from one tick to the next."""

    def reset(self) -> None: ...  # as before the first tick of a run


@base("skill")
class Function:
    """A function that learns nothing and whose outputs are 0; a kind says what is different about it.

    `inputs` and `outputs` are how many its skill has.
    """

    __slots__ = ()

    learns = False
    has_outputs = True  # whether edges without `at` can send one
    opaque = ""  # why nothing can be proved of its outputs, even with its weights
    calls: str | None = None  # the Python function whose text belongs to the mind, `module.function`, if it calls one
    in_arrays = False  # whether numpy computes it in the lanes, too, for all runs at once (`ArrayFunction.computed`)
    derived: tuple[str, ...] = ()  # arguments that nobody said and that follow from what its skill reads and sends

    def explicit(self, inputs: int, outputs: int) -> Self:
        """The function with every argument said that follows from its inputs and outputs."""
        return self

    def layers(self, inputs: int, outputs: int) -> Layers:
        """The layers of a feed-forward network without biases; none where it is something else."""
        return () if self.opaque else self.matrix_shapes(inputs, outputs)

    def matrix_shapes(self, inputs: int, outputs: int) -> Layers:
        """(values in, values out) of the matrices in which its genome lies, row by row; none where none is learnt."""
        return ()

    def forward(self, of: Terms, matrices: Sequence[Any], inputs: Any, state: Any) -> tuple[Any, Any]:
        """The outputs for inputs [..., inputs] in a state [..., state], before the clamp, and the state after that.

        In the terms of numpy, of PyTorch, or of whoever else computes what these matrices do; not of what has none.
        """
        raise NotImplementedError

    def state_length(self, inputs: int, outputs: int) -> int:
        """The number of values it remembers from one tick to the next; they are 0 at the beginning of a run."""
        return 0

    def row(self, inputs: int, outputs: int) -> Mapping[str, int]:
        """The kind's own columns of the lanes' table of skills: `hidden` and `width`."""
        return {}

    def scratch(self, inputs: int, outputs: int) -> int:
        """The number of rows of `s.hidden` that its lane function writes, its outputs among them."""
        return outputs

    @staticmethod
    def lane(t: Any, s: Any, skill: Any, n: int) -> int:
        """Write its outputs in n simulated worlds into rows of `s.hidden`; return the first of these rows.

        Compiled, in the terms of `numbers.arithmetic`, which it is given then. The inputs stand in `s.gathered`, with
        as many rows behind them as it remembers; the weights from `skill.weights` on (`mlp.layer` takes them where they
        are). World number k is lane `s.active[k]`; what it remembers stands in `s.recurrent` from `skill.state` on.
        """
        return 0

    def genome_length(self, inputs: int, outputs: int) -> int:
        """The number of weights it learns."""
        return sum(before * after for before, after in self.matrix_shapes(inputs, outputs))

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

    def ready(self, inputs: int, outputs: int, weights: Weights, sources: Sources) -> Compute:
        """A function of float32 inputs to float32 outputs, not yet clamped; `sources` are modules' texts by name."""
        import numpy as np

        return lambda values: np.zeros(outputs, np.float32)


class NetworkFunction(Function):
    """A network of matrices without biases, with neurons of a `width` (0: Eq. 5, max(inputs, outputs) + 2).

    Without inputs or outputs it has no matrices. Its last one gives the outputs.
    """

    __slots__ = ()

    width: int

    learns = True
    readers = 1  # how many of its matrices, the first, read the inputs, and behind them what it remembers

    def neurons(self, inputs: int, outputs: int) -> int:
        """The width, as it is said or as Eq. 5 has it; 0 without inputs or outputs."""
        return (self.width or max(inputs, outputs) + 2) if inputs and outputs else 0

    @property
    def derived(self) -> tuple[str, ...]:  # type: ignore[override]
        return () if self.width else ("width",)

    def explicit(self, inputs: int, outputs: int) -> Self:
        if len(self.matrix_shapes(inputs, outputs)) < 2:
            return self
        return replace(self, width=self.neurons(inputs, outputs))  # type: ignore[type-var]

    def row(self, inputs: int, outputs: int) -> Mapping[str, int]:
        return {"width": self.neurons(inputs, outputs)}

    def draw(self, inputs: int, outputs: int, count: int, rng: np.random.Generator) -> Weights:
        """Random genomes [count, weights] whose outputs are 1/2 where all neurons say 1/2."""
        import numpy as np

        genomes = INITIAL_SPREAD * rng.standard_normal((count, self.genome_length(inputs, outputs)), np.float32)
        for before, after in self.matrix_shapes(inputs, outputs)[-1:]:
            last = genomes[:, -before * after :].reshape(count, after, before)
            last += (1 - last.sum(axis=2, keepdims=True)) / before
        return genomes

    def widened(
        self, weights: Weights, before: tuple[int, int], now: Function, after: tuple[int, int]
    ) -> Weights | None:
        from mindrun.numbers.network import genome, matrices, padded

        small, large = self.matrix_shapes(*before), now.matrix_shapes(*after)
        if len(small) != len(large) or any(a < b or c < d for (a, c), (b, d) in zip(large, small, strict=True)):
            return None
        if after[0] < before[0] or now.state_length(*after) < self.state_length(*before):
            return None
        found = matrices(weights, small)
        cuts = [before[0] if number < self.readers else shape[0] for number, shape in enumerate(small)]
        places = [after[0] if number < self.readers else shape[0] for number, shape in enumerate(large)]
        return genome(map(padded, found, large, cuts, places))

    def reordered(self, weights: Weights, inputs: Sequence[int], outputs: Sequence[int]) -> Weights:
        from mindrun.numbers.network import genome, matrices

        shapes = self.matrix_shapes(len(inputs), len(outputs))
        if not shapes:
            return weights
        found = list(matrices(weights, shapes))
        for number, (columns, _) in enumerate(shapes[: self.readers]):
            found[number] = found[number][:, [*inputs, *range(len(inputs), columns)]]
        found[-1] = found[-1][list(outputs)]
        return genome(found)

    def ready(self, inputs: int, outputs: int, weights: Weights, sources: Sources) -> Compute:
        """The network with these weights (Eq. 1), from tick to tick; one without a state takes rows of inputs, too."""
        from mindrun.numbers.network import FLOAT32, NOTHING, StatefulNetwork, matrices

        shapes = self.matrix_shapes(inputs, outputs)
        if not shapes:
            return Function.ready(self, inputs, outputs, weights, sources)
        found, length = matrices(weights, shapes), self.state_length(inputs, outputs)
        if length:
            return StatefulNetwork(self.forward, found, length)
        return lambda values: self.forward(FLOAT32, found, values, NOTHING)[0]


@kind("skill", "rule")
class Rule(Function):
    """No function of its own: every edge of the skill has `at`."""

    has_outputs = False
