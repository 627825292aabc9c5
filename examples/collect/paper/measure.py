"""Measuring what minds do: what taught them, how well they do, and how many attempts of a lesson have succeeded."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from math import sqrt
from pathlib import Path

from mindrun.errors import MindError
from mindrun.graph.graph import Lesson
from mindrun.graph.weights import Weights, learners, reachable
from mindrun.processors import cores
from mindrun.sim.rollout import Rollout
from plan import read_plan
from protocol import Case

from mindlang.compiler.compile import Compiled, load
from mindlang.lock import lock_path, read_lock
from mindlang.lock.status import make_ready
from mindlang.run.setup import NO_GENOME, layouts, set_up


@dataclass(frozen=True, slots=True)
class Measured:
    """Objects in a run with the standard error of their mean, and the share of its time that a run lasted."""

    objects: float
    error: float
    runtime: float

    def text(self, interrupt: bool) -> str:
        """The cell of a table: objects, their error and, where runs are interrupted, the share of time they last."""
        return f"{self.objects:.2f} ± {self.error:.2f}" + (f" ({self.runtime:.1%})" if interrupt else "")


def teaching(folder: Path, case: Case) -> dict[Path, list[Lesson]]:
    """The lessons that make a case what it is, by the file in which they stand, the case's own file first.

    They are those of the first curriculum of each file that teach a skill at work under the case's master.
    """
    found = compiled(folder / case.file)
    assert found.graph is not None
    assert found.mind is not None
    at_work = {skill.name for skill in reachable(found.graph, case.master)}
    first: dict[Path, str] = {}
    lessons: dict[Path, list[Lesson]] = {}
    for lesson, written in zip(found.graph.lessons, found.mind.lessons, strict=True):
        file = written.fact.span.source.path
        is_first = first.setdefault(file, lesson.curriculum) == lesson.curriculum
        if is_first and at_work & set(learners(found.graph, lesson)):
            lessons.setdefault(file, []).append(lesson)
    return lessons


def is_taught(folder: Path, case: Case) -> bool:
    """Whether every lesson that makes a case has been given: without its own it would be another case in disguise."""
    if read_plan(folder) and not (folder / case.file).exists():
        return False  # what was taught in part is shipped without the other files
    graph = compiled(folder / case.file).graph
    assert graph is not None
    return all(
        set(learners(graph, lesson)) <= set(read_lock(lock_path(file)))
        for file, lessons in teaching(folder, case).items()
        for lesson in lessons
    )


def measure(folder: Path, case: Case, runs: int, seed: int) -> Measured:
    """A case on so many layouts, with the weights that lie in a folder; CastingError where some are missing."""
    found = set_up(str(folder / case.file), compiled(folder / case.file), case.task, case.master)
    rollout = found.rollout(case.interrupt, cores())
    scores = rollout.score(NO_GENOME, layouts(seed, runs))
    counts = scores.counts[0]
    error = float(counts.std(ddof=1)) / sqrt(runs)
    return Measured(float(counts.mean()), error, float(scores.ticks[0].mean()) / rollout.task.ticks)


def champions_do(folder: Path, file: str, lesson: str, champions: Weights, runs: int, seed: int) -> list[float]:
    """What each champion [attempts, weights] of a lesson counts in a run, on the mean over so many layouts."""
    graph = compiled(folder / file).graph
    assert graph is not None
    taught = next(written for written in graph.lessons if written.name == lesson)
    rollout = rollout_of(folder, file, taught, [taught.skill], cores())
    return [float(mean) for mean in rollout.score(champions, layouts(seed, runs)).counts.mean(axis=1)]


def rollout_of(folder: Path, file: str, lesson: Lesson, skills: Sequence[str], workers: int) -> Rollout:
    """The world of a lesson for genomes of these skills, all others with the weights that lie in a folder."""
    found = compiled(folder / file)
    assert found.graph is not None
    ready = make_ready(found.graph, found.sources, lesson.master)
    return Rollout(ready.policy, lesson.task, lesson.master, skills, procedures=folder, workers=workers)


@cache
def compiled(path: Path) -> Compiled:
    """A file, compiled once."""
    found = load(path)
    if found.graph is None:
        raise MindError("; ".join(diagnostic.message for diagnostic in found.diagnostics), "Is the folder right?")
    return found
