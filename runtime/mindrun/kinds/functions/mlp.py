"""The multi-layer perceptron of the paper (4.1): sigmoid hidden layers, a linear last layer in 0..1."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Annotated, Any

from mindrun.kinds.functions.function import NetworkFunction, Switch, Width
from mindrun.kinds.registry import kind, left_out
from mindrun.numbers.quantity import Quantity

if TYPE_CHECKING:  # a lane is given its terms when it is compiled
    from mindrun.numbers.arithmetic import *
    from mindrun.numbers.arrays import Layers
    from mindrun.numbers.network import Terms

HIDDEN = Quantity("a whole number", {"": 1.0}, low=0, high=16, whole=True)


@kind("skill", "mlp")
class Mlp(NetworkFunction):
    """A perceptron with `hidden` layers of `width` neurons (0: Eq. 5, max(inputs, outputs) + 2).

    The paper's has no biases. With `bias 1` each layer has one more input, which is always 1.
    """

    hidden: Annotated[int, HIDDEN] = 2
    width: Width = 0
    bias: Switch = left_out(0)
    centred: Switch = left_out(0)

    def matrix_shapes(self, inputs: int, outputs: int) -> Layers:
        widths = [self.neurons(inputs, outputs)] * self.hidden
        sizes = pairwise((inputs, *widths, outputs)) if inputs and outputs else ()
        return tuple((before + self.bias, after) for before, after in sizes)

    def neurons_as_links(self, inputs: int, outputs: int) -> int | None:
        return self.hidden * self.neurons(inputs, outputs)

    def forward(self, of: Terms, matrices: Sequence[Any], inputs: Any, state: Any) -> tuple[Any, Any]:
        *hidden, last = matrices
        values = self.taken(inputs)
        for matrix in hidden:
            values = self.taken(of.sigmoid(of.product(self.read(of, values), matrix)))
        return self.sent(of.product(self.read(of, values), last)), state

    def row(self, inputs: int, outputs: int) -> Mapping[str, int]:
        shapes = self.matrix_shapes(inputs, outputs)
        own = {"hidden": len(shapes) - 1, "width": shapes[0][1]} if shapes else {}
        return {**NetworkFunction.row(self, inputs, outputs), **own}

    def scratch(self, inputs: int, outputs: int) -> int:
        return 2 * max(self.neurons(inputs, outputs) if self.hidden else 0, outputs)

    @staticmethod
    def lane(t: Any, s: Any, skill: Any, n: int) -> int:
        """Compute the layers into the two halves of `s.hidden` by turns."""
        half: int = s.hidden.shape[0] // 2
        source, inputs, place = s.gathered, skill.inputs, skill.weights
        base = half
        centre(skill, source, inputs, -HALF, n)
        for number in range(skill.hidden + 1):
            base = half - base
            target = s.hidden[base : base + half]
            last = number == skill.hidden
            outputs = skill.outputs if last else skill.width
            place = layer(t, s, skill, place, source, inputs, target, outputs, last, n)
            centre(skill, target, outputs, HALF if last else -HALF, n)
            source, inputs = target, outputs
        return base


def layer(
    t: Any, s: Any, skill: Any, place: Any, source: Any, inputs: int, target: Any, outputs: int, last: bool, n: int
) -> Any:
    """Compute `target` [outputs, lane] from `source` [inputs, lane] with the weights from `place` on; return their end.

    The sigmoids of the sums, or the sums where it is the `last` layer. The weights are each lane's own, or all lanes'.
    """
    if skill.own:
        dense(s.genome[place:], source, inputs, skill.bias, target, outputs, last, n)
    else:
        dense(t.weights[place:], source, inputs, skill.bias, target, outputs, last, n)
    return place + (inputs + skill.bias) * outputs


def centre(skill: Any, values: Any, rows: int, by: Any, n: int) -> None:
    """Add `by` to the first rows of values [row, lane], where the function of a skill is centred."""
    for j in range(rows if skill.centred else 0):
        for p in range(0, n, LANES):
            store(values, j, p, load(values, j, p) + splat(by))


def dense(w: Any, source: Any, inputs: int, bias: int, target: Any, outputs: int, last: bool, n: int) -> None:
    """target[q] = bias + Σ weight · source[j], summed in the order of j; then the sigmoid, but for the last layer.

    Sixteen lanes and four outputs at a time, then two and one. The weights stand output after output, each begins with
    its bias, if there is one: w is flat, or [weight, lane].
    """
    for p in range(0, n, LANES):
        for q in range(0, outputs - 3, 4):
            four(w, source, inputs, bias, target, q, last, p)
        if outputs & 2:
            two(w, source, inputs, bias, target, outputs // 4 * 4, last, p)
        if outputs & 1:
            one(w, source, inputs, bias, target, outputs - 1, last, p)


def begun(w: Any, place: int, bias: int, p: int) -> Any:
    """The beginning of a sum: its bias, 0 without one."""
    return load(w, place, p) if bias else splat(ZERO)


def four(w: Any, source: Any, inputs: int, bias: int, target: Any, q: int, last: bool, p: int) -> None:
    """Compute the outputs q to q + 3 in the lanes from p on."""
    each = inputs + bias
    first = q * each
    a, b = begun(w, first, bias, p), begun(w, first + each, bias, p)
    c, d = begun(w, first + 2 * each, bias, p), begun(w, first + 3 * each, bias, p)
    first += bias
    for j in range(inputs):
        x = load(source, j, p)
        a = a + load(w, first + j, p) * x
        b = b + load(w, first + each + j, p) * x
        c = c + load(w, first + 2 * each + j, p) * x
        d = d + load(w, first + 3 * each + j, p) * x
    if not last:
        a, b, c, d = sigmoids(a, b, c, d)
    store(target, q, p, a)
    store(target, q + 1, p, b)
    store(target, q + 2, p, c)
    store(target, q + 3, p, d)


def two(w: Any, source: Any, inputs: int, bias: int, target: Any, q: int, last: bool, p: int) -> None:
    """Compute the outputs q and q + 1 in the lanes from p on."""
    each = inputs + bias
    first = q * each
    a, b = begun(w, first, bias, p), begun(w, first + each, bias, p)
    first += bias
    for j in range(inputs):
        x = load(source, j, p)
        a = a + load(w, first + j, p) * x
        b = b + load(w, first + each + j, p) * x
    if not last:
        a, b = sigmoids(a, b)
    store(target, q, p, a)
    store(target, q + 1, p, b)


def one(w: Any, source: Any, inputs: int, bias: int, target: Any, q: int, last: bool, p: int) -> None:
    """Compute output q in the lanes from p on."""
    first = q * (inputs + bias)
    a = begun(w, first, bias, p)
    for j in range(inputs):
        a = a + load(w, first + bias + j, p) * load(source, j, p)
    if not last:
        (a,) = sigmoids(a)
    store(target, q, p, a)
