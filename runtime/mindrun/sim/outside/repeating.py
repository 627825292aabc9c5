"""Whether an environment does the same again: a run that was made is made once more, and held against itself."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from threading import Event, Timer
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.errors import MindError
from mindrun.sim.outside.stepper import Run, Stepper
from mindrun.sim.outside.taking import Place

CHECKED_TICKS = 1000  # of a run: what is the same so far is taken to stay so
CHECKED_SECONDS = 20.0  # for all that is done again
SLOW = "whether {name} does the same again is not known: it has not made its first run again in {seconds:g} s"
FLAW = "{name} does not do the same again, so no figure of it can be repeated: with seed {seed} {where}"
WORN = (
    "{name} does otherwise where it is reset again than where it is new: with seed {seed} {where}; each run has a new "
    "one, so figures can be repeated"
)
Row = NDArray[np.float64]


class WrittenDown:
    """A stepper that writes down what is done in its only run, and what comes of it: a row for each tick."""

    def __init__(self, stepper: Stepper) -> None:
        self._stepper = stepper
        self.environment = stepper.environment
        self.actions: list[Mapping[str, Any]] = []
        self.rows: list[Row] = []

    def run(self, places: Sequence[Place], seed: int, is_seen: bool = False) -> Any:
        """A new environment for the run."""
        self._places, self._seed = places, seed
        return self._stepper.run(places, seed, is_seen)

    def step(self, runs: Sequence[Run], actions: Sequence[Mapping[str, Any]]) -> None:
        """Step it."""
        if not self.rows:
            self.rows.append(_row(runs[0]))
        self._stepper.step(runs, actions)
        self.actions += actions
        self.rows.append(_row(runs[0]))

    def flaw(self, another: Stepper, names: Sequence[str], is_paid: bool) -> str:
        """What is not the same when the same is done in two environments of another stepper side by side, or in the
        first of them once more, in a sentence about the sensors of these names; nothing where all is. A reward that
        nobody is paid may be what it likes.
        """
        begun: list[Run] = []
        said = {"name": self.environment, "seed": self._seed}
        try:
            other = another.run(self._places, self._seed ^ 1)  # what a process keeps of its first run is now of this
            other.begin()
            other.close()
            begun += (another.run(self._places, self._seed) for _ in range(2))
            for runs, sentence in ((begun, FLAW), (begun[:1], WORN)):
                if where := self._difference(_rows(another, runs, self.actions), names, is_paid):
                    return sentence.format(where=where, **said)
        except MindError as error:
            return FLAW.format(where=f"it failed then: {error}", **said)
        finally:
            for run in begun:
                run.close()
        return ""

    def _difference(self, others: Iterator[list[Row]], names: Sequence[str], is_paid: bool) -> str:
        """What differs first, and in which tick."""
        words = *names, "its reward", "its end", "the time that it breaks off"
        for ticks, (row, rows) in enumerate(zip(self.rows, others, strict=False)):
            for other in rows:
                differs = (row != other) & ~(np.isnan(row) & np.isnan(other))
                differs[len(names)] &= is_paid
                for place in np.flatnonzero(differs).tolist():
                    tick = ticks + (place < len(names))  # what is observed after a step is read in the next tick
                    return f"{words[place]} in tick {tick} was {row[place]:.9g}, and {other[place]:.9g} then"
        return ""


@contextmanager
def in_time(*steppers: Stepper) -> Iterator[Event]:
    """Meanwhile steppers have so long, and no longer, for all that they are asked; the event says that it was over."""
    is_late = Event()

    def break_off() -> None:
        is_late.set()
        for each in steppers:
            each.break_off()

    timer = Timer(CHECKED_SECONDS, break_off)
    timer.daemon = True
    timer.start()
    try:
        yield is_late
    finally:
        timer.cancel()


def _rows(stepper: Stepper, runs: Sequence[Run], actions: Sequence[Mapping[str, Any]]) -> Iterator[list[Row]]:
    for run in runs:
        run.begin()
    yield [_row(run) for run in runs]
    for action in actions:
        if any(run.is_over for run in runs):
            return
        stepper.step(runs, [action] * len(runs))
        yield [_row(run) for run in runs]


def _row(run: Run) -> Row:
    """What is observed [slots], the reward, and how the run stands."""
    return np.array([*run.observed, run.reward, run.is_terminated, run.is_truncated], np.float64)
