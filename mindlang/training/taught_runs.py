"""The lessons that a mind was taught, by their runs: what it knew after each, and what it does then in every task."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mindrun.files.npy import from_npy
from mindrun.files.regular_files import read_whole
from mindrun.graph.policy import Policy
from mindrun.graph.skill_sets import acting
from mindrun.graph.weights import Weights, owners, parts
from mindrun.sim.rollout import Rollout
from mindrun.sim.rollouts import rollout_for
from mindrun.train import NotFoundError
from mindrun.train.manifest import fingerprint
from mindrun.train.run_folder import MAX_FILE_BYTES, RESULT, SOURCES, WEIGHTS, RunFolder, open_run, read_result

from mindlang.compiler.compile import load
from mindlang.lock.signature import arrange, signature
from mindlang.number_format import finite
from mindlang.run.setup import NO_GENOME
from mindlang.training.subject import Subject

Place = tuple[str, str]  # a task, and the master that is in charge
Row = list[float | None]  # a number after each lesson; None where a skill had yet to be taught, or it is not finite


@dataclass(frozen=True, slots=True)
class Taught:
    """A lesson that was taught, by its run, and what each skill of the mind knew after it."""

    run: RunFolder
    known: Mapping[str, Weights]

    @property
    def place(self) -> Place:
        return self.run.manifest.lesson.task, self.run.manifest.lesson.master


def taught_runs(subject: Subject, runs: Path) -> tuple[list[Taught], int]:
    """The lessons of a mind whose weights went to the lock, in the order in which they began; how many are left out.

    What these taught does not fit the mind any more. NotFoundError where no others are.
    """
    found, known, others = list[Taught](), dict[str, Weights](), 0
    ended = sorted(runs.glob(f"*/*/{RESULT}"), key=lambda path: path.stat().st_mtime_ns)
    for run in sorted((open_run(path.parent) for path in ended), key=lambda run: run.manifest.started):
        result = read_result(run.folder)
        if Path(run.manifest.source).name != subject.source.name or result is None or not result["kept"]:
            continue
        if not _fits(subject, run):
            others += 1
            continue
        genome = from_npy(read_whole(run.folder / WEIGHTS, MAX_FILE_BYTES))
        known = {**known, **run.weights, **parts(subject.graph, run.manifest.learners, genome)}
        found.append(Taught(run, known))
    if not found:
        hint = "mindc train teaches, and keeps runs; say where with --runs"
        raise NotFoundError(f"no lesson of {subject.shown}, as it is now, has a run in {runs}", hint)
    return found, others


def _fits(subject: Subject, run: RunFolder) -> bool:
    """True if a mind has what a run taught, and its skills take the weights of the run in the order that they have.

    Skills and tasks may have come since: what was then stands in the run's folder.
    """
    graph, lesson = subject.graph, run.manifest.lesson
    before = load(run.folder / SOURCES / Path(run.manifest.source).name).graph
    is_there = any(lesson.task == task.name for task in graph.tasks) and lesson.master in graph.skill_numbers
    if before is None or not is_there:
        return False
    before = arrange(before, subject.lock)
    if fingerprint(before, lesson, subject.folder) != run.manifest.mind:
        return False
    then, now = ({skill.name: signature(of, skill) for skill in of.skills} for of in (before, graph))
    return all(then[name] == now.get(name) for name in {*run.weights, *run.manifest.learners})


def players(subject: Subject, place: Place, taught: Sequence[Taught], workers: int) -> Iterator[Rollout | None]:
    """A rollout of a task under a master after each lesson; None where a skill had yet to be taught."""
    task, master = place
    needed = owners(acting(subject.graph, next(each for each in subject.graph.tasks if each.name == task), master))
    for each in taught:
        weights = {name: each.known[name] for name in needed if name in each.known}
        policy, ready = Policy(subject.graph, weights), len(weights) == len(needed)
        yield rollout_for(policy, task, master, procedures=subject.folder, workers=workers) if ready else None


def mean_of(rollout: Rollout, seeds: Sequence[int]) -> float | None:
    """The mean of what a task counts, or of its scores where it counts nothing; None where that is not finite."""
    scores = rollout.score(NO_GENOME, seeds[: 1 if rollout.is_one_world else None])
    return finite(float((scores.counts if rollout.task.counts else scores.total).mean()))


def history(taught: Sequence[Taught], rows: Mapping[Place, Row]) -> dict[str, Any]:
    """The lessons, and of each task the numbers after them, as plain data."""
    lessons = [each.run.manifest.lesson for each in taught]
    return {
        "lessons": [
            {"lesson": lesson.name, "skill": lesson.skill, "task": lesson.task, "master": lesson.master}
            | {"curriculum": lesson.curriculum, "run": str(each.run.folder)}
            for each, lesson in zip(taught, lessons, strict=True)
        ],
        "tasks": [
            {"task": place[0], "master": place[1], "means": row}
            | {"kept": kept(row, max(number for number, each in enumerate(taught) if each.place == place))}
            for place, row in rows.items()
        ],
    }


def kept(row: Row, own: int) -> float | None:
    """The share of what a task had after lesson `own` that it has after the last one; None where that was nothing.

    >>> kept([None, 20.0, 5.0], 1)
    0.25
    """
    before, now = row[own], row[-1]
    return now / before if before is not None and now is not None and before > 0 else None
