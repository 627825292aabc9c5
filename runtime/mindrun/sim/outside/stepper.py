"""What steps environments of a name, in this process or in another one; and a run in one of them."""

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

from numpy.typing import NDArray

from mindrun.sim.outside.asking import Asked
from mindrun.sim.outside.parts import Spaces
from mindrun.sim.outside.taking import Place
from mindrun.work.last_step import LastStep


class Run(Protocol):
    """An environment in the run of a seed. After each step: what is `observed` [slots], the reward, how it stands."""

    observed: NDArray[Any]
    reward: float
    is_terminated: bool
    is_truncated: bool

    @property
    def is_over(self) -> bool:
        """Whether it can be stepped no more."""

    def begin(self) -> None:
        """Begin the run, or begin it again."""

    def image(self) -> Any:
        """What is seen of it now [height, width, 3], red first; None where it draws nothing."""

    def close(self) -> None:
        """Give back what it holds."""


class Stepper(Protocol):
    """Steps environments of one name; BrokenEnvironmentError where one does what none may do."""

    environment: str

    @property
    def spaces(self) -> Spaces:
        """What it observes and takes."""

    def run(self, places: Sequence[Place], seed: int, is_seen: bool = False) -> Any:
        """A new environment for the run of a seed, of which the numbers at these places are read: a `Run`."""

    def step(self, runs: Sequence[Any], actions: Sequence[Mapping[str, Any]]) -> None:
        """Step each of its runs: the values of the parts of its action."""

    def asked(self) -> Asked | None:
        """What an environment in this process has been asked and has not answered, seen from another thread."""

    def break_off(self) -> None:
        """End what is asked of another process, from another thread: whoever waits for an answer is told."""

    def write_steps(self, last_step: LastStep) -> None:
        """Write each step there from now on, where this process makes them."""
