"""A continuous-time recurrent network: each neuron follows what drives it in a time of its own (Beer, 1995)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from mindrun.kinds.functions.elman import recall, remember
from mindrun.kinds.functions.function import NetworkFunction, Width
from mindrun.kinds.functions.mlp import layer
from mindrun.kinds.registry import kind

if TYPE_CHECKING:  # a lane is given its terms when it is compiled
    import numpy as np

    from mindrun.numbers.arithmetic import *
    from mindrun.numbers.arrays import Layers, Weights
    from mindrun.numbers.network import Terms

TICK_DOUBLINGS = 8  # of a time constant, from 1 tick to 256


@kind("skill", "ctrnn")
class Ctrnn(NetworkFunction):
    """A continuous-time recurrent network of `width` neurons (0: Eq. 5, max(inputs, outputs) + 2).

    A neuron has a state, 0 at the beginning of a run, and says the sigmoid of the sum of that and its bias. The skill's
    inputs and what all neurons say drive it: in each tick its state goes a part of the way there, all of it with a time
    constant of 1 tick, 1/256 with one of 256. So some of its neurons are quick, and others remember. Time constants and
    biases are learnt, too. A skill without influence does not compute, and remembers.
    """

    width: Width = 0

    opaque = "remembers what it computed"

    def state_length(self, inputs: int, outputs: int) -> int:
        return self.neurons(inputs, outputs)

    def matrix_shapes(self, inputs: int, outputs: int) -> Layers:
        """What drives the neurons; of each its bias and the gene of its time constant; the outputs."""
        width = self.neurons(inputs, outputs)
        return ((inputs + width, width), (2, width), (width, outputs)) if width else ()

    def forward(self, of: Terms, matrices: Sequence[Any], inputs: Any, state: Any) -> tuple[Any, Any]:
        """y' = y + (W·[x, σ(y + θ)] − y) / τ, and the outputs O·σ(y' + θ); y is the state, y' the new one.

        τ = 2^⌊g⌋·(1 + (g − ⌊g⌋)) ticks for the gene g, clamped to 1..256: straight lines between the powers of two.
        """
        drive, own, last = matrices
        bias, gene = own.T[..., 0, :], own.T[..., 1, :]
        ticks = sum((2**i * (gene - i).clip(0, 1) for i in range(TICK_DOUBLINGS)), 1.0)
        driven = of.product(of.joined(inputs, of.sigmoid(state + bias)), drive)
        after = state + (driven - state) / ticks
        return of.product(of.sigmoid(after + bias), last), after

    def draw(self, inputs: int, outputs: int, count: int, rng: np.random.Generator) -> Weights:
        """Random genomes [count, weights] whose outputs and neurons stay at 1/2 where all readings are 1/2.

        Each doubling of a time constant is as likely as any other.
        """
        genomes = NetworkFunction.draw(self, inputs, outputs, count, rng)
        for read, width in self.matrix_shapes(inputs, outputs)[:1]:
            drive, own = genomes[:, : read * width], genomes[:, read * width : (read + 2) * width]
            own[:, ::2] = -drive.reshape(count, width, read).sum(axis=2) / 2
            own[:, 1::2] = rng.uniform(0, TICK_DOUBLINGS, (count, width))
        return genomes

    def scratch(self, inputs: int, outputs: int) -> int:
        return self.neurons(inputs, outputs) + outputs

    @staticmethod
    def lane(t: Any, s: Any, skill: Any, n: int) -> int:
        """Compute `forward` with its sums and products in the same order, sixteen lanes at a time."""
        inputs: int = skill.inputs
        width: int = skill.width
        state = s.gathered[inputs:]
        recall(s, skill, n)
        if skill.own:
            fire(s.genome[skill.weights + (inputs + width) * width :], state, state, width, n)
        else:
            fire(t.weights[skill.weights + (inputs + width) * width :], state, state, width, n)
        own = layer(t, s, skill, skill.weights, s.gathered, inputs + width, s.hidden, width, True, n)
        recall(s, skill, n)
        if skill.own:
            follow(s.genome[own:], s.hidden, state, width, n)
            fire(s.genome[own:], state, s.hidden, width, n)
        else:
            follow(t.weights[own:], s.hidden, state, width, n)
            fire(t.weights[own:], state, s.hidden, width, n)
        layer(t, s, skill, own + 2 * width, s.hidden, width, s.hidden[width:], skill.outputs, True, n)
        remember(s, skill, state, n)
        return width


def fire(w: Any, state: Any, target: Any, width: int, n: int) -> None:
    """Write what the neurons say in their state [neuron, world] into `target`; w holds bias and gene of each."""
    for j in range(width):
        for p in range(0, n, LANES):
            (said,) = sigmoids(load(state, j, p) + load(w, 2 * j, p))
            store(target, j, p, said)


def follow(w: Any, driven: Any, state: Any, width: int, n: int) -> None:
    """Move the neurons' state [neuron, world] towards what drives them; w holds bias and gene of each."""
    for j in range(width):
        for p in range(0, n, LANES):
            gene, ticks, power = load(w, 2 * j + 1, p), splat(ONE), splat(ONE)
            for _ in range(TICK_DOUBLINGS):
                ticks = ticks + power * highest(lowest(gene, splat(ONE)), splat(ZERO))
                gene, power = gene - splat(ONE), power + power
            y = load(state, j, p)
            store(state, j, p, y + (load(driven, j, p) - y) / ticks)
