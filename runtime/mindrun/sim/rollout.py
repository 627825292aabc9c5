"""Rollouts: genomes on layouts, scored in lanes on every core. A result depends on its genome and its seed alone."""

from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_EXCEPTION, Future, wait
from copy import copy
from dataclasses import dataclass
from pathlib import Path
from threading import Event, Thread
from typing import Any, Self, TypeVar

import numpy as np
from numpy.typing import NDArray

from mindrun.errors import MindError
from mindrun.graph.graph import Task
from mindrun.graph.policy import Policy
from mindrun.graph.run_scores import Scores, score_of
from mindrun.graph.tasks import is_one_world
from mindrun.numbers.arrays import Array, Integers, Singles
from mindrun.sim.arrays import whole_vectors
from mindrun.sim.build import build, genome_length
from mindrun.sim.c_library import library
from mindrun.sim.compilation import compile_missing
from mindrun.sim.dependencies import needed_units
from mindrun.sim.lanes.advance import advance, after, before
from mindrun.sim.lanes.runs import fill
from mindrun.sim.lanes.think import send, think, wake
from mindrun.sim.procedures import Memories, Procedures
from mindrun.sim.state import FAILED_COLUMN, FAILED_SKILL, Jobs, State, empty_state, unbegun
from mindrun.sim.units import Unit

T = TypeVar("T")
R = TypeVar("R")
DEFAULT_LANES = 256
SLICE_TICKS, SLOW_SLICE_TICKS = 1000, 20  # ticks between two looks at whether to stop; where procedures run in Python


@dataclass(frozen=True, slots=True)
class Tile:
    """Some lanes that run together, with the procedures' memories, and objects that must outlive them."""

    state: State
    memories: Memories
    kept: Any = None


class Rollout:
    """Runs a task under a master of a policy; a genome has the weights of the `learners`, in the order given.

    MindError where the task is in an environment: `sim.rollouts.rollout_for` chooses.
    """

    simulates = True  # whether the worlds are the lanes' own

    def __init__(
        self,
        policy: Policy,
        task: str,
        master: str,
        learners: Sequence[str] = (),
        *,
        procedures: Path | None = None,
        interrupt: bool = True,
        workers: int = 1,
        lanes: int = DEFAULT_LANES,
    ) -> None:
        self.graph = graph = policy.graph
        self.task = next(t for t in graph.tasks if t.name == task)
        if self.simulates and (name := self.task.scene.environment):
            said = f"{task} is in the environment {name}, which cannot be simulated otherwise"
            raise MindError(said, "mindc run, bench, train and view step it.")
        self.is_one_world = is_one_world(graph, self.task, master)
        self.procedures = Procedures(graph, self.task, master, procedures)
        self.interrupt, self.workers, self.lanes = interrupt, workers, lanes
        named, learners = {skill.name: skill for skill in graph.skills}, [*dict.fromkeys(learners)]
        self.learners = tuple(named[name] for name in learners)
        self.genome_length = genome_length(graph, learners)
        self.slice_ticks = SLOW_SLICE_TICKS if self.procedures.slow else SLICE_TICKS
        addresses = self.procedures.addresses
        self.tables, self.sizes = build(graph, policy.weights, self.task, master, learners, addresses, library())

    def score(
        self,
        genomes: Singles,
        seeds: Sequence[int],
        ran: Callable[[float], None] = lambda runs: None,
        ticks: int | None = None,
    ) -> Scores:
        """Score every genome [genomes, genome_length] on every seed; ValueError where a weight is not finite.

        With `ticks` no run lasts longer than so many. `ran` is told now and then, from any thread, how many more runs
        have been made, parts of them too. Ctrl-C stops all workers.
        """
        if not np.isfinite(genomes).all():
            raise ValueError("a genome has weights that are not finite numbers")
        jobs = self.jobs(np.ascontiguousarray(genomes, np.float32), np.array(seeds, np.uint64), ticks)
        workers = max(1, min(self.workers, len(jobs.genome)))
        shares = [np.arange(worker, len(jobs.genome), workers) for worker in range(workers)]
        stop = Event()
        parts = _in_threads(lambda share: self._run(jobs, share, stop, ran), shares, stop)
        return _scores(parts, shares, (len(genomes), len(seeds)), self.task.counts)

    def on(self, workers: int) -> Self:
        """A copy that runs on so many cores; what is compiled and read is shared."""
        other = copy(self)
        other.workers = workers
        return other

    def draw(self, count: int, rng: np.random.Generator) -> Singles:
        """Random genomes [count, genome_length] for learning to begin with."""
        none = np.empty((count, 0), np.float32)
        each = (skill.function.draw(len(skill.inputs), skill.outputs, count, rng) for skill in self.learners)
        return np.concatenate([none, *each], axis=1)

    def jobs(self, genomes: Singles, seeds: NDArray[np.uint64], ticks: int | None = None) -> Jobs:
        """Every genome on every seed, as jobs that have not begun; with `ticks` none lasts longer than so many."""
        pairs = np.indices((len(genomes), len(seeds))).reshape(2, -1)
        most = np.array([min(ticks or self.task.ticks, self.task.ticks)])
        return unbegun(genomes, seeds, most, pairs[0], pairs[1], len(self.tables.rewards), len(self.tables.events))

    @property
    def entries(self) -> tuple[Unit, ...]:
        """The units that its runs call first."""
        return (fill, before, think, wake, send, after) if self.procedures.slow else (fill, advance)

    def units(self, *entries: Unit) -> list[Unit]:
        """These units, or those of its runs, and all that they call."""
        return needed_units(entries or self.entries, self.tables)

    def compile(self, *entries: Unit, told: Callable[[], None] = lambda: None) -> None:
        """Compile what is not kept of these units, or of those of its runs, and load them; `told` is called after each.

        Ten seconds of two cores where nothing is kept, else a few hundredths.
        """
        needed = self.units(*entries)
        compile_missing(needed, told)
        for unit in needed:
            unit.load()

    def tile(self, lanes: int) -> Tile:
        """A tile with room for so many worlds, of as many lanes as robots each."""
        lanes *= len(self.tables.robots)
        return Tile(empty_state(self.tables, self.sizes, lanes), Memories(self.procedures))

    def _run(self, jobs: Jobs, share: Integers, stop: Event, ran: Callable[[float], None]) -> Jobs:
        lines, events = jobs.lines.shape[1], jobs.counts.shape[1]
        mine = unbegun(jobs.genomes, jobs.seeds, jobs.most, jobs.genome[share], jobs.seed[share], lines, events)
        robots = len(self.tables.robots)
        tile = self.tile(lanes_for(len(share), max(1, self.lanes // robots)))
        self.fill(tile, mine)
        told, working = 0.0, 1
        while working and not stop.is_set():
            working = self.advance(tile, mine, self.slice_ticks)
            done = (
                int(mine.next[0])
                - (working - float(tile.state.world.tick[:working].sum()) / int(mine.most[0])) / robots
            )
            ran(done - told)
            told = done
        return mine

    def fill(self, tile: Tile, jobs: Jobs) -> None:
        """Begin a job in every lane."""
        fill(self.tables, tile.state, jobs, len(tile.state.world.tick))

    def advance(self, tile: Tile, jobs: Jobs, ticks: int) -> int:
        """Run so many ticks; return how many lanes are still at work. ProcedureError where a procedure fails."""
        if self.simulates and not self.procedures.slow:
            advance(self.tables, tile.state, jobs, ticks, self.interrupt)
            self._explain(tile)
            return int(jobs.lanes[0])
        for _ in range(ticks):
            if jobs.lanes[0] == 0:
                break
            self.observe(tile, jobs)
            before(self.tables, tile.state, jobs)
            self.think(tile, jobs, 0, len(self.tables.skills))
            self.conclude(tile, jobs)
        self.forget(tile, {*tile.state.run.job[: jobs.lanes[0]].tolist()})
        return int(jobs.lanes[0])

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences that a user should read about the runs so far."""
        return ()

    def make_again(self, genome: Singles, seed: int) -> None:
        """Make a run twice where it may not be the same again: the lanes' own worlds always are."""

    def observe(self, tile: Tile, jobs: Jobs) -> None:
        """Write readings that come from outside of the lanes, before a tick: none here."""

    def conclude(self, tile: Tile, jobs: Jobs) -> None:
        """Make the second half of a tick, after `think`."""
        after(self.tables, tile.state, jobs, self.interrupt)

    def forget(self, tile: Tile, working: set[int]) -> None:
        """Forget what procedures remember of all jobs but those at work."""
        tile.memories.forget(working)

    def think(self, tile: Tile, jobs: Jobs, first: int, last: int) -> None:
        """Run the skills first..last of the table, between both halves of a tick; ProcedureError where one fails."""
        tables, state, lanes = self.tables, tile.state, int(jobs.lanes[0])
        if not self.procedures.slow:
            think(tables, state, lanes, first, last)
            self._explain(tile)
            return
        for row in range(first, last):
            if (name := self._skill(row)) not in self.procedures.slow:
                think(tables, state, lanes, row, row + 1)
                self._explain(tile)
            elif count := wake(tables, state, lanes, row):
                tile.memories.run(name, tables.skills[row], tables, state, count)
                send(tables, state, row, 0, count, lanes)

    def _explain(self, tile: Tile) -> None:
        """Raise ProcedureError where a compiled procedure has failed."""
        failed = tile.state.run.failed
        if (row := failed[FAILED_SKILL]) >= 0:
            inputs = tile.state.mind.gathered[: int(self.tables.skills[row]["inputs"]), failed[FAILED_COLUMN]]
            raise self.procedures.explain(self._skill(row), inputs)

    def _skill(self, row: int) -> str:
        """The name of a skill in the tables."""
        return self.graph.skills[int(self.tables.skills[row]["index"])].name


def scores_of(jobs: Jobs, task: Task) -> Scores:
    """The scores of all jobs, every genome on every seed."""
    return _scores([jobs], [np.arange(len(jobs.genome))], (len(jobs.genomes), len(jobs.seeds)), task.counts)


def lanes_for(jobs: int, most: int) -> int:
    """The number of lanes for so many jobs: no more than `most`, few rounds, whole vectors of 16."""
    lanes = -(-jobs // max(1, -(-jobs // most)))
    return max(1, min(most, whole_vectors(lanes) if lanes > 1 else 1))


def _scores(parts: Sequence[Jobs], shares: Sequence[Array], shape: tuple[int, int], counted: Sequence[int]) -> Scores:
    order = np.argsort(np.concatenate(shares))

    def joined(name: str) -> Array:
        whole: Array = np.concatenate([getattr(part, name) for part in parts])[order]
        return whole.reshape(*shape, *whole.shape[1:])

    lines, happened = joined("lines"), joined("counts")
    total = score_of(lines)
    broken = ~np.isfinite(total)
    return Scores(
        total=np.where(broken, -np.inf, total),
        by_line=lines,
        counts=happened[:, :, list(counted)].sum(axis=2),
        by_event=happened,
        ticks=joined("ticks"),
        ended_by=joined("ended"),
        met=joined("met"),
        faults=joined("faults") + broken,
    )


def _in_threads(work: Callable[[T], R], items: Sequence[T], stop: Event) -> list[R]:
    """The results of `work` for each item, each in a thread of its own, for which the caller's thread only waits.

    So Ctrl-C reaches it whatever compiled code does, and a program that ends waits for none. `stop` is set where
    anything fails; of several errors the one of the first item is raised.
    """
    results: list[Future[R]] = [Future() for _ in items]

    def run(result: Future[R], item: T) -> None:
        try:
            result.set_result(work(item))
        except BaseException as error:
            result.set_exception(error)

    try:
        for result, item in zip(results, items, strict=True):
            Thread(target=run, args=(result, item), daemon=True).start()
        wait(results, return_when=FIRST_EXCEPTION)
    finally:
        stop.set()
    wait(results)
    return [result.result() for result in results]
