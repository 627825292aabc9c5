"""A recurrent network: what its hidden neurons said in the tick before is among their inputs (Elman, 1990)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from mindrun.kinds.functions.function import NetworkFunction, Switch, Width
from mindrun.kinds.functions.mlp import centre, layer
from mindrun.kinds.registry import kind, left_out

if TYPE_CHECKING:  # a lane is given its terms when it is compiled
    from mindrun.numbers.arithmetic import *
    from mindrun.numbers.arrays import Layers
    from mindrun.numbers.network import Terms


@kind("skill", "elman")
class Elman(NetworkFunction):
    """A recurrent network with one hidden layer of `width` neurons (0: Eq. 5, max(inputs, outputs) + 2).

    Its neurons read the skill's inputs and what they all said when the skill last computed, 0 at the beginning of a
    run. A skill without influence does not compute, and remembers.
    """

    width: Width = 0
    bias: Switch = left_out(0)
    centred: Switch = left_out(0)

    opaque = "remembers what it computed"

    def state_length(self, inputs: int, outputs: int) -> int:
        return self.neurons(inputs, outputs)

    def matrix_shapes(self, inputs: int, outputs: int) -> Layers:
        width = self.neurons(inputs, outputs)
        b = self.bias
        return ((b + inputs + width, width), (b + width, outputs)) if width else ()

    def forward(self, of: Terms, matrices: Sequence[Any], inputs: Any, state: Any) -> tuple[Any, Any]:
        """h' = σ(H·[x, h]), and the outputs O·h'; h are the hidden neurons' last outputs, h' the new state.

        With a bias, of both matrices the first column is added. A centred one keeps h less 1/2.
        """
        hidden, last = matrices
        said = self.taken(of.sigmoid(of.product(self.read(of, of.joined(self.taken(inputs), state)), hidden)))
        return self.sent(of.product(self.read(of, said), last)), said

    def scratch(self, inputs: int, outputs: int) -> int:
        return self.neurons(inputs, outputs) + outputs

    @staticmethod
    def lane(t: Any, s: Any, skill: Any, n: int) -> int:
        """Write the outputs of `forward` behind the hidden neurons, which are remembered."""
        width: int = skill.width
        recall(s, skill, n)
        centre(skill, s.gathered, skill.inputs, -HALF, n)
        last = layer(t, s, skill, skill.weights, s.gathered, skill.inputs + width, s.hidden, width, False, n)
        centre(skill, s.hidden, width, -HALF, n)
        layer(t, s, skill, last, s.hidden, width, s.hidden[width:], skill.outputs, True, n)
        centre(skill, s.hidden[width:], skill.outputs, HALF, n)
        remember(s, skill, s.hidden, n)
        return width


def recall(s: Any, skill: Any, n: int) -> None:
    """Copy a skill's memory behind its inputs, into `s.gathered`."""
    for j in range(skill.width):
        for k in range(n):
            s.gathered[skill.inputs + j, k] = s.recurrent[skill.state + j, s.active[k]]


def remember(s: Any, skill: Any, said: Any, n: int) -> None:
    """Store the neurons' outputs `said` [neuron, world], where the skill has influence and all its inputs are sound."""
    for j in range(skill.width):
        for k in range(n):
            if s.sound[k] == ZERO and s.influence[skill.index, s.active[k]] != ZERO:
                s.recurrent[skill.state + j, s.active[k]] = said[j, k]
