"""What an environment has been asked and has not answered: for whoever looks whether it ever does."""

from dataclasses import dataclass

from mindrun.work.last_step import MAX_NAME_BYTES, LastStep, place_of


@dataclass(frozen=True, slots=True)
class Asked:
    """A question to an environment: `where` says in words which, `number` counts all of them."""

    environment: str
    where: str
    number: int


class Asking:
    """The question at hand; who steps writes it, and another thread may look at it.

    Where there is a `last_step`, another process may, too, and does when this one has ended.
    """

    def __init__(self, environment: str, last_step: LastStep | None = None) -> None:
        self.environment, self.last_step = environment, last_step
        self._name = environment.encode(errors="replace")[:MAX_NAME_BYTES]
        self._number, self._seed, self._steps, self._is_open = 0, 0, 0, False

    def begin(self, seed: int, steps: int) -> None:
        """A question begins: the step after so many of a run, 0 for its beginning."""
        self._seed, self._steps = seed, steps
        self._number += 1
        self._is_open = True
        if self.last_step is not None:
            self.last_step.write(self._name, seed, steps)

    def end(self) -> None:
        """It has been answered."""
        self._is_open = False
        if self.last_step is not None:
            self.last_step.clear()

    def asked(self) -> Asked | None:
        """What has not been answered; None where everything has been."""
        if not self._is_open:
            return None
        return Asked(self.environment, place_of(self._seed, self._steps), self._number)
