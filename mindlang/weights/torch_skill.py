"""A skill of a mind as a module of PyTorch, and the file in which its weights go there and back."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import torch
from mindrun.graph.weights import Weights

from mindlang.lock import lock_sources, read_locks
from mindlang.lock.arrange import arrange
from mindlang.lock.status import trained_weights
from mindlang.weights.files import load_genome, save
from mindlang.weights.network import Network, network_of
from mindlang.weights.torch_module import NetworkModule

if TYPE_CHECKING:
    from mindlang.api import Mind


class Skill(NetworkModule):
    """What a skill of a mind computes, with the weights that it was taught; see `NetworkModule` for how it is called.

    Where there are none that fit, or `from_scratch`, with random ones of PyTorch's generator. `reads` and `sends` say
    what its inputs and outputs are, in their order; a sensor with several readings says how many: proximity:10.

    MindError where the file has errors, and where the skill learns nothing or is like another one.
    """

    def __init__(self, mind: Mind, name: str, from_scratch: bool = False) -> None:
        lock = read_locks(lock_sources(mind.compiled.sources))
        graph = arrange(mind.graph, lock)
        network = network_of(graph, name)
        taught = {} if from_scratch else trained_weights(graph, lock, [name])[0]
        super().__init__(network, taught[name] if name in taught else _random(network))
        self.reads, self.sends = network.signature.reads, network.signature.sends

    def save(self, path: Path | str) -> None:
        """Write its weights as safetensors, with what they read and send; `mindc weights import` takes them."""
        save(Path(path), self.network, self.genome())

    def load(self, path: Path | str) -> None:
        """Take the weights of a file; WeightsError where they are not those of this skill."""
        self.take(load_genome(Path(path), self.network))


def _random(network: Network) -> Weights:
    """As learning begins with them here; the seed is that of PyTorch's generator."""
    rng = np.random.default_rng(int(torch.randint(2**62, ())))
    return network.skill.function.draw(network.inputs, network.outputs, 1, rng)[0]
