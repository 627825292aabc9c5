"""A skill of a mind as a module of PyTorch: forward the bits of the engine, backward the derivatives.

Forward every sum is taken in the engine's order, and nothing is fused. Backward the order means nothing, and a product
of matrices is fast.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import torch
from mindrun.errors import MindError, WeightsError, system_errors_as
from mindrun.files.atomic_write import write
from mindrun.graph.graph import Skill as GraphSkill
from mindrun.graph.weights import Weights
from mindrun.numbers.arithmetic import DENOMINATOR, LIMIT, NUMERATOR
from mindrun.numbers.network import Terms, matrices
from torch import Tensor, nn
from torch.autograd import Function

from mindlang.lock import lock_sources, read_locks
from mindlang.lock.signature import arrange
from mindlang.lock.status import trained_weights
from mindlang.weights.network import SkillNetwork, genome_in, network_of, read_bytes, to_bytes

if TYPE_CHECKING:
    from mindlang.api import Mind


class OrderedProduct(Function):
    """y[..., q] = Σ weight[q, j] · x[..., j], strictly from j = 0 on; the derivatives of a product of matrices."""

    generate_vmap_rule = True

    @staticmethod
    def forward(x: Tensor, weight: Tensor) -> Tensor:
        total = x[..., :1] * weight[:, 0]
        for j in range(1, weight.shape[1]):
            total += x[..., j : j + 1] * weight[:, j]
        return total

    @staticmethod
    def setup_context(ctx: Any, inputs: tuple[Tensor, Tensor], output: Tensor) -> None:
        ctx.save_for_backward(*inputs)

    @staticmethod
    def backward(ctx: Any, grad: Tensor) -> tuple[Tensor, Tensor]:
        x, weight = ctx.saved_tensors
        return grad @ weight, grad.reshape(-1, weight.shape[0]).T @ x.reshape(-1, weight.shape[1])


class RationalSigmoid(Function):
    """The sigmoid of `mindrun.numbers.arithmetic`; its derivative is y·(1 − y), as that of the true sigmoid."""

    generate_vmap_rule = True

    @staticmethod
    def forward(x: Tensor) -> Tensor:
        """A quotient of two polynomials, within 1e-6 of 1/(1 + e^−x); NaN gives what −∞ gives."""
        x = torch.fmin(torch.fmax(x * 0.5, x.new_tensor(-LIMIT)), x.new_tensor(LIMIT))
        y = x * x
        return _polynomial(y, NUMERATOR).mul_(x).div_(_polynomial(y, DENOMINATOR)).mul_(0.5).add_(0.5)

    @staticmethod
    def setup_context(ctx: Any, inputs: tuple[Tensor], output: Tensor) -> None:
        ctx.save_for_backward(output)

    @staticmethod
    def backward(ctx: Any, grad: Tensor) -> Tensor:
        (y,) = ctx.saved_tensors
        return grad * y * (1 - y)


def _polynomial(y: Tensor, coefficients: tuple[float, ...]) -> Tensor:
    """Lowest power first, evaluated from the highest on."""
    *rest, top = coefficients
    total = y * top
    for a in reversed(rest[1:]):
        total.add_(a).mul_(y)
    return total.add_(rest[0])


class ReturningClamp(Function):
    """The value within 0..1. What leads a value that is outside back has its derivative, what leads on has none.

    As nothing comes back through torch.clamp, a neuron that is outside for all readings would never learn again.
    """

    generate_vmap_rule = True

    @staticmethod
    def forward(x: Tensor) -> Tensor:
        """The engine sends nothing where a value is not finite: that is NaN here."""
        return torch.where(torch.isfinite(x), x.clamp(0, 1), torch.nan)

    @staticmethod
    def setup_context(ctx: Any, inputs: tuple[Tensor], output: Tensor) -> None:
        ctx.save_for_backward(*inputs)

    @staticmethod
    def backward(ctx: Any, grad: Tensor) -> Tensor:
        """Descent moves a value against its derivative: above 1 it may fall, below 0 it may rise."""
        (x,) = ctx.saved_tensors
        leads_on = ((x > 1) & (grad < 0)) | ((x < 0) & (grad > 0))
        return torch.where(leads_on, torch.zeros_like(grad), grad)


def _joined(one: Tensor, other: Tensor) -> Tensor:
    return torch.cat([one, other], -1)


def _biased(values: Tensor) -> Tensor:
    return _joined(values.new_ones(*values.shape[:-1], 1), values)


TERMS = Terms(
    OrderedProduct.apply, RationalSigmoid.apply, _joined, _biased
)  # in which a function says what it computes


class Layer(nn.Module):
    """`weight` [values out, values in]; of one with a bias the first of these is 1."""

    def __init__(self, inputs: int, outputs: int) -> None:
        super().__init__()
        self.weight = nn.Parameter(torch.zeros(outputs, inputs))


class NetworkModule(nn.Module):
    """Readings [..., inputs] to what its skill sends [..., outputs], in 0..1, with the weights of a genome.

    Through the clamp comes the derivative that leads a value back into 0..1, and none that leads it on. A network that
    remembers is called with its state, too, and returns that of the next tick: `sent, state = skill(readings, state)`,
    with None or `start(batch)` in the beginning.
    """

    def __init__(self, network: SkillNetwork, genome: Weights) -> None:
        super().__init__()
        self.network = network
        self.choice = _choice(network.skill)
        self.layers = nn.ModuleList(Layer(before, after) for before, after in network.shapes)
        self.take(genome)

    def forward(self, readings: Tensor, state: Tensor | None = None) -> Tensor | tuple[Tensor, Tensor]:
        """The values sent; of a network that remembers, with its state after the tick."""
        values, after = self._computed(readings, state)
        sent = ReturningClamp.apply(values)
        if self.choice:
            sent = sent.index_copy(-1, torch.tensor(self.choice, device=sent.device), _chosen(values[..., self.choice]))
        return (sent, after) if self.network.state else sent

    def before_clamp(self, readings: Tensor) -> Tensor:
        """The sums of its last layer, of a network that remembers nothing: the mean of a policy that explores."""
        return self._computed(readings, None)[0]

    def _computed(self, readings: Tensor, state: Tensor | None) -> tuple[Tensor, Tensor]:
        before = self.start(*readings.shape[:-1]) if state is None else state
        weights = [layer.weight for layer in self.layers]
        return self.network.skill.function.forward(TERMS, weights, readings, before)

    def start(self, *batch: int) -> Tensor:
        """The state before the first tick of a run: zeros [*batch, state]."""
        return self.layers[0].weight.new_zeros(*batch, self.network.state)

    def take(self, genome: Weights) -> None:
        with torch.no_grad():
            for layer, matrix in zip(self.layers, matrices(genome, self.network.shapes), strict=True):
                layer.weight.copy_(torch.from_numpy(np.array(matrix)))

    def genome(self) -> Weights:
        """The weights of the module as the engine has them: float32 [genes]."""
        flat = [layer.weight.detach().to("cpu", torch.float32).numpy().ravel() for layer in self.layers]
        return np.concatenate(flat)

    def extra_repr(self) -> str:
        return f"{self.network.skill.name} is {self.network.signature.function}"


class Skill(NetworkModule):
    """A skill of a mind as a module, with the weights that it was taught; see `NetworkModule` for how it is called.

    Where there are none that fit, or `from_scratch`, with random ones of PyTorch's generator. `reads` and `sends` say
    what its inputs and outputs are, in their order; a sensor with several readings says how many: proximity:10.

    MindError where the file has errors, and where the skill learns nothing or is like another one.
    """

    def __init__(self, mind: "Mind", name: str, from_scratch: bool = False) -> None:
        lock = read_locks(lock_sources(mind.compiled.sources))
        graph = arrange(mind.graph, lock)
        network = network_of(graph, name)
        taught = {} if from_scratch else trained_weights(graph, lock, [name])[0]
        super().__init__(network, taught[name] if name in taught else _random(network))
        self.reads, self.sends = network.signature.reads, network.signature.sends

    def save(self, path: Path | str) -> None:
        """Write its weights as safetensors, with what they read and send; `mindc weights import` takes them."""
        with system_errors_as(WeightsError, f"{path} cannot be written"):
            write(Path(path), to_bytes(self.network, self.genome()))

    def load(self, path: Path | str) -> None:
        """Load the weights of a file; WeightsError where they are not those of this skill."""
        self.take(genome_in(Path(path), read_bytes(Path(path)), self.network))


def _choice(skill: GraphSkill) -> list[int]:
    """The outputs of a skill that chooses among which it does; none of one that does not.

    MindError where it chooses among what no output says, too.
    """
    influences = [edge for edge in skill.edges if edge.to == "skill"] if skill.chooses else []
    found = [edge.output for edge in influences if edge.output is not None and edge.gate is None]
    if len(found) < len(influences):
        message = f"{skill.name} chooses among lines with at or when, of which its function knows nothing"
        raise MindError(message, "Leave at and when out of its influences, or let it choose in the engine.")
    return found


def _chosen(values: Tensor) -> Tensor:
    """1 for the greatest of the values [..., n], of equals the first, and 0 for the others; NaN where one is no number.

    The derivatives are those of a softmax: a choice itself has none.
    """
    is_number = torch.isfinite(values)
    among = torch.where(is_number, values, -torch.inf)
    soft = torch.softmax(among, -1)
    one = torch.nn.functional.one_hot(among.argmax(-1), values.shape[-1]).to(values)
    return torch.where(is_number, one + (soft - soft.detach()), torch.nan)


def _random(network: SkillNetwork) -> Weights:
    """Random weights as `mindc train` begins with, seeded by PyTorch's generator."""
    rng = np.random.default_rng(int(torch.randint(2**62, ())))
    return network.skill.function.draw(network.inputs, network.outputs, 1, rng)[0]
