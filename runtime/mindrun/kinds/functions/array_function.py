"""The base of functions in numpy: a kind of one's own says what it computes, over all runs of a tick at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Self

from mindrun.errors import MindError, ProcedureError, text_of
from mindrun.kinds.functions.function import NetworkFunction
from mindrun.kinds.registry import names

if TYPE_CHECKING:
    from mindrun.kinds.procedure_text import Sources
    from mindrun.numbers.arrays import Compute, Singles, Weights
    from mindrun.numbers.network import Terms


class ArrayFunction(NetworkFunction):
    """A function that `apply` computes, the same for the simulator, the engine and the robot; nothing is compiled.

    `matrix_shapes` says the matrices that it learns (the last one gives the outputs, the first `readers` read the
    inputs), `state_length` how many values it remembers. Without `matrix_shapes` it learns nothing: say `learns =
    False`. Without inputs or outputs its outputs are 0.
    """

    __slots__ = ()

    opaque = "is computed in numpy"
    in_arrays = True

    def apply(
        self, x: Singles, w: tuple[Singles, ...], state: Singles
    ) -> tuple[Singles, Singles]:  # what a kind of one's own says
        """The outputs [runs, outputs], before the clamp, and the state after that [runs, state].

        For inputs x [runs, inputs], matrices w [runs, values out, values in] and a state [runs, state], at first
        zeros: all float32, and not to be written to. Each run by itself: what one gives depends on no other.
        """
        raise NotImplementedError

    @property
    def derived(self) -> tuple[str, ...]:  # type: ignore[override]
        return super().derived if hasattr(self, "width") else ()

    def explicit(self, inputs: int, outputs: int) -> Self:
        return super().explicit(inputs, outputs) if hasattr(self, "width") else self

    def row(self, inputs: int, outputs: int) -> Mapping[str, int]:
        return {}

    def forward(self, of: Terms, matrices: Sequence[Any], inputs: Any, state: Any) -> tuple[Any, Any]:
        said = f"{names()[type(self)]} is computed in numpy alone, with no gradient"
        raise MindError(said, "mindc train teaches it")

    def ready(self, inputs: int, outputs: int, weights: Weights, sources: Sources) -> Compute:
        return RunningArrays(self, weights, self.state_length(inputs, outputs), outputs)

    def computed(self, x: Singles, genome: Weights, state: Singles, outputs: int) -> tuple[Singles, Singles]:
        """`apply` for genomes [runs, weights], or one [weights] of all runs; ProcedureError where it fails."""
        import numpy as np

        runs, inputs = x.shape
        if not (inputs and outputs):
            return np.zeros((runs, outputs), np.float32), state
        shapes = self.matrix_shapes(inputs, outputs)
        parts = np.split(genome, np.cumsum([into * out for into, out in shapes])[:-1], axis=-1) if shapes else []
        # Copies in one order of memory: numpy sums otherwise in another, and engine and lanes would differ.
        pairs = zip(parts, shapes, strict=True)
        w = tuple(_fixed(np.broadcast_to(part, (runs, part.shape[-1])).reshape(runs, o, i)) for part, (i, o) in pairs)
        name = names()[type(self)]
        try:
            with np.errstate(all="ignore"):
                sent, after = (np.asarray(each).astype(np.float32) for each in self.apply(_fixed(x), w, _fixed(state)))
        except Exception as error:
            said = f"{name} fails for {x.tolist()!s:.200}: {type(error).__name__}: {text_of(error)}"
            raise ProcedureError(said) from error
        for what, found, length in (("outputs", sent, outputs), ("state", after, state.shape[1])):
            if found.shape != (runs, length):
                raise ProcedureError(f"{name} gives {what} of the shape {found.shape} instead of {(runs, length)}")
        return sent, after


class RunningArrays:
    """An `ArrayFunction` with weights, from tick to tick; its state is at first zeros."""

    def __init__(self, function: ArrayFunction, weights: Weights, length: int, outputs: int) -> None:
        self.function, self.weights, self.length, self.outputs = function, weights, length, outputs
        self.reset()

    def reset(self) -> None:
        """Set the state to zeros."""
        import numpy as np

        self.state: Singles = np.zeros((1, self.length), np.float32)

    def __call__(self, inputs: Singles) -> Singles:
        """The outputs for inputs [inputs], before the clamp; the state goes on."""
        sent, self.state = self.function.computed(inputs[None], self.weights, self.state, self.outputs)
        return sent[0]  # type: ignore[no-any-return]


def _fixed(values: Singles) -> Singles:
    """A copy in the order of C that nobody writes to."""
    import numpy as np

    copied: Singles = np.array(values, np.float32, order="C")
    copied.flags.writeable = False
    return copied
