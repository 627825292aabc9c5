"""The network of a skill as a module of PyTorch: the function that the engine computes, to the bit on a processor."""

import numpy as np
import torch
from mindrun.graph.weights import Weights
from torch import Tensor, nn

from mindlang.weights.network import Network, matrices_of
from mindlang.weights.torch_functions import OrderedProduct, RationalSigmoid, ReturningClamp


class Layer(nn.Module):
    """`weight` [values out, values in] without biases, as the engine sums."""

    def __init__(self, inputs: int, outputs: int) -> None:
        super().__init__()
        self.weight = nn.Parameter(torch.zeros(outputs, inputs))

    def forward(self, x: Tensor) -> Tensor:
        """[..., values in] to [..., values out]."""
        return OrderedProduct.apply(x, self.weight)


class NetworkModule(nn.Module):
    """Readings [..., inputs] to what its skill sends [..., outputs], in 0..1, with the weights of a genome.

    Through the clamp comes the derivative that leads a value back into 0..1, and none that leads it on. A network that
    remembers is called with its state, too, and returns that of the next tick: `sent, state = skill(readings, state)`,
    with None or `start(batch)` in the beginning.
    """

    def __init__(self, network: Network, genome: Weights) -> None:
        super().__init__()
        self.network = network
        self.layers = nn.ModuleList(Layer(before, after) for before, after in network.shapes)
        self.take(genome)

    def forward(self, readings: Tensor, state: Tensor | None = None) -> Tensor | tuple[Tensor, Tensor]:
        """What it sends; with what it remembers, where it does."""
        if not self.network.state:
            return ReturningClamp.apply(self.before_clamp(readings))
        before = self.start(*readings.shape[:-1]) if state is None else state
        neurons = RationalSigmoid.apply(self.layers[0](torch.cat([readings, before], -1)))
        return ReturningClamp.apply(self.layers[1](neurons)), neurons

    def before_clamp(self, readings: Tensor) -> Tensor:
        """What its last layer adds up to, of a network that remembers nothing: the mean of a policy that explores."""
        *hidden, last = self.layers
        values = readings
        for layer in hidden:
            values = RationalSigmoid.apply(layer(values))
        return last(values)

    def start(self, *batch: int) -> Tensor:
        """What it remembers before the first tick of a run: zeros [..., state]."""
        return self.layers[0].weight.new_zeros(*batch, self.network.state)

    def take(self, genome: Weights) -> None:
        """Take the weights of a genome."""
        with torch.no_grad():
            for layer, matrix in zip(self.layers, matrices_of(self.network, genome), strict=True):
                layer.weight.copy_(torch.from_numpy(np.array(matrix)))

    def genome(self) -> Weights:
        """Its weights as the engine has them: float32 [genes]."""
        flat = [layer.weight.detach().to("cpu", torch.float32).numpy().ravel() for layer in self.layers]
        return np.concatenate(flat)

    def extra_repr(self) -> str:
        """Whose function it is."""
        return f"{self.network.skill.name} is {self.network.signature.function}"
