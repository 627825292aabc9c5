"""The arithmetic of a skill in PyTorch: forward the bits of the engine, backward the derivatives.

Forward every sum is taken in the engine's order, and nothing is fused. Backward the order means nothing, and a product
of matrices is fast.
"""

from typing import Any

import torch
from mindrun.numbers.sigmoid import DENOMINATOR, LIMIT, NUMERATOR
from torch import Tensor
from torch.autograd import Function


class OrderedProduct(Function):
    """y[..., q] = Σ weight[q, j] · x[..., j], strictly from j = 0 on; the derivatives of a product of matrices."""

    generate_vmap_rule = True

    @staticmethod
    def forward(x: Tensor, weight: Tensor) -> Tensor:
        """The sums."""
        total = x[..., :1] * weight[:, 0]
        for j in range(1, weight.shape[1]):
            total += x[..., j : j + 1] * weight[:, j]
        return total

    @staticmethod
    def setup_context(ctx: Any, inputs: tuple[Tensor, Tensor], output: Tensor) -> None:
        """Keep what the derivatives need."""
        ctx.save_for_backward(*inputs)

    @staticmethod
    def backward(ctx: Any, grad: Tensor) -> tuple[Tensor, Tensor]:
        """Of the values, and of the weights."""
        x, weight = ctx.saved_tensors
        return grad @ weight, grad.reshape(-1, weight.shape[0]).T @ x.reshape(-1, weight.shape[1])


class RationalSigmoid(Function):
    """The sigmoid of `mindrun.numbers.sigmoid`; its derivative is taken as y·(1 − y), as that of the true sigmoid."""

    generate_vmap_rule = True

    @staticmethod
    def forward(x: Tensor) -> Tensor:
        """A quotient of two polynomials, within 1e-6 of 1/(1 + e^−x); NaN gives what −∞ gives."""
        x = torch.fmin(torch.fmax(x * 0.5, x.new_tensor(-LIMIT)), x.new_tensor(LIMIT))
        y = x * x
        return _polynomial(y, NUMERATOR).mul_(x).div_(_polynomial(y, DENOMINATOR)).mul_(0.5).add_(0.5)

    @staticmethod
    def setup_context(ctx: Any, inputs: tuple[Tensor], output: Tensor) -> None:
        """Keep the values."""
        ctx.save_for_backward(output)

    @staticmethod
    def backward(ctx: Any, grad: Tensor) -> Tensor:
        """y·(1 − y)."""
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
        """Keep the values before the clamp."""
        ctx.save_for_backward(*inputs)

    @staticmethod
    def backward(ctx: Any, grad: Tensor) -> Tensor:
        """Descent moves a value against its derivative: above 1 it may fall, below 0 it may rise."""
        (x,) = ctx.saved_tensors
        leads_on = ((x > 1) & (grad < 0)) | ((x < 0) & (grad > 0))
        return torch.where(leads_on, torch.zeros_like(grad), grad)
