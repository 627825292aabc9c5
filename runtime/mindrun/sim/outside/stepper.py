"""Environments stepped in this process."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cached_property
from itertools import count
from numbers import Real
from pathlib import Path
from typing import Any
from weakref import finalize

import numpy as np

from mindrun.numbers.arrays import Array, Doubles
from mindrun.sim.outside import making
from mindrun.sim.outside.making import BrokenEnvironmentError, first_line, foreign_code
from mindrun.sim.outside.parts import PartReader, Place, Spaces, actions_of, sources_of, spaces_of

SEED_LIMIT = 1 << 31  # some environments take no larger ones
REWARD_COLUMN, TERMINATED_COLUMN, TRUNCATED_COLUMN = -3, -2, -1  # where they stand in a row, behind what is observed
_numbers = count()  # of runs, by which another process knows them


class EnvironmentRun:
    """An environment in the run of a seed, after so many `steps`: the `row` of what it said last [slots + 3]."""

    def __init__(self, seed: int, slots: int) -> None:
        self.number, self.seed, self.steps = next(_numbers), seed, 0
        self.row: Doubles = np.zeros(slots + 3)

    @property
    def is_over(self) -> bool:
        """True if it can be stepped no more."""
        return bool(self.row[TERMINATED_COLUMN] or self.row[TRUNCATED_COLUMN])

    @property
    def where(self) -> str:
        """The seed and the step that it has come to, in words."""
        return place_of(self.seed, self.steps)


class LocalStepper:
    """Steps environments of a name in this process; a module before it is looked for in `folder` first.

    BrokenEnvironmentError where one does what none may do. `reached` is told before each environment of a question
    which of them is asked now.
    """

    def __init__(
        self, environment: str, folder: Path | None = None, reached: Callable[[int], object] = lambda number: None
    ) -> None:
        self.environment, self._folder, self._reached = environment, folder, reached
        # The environment of each run that is open, and what reads its observations.
        self._open: dict[EnvironmentRun, tuple[Any, Sequence[PartReader]]] = {}
        self._at = EnvironmentRun(0, 0)  # the run of which the environment is asked
        finalize(self, _close, self._open)

    @cached_property
    def spaces(self) -> Spaces:
        """The spaces of their observations and actions."""
        return spaces_of(*self._spaces)

    @cached_property
    def _spaces(self) -> tuple[Any, Any]:
        """The spaces of Gymnasium of the first environment."""
        environment = making.make(self.environment, self._folder)
        try:
            return making.spaces_in(self.environment, environment)
        finally:
            making.close(environment)

    def begin(self, places: Sequence[Place], seeds: Sequence[int], is_seen: bool = False) -> list[EnvironmentRun]:
        """A new environment for the run of each seed, of which the numbers at these places are read, one a slot."""
        sources = sources_of(self._spaces[0], self.spaces.observed, places)
        runs = [EnvironmentRun(seed, len(places)) for seed in seeds]
        try:
            for run in self._each(runs):
                environment = making.make(self.environment, self._folder, is_seen)
                self._open[run] = environment, sources
                with self._blaming():
                    self._refuse_other_spaces(environment, run)
                    self._reset(run)
        except BaseException:
            self.close(runs)
            raise
        return runs

    def reset(self, runs: Sequence[EnvironmentRun]) -> None:
        """Begin runs again, each in its environment."""
        with self._blaming():
            for run in self._each(runs):
                self._reset(run)

    def step(self, runs: Sequence[EnvironmentRun], actions: Doubles) -> None:
        """Step each run: the numbers of its action, part after part [runs, numbers]."""
        _, acted = self._spaces
        with self._blaming():
            for run, action in zip(self._each(runs), actions_of(acted, self.spaces.acted, actions), strict=True):
                run.steps += 1
                environment, sources = self._open[run]
                observation, reward, terminated, truncated, _ = environment.step(action)
                for source in sources:
                    source.read(observation, run.row)
                run.row[REWARD_COLUMN] = number_of("the reward", reward)
                run.row[TERMINATED_COLUMN] = truth_of("terminated", terminated)
                run.row[TRUNCATED_COLUMN] = truth_of("truncated", truncated)

    def image(self, run: EnvironmentRun) -> Array:
        """The image of a run now [height, width, 3], red first; another array where it draws nothing."""
        with self._blaming():
            self._at = run
            return np.asarray(self._open[run][0].render())

    def close(self, runs: Sequence[EnvironmentRun]) -> None:
        """Give back what runs hold; those that have not begun hold nothing."""
        for run in self._each(runs):
            if run in self._open:
                making.close(self._open.pop(run)[0])

    def _reset(self, run: EnvironmentRun) -> None:
        environment, sources = self._open[run]
        run.row[:], run.steps = 0.0, 0
        observation, _ = environment.reset(seed=run.seed % SEED_LIMIT)
        for source in sources:
            source.read(observation, run.row)

    def _each(self, runs: Sequence[EnvironmentRun]) -> Iterator[EnvironmentRun]:
        for number, run in enumerate(runs):
            self._reached(number)
            self._at = run
            yield run

    def _refuse_other_spaces(self, environment: Any, run: EnvironmentRun) -> None:
        """Raise BrokenEnvironmentError where its spaces are not those of the first of its name, wired to a mind."""
        now = making.spaces_in(self.environment, environment)
        for verb, first, other in zip(("observes", "takes"), self._spaces, now, strict=True):
            if first != other:
                why = f"it {verb} {other}, and the first {first}"
                message = f"the environment {self.environment} has other spaces each time that it is made"
                hint = f"In {run.where} {why}. Let it always have the same: a mind is wired to them once."
                raise BrokenEnvironmentError(message, hint, why)

    @contextmanager
    def _blaming(self) -> Iterator[None]:
        """A context for calls of environments: whatever one raises becomes an error that says where in which run."""
        try:
            with foreign_code():
                yield
        except BrokenEnvironmentError:
            raise
        except Exception as error:
            why = first_line(error)
            hint = f"It was in {self._at.where}, and the fault is the environment's: {why}.".replace("..", ".")
            raise BrokenEnvironmentError(f"the environment {self.environment} failed", hint, why) from error


def place_of(seed: int, steps: int) -> str:
    """A place in a run, in words."""
    return f"step {steps} of the run of seed {seed}" if steps else f"the beginning of the run of seed {seed}"


def number_of(what: str, value: Any) -> float:
    """A number, or an array of one; TypeError where it is a text, which Python would read as one."""
    value = value.item() if isinstance(value, np.ndarray) else value
    if isinstance(value, str | bytes | bytearray):
        raise TypeError(f"{what} is the text {value!r:.40}, which is no number")
    return float(value)


def truth_of(what: str, value: Any) -> bool:
    """A truth value, or a number that is 0 or 1, or an array of one; TypeError where it is anything else."""
    value = value.item() if isinstance(value, np.ndarray | np.generic) else value
    if isinstance(value, Real) and value in (0, 1):
        return bool(value)
    raise TypeError(f"{what} is {value!r:.40}, which is neither true nor false")


def _close(opened: Mapping[EnvironmentRun, tuple[Any, Sequence[PartReader]]]) -> None:
    for environment, _ in opened.values():
        making.close(environment)
