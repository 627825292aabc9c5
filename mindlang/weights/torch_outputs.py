"""What a skill's network sends in PyTorch, which is imported here alone, and where it is asked for."""

import numpy as np
from mindrun.graph.weights import Weights
from numpy.typing import NDArray

from mindlang.weights.network import Network

Rows = NDArray[np.float32]  # [ticks, values]


def in_torch(network: Network, genome: Weights, inputs: Rows) -> Rows:
    """A network's outputs [ticks, outputs] for a run's inputs [ticks, inputs], by PyTorch; ImportError without it."""
    import torch

    from mindlang.weights.torch_module import NetworkModule

    module, rows = NetworkModule(network, genome), torch.from_numpy(inputs)
    with torch.no_grad():
        if not network.state:
            return np.asarray(module(rows).numpy())
        found, state = [], None
        for row in rows:
            outputs, state = module(row, state)
            found.append(outputs.numpy())
    return np.array(found, np.float32).reshape(len(inputs), network.outputs)
