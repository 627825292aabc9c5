"""The base classes of internal functions (Eq. 1): the rest of the program asks a kind, and knows none by name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any, Protocol, Self, runtime_checkable

from mindrun.kinds.registry import base, kind
from mindrun.numbers.quantity import Quantity

if TYPE_CHECKING:
    import numpy as np

    from mindrun.kinds.learners import Genetic
    from mindrun.kinds.procedure_text import Sources
    from mindrun.numbers.arrays import Bools, Compute, Doubles, Layers, Weights
    from mindrun.numbers.network import Terms

Width = Annotated[int, Quantity("a whole number", {"": 1.0}, low=0, high=1000, whole=True)]
Switch = Annotated[int, Quantity("a whole number", {"": 1.0}, low=0, high=1, whole=True)]
# Of the weights that learning begins with, 4: without biases, small weights leave every sigmoid near 1/2. Tried on a
# stand-in for GoToObject, 6 seeds each, until 17 targets: with 1 one seed got there in 100 M ticks, with 2 all by the
# 10th generation, with 4 five in the first; 6 (until 22 targets) was no better than 4.
INITIAL_SPREAD = 4.0
MIDDLE_READING = 0.5  # what most readings are when all is well


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
    grows = False  # whether it learns which of its inputs it reads, too
    bias = 0  # 1 if each of its matrices has a first column that reads 1
    centred = 0  # 1 if its matrices read all else less 1/2, and 1/2 is added to what they send
    opaque = ""  # why nothing can be proved of its outputs, even with its weights
    calls: str | None = None  # the Python function whose text belongs to the mind, `module.function`, if it calls one
    in_arrays = False  # whether numpy computes it in the lanes, too, for all runs at once (`ArrayFunction.computed`)
    derived: tuple[str, ...] = ()  # arguments that nobody said and that follow from what its skill reads and sends

    def explicit(self, inputs: int, outputs: int) -> Self:
        """The function with every argument said that follows from its inputs and outputs."""
        return self

    def layers(self, inputs: int, outputs: int) -> Layers:
        """The layers of a feed-forward network; none where it is something else."""
        return () if self.opaque else self.matrix_shapes(inputs, outputs)

    def matrix_shapes(self, inputs: int, outputs: int) -> Layers:
        """(values in, values out) of the matrices in which its genome lies, row by row; none where none is learnt."""
        return ()

    def forward(self, of: Terms, matrices: Sequence[Any], inputs: Any, state: Any) -> tuple[Any, Any]:
        """The outputs for inputs [..., inputs] in a state [..., state], before the clamp, and the state after that.

        In the terms of numpy, of PyTorch, or of whoever else computes what these matrices do; not of what has none.
        Many genomes side by side are inputs and states [..., genomes, values] and matrices [out, in, genomes].
        """
        raise NotImplementedError

    def state_length(self, inputs: int, outputs: int) -> int:
        """The number of values it remembers from one tick to the next; they are 0 at the beginning of a run."""
        return 0

    def row(self, inputs: int, outputs: int) -> Mapping[str, int]:
        """The kind's own columns of the lanes' table of skills: `hidden`, `width`, `bias` and `centred`."""
        return {}

    def scratch(self, inputs: int, outputs: int) -> int:
        """The number of rows of `s.hidden` that its lane function writes, its outputs among them."""
        return outputs

    def gathered(self, inputs: int, outputs: int) -> int:
        """The number of rows of `s.gathered` that its lane function reads or writes, its inputs the first of them."""
        return inputs + self.state_length(inputs, outputs)

    @staticmethod
    def lane(t: Any, s: Any, skill: Any, n: int) -> int:
        """Write its outputs in n simulated worlds into rows of `s.hidden`; return the first of these rows.

        Compiled, in the terms of `numbers.arithmetic`, which it is given then. The inputs stand in `s.gathered`, with
        room behind them; the weights from `skill.weights` on (`mlp.layer` takes them where they
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

    def grown(self, genomes: Weights, outputs: int, rates: Genetic, rng: np.random.Generator) -> Weights:
        """The genomes [individuals, weights], some of them with other links, as often as `rates` say."""
        return genomes

    def crossed(self, mothers: Weights, fathers: Weights, first: Bools, better: Bools) -> Weights:
        """Children [individuals, weights], each weight that of the mother where `first` says so, else of the father.

        `better` [individuals, 1] says of each mother whether she did better than the father.
        """
        import numpy as np

        return np.where(first, mothers, fathers)

    def moved(self, genomes: Weights, steps: Weights) -> Weights:
        """The genomes [individuals, weights], moved by steps where they may be."""
        return genomes + steps

    def distance(self, genomes: Weights, one: Weights) -> Doubles:
        """How far genomes [individuals, weights] are from one: [individuals]; 0 where they are the same."""
        import numpy as np

        return np.asarray(np.abs(genomes - one).sum(axis=1), np.float64)

    def summary(self, weights: Weights, outputs: int) -> str:
        """What a status says of its weights; mostly nothing."""
        return ""

    def narrowed(self, weights: Weights, outputs: int, kept: Sequence[int]) -> Weights | None:
        """Weights with which it does the same with these of its inputs alone; None where the others matter."""
        return None

    def unread(self, weights: Weights, outputs: int) -> list[int]:
        """The inputs, by their places, that no link leads from, of a function that `grows`."""
        return []

    def pruned(self, weights: Weights, outputs: int) -> Function:
        """The function without what leads nowhere with these weights: it does the same."""
        return self

    def neurons_as_links(self, inputs: int, outputs: int) -> int | None:
        """How many neurons a network of single links needs to do the same; None where it cannot."""
        return None

    def recast(self, weights: Weights, size: tuple[int, int], of: Function) -> Weights | None:
        """Weights with which it does what another function of its size (inputs, outputs) does with these, if it can."""
        return None

    def holds(self, size: tuple[int, int], other: Function, its: tuple[int, int]) -> bool:
        """True if of `size` (inputs, outputs) it does what another of its size does, once some weights are 0."""
        return False

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
    """A network of matrices with neurons of a `width` (0: Eq. 5, max(inputs, outputs) + 2).

    Without inputs or outputs it has no matrices. Its last one gives the outputs. With `bias 1` each matrix has one more
    column, the first: what it reads there is always 1. With `centred 1` inputs and neurons are read less 1/2, and the
    outputs are 1/2 more than the sums.
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
        size = {"width": self.neurons(inputs, outputs), "bias": self.bias, "centred": self.centred}
        return size if inputs and outputs else {}

    def read(self, of: Terms, values: Any) -> Any:
        """The values [..., values] that a matrix reads: with a bias 1 before them."""
        return of.biased(values) if self.bias else values

    def taken(self, values: Any) -> Any:
        """Inputs, or what neurons say, as they are read."""
        return values - MIDDLE_READING if self.centred else values

    def sent(self, sums: Any) -> Any:
        """The outputs for the sums of the last matrix."""
        return sums + MIDDLE_READING if self.centred else sums

    def draw(self, inputs: int, outputs: int, count: int, rng: np.random.Generator) -> Weights:
        """Random genomes [count, weights] whose outputs are 1/2 where all neurons say 1/2."""
        import numpy as np

        genomes = INITIAL_SPREAD * rng.standard_normal((count, self.genome_length(inputs, outputs)), np.float32)
        for before, after in () if self.centred else self.matrix_shapes(inputs, outputs)[-1:]:
            last = genomes[:, -before * after :].reshape(count, after, before)
            if self.bias:
                last[..., 0] = (1 - last[..., 1:].sum(axis=2)) / 2
            else:
                last += (1 - last.sum(axis=2, keepdims=True)) / before
        return genomes

    def holds(self, size: tuple[int, int], other: Function, its: tuple[int, int]) -> bool:
        large, small = self.matrix_shapes(*size), other.matrix_shapes(*its)
        can_be_silent = self.bias >= self.centred  # a new output of a centred one is 0 by its bias alone
        return (
            type(self) is type(other)
            and (size[1] == its[1] or can_be_silent)
            and 0 < len(large) == len(small)
            and all(a >= b and c >= d for (a, c), (b, d) in zip(large, small, strict=True))
            and size[0] >= its[0]
            and self.state_length(*size) >= other.state_length(*its)
            and self.bias >= other.bias
            and self.centred == other.centred
        )

    def widened(
        self, weights: Weights, before: tuple[int, int], now: Function, after: tuple[int, int]
    ) -> Weights | None:
        import numpy as np

        from mindrun.numbers.network import genome, matrices, padded

        if not now.holds(after, self, before):
            return None
        small, large = self.matrix_shapes(*before), now.matrix_shapes(*after)
        bias, new = now.bias, now.bias - self.bias
        found = (np.pad(matrix, ((0, 0), (new, 0))) for matrix in matrices(weights, small))
        cuts = [bias + before[0] if number < self.readers else shape[0] + new for number, shape in enumerate(small)]
        places = [bias + after[0] if number < self.readers else shape[0] for number, shape in enumerate(large)]
        wide = [*map(padded, found, large, cuts, places)]
        self.silence(wide[-1][before[1] :], now.bias)
        return genome(wide)

    def silence(self, rows: Weights, bias: int) -> None:
        """Make outputs 0 whose weights [outputs, values in] are."""
        if self.centred:
            rows[:, :bias] = -MIDDLE_READING

    def reordered(self, weights: Weights, inputs: Sequence[int], outputs: Sequence[int]) -> Weights:
        from mindrun.numbers.network import genome, matrices

        shapes = self.matrix_shapes(len(inputs), len(outputs))
        if not shapes:
            return weights
        found = list(matrices(weights, shapes))
        for number, (columns, _) in enumerate(shapes[: self.readers]):
            moved = [self.bias + place for place in inputs]
            rest = range(self.bias + len(inputs), columns)
            found[number] = found[number][:, [*range(self.bias), *moved, *rest]]
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
