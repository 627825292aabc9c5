"""A network whose links are learnt as well as their weights: augmenting topologies (Stanley and Miikkulainen, 2002)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

from mindrun.kinds.functions.elman import recall, remember
from mindrun.kinds.functions.function import INITIAL_SPREAD, Function, NetworkFunction, Switch
from mindrun.kinds.functions.mlp import centre, layer
from mindrun.kinds.registry import kind, left_out
from mindrun.numbers.quantity import Quantity, Reference

if TYPE_CHECKING:  # a lane is given its terms when it is compiled
    import numpy as np

    from mindrun.kinds.learners import Genetic
    from mindrun.numbers.arithmetic import *
    from mindrun.numbers.arrays import Bools, Doubles, Layers, Weights
    from mindrun.numbers.links import Links
    from mindrun.numbers.network import Terms

MOST_NEURONS = 100
Most = Annotated[int, Quantity("a whole number", {"": 1.0}, low=0, high=MOST_NEURONS, whole=True)]
Reach = Literal["any", "forward"]


@kind("skill", "neat")
class Neat(NetworkFunction):
    """A network whose links are learnt, too: at first from readings to outputs alone; neurons grow on them.

    It has room for `most` neurons. With `links forward` one reads the skill's inputs and the neurons before it; with
    `links any` the others and itself, too: what these said when the skill last computed, 0 at the beginning of a run.
    A row of its matrix is what a neuron reads, the last rows what the outputs read: first the bias, then the inputs,
    then the neurons. A weight of 0 is no link.
    """

    most: Most = 8
    links: Annotated[Reach, Reference("direction", ("any", "forward"))] = "forward"
    bias: Switch = 1
    centred: Switch = left_out(0)

    derived = ()
    grows = True

    @property
    def is_recurrent(self) -> bool:
        return self.links == "any" and self.most > 0

    @property
    def opaque(self) -> str:  # type: ignore[override]
        return "remembers what it computed" if self.is_recurrent else ""

    def explicit(self, inputs: int, outputs: int) -> Self:
        return self

    def neurons(self, inputs: int, outputs: int) -> int:
        return self.most if inputs and outputs else 0

    def state_length(self, inputs: int, outputs: int) -> int:
        return self.neurons(inputs, outputs) if self.is_recurrent else 0

    def matrix_shapes(self, inputs: int, outputs: int) -> Layers:
        return ((self.bias + inputs + self.most, self.most + outputs),) if inputs and outputs else ()

    def forward(self, of: Terms, matrices: Sequence[Any], inputs: Any, state: Any) -> tuple[Any, Any]:
        """Neuron after neuron: h[r] = σ(W[r]·[1, x, h]), where h is new before r; then the outputs W·[1, x, h]."""
        [links] = matrices
        now = self.read(of, self.taken(inputs))
        for row in range(self.most):
            read = of.joined(now, state[..., row:]) if self.is_recurrent else now
            now = of.joined(now, self.taken(of.sigmoid(of.product(read, links[row : row + 1, : read.shape[-1]]))))
        after = now[..., now.shape[-1] - self.most :] if self.is_recurrent else state
        return self.sent(of.product(now, links[self.most :])), after

    def row(self, inputs: int, outputs: int) -> Mapping[str, int]:
        return {**NetworkFunction.row(self, inputs, outputs), "hidden": self.is_recurrent}

    def gathered(self, inputs: int, outputs: int) -> int:
        return inputs + self.neurons(inputs, outputs)

    @staticmethod
    def lane(t: Any, s: Any, skill: Any, n: int) -> int:
        """Compute the neurons into the rows behind the inputs, where the next ones read them."""
        inputs: int = skill.inputs
        most: int = skill.width
        if skill.hidden:
            recall(s, skill, n)
        place = skill.weights
        centre(skill, s.gathered, inputs, -HALF, n)
        for r in range(most):
            read = inputs + (most if skill.hidden else r)
            layer(t, s, skill, place, s.gathered, read, s.gathered[inputs + r :], 1, False, n)
            centre(skill, s.gathered[inputs + r :], 1, -HALF, n)
            place += skill.bias + inputs + most
        layer(t, s, skill, place, s.gathered, inputs + most, s.hidden, skill.outputs, True, n)
        centre(skill, s.hidden, skill.outputs, HALF, n)
        if skill.hidden:
            remember(s, skill, s.gathered[inputs:], n)
        return 0

    def holds(self, size: tuple[int, int], other: Function, its: tuple[int, int]) -> bool:
        fits = isinstance(other, Neat) and self.most >= other.most and self.links <= other.links  # "any" < "forward"
        return fits and NetworkFunction.holds(self, size, other, its)

    def widened(
        self, weights: Weights, before: tuple[int, int], now: Function, after: tuple[int, int]
    ) -> Weights | None:
        import numpy as np

        if not now.holds(after, self, before):
            return None
        assert isinstance(now, Neat)
        found = np.zeros(now.genome_length(*after), np.float32)
        own, cells = self.network(weights, before[1]), now.network(found, after[1]).cells
        rows = [*range(self.most), *range(now.most, now.most + before[1])]
        first, behind = now.bias, now.bias + after[0]
        columns = [*range(self.bias), *range(first, first + before[0]), *range(behind, behind + self.most)]
        cells[np.ix_(rows, columns)] = np.where(own.allowed, own.cells, 0)
        self.silence(cells[now.most + before[1] :], now.bias)
        return found

    def narrowed(self, weights: Weights, outputs: int, kept: Sequence[int]) -> Weights | None:
        links = self.network(weights, outputs)
        columns = [self.bias + place for place in kept]
        read = range(self.bias, links.direct)
        if not kept or any(links.cells[:, column].any() for column in read if column not in columns):
            return None
        rest = range(links.direct, links.cells.shape[1])
        left: Weights = links.cells[:, [*range(self.bias), *columns, *rest]].ravel()
        return left

    def unread(self, weights: Weights, outputs: int) -> list[int]:
        """The inputs that no link leads from."""
        links = self.network(weights, outputs)
        return [place for place in range(links.direct - self.bias) if not links.cells[:, self.bias + place].any()]

    def pruned(self, weights: Weights, outputs: int) -> Neat:
        return replace(self, most=int(self.network(weights, outputs).live.sum()))

    def recast(self, weights: Weights, size: tuple[int, int], of: Function) -> Weights | None:
        import numpy as np

        from mindrun.numbers.network import matrices

        if not self.genome_length(*size) or of.bias > self.bias or of.centred != self.centred:
            return None
        if isinstance(of, Neat):
            old, now = of.network(weights, size[1]), of.pruned(weights, size[1])
            live = np.flatnonzero(old.live)
            rows, columns = [*live, *range(of.most, len(old.cells))], [*range(old.direct), *(old.direct + live)]
            return now.widened(old.cells[rows][:, columns].ravel(), size, self, size)
        needed = of.neurons_as_links(*size)
        if needed is None or needed > self.most:
            return None
        found = np.zeros(self.genome_length(*size), np.float32)
        self._take_layers(self.network(found, size[1]).cells, matrices(weights, of.layers(*size)), of.bias)
        return found

    def _take_layers(self, cells: Weights, layers: Sequence[Weights], bias: int) -> None:
        """Write the layers of a perceptron, one after the other, into cells that are 0."""
        width, inputs = len(layers[0]), cells.shape[1] - self.most - self.bias
        for number, matrix in enumerate(layers):
            row = number * width if number < len(layers) - 1 else self.most
            column = self.bias + (inputs + (number - 1) * width if number else 0)
            rows = cells[row : row + len(matrix)]
            rows[:, :bias] = matrix[:, :bias]
            rows[:, column : column + matrix.shape[1] - bias] = matrix[:, bias:]

    def reordered(self, weights: Weights, inputs: Sequence[int], outputs: Sequence[int]) -> Weights:
        if not len(weights):
            return weights
        rows = [*range(self.most), *(self.most + place for place in outputs)]
        end = self.bias + len(inputs)
        columns = [*range(self.bias), *(self.bias + place for place in inputs), *range(end, end + self.most)]
        moved: Weights = self.network(weights, len(outputs)).cells[rows][:, columns].ravel()
        return moved

    def draw(self, inputs: int, outputs: int, count: int, rng: np.random.Generator) -> Weights:
        """Random genomes [count, weights] without neurons: everything that is read is linked to every output."""
        import numpy as np

        genomes = np.zeros((count, self.genome_length(inputs, outputs)), np.float32)
        if genomes.size:
            direct = self.bias + inputs
            cells = genomes.reshape(count, self.most + outputs, -1)
            cells[:, self.most :, :direct] = INITIAL_SPREAD * rng.standard_normal((count, outputs, direct), np.float32)
        return genomes

    def network(self, weights: Weights, outputs: int) -> Links:
        """The links that weights are; the same memory."""
        from mindrun.numbers.links import Links

        return Links(weights.reshape(self.most + outputs, -1), self.most, self.bias, self.is_recurrent, self.centred)

    def grown(self, genomes: Weights, outputs: int, rates: Genetic, rng: np.random.Generator) -> Weights:
        found, chosen = genomes.copy(), rng.random((len(genomes), 3)) < (rates.drop, rates.link, rates.grow)
        for genome, (loses, joins, splits) in zip(found, chosen, strict=True):
            links = self.network(genome, outputs)
            if loses:
                links.lose(rng)
            if joins:
                links.join(INITIAL_SPREAD, rng)
            if splits:
                links.split(rng)
        return found

    def crossed(self, mothers: Weights, fathers: Weights, first: Bools, better: Bools) -> Weights:
        from mindrun.numbers.links import crossed

        return crossed(mothers, fathers, first, better)

    def moved(self, genomes: Weights, steps: Weights) -> Weights:
        from mindrun.numbers.links import moved

        return moved(genomes, steps)

    def distance(self, genomes: Weights, one: Weights) -> Doubles:
        from mindrun.numbers.links import distance

        return distance(genomes, one)

    def summary(self, weights: Weights, outputs: int) -> str:
        allowed = (links := self.network(weights, outputs)).allowed
        return f"{(links.cells[allowed] != 0).sum()} of {allowed.sum()} links"
