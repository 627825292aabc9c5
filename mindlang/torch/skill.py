"""A skill that learns, as a module of PyTorch: the function that the engine computes, to the bit on a processor."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import torch
from mindrun.weights import Weights
from torch import Tensor, nn

from mindlang.lock import lock_sources, read_locks
from mindlang.lock.arrange import arrange
from mindlang.lock.status import trained_weights
from mindlang.torch.functions import OrderedProduct, RationalSigmoid, ReturningClamp
from mindlang.weights.files import load_genome, save
from mindlang.weights.network import Network, matrices_of, network_of

if TYPE_CHECKING:
    from mindlang.api import Mind


class Layer(nn.Module):
    """`weight` [values out, values in] without biases, as the engine sums."""

    def __init__(self, inputs: int, outputs: int) -> None:
        super().__init__()
        self.weight = nn.Parameter(torch.zeros(outputs, inputs))

    def forward(self, x: Tensor) -> Tensor:
        """[..., values in] to [..., values out]."""
        return OrderedProduct.apply(x, self.weight)


class Skill(nn.Module):
    """What a skill of a mind computes: readings [..., inputs] to what it sends [..., outputs], in 0..1.

    Begins with the weights that it was taught and that fit, else (or `from_scratch`) with random ones of PyTorch's
    generator. Both stand in the order of `reads` and `sends`. Through the clamp comes the derivative that leads a value
    back into 0..1, and none that leads it on. A skill that remembers is called with its state, too, and returns that
    of the next tick: `commands, state = skill(readings, state)`, with `skill.start(batch)` in the beginning.

    MindError where the file has errors, the skill learns nothing, or is like another one.
    """

    def __init__(self, mind: Mind, name: str, from_scratch: bool = False) -> None:
        super().__init__()
        lock = read_locks(lock_sources(mind.compiled.sources))
        graph = arrange(mind.graph, lock)
        self.network = network_of(graph, name)
        known = {} if from_scratch else trained_weights(graph, lock, [name])[0]
        self.layers = nn.ModuleList(Layer(before, after) for before, after in self.network.shapes)
        self.take(known[name] if name in known else _random(self.network))

    @property
    def reads(self) -> tuple[str, ...]:
        """Its inputs in order; a sensor with several readings says how many: proximity:10."""
        return self.network.signature.reads

    @property
    def sends(self) -> tuple[str, ...]:
        """The actuators, skills and memories to which its outputs go, in order."""
        return self.network.signature.sends

    def forward(self, readings: Tensor, state: Tensor | None = None) -> Tensor | tuple[Tensor, Tensor]:
        """What it sends; with what it remembers, where it does."""
        if not self.network.state:
            return ReturningClamp.apply(self._last(readings))
        before = self.start(*readings.shape[:-1]) if state is None else state
        said = RationalSigmoid.apply(self.layers[0](torch.cat([readings, before.to(readings)], -1)))
        return ReturningClamp.apply(self.layers[1](said)), said

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

    def save(self, path: Path | str) -> None:
        """Write its weights as safetensors, with what they read and send; `mindc weights import` brings them home."""
        save(Path(path), self.network, self.genome())

    def load(self, path: Path | str) -> None:
        """Take the weights of a file; WeightsError where they are not those of this skill."""
        self.take(load_genome(Path(path), self.network))

    def extra_repr(self) -> str:
        """Whose function it is."""
        return f"{self.network.skill.name} is {self.network.signature.function}"

    def _last(self, readings: Tensor) -> Tensor:
        *hidden, last = self.layers
        values = readings
        for layer in hidden:
            values = RationalSigmoid.apply(layer(values))
        return last(values)


def _random(network: Network) -> Weights:
    """As learning begins with them here; the seed is that of PyTorch's generator."""
    rng = np.random.default_rng(int(torch.randint(2**62, ())))
    return network.skill.function.draw(network.inputs, network.outputs, 1, rng)[0]
