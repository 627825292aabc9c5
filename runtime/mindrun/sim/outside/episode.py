"""One environment that is stepped, and what it said last."""

from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np

from mindrun.sim.outside import making
from mindrun.sim.outside.asking import Asking, place_of
from mindrun.sim.outside.foreign import first_line, foreign_code
from mindrun.sim.outside.making import BrokenEnvironmentError
from mindrun.sim.outside.wiring import Wiring

T = TypeVar("T")
SEED_LIMIT = 1 << 31  # some environments take no larger ones


class Episode:
    """An environment in a run. After each step: what is `observed` [slots], the reward, how it stands.

    One that `is_seen` draws itself.

    BrokenEnvironmentError where it raises, or says what none may say.
    """

    def __init__(self, wiring: Wiring, is_seen: bool = False, asking: Asking | None = None) -> None:
        self._wiring = wiring
        self._asking = asking or Asking(wiring.environment)
        self._environment = making.make(wiring.environment, wiring.folder, is_seen)
        self.observed = np.zeros(len(wiring.rows))
        self.reward, self.is_terminated, self.is_truncated = 0.0, False, False
        self._seed, self._steps = 0, 0

    @property
    def is_over(self) -> bool:
        """Whether it can be stepped no more."""
        return self.is_terminated or self.is_truncated

    def begin(self, seed: int) -> None:
        """Begin the run of a seed."""
        self.reward, self.is_terminated, self.is_truncated = 0.0, False, False
        self._seed, self._steps = seed, 0
        self._asked(lambda: self._begun(seed % SEED_LIMIT))

    def step(self, action: Any) -> None:
        """Do it."""
        self._steps += 1
        self._asked(lambda: self._stepped(action))

    def image(self) -> Any:
        """What is seen of it now [height, width, 3], red first; None where it draws nothing."""
        return self._asked(self._environment.render)

    def close(self) -> None:
        """Give back what it holds."""
        making.close(self._environment)

    def _begun(self, seed: int) -> None:
        observation, _ = self._environment.reset(seed=seed)
        self._wiring.take(observation, self.observed)

    def _stepped(self, action: Any) -> None:
        observation, reward, terminated, truncated, _ = self._environment.step(action)
        self._wiring.take(observation, self.observed)
        self.reward, self.is_terminated, self.is_truncated = float(reward), bool(terminated), bool(truncated)

    def _asked(self, ask: Callable[[], T]) -> T:
        asking = self._asking
        asking.seed, asking.steps = self._seed, self._steps
        asking.number += 1
        asking.is_open = True
        try:
            with foreign_code():
                return ask()
        except Exception as error:
            name, where = self._wiring.environment, place_of(self._seed, self._steps)
            hint = f"It was in {where}, and the fault is the environment's: {first_line(error)}."
            raise BrokenEnvironmentError(f"the environment {name} failed", hint.replace("..", ".")) from error
        finally:
            asking.is_open = False
