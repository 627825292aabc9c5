"""A gated recurrent unit: gates say what of its state it keeps, and what of that it looks at (Cho et al., 2014)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from mindrun.kinds.functions.elman import recall, remember
from mindrun.kinds.functions.function import NetworkFunction, Switch, Width
from mindrun.kinds.functions.mlp import centre, layer
from mindrun.kinds.registry import kind, left_out

if TYPE_CHECKING:  # a lane is given its terms when it is compiled
    from mindrun.numbers.arithmetic import *
    from mindrun.numbers.arrays import Layers
    from mindrun.numbers.network import Terms


@kind("skill", "gru")
class Gru(NetworkFunction):
    """A gated recurrent unit with `width` neurons (0: Eq. 5, max(inputs, outputs) + 2).

    Each neuron keeps a share of what it said when the skill last computed, as its update gate says, and takes the rest
    from a candidate. Gates and candidate are sigmoids of the skill's inputs and of what all neurons said, 0 at the
    beginning of a run; the candidate sees of that what its reset gate lets through. So a neuron can remember for long
    what an `elman` forgets. A skill without influence does not compute, and remembers.
    """

    width: Width = 0
    bias: Switch = left_out(0)
    centred: Switch = left_out(0)

    opaque = "remembers what it computed"
    readers = 3

    def state_length(self, inputs: int, outputs: int) -> int:
        return self.neurons(inputs, outputs)

    def matrix_shapes(self, inputs: int, outputs: int) -> Layers:
        width = self.neurons(inputs, outputs)
        b = self.bias
        return (*[(b + inputs + width, width)] * 3, (b + width, outputs)) if width else ()

    def forward(self, of: Terms, matrices: Sequence[Any], inputs: Any, state: Any) -> tuple[Any, Any]:
        """r, u = σ(R·[x, s]), σ(U·[x, s]); c = σ(C·[x, r·s]); s' = u·s + (1 − u)·c, and the outputs O·s'.

        With a bias, of each matrix the first column is added. A centred one takes c less 1/2, and so keeps s.
        """
        reset, update, candidate, last = matrices
        values = self.taken(inputs)
        both = self.read(of, of.joined(values, state))
        through, kept = of.sigmoid(of.product(both, reset)), of.sigmoid(of.product(both, update))
        new = self.taken(of.sigmoid(of.product(self.read(of, of.joined(values, through * state)), candidate)))
        said = kept * state + (1 - kept) * new
        return self.sent(of.product(self.read(of, said), last)), said

    def scratch(self, inputs: int, outputs: int) -> int:
        return 3 * self.neurons(inputs, outputs) + outputs

    @staticmethod
    def lane(t: Any, s: Any, skill: Any, n: int) -> int:
        """Compute `forward` with its sums and products in the same order, sixteen lanes at a time."""
        inputs: int = skill.inputs
        width: int = skill.width
        reset, kept, new = s.hidden[:width], s.hidden[width : 2 * width], s.hidden[2 * width : 3 * width]
        recall(s, skill, n)
        centre(skill, s.gathered, inputs, -HALF, n)
        place = layer(t, s, skill, skill.weights, s.gathered, inputs + width, reset, width, False, n)
        place = layer(t, s, skill, place, s.gathered, inputs + width, kept, width, False, n)
        for j in range(width):
            for p in range(0, n, LANES):
                store(s.gathered, inputs + j, p, load(reset, j, p) * load(s.gathered, inputs + j, p))
        place = layer(t, s, skill, place, s.gathered, inputs + width, new, width, False, n)
        centre(skill, new, width, -HALF, n)
        recall(s, skill, n)
        for j in range(width):
            for k in range(n):
                new[j, k] = kept[j, k] * s.gathered[inputs + j, k] + (ONE - kept[j, k]) * new[j, k]
        layer(t, s, skill, place, new, width, s.hidden[3 * width :], skill.outputs, True, n)
        centre(skill, s.hidden[3 * width :], skill.outputs, HALF, n)
        remember(s, skill, new, n)
        return 3 * width
