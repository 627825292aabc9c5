"""A check that an environment repeats itself: a run that was made is made once more, and compared with itself."""

from collections.abc import Iterator, Sequence
from time import monotonic

import numpy as np

from mindrun.errors import MindError
from mindrun.numbers.arrays import Doubles
from mindrun.sim.outside.parts import Place
from mindrun.sim.outside.stepper import EnvironmentRun
from mindrun.sim.outside.subprocess_stepper import Stepper

CHECKED_TICKS = 1000  # of a run: what is the same so far is taken to stay so
CHECKED_SECONDS = 20.0  # for all that is done again
SLOW = "whether {name} does the same again is not known: it has not made its first run again in {seconds:g} s"
FLAW = "{name} does not do the same again, so no figure of it can be repeated: with seed {seed} {where}"
WORN = (
    "{name} does otherwise where it is reset again than where it is new: with seed {seed} {where}; each run has a new "
    "one, so figures can be repeated"
)


class SlowError(MindError):
    """An environment of which too little came in the time that there is."""


class RecordingStepper:
    """A stepper that writes down what is done in its only run, and what comes of it: a row for each tick.

    SlowError where that, or doing the same again, takes longer than `CHECKED_SECONDS` in all.
    """

    def __init__(self, stepper: Stepper) -> None:
        self._stepper = stepper
        self.environment, self._until = stepper.environment, monotonic() + CHECKED_SECONDS
        self._places: Sequence[Place] = ()
        self._seed = 0
        self.actions, self.rows = list[Doubles](), list[Doubles]()

    def begin(self, places: Sequence[Place], seeds: Sequence[int], is_seen: bool = False) -> list[EnvironmentRun]:
        """A new environment for the run."""
        self._places, [self._seed] = places, seeds
        [run] = self._stepper.begin(places, seeds, is_seen)
        self.rows.append(run.row.copy())
        return [run]

    def step(self, runs: Sequence[EnvironmentRun], actions: Doubles) -> None:
        """Step it."""
        self._refuse_late()
        self._stepper.step(runs, actions)
        self.actions.append(actions[0])
        self.rows.append(runs[0].row.copy())

    def close(self, runs: Sequence[EnvironmentRun]) -> None:
        """Give back what the run holds."""
        self._stepper.close(runs)

    def flaw(self, another: Stepper, names: Sequence[str], is_paid: bool) -> str:
        """The first difference, as a sentence, when the same is done in two environments of another stepper side by
        side, and then in the first of them once more; empty where there is none. `names` are those of the sensors; a
        reward that is not `is_paid` may differ.
        """
        begun, said = list[EnvironmentRun](), {"name": self.environment, "seed": self._seed}
        try:
            # What a process keeps of its first run is now of this one.
            another.close(another.begin(self._places, [self._seed ^ 1]))
            begun += another.begin(self._places, [self._seed, self._seed])
            if where := self._difference(self._again(another, begun), names, is_paid):
                return FLAW.format(where=where, **said)
            another.reset(begun[:1])
            if where := self._difference(self._again(another, begun[:1]), names, is_paid):
                return WORN.format(where=where, **said)
        except SlowError:
            raise
        except MindError as error:
            return FLAW.format(where=f"it failed then: {error}", **said)
        finally:
            another.close(begun)
        return ""

    def _again(self, stepper: Stepper, runs: Sequence[EnvironmentRun]) -> Iterator[list[Doubles]]:
        """The rows of runs that have begun, tick after tick, in which the same is done."""
        yield [run.row for run in runs]
        for action in self.actions:
            if any(run.is_over for run in runs):
                return
            self._refuse_late()
            stepper.step(runs, np.stack([action] * len(runs)))
            yield [run.row for run in runs]

    def _difference(self, others: Iterator[list[Doubles]], names: Sequence[str], is_paid: bool) -> str:
        """The first number that differs, and its tick, in words; empty where none does."""
        words = *names, "its reward", "its end", "the time that it breaks off"
        for ticks, (row, rows) in enumerate(zip(self.rows, others, strict=False)):
            for other in rows:
                differs = (row != other) & ~(np.isnan(row) & np.isnan(other))
                differs[len(names)] &= is_paid
                for place in np.flatnonzero(differs).tolist():
                    tick = ticks + (place < len(names))  # what is observed after a step is read in the next tick
                    return f"{words[place]} in tick {tick} was {row[place]:.9g}, and {other[place]:.9g} then"
        return ""

    def _refuse_late(self) -> None:
        if monotonic() > self._until:
            raise SlowError(SLOW.format(name=self.environment, seconds=CHECKED_SECONDS))
