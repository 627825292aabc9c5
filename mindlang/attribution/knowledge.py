"""What memories and recurrent states know of what was drawn for a run: ridge regression on fresh runs, by tick."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from mindrun.errors import MindError
from mindrun.graph.draws import drawn_numbers
from mindrun.graph.skill_sets import reachable
from mindrun.numbers.arrays import Bools, Doubles, Integers
from mindrun.sim.rollout import Rollout

from mindlang.run.setup import NO_GENOME, RunSetup, run_all

TICKS_ASKED = 24  # of a run, at most
MOST_VALUES = 10  # that are told apart; of more, or of a range, the number itself is asked for
FOLD_COUNT, PERMUTATIONS_DRAWN, LEAST_RUNS = 5, 20, 20
RIDGE_WEIGHT = 1.0  # of readings with a spread of 1


class ProbeError(MindError):
    """What cannot be asked of a mind or a task."""


@dataclass(frozen=True, slots=True)
class Knowledge:
    """What one memory, or the state of one skill, knows at each of the `ticks`.

    `score` and `chance` [ticks] are the share of runs in which the value is told rightly, or the share of the number's
    variance that is explained; of `chance` the mean over permuted values. It `is_known` [ticks] where the score is
    above that of every permutation.
    """

    name: str
    noun: str
    ticks: Integers
    score: Doubles
    chance: Doubles
    is_known: Bools


@dataclass(frozen=True, slots=True)
class Probe:
    """What all of them know of one drawn number, of so many runs; `values` are those that are told apart, if any."""

    of: str
    runs: int
    values: tuple[float, ...]
    found: tuple[Knowledge, ...]


def probe(
    setup: RunSetup, rollout: Rollout, of: str, seeds: Sequence[int], ran: Callable[[float], None] = lambda runs: None
) -> Probe:
    """What the memories and recurrent states of a mind know of a number that is drawn; ProbeError where nothing is."""
    sources = _sources(setup, rollout)
    lasted = run_all(rollout, seeds).ticks[0]
    ticks = np.unique(np.linspace(1, max(1, int(np.median(lasted))), TICKS_ASKED).astype(np.int64))
    kept, drawn = [], list[tuple[float, ...]]()
    for seed in seeds:
        states = _states(rollout, seed, ticks)
        drawn.append(_drawn(setup, of, seed, states))
        kept.append([*states[1:]])
        ran(1)
    values, targets = _targets(np.array(drawn))
    order = np.random.default_rng(len(seeds)).permuted(
        np.tile(np.arange(len(seeds)), (PERMUTATIONS_DRAWN, 1)), axis=1
    )  # the first runs' values are those of others
    found = []
    for (noun, name), rows in sources.items():
        at = [_asked(kept, number, rows, targets, order, bool(values)) for number in range(len(ticks))]
        scores = np.array([each for each in at if each is not None]).reshape(-1, 1 + PERMUTATIONS_DRAWN)
        own, others = scores[:, 0], scores[:, 1:]
        known = own > others.max(axis=1, initial=-np.inf)
        found.append(Knowledge(name, noun, ticks[: len(scores)], own, others.mean(axis=1), known))
    return Probe(of, len(seeds), values, tuple(found))


def _sources(setup: RunSetup, rollout: Rollout) -> Mapping[tuple[str, str], Integers]:
    """The rows of each memory, and of the state of each skill that has one, among readings and then states."""
    graph = setup.ready.policy.graph
    found = {("memory", each.name): np.arange(each.place.start, each.place.stop) for each in graph.memories}
    for skill, row in zip(reachable(graph, setup.master), rollout.tables.skills, strict=True):
        if length := skill.function.state_length(len(skill.inputs), skill.outputs):
            found["state", skill.name] = graph.width + int(row["state"]) + np.arange(length)
    if not found:
        raise ProbeError("this mind remembers nothing", "declare a memory, or let a skill be elman or gru")
    return found


def _states(rollout: Rollout, seed: int, ticks: Integers) -> list[Doubles]:
    """What is read and remembered after the first tick of a run, then after each of some, as far as the run lasts."""
    mind, width = (tile := rollout.tile(1)).state.mind, rollout.graph.width
    jobs = rollout.jobs(NO_GENOME, np.array([seed], np.uint64))
    rollout.fill(tile, jobs)
    found, now = list[Doubles](), 0
    for tick in (1, *ticks.tolist()):
        if tick > now and not rollout.advance(tile, jobs, tick - now):
            break
        now = tick
        found.append(np.concatenate([mind.readings[:width, 0], mind.recurrent[:, 0]]).astype(np.float64))
    return found or [np.full(width + len(mind.recurrent), np.nan)]


def _drawn(setup: RunSetup, of: str, seed: int, states: Sequence[Doubles]) -> tuple[float, ...]:
    """The number that is drawn for a run, or the readings of an order in its first tick."""
    graph, numbers = setup.ready.policy.graph, drawn_numbers(setup.task.draws, seed)
    if of in numbers:
        return (numbers[of],)
    orders = {sensor.name: sensor for sensor in graph.sensors if sensor.kind.is_order}
    if of not in orders:
        known = [*numbers, *orders]
        hint = f"it draws {', '.join(known)}" if known else "write draws side from 0 1 in the task, and what it changes"
        raise ProbeError(f"task {setup.task.name} draws nothing called {of}", hint)
    said = states[0][orders[of].place]
    if not np.isfinite(said).all():
        raise ProbeError(f"nobody hears {of} in task {setup.task.name}", "let a skill or a reward read it")
    return tuple(said.tolist())


def _targets(drawn: Doubles) -> tuple[tuple[float, ...], Doubles]:
    """The values that are told apart, and what is to be told [runs, columns]: 1 for a value, or a number."""
    several = np.unique(drawn, axis=0)
    if len(several) == 1:
        raise ProbeError("it is the same in all of these runs", "make more runs, or draw one of several")
    if len(several) > MOST_VALUES:
        return (), drawn
    targets = (drawn[:, None] == several).all(axis=2).astype(np.float64)
    single = several[:, 0] if several.shape[1] == 1 else 1.0 + np.arange(len(several))
    return tuple(single.tolist()), targets


def _asked(
    kept: Sequence[Sequence[Doubles]], number: int, rows: Integers, targets: Doubles, order: Integers, is_class: bool
) -> Doubles | None:
    """The score of some rows at one of the ticks, then those for permuted values; None where too few runs last."""
    lasting = np.array([place for place, run in enumerate(kept) if len(run) > number])
    if len(lasting) < LEAST_RUNS:
        return None
    seen = np.array([kept[place][number][rows] for place in lasting])
    wanted = targets[lasting]
    others = [wanted[np.argsort(each[lasting])] for each in order]
    told = np.array([wanted, *others]).transpose(1, 0, 2)  # [runs, 1 + permutations, columns]
    guessed = np.empty_like(told)
    for test in np.array_split(np.arange(len(seen)), FOLD_COUNT):
        rest = np.setdiff1d(np.arange(len(seen)), test)
        guessed[test] = _ridge(seen[rest], told[rest].reshape(len(rest), -1), seen[test]).reshape(told[test].shape)
    if is_class:
        right: Doubles = (guessed.argmax(axis=2) == told.argmax(axis=2)).mean(axis=0)
        return right
    missed = ((guessed - told) ** 2).sum(axis=(0, 2))
    explained: Doubles = 1.0 - missed / ((told - told.mean(axis=0)) ** 2).sum(axis=(0, 2)).clip(1e-12)
    return explained


def _ridge(seen: Doubles, told: Doubles, fresh: Doubles) -> Doubles:
    """What is told of fresh rows by the regression of `told` [rows, columns] on `seen`, each reading with spread 1."""
    middle, spread = seen.mean(axis=0), seen.std(axis=0)
    scaled = (seen - middle) / np.where(spread > 1e-9, spread, np.inf)
    square = scaled.T @ scaled + RIDGE_WEIGHT * np.eye(seen.shape[1])
    mean = told.mean(axis=0)
    slopes = np.linalg.solve(square, scaled.T @ (told - mean))
    guessed: Doubles = (fresh - middle) / np.where(spread > 1e-9, spread, np.inf) @ slopes + mean
    return guessed


def since(found: Knowledge) -> Iterator[int]:
    """The tick from which it is known without a gap to the last that was asked about; none where it is not at last."""
    unknown = np.flatnonzero(~found.is_known)
    first = int(unknown[-1]) + 1 if len(unknown) else 0
    if first < len(found.ticks):
        yield int(found.ticks[first])
