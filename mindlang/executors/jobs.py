"""Jobs: pure functions of their own data and their assignment, done by any worker, in any order, any number of times.

A job is a stretch of an attempt, or genomes to be scored on seeds. Its result is an answer, and so is, in plain
words, why it was not done. Genomes × seeds become jobs, whose results are the arrays that one machine would make.
"""

import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from importlib.util import find_spec
from math import ceil
from pathlib import Path
from queue import Empty, SimpleQueue
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np
from mindrun.engine.engine import procedure_sources
from mindrun.errors import MindError
from mindrun.graph.bundle import Bundle, pack, unpack
from mindrun.graph.graph import Task
from mindrun.graph.policy import Policy
from mindrun.graph.run_scores import Scores
from mindrun.kinds.procedure_text import FILES
from mindrun.train.attempt import Segment, Stretch, advance
from mindrun.train.lesson_state import Course
from mindrun.train.scoring import WrappedScorer
from numpy.typing import NDArray

if TYPE_CHECKING:
    from mindrun import Rollout

POLL_SECONDS = 0.2  # to wait for an answer before who asks may look at something else
MAX_LOSSES = 5  # times that a job may be lost with its worker
SHOWN_CHARACTERS = 1000  # of why a job failed
JOB_SECONDS = 1.0  # that a job takes at most, as far as is known: so much is lost with a worker
MIN_JOB_SECONDS = 0.1  # that it takes at least, while there is so much to do
JOBS_PER_WORKER = 2  # then, so that none waits long for the last
FIRST_RUNS = 16  # in a job of which nobody knows how long it takes
COUNTED = ("counts", "by_event", "ticks", "ended_by", "met", "faults")
SUMMED = ("total", "by_line")
FATAL = (
    "the same job ends whoever does it: memory may run out there, a procedure end the process, or an environment that "
    "a program registered itself"
)

Tally = NDArray[np.int64]
Work = Callable[[Any], Any]  # a job: the scorer of its assignment to the job's result; it is pickled


class WorkError(MindError):
    """Work that no worker can do."""


@dataclass(frozen=True, slots=True)
class Assignment:
    """The common part of all jobs of a training or a bench: a task under a master, and the packed bundle that has both.

    A genome has the weights of the `learners`, one after the other. In `folder`, which no other machine is told, a
    module may stand that registers an environment.
    """

    bundle: bytes
    task: str
    master: str
    learners: tuple[str, ...] = ()
    interrupt: bool = True
    folder: Path | None = None


def assignment_of(
    policy: Policy, task: str, master: str, folder: Path, learners: tuple[str, ...] = (), interrupt: bool = True
) -> Assignment:
    """The assignment of a mind whose procedures lie in `folder`; MindError where it is too large for a bundle."""
    procedures = procedure_sources(policy.graph, folder, master)
    return Assignment(pack(Bundle(policy, procedures)), task, master, learners, interrupt, folder)


@dataclass(frozen=True, slots=True)
class Done:
    """The result of a job, the seconds that it took, and what its scorer counted meanwhile beside the results."""

    result: Any
    seconds: float
    tally: Tally

    def count_in(self, scorer: Any) -> None:
        if len(self.tally):
            scorer.add(self.tally)


@dataclass(frozen=True, slots=True)
class Failed:
    """Why a job was not done: the same would be so anywhere, so that it is not tried again."""

    message: str
    hint: str = ""


def answer(scorer: Callable[[], Any], work: Work) -> Done | Failed:
    """Do a job with the scorer that `scorer()` makes of its assignment; whatever is raised is an answer, too."""
    try:
        made = scorer()
        before, began = tally_of(made), perf_counter()
        result = work(made)
        return Done(result, max(0.0, perf_counter() - began), tally_of(made) - before)
    except MindError as error:
        return Failed(str(error), error.hint)
    except BaseException as error:
        return Failed(f"a job failed: {type(error).__name__}: {error}"[:SHOWN_CHARACTERS])


def tally_of(scorer: Any) -> Tally:
    """The counts of a scorer beside its results, as `mindrun.sim.outside.rollout` has them; empty of one without."""
    return scorer.tally() if hasattr(scorer, "tally") else np.zeros(0, np.int64)


def rollout_of(assignment: Assignment, threads: int) -> "Rollout":
    """A rollout of an assignment on so many cores, compiled; the text of its procedures' modules is run."""
    rollout_for = import_module("mindrun.sim.rollouts").rollout_for
    bundle = unpack(assignment.bundle)
    with tempfile.TemporaryDirectory(prefix="mind-work-") as folder:
        for name, content in bundle.procedures.items():
            if isinstance(content, str):
                name, content = f"{name.replace('.', '/')}.py", content.encode()
            path = Path(folder, name.removeprefix(FILES))
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        cast = bundle.policy, assignment.task, assignment.master, assignment.learners
        rollout: Rollout = rollout_for(*cast, procedures=Path(folder), interrupt=assignment.interrupt, workers=threads)
        rollout.compile()
    return rollout


@dataclass(slots=True)
class Job:
    """A job that is being done; `worker` does it, where that is one of ours."""

    number: int
    work: Work
    worker: Any = None
    losses: int = 0  # workers that it has cost
    starts: int = 0  # and those with others that had not come to it yet


class JobExecutor:
    """Does the jobs of one assignment, a future each; one whose worker is lost is done again."""

    has_begun = True  # whether a worker has been there by now: before, nobody has done anything

    def __init__(self) -> None:
        self._open: dict[Any, Job] = {}  # by their futures
        self._ended: SimpleQueue[Any] = SimpleQueue()

    @property
    def workers(self) -> int:
        """The number of jobs that can be at work at once, as far as is known; it may change."""
        raise NotImplementedError

    def has_room(self) -> bool:
        """True if a worker would wait without another job."""
        return len(self._open) < self.workers

    def submit(self, number: int, work: Work) -> None:
        self._ask(Job(number, work))

    def next_result(self) -> tuple[int, Done] | None:
        """The number of a job that is done, and its answer; None after POLL_SECONDS. WorkError where none can come."""
        try:
            future = self._ended.get(timeout=POLL_SECONDS)
        except Empty:
            self.workers  # noqa: B018  # looks whether there are any
            return None
        job = self._open.pop(future)
        try:
            found = self._answer(future, job)
        except TimeoutError:  # its result has not come yet
            self._open[future] = job
            self._ended.put(future)
            return None
        if found is None:
            self._ask(job)
            return None
        if isinstance(found, Failed):
            raise WorkError(found.message, found.hint)
        return job.number, found

    def close(self) -> None:
        """End all workers, whatever they do."""
        raise NotImplementedError

    def _ask(self, job: Job) -> None:
        future = self._future_of(job)
        self._open[future] = job
        future.add_done_callback(self._ended.put)

    def _future_of(self, job: Job) -> Any:
        """The answer to a job, once there is one."""
        raise NotImplementedError

    def _answer(self, future: Any, job: Job) -> Done | Failed | None:
        """The answer in a future; None if its worker was lost, TimeoutError before it comes, WorkError if none will."""
        raise NotImplementedError


@dataclass(frozen=True, slots=True)
class StretchExecutor:
    """Does the stretches of a course; what its workers count beside their results is counted in `scorer`."""

    course: Course
    jobs: JobExecutor
    scorer: Any = None

    def has_room(self) -> bool:
        return self.jobs.has_room()

    def submit(self, job: int, stretch: Stretch) -> None:
        self.jobs.submit(job, partial(_advance, self.course, stretch))

    def next_result(self) -> tuple[int, Segment] | None:
        if (taken := self.jobs.next_result()) is None:
            return None
        job, done = taken
        done.count_in(self.scorer)
        return job, done.result


def _advance(course: Course, stretch: Stretch, scorer: Any) -> Segment:
    return advance(course, scorer, stretch, perf_counter)


def refuse_without(packages: tuple[str, ...], who: str, extra: str) -> None:
    """MindError where one of these packages is not installed; `who` begins the sentence, `extra` would bring them."""
    for name in packages:
        if find_spec(name) is None:
            hint = f"pip install 'mindlang[{extra}]'"
            raise MindError(f"{who} {name.replace('_', '-')}, which is not installed", hint)


class JobScorer(WrappedScorer):
    """Scores as `rollout` would, to the bit, by any workers: a result depends on its genome and its seed alone."""

    def __init__(self, rollout: Any, jobs: JobExecutor) -> None:
        super().__init__(rollout)
        self.jobs = jobs
        self._seconds: float | None = None  # that a run takes, by the last job
        self._asked = 0  # the number of the last job: one that was given up may still be answered

    @property
    def notes(self) -> tuple[str, ...]:
        notes: tuple[str, ...] = self.rollout.notes
        return notes

    def make_again(self, genome: NDArray[np.float32], seed: int) -> None:
        self.rollout.make_again(genome, seed)

    def score(
        self,
        genomes: NDArray[np.float32],
        seeds: Sequence[int] | NDArray[np.uint64],
        ran: Callable[[float], None] = lambda runs: None,
        ticks: int | None = None,
    ) -> Scores:
        """Every genome [genomes, genome_length] on every seed; `ran` is told how many more runs have been made.

        With `ticks` no run lasts longer than so many.
        """
        if not np.isfinite(genomes).all():
            raise ValueError("a genome has weights that are not finite numbers")
        genomes, words = np.ascontiguousarray(genomes, np.float32), np.array(seeds, np.uint64)
        whole = empty_scores(len(genomes), len(words), self.task)

        def size() -> int:
            return runs_in_a_job(len(genomes) * len(words), self.jobs.workers, self._seconds)

        left, open_jobs = blocks(len(genomes), len(words), size), dict[int, Block]()
        block = next(left, None)
        while block or open_jobs:
            while block and self.jobs.has_room():
                self._asked += 1
                self.jobs.submit(self._asked, partial(_score, genomes[block.genomes], words[block.seeds], ticks))
                open_jobs[self._asked] = block
                block = next(left, None)
            if (taken := self.jobs.next_result()) is not None and (answered := open_jobs.pop(taken[0], None)):
                done = taken[1]
                done.count_in(self.rollout)
                self._seconds = done.seconds / answered.runs
                write_scores(answered, done.result, whole)
                ran(answered.runs)
        return whole

    def tally(self) -> Tally:
        return tally_of(self.rollout)


def _score(genomes: NDArray[np.float32], seeds: NDArray[np.uint64], ticks: int | None, scorer: Any) -> Scores:
    scores: Scores = scorer.score(genomes, seeds, ticks=ticks)
    return scores


@dataclass(frozen=True, slots=True)
class Block:
    """Some genomes on some seeds."""

    genomes: slice
    seeds: slice

    @property
    def runs(self) -> int:
        return int((self.genomes.stop - self.genomes.start) * (self.seeds.stop - self.seeds.start))


def runs_in_a_job(runs: int, workers: int, seconds: float | None) -> int:
    """The number of runs for one job out of all, where a run takes so many seconds (None: nobody knows)."""
    if seconds is None:
        return FIRST_RUNS
    share = runs / (max(1, workers) * JOBS_PER_WORKER)
    fewest, most = MIN_JOB_SECONDS / max(seconds, 1e-9), JOB_SECONDS / max(seconds, 1e-9)
    return max(1, ceil(min(max(share, fewest), most)))


def blocks(genomes: int, seeds: int, size: Callable[[], int]) -> Iterator[Block]:
    """Genomes × seeds cut into blocks, of about `size()` runs each: whole genomes where these are all seeds or more."""
    done = 0
    while done < genomes * seeds:
        (genome, seed), runs = divmod(done, seeds), size()
        if seed == 0 and runs >= seeds:
            block = Block(slice(genome, min(genomes, genome + runs // seeds)), slice(0, seeds))
        else:
            block = Block(slice(genome, genome + 1), slice(seed, min(seeds, seed + runs)))
        done += block.runs
        yield block


def empty_scores(genomes: int, seeds: int, task: Task) -> Scores:
    more = {"by_line": (max(1, len(task.rewards)),), "by_event": (len(task.events),)}
    types = dict.fromkeys(SUMMED, np.float64) | dict.fromkeys(COUNTED, np.int64)
    return Scores(**{name: np.zeros((genomes, seeds, *more.get(name, ())), of) for name, of in types.items()})


def write_scores(block: Block, part: Any, whole: Scores) -> None:
    for name in (*SUMMED, *COUNTED):
        getattr(whole, name)[block.genomes, block.seeds] = getattr(part, name)
