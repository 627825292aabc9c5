"""The multi-layer perceptron of the paper (4.1): no biases, sigmoid hidden layers, a linear last layer in 0..1."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.functions.function import Function
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import Quantity

if TYPE_CHECKING:  # a lane is given its terms when it is compiled
    import numpy as np

    from mindrun.numbers.arithmetic import LANES, ZERO, broadcast, load, sigmoids, splat, store
    from mindrun.numbers.arrays import Compute, Layers, Weights

WIDTH = Quantity("a whole number", {"": 1.0}, low=0, high=1000, whole=True)
# Of the weights that learning begins with, 4: without biases, small weights leave every sigmoid near 1/2. Tried on a
# stand-in for GoToObject, 6 seeds each, until 17 targets: with 1 one seed got there in 100 M ticks, with 2 all by the
# 10th generation, with 4 five in the first; 6 (until 22 targets) was no better than 4.
INITIAL_SPREAD = 4.0
HIDDEN = Quantity("a whole number", {"": 1.0}, low=0, high=16, whole=True)


@kind("skill", "mlp")
class Mlp(Function):
    """A perceptron with `hidden` layers of `width` neurons (0: Eq. 5, max(inputs, outputs) + 2)."""

    hidden: Annotated[int, HIDDEN] = 2
    width: Annotated[int, WIDTH] = 0

    learns = True

    @property
    def derived(self) -> tuple[str, ...]:
        """The width, where Eq. 5 says it."""
        return () if self.width else ("width",)

    def explicit(self, inputs: int, outputs: int) -> Mlp:
        """The perceptron with its width said; it has none without a hidden layer."""
        shape = self.layers(inputs, outputs)
        return replace(self, width=shape[0][1]) if len(shape) > 1 else self

    def layers(self, inputs: int, outputs: int) -> Layers:
        """(values in, values out) of each layer; none where the skill has no inputs or outputs."""
        if inputs == 0 or outputs == 0:
            return ()
        width = self.width or max(inputs, outputs) + 2
        return tuple(pairwise((inputs, *[width] * self.hidden, outputs)))

    def genome_length(self, inputs: int, outputs: int) -> int:
        """One weight per connection, no biases."""
        return sum(before * after for before, after in self.layers(inputs, outputs))

    def row(self, inputs: int, outputs: int) -> Mapping[str, int]:
        """Its hidden layers; it has none where it has nothing to compute."""
        shape = self.layers(inputs, outputs)
        return {"hidden": self.hidden, "width": shape[0][1]} if len(shape) > 1 else {}

    @staticmethod
    def lane(t: Any, s: Any, skill: Any, n: int) -> int:
        """Layer after layer, in the two halves of `s.hidden` by turns."""
        half: int = s.hidden.shape[0] // 2
        source, inputs, place = s.gathered, skill.inputs, skill.weights
        base = half
        for layer in range(skill.hidden + 1):
            base = half - base
            target = s.hidden[base : base + half]
            last = layer == skill.hidden
            outputs = skill.outputs if last else skill.width
            if skill.own:
                dense_own(s.genome[place:], source, inputs, target, outputs, last, n)
            else:
                dense(t.weights[place:], source, inputs, target, outputs, last, n)
            place += inputs * outputs
            source, inputs = target, outputs
        return base

    def draw(self, inputs: int, outputs: int, count: int, rng: np.random.Generator) -> Weights:
        """Random genomes [count, weights] whose outputs are 1/2 where all neurons say 1/2.

        Without biases the outputs would otherwise lie anywhere, most beyond 0..1, where they answer to no input.
        """
        import numpy as np

        genomes = INITIAL_SPREAD * rng.standard_normal((count, self.genome_length(inputs, outputs)), np.float32)
        for before, after in self.layers(inputs, outputs)[-1:]:
            last = genomes[:, -before * after :].reshape(count, after, before)
            last += (1 - last.sum(axis=2, keepdims=True)) / before
        return genomes

    def widened(
        self, weights: Weights, before: tuple[int, int], now: Function, after: tuple[int, int]
    ) -> Weights | None:
        """The genome in a larger one whose other weights are 0; None where a layer is missing or smaller."""
        small, large = self.layers(*before), now.layers(*after)
        if len(small) != len(large) or any(a < b or c < d for (a, c), (b, d) in zip(large, small, strict=True)):
            return None
        from mindrun.numbers.network import genome, matrices, padded

        return genome(map(padded, matrices(weights, small), large))

    def reordered(self, weights: Weights, inputs: Sequence[int], outputs: Sequence[int]) -> Weights:
        """The columns of the first matrix and the rows of the last in this order."""
        from mindrun.numbers.network import genome, matrices

        found = list(matrices(weights, self.layers(len(inputs), len(outputs))))
        if not found:
            return weights
        found[0] = found[0][:, list(inputs)]
        found[-1] = found[-1][list(outputs)]
        return genome(found)

    def ready(self, inputs: int, outputs: int, weights: Weights, sources: Mapping[str, str]) -> Compute:
        """Eq. 1 with these weights."""
        from mindrun.numbers.network import perceptron

        shape = self.layers(inputs, outputs)
        return perceptron(weights, shape) if shape else Function.ready(self, inputs, outputs, weights, sources)


def dense(w: Any, source: Any, inputs: int, target: Any, outputs: int, last: bool, n: int) -> None:
    """target[q] = Σ weight · source[j], summed in the order of j; then the sigmoid, but for the last layer.

    Sixteen lanes and four outputs at a time; w is flat, output after output.
    """
    for p in range(0, n, LANES):
        for q in range(0, outputs - 3, 4):
            a, b, c, d = splat(ZERO), splat(ZERO), splat(ZERO), splat(ZERO)
            first = q * inputs
            for j in range(inputs):
                x = load(source, j, p)
                a = a + broadcast(w, first + j) * x
                b = b + broadcast(w, first + inputs + j) * x
                c = c + broadcast(w, first + 2 * inputs + j) * x
                d = d + broadcast(w, first + 3 * inputs + j) * x
            store(target, q, p, a if last else sigmoids(a))
            store(target, q + 1, p, b if last else sigmoids(b))
            store(target, q + 2, p, c if last else sigmoids(c))
            store(target, q + 3, p, d if last else sigmoids(d))
        for q in range(outputs - outputs % 4, outputs):
            a = splat(ZERO)
            for j in range(inputs):
                a = a + broadcast(w, q * inputs + j) * load(source, j, p)
            store(target, q, p, a if last else sigmoids(a))


def dense_own(w: Any, source: Any, inputs: int, target: Any, outputs: int, last: bool, n: int) -> None:
    """As `dense`, with weights [weight, lane] of each lane's own."""
    for p in range(0, n, LANES):
        for q in range(outputs):
            a = splat(ZERO)
            for j in range(inputs):
                a = a + load(w, q * inputs + j, p) * load(source, j, p)
            store(target, q, p, a if last else sigmoids(a))
