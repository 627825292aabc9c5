"""One environment that is stepped, and what it said last."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from mindrun.sim.outside import making
from mindrun.sim.outside.asking import Asking
from mindrun.sim.outside.foreign import first_line, foreign_code
from mindrun.sim.outside.making import BrokenEnvironmentError
from mindrun.sim.outside.parts import Spaces, difference, formed, spaces_of
from mindrun.sim.outside.taking import Taking, number_of, truth_of
from mindrun.work.last_step import place_of

T = TypeVar("T")
SEED_LIMIT = 1 << 31  # some environments take no larger ones


class Episode:
    """An environment in the run of a seed. After each step: what is `observed` [slots], the reward, how it stands.

    One that `is_seen` draws itself.

    BrokenEnvironmentError where it raises, or says what none may say.
    """

    def __init__(
        self,
        asking: Asking,
        folder: Path | None,
        seed: int,
        taking: Taking,
        acted: Any,
        spaces: Spaces,
        is_seen: bool = False,
    ) -> None:
        self._asking, self._taking, self._acted = asking, taking, acted
        self._seed, self._steps = seed, 0
        self.observed = np.zeros(taking.slots)
        self.reward, self.is_terminated, self.is_truncated = 0.0, False, False
        asking.begin(seed, 0)
        try:
            self._environment = making.make(asking.environment, folder, is_seen)
        finally:
            asking.end()
        self._refuse_other_spaces(spaces)

    @property
    def is_over(self) -> bool:
        """Whether it can be stepped no more."""
        return self.is_terminated or self.is_truncated

    def begin(self) -> None:
        """Begin the run."""
        self.reward, self.is_terminated, self.is_truncated = 0.0, False, False
        self._steps = 0
        self._asked(self._begun)

    def step(self, action: Mapping[str, Any]) -> None:
        """Do it: the values of the parts of an action."""
        self._steps += 1
        self._asked(lambda: self._stepped(formed(self._acted, action)))

    def image(self) -> Any:
        """What is seen of it now [height, width, 3], red first; None where it draws nothing."""
        return self._asked(self._environment.render)

    def close(self) -> None:
        """Give back what it holds."""
        making.close(self._environment)

    def _refuse_other_spaces(self, spaces: Spaces) -> None:
        """BrokenEnvironmentError where it has other spaces than the first of its name, to which a mind is wired."""
        now = spaces_of(*making.spaces_in(self._asking.environment, self._environment))
        if why := difference(spaces, now):
            self.close()
            name = self._asking.environment
            message = f"the environment {name} has other spaces each time that it is made"
            hint = f"In {place_of(self._seed, 0)} {why}. Let it always have the same: a mind is wired to them once."
            raise BrokenEnvironmentError(message, hint, why)

    def _begun(self) -> None:
        observation, _ = self._environment.reset(seed=self._seed % SEED_LIMIT)
        self._taking.take(observation, self.observed)

    def _stepped(self, action: Any) -> None:
        observation, reward, terminated, truncated, _ = self._environment.step(action)
        self._taking.take(observation, self.observed)
        self.reward = number_of("the reward", reward)
        self.is_terminated = truth_of("terminated", terminated)
        self.is_truncated = truth_of("truncated", truncated)

    def _asked(self, ask: Callable[[], T]) -> T:
        self._asking.begin(self._seed, self._steps)
        try:
            with foreign_code():
                return ask()
        except Exception as error:
            name, where, why = self._asking.environment, place_of(self._seed, self._steps), first_line(error)
            hint = f"It was in {where}, and the fault is the environment's: {why}."
            raise BrokenEnvironmentError(f"the environment {name} failed", hint.replace("..", "."), why) from error
        finally:
            self._asking.end()
