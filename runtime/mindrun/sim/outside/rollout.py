"""Rollouts whose worlds are environments: these are stepped one by one, and the skills think in lanes between."""

from collections.abc import Callable, Iterator, Sequence
from copy import copy
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from time import monotonic

import numpy as np

from mindrun.errors import MindError
from mindrun.graph.policy import Policy
from mindrun.numbers.arrays import Doubles, Integers, Singles
from mindrun.sim.codes import BROKEN_OFF
from mindrun.sim.lanes.act import act
from mindrun.sim.lanes.advance import before, conclude
from mindrun.sim.lanes.runs import fill
from mindrun.sim.lanes.think import send, think, wake
from mindrun.sim.outside.making import GAVE_NO_NUMBER
from mindrun.sim.outside.parts import Place
from mindrun.sim.outside.stepper import REWARD_COLUMN, TERMINATED_COLUMN, EnvironmentRun
from mindrun.sim.outside.subprocess_stepper import SilentEnvironmentError, Stepper, stepper_for
from mindrun.sim.outside.wiring import EnvironmentWiring, wiring_of
from mindrun.sim.rollout import SLOW_SLICE_TICKS, Rollout, Tile
from mindrun.sim.state import Jobs
from mindrun.sim.units import Unit

ENVIRONMENT_LANES = 64  # environments side by side: so many share one call of what is compiled
LEAST_SHARE = 0.001  # of the ticks, that is said as a number
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


@dataclass(frozen=True, slots=True)
class RunningEnvironments:
    """The environment of each run that goes on, by the number of its job, and their stepper."""

    stepper: Stepper
    going_on: dict[int, EnvironmentRun] = field(default_factory=dict)


class EnvironmentRollout(Rollout):
    """Runs a task in an environment, as `Rollout` does one in its own world: a run of a seed begins with `reset(seed)`.

    Every run has an environment of its own, and this thread has all of them stepped, in the process that `steppers`
    says. `clipped` counts for each observed sensor how many of the `observed` numbers were beyond its range, and
    `unreal` how many were no number at all; behind these stands how many rewards were not finite.
    """

    simulates = False

    def __init__(
        self,
        policy: Policy,
        task: str,
        master: str,
        learners: Sequence[str] = (),
        *,
        procedures: Path | None = None,
        interrupt: bool = True,
        lanes: int = ENVIRONMENT_LANES,
        steppers: Callable[[str, Path | None], Stepper] | None = None,
    ) -> None:
        super().__init__(policy, task, master, learners, procedures=procedures, interrupt=interrupt, lanes=lanes)
        self._another_stepper = partial(steppers or stepper_for, self.task.scene.environment, procedures)
        self._stepper: Stepper = self._another_stepper()
        self.wiring: EnvironmentWiring = wiring_of(self.graph, self._stepper.spaces)
        self.slice_ticks = SLOW_SLICE_TICKS
        self._measured = self.tables.measured[self.wiring.rows]
        self.observed, self.clipped = 0, np.zeros(len(self.wiring.rows), np.int64)
        self.unreal = np.zeros(len(self.wiring.rows) + 1, np.int64)
        self._flaw = ""
        self._rewards = [i for i, measure in enumerate(self.task.measures) if measure.is_outside]
        self._ends = [i for i, event in enumerate(self.task.events) if event.is_outside]

    def make_again(self, genome: Singles, seed: int) -> None:
        """Make the run of a genome and a seed twice; what is not the same again is in `notes` from then on.

        So it is where that takes too long. An environment that fails says so in the run itself; one that does not come
        back is waited for only once: SilentEnvironmentError.
        """
        probe, recorder = copy(self), RecordingStepper(self._stepper)
        probe._stepper = recorder  # type: ignore[assignment]  # it is asked for nothing else
        probe.observed, probe.clipped, probe.unreal = 0, np.zeros_like(self.clipped), np.zeros_like(self.unreal)
        tile, jobs = probe.tile(1), self.jobs(genome[None], np.array([seed], np.uint64))
        try:
            probe.fill(tile, jobs)
            probe.advance(tile, jobs, CHECKED_TICKS)
            self._flaw = recorder.flaw(self._another_stepper(), self.wiring.names, bool(self._rewards))
        except SlowError as error:
            self._flaw = str(error)
        except SilentEnvironmentError:
            raise
        except MindError:
            self._flaw = ""
        finally:
            probe._release(tile.kept, set())

    def tally(self) -> Integers:
        """The counts `observed`, `clipped` and `unreal`, one after the other."""
        return np.array([self.observed, *self.clipped, *self.unreal], np.int64)

    def add(self, tally: Integers) -> None:
        """Count what was observed elsewhere."""
        self.observed += int(tally[0])
        self.clipped += tally[1 : 1 + len(self.clipped)]
        self.unreal += tally[1 + len(self.clipped) :]

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on what the environment does not repeat, where it gave no number, and what was beyond a range."""
        beyond = self._shares(self.wiring.names, self.clipped)
        unreal = self._shares((*self.wiring.names, "the reward"), self.unreal)
        gave = f"the environment {self.task.scene.environment} itself {GAVE_NO_NUMBER}: {unreal}" if unreal else ""
        return tuple(filter(None, (self._flaw, gave, f"readings beyond their range: {beyond}" if beyond else "")))

    def _shares(self, names: Sequence[str], counts: Integers) -> str:
        """In words, the share of ticks in which something was true of each name; "" where it never was."""
        shares: dict[str, float] = {}  # of a sensor with several readings that of the worst
        for name, share in zip(names, (counts / max(1, self.observed)).tolist(), strict=True):
            shares[name] = max(share, shares.get(name, 0.0))
        said = [f"{name} in {_percent(share)}" for name, share in shares.items() if share]
        return f"{', '.join(said)} of the ticks" if said else ""

    @property
    def entries(self) -> tuple[Unit, ...]:
        """The units that its runs call first."""
        return fill, before, think, wake, send, act, conclude

    def tile(self, lanes: int) -> Tile:
        """Room for so many lanes, and for their environments."""
        tile = super().tile(lanes)
        return Tile(tile.state, tile.memories, RunningEnvironments(self._stepper))

    def forget(self, tile: Tile, working: set[int]) -> None:
        """Forget all jobs but those, and give back their environments."""
        super().forget(tile, working)
        self._release(tile.kept, working)

    def observe(self, tile: Tile, jobs: Jobs) -> None:
        """Turn the environments' observations into readings; the environments of runs that begin are made."""
        lanes, readings = int(jobs.lanes[0]), tile.state.mind.readings
        episodes = self._episodes(tile, jobs)
        wiring = self.wiring
        self.observed += lanes
        if len(wiring.rows) == 0:
            return
        seen = np.stack([episode.row[:REWARD_COLUMN] for episode in episodes], axis=1)
        share = (seen - wiring.low[:, None]) / (wiring.high - wiring.low)[:, None]
        self.clipped += ((share < 0) | (share > 1)).sum(axis=1)
        self.unreal[:-1] += np.isnan(seen).sum(axis=1)
        readings[wiring.rows[self._measured], :lanes] = np.clip(share[self._measured], 0.0, 1.0)

    def conclude(self, tile: Tile, jobs: Jobs) -> None:
        """Make the second half of a tick: commands, a step of every environment, and its reward."""
        state, lanes = tile.state, int(jobs.lanes[0])
        act(self.tables, state, lanes)
        episodes = self._episodes(tile, jobs)
        judge, ended, commands = state.judge, state.run.ended, state.world.acting[: len(self.tables.actuators), :lanes]
        tile.kept.stepper.step(episodes, self.wiring.actions(commands))
        rows = np.array([episode.row[REWARD_COLUMN:] for episode in episodes]).reshape(-1, -REWARD_COLUMN)
        rewards = rows[:, REWARD_COLUMN]
        judge.measures[self._rewards, :lanes] = rewards
        self.unreal[-1] += np.count_nonzero(~np.isfinite(rewards)) if self._rewards else 0
        judge.events[self._ends, :lanes] = rows[:, TERMINATED_COLUMN] != 0
        is_over = (rows[:, TERMINATED_COLUMN:] != 0).any(axis=1)
        ended[:lanes][is_over] = BROKEN_OFF  # unless one of the task's ends comes
        conclude(self.tables, state, jobs, self.interrupt)

    def _episodes(self, tile: Tile, jobs: Jobs) -> list[EnvironmentRun]:
        """The environments of the lanes at work; a run that has not begun in one begins."""
        working, going_on = tile.state.run.job[: jobs.lanes[0]].tolist(), tile.kept.going_on
        begun = [job for job in working if job not in going_on]
        if begun:
            self._release(tile.kept, {*working})
            seeds = [int(jobs.seeds[jobs.seed[job]]) for job in begun]
            runs = tile.kept.stepper.begin(self.wiring.places, seeds)  # new ones: BipedalWalker is worn by each run
            going_on.update(zip(begun, runs, strict=True))
        return [going_on[job] for job in working]

    def _release(self, episodes: RunningEnvironments, working: set[int]) -> None:
        """Close the environments of runs that are over."""
        over = [job for job in episodes.going_on if job not in working]
        if over:
            episodes.stepper.close([episodes.going_on.pop(job) for job in over])


def _percent(share: float) -> str:
    return f"{share:.1%}" if share >= LEAST_SHARE else f"less than {LEAST_SHARE:.1%}"
