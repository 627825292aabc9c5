"""What an environment has been asked and has not answered: for whoever looks whether it ever does."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Asked:
    """A question to an environment: `where` says in words which, `number` counts all of them."""

    environment: str
    where: str
    number: int


class Asking:
    """The question at hand; who steps writes it, and another thread may look at it."""

    def __init__(self, environment: str) -> None:
        self.environment, self.number, self.seed, self.steps, self.is_open = environment, 0, 0, 0, False

    def asked(self) -> Asked | None:
        """What has not been answered; None where everything has been."""
        if not self.is_open:
            return None
        return Asked(self.environment, place_of(self.seed, self.steps), self.number)


def place_of(seed: int, steps: int) -> str:
    """Where in a run something was, in words."""
    return f"step {steps} of the run of seed {seed}" if steps else f"the beginning of the run of seed {seed}"
