"""The champion of a generation of a training, in the world in which it was taught."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path

from mindrun.errors import MindError
from mindrun.graph.policy import Policy
from mindrun.graph.weights import learners, parts
from mindrun.sim.rollout import Rollout
from mindrun.train import RunError
from mindrun.train.manifest import fingerprint
from mindrun.train.population import Genomes
from mindrun.train.run_folder import SOURCES, RunFolder

from mindlang.compiler.compile import load
from mindlang.compiler.drawing import text_after_name
from mindlang.lock.ready import ReadyMind
from mindlang.run.setup import RunSetup
from mindlang.training.subject import Subject, open_subject
from mindlang.view.about import Texts
from mindlang.view.learning import Learning, LearntRun
from mindlang.view.viewed import Viewed
from mindlang.view.viewed_run import ViewedRun


@dataclass(slots=True)
class Champions:
    """Plays champions of trainings; a mind is compiled once for each run."""

    learning: Learning
    seed: int
    _minds: dict[Path, tuple[Subject, Texts]] = field(default_factory=dict)

    def begin(self, number: int, attempt: int, generation: int, seed: int | None = None) -> Viewed:
        """The run of a champion, which has not begun but for its beginning; MindError where it cannot be made."""
        learnt = self.learning.runs[number]
        champion = learnt.champion(attempt, generation)
        setup, texts = self._setup(learnt.run, champion.genome)
        viewed = ViewedRun(setup, setup.rollout(), self.seed if seed is None else seed, texts).begun()
        viewed.about = {
            **viewed.about,
            "source": "training",
            "training": {
                "run": number,
                "attempt": attempt,
                "generation": generation,
                "since": champion.generation,
                "score": learnt.score(attempt, generation),
            },
        }
        viewed.grow()
        return viewed

    def rollout(self, learnt: LearntRun) -> Rollout:
        """The simulator of a run, for compiling it before anybody waits."""
        return self._setup(learnt.run, learnt.champions[-1].genome)[0].rollout()

    def _setup(self, run: RunFolder, genome: Genomes) -> tuple[RunSetup, Texts]:
        if run.folder not in self._minds:
            self._minds[run.folder] = mind_of(run)
        subject, texts = self._minds[run.folder]
        lesson = run.manifest.lesson
        weights = dict(run.weights) | parts(subject.graph, run.manifest.learners, genome)
        policy = Policy(replace(subject.graph, master=lesson.master), weights)
        task = next(task for task in subject.graph.tasks if task.name == lesson.task)
        return RunSetup(task, lesson.master, ReadyMind(policy, (), ()), subject.folder), texts


def mind_of(run: RunFolder) -> tuple[Subject, Texts]:
    """The mind of a run, and what its edges say: its source if that has not changed since, else the run's copy of it.

    RunError where both are another mind than that which was taught.
    """
    source = Path(run.manifest.source)
    for path in (source, run.folder / SOURCES / source.name):
        try:
            compiled = load(path)
            if compiled.graph is None or compiled.mind is None:
                continue
            subject = open_subject(path, compiled)
            if _is_mind_of(run, subject):
                edges = ((skill.name, edge) for skill in compiled.mind.skills for edge in skill.edges)
                return subject, {(name, edge.target): text_after_name(edge.fact) for name, edge in edges}
        except (MindError, OSError):
            continue
    raise RunError(
        f"{source} has changed since this run of {run.manifest.lesson.skill} began, and its champions do not fit",
        f"undo the change: {run.folder / SOURCES} has it as it was",
    )


def _is_mind_of(run: RunFolder, subject: Subject) -> bool:
    lesson = run.manifest.lesson
    names = {skill.name for skill in subject.graph.skills}, {task.name for task in subject.graph.tasks}
    return (
        {lesson.skill, lesson.master} <= names[0]
        and lesson.task in names[1]
        and learners(subject.graph, lesson) == run.manifest.learners
        and fingerprint(subject.graph, lesson, subject.folder) == run.manifest.mind
    )
