"""A candidate tried: compiled into its mind, taught by the lesson's own code, scored on layouts common to all."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.skill_sets import owner_of, reachable
from mindrun.graph.weights import Weights
from mindrun.sim.rollout import Rollout
from mindrun.sim.rollouts import rollout_for
from mindrun.train.attempt import generation
from mindrun.train.lesson_state import AttemptState, Course, begin_attempt
from mindrun.train.scoring import Purpose, layouts, mark
from numpy.typing import NDArray

from mindlang.compiler.compile import Compiled, compile_source
from mindlang.compiler.source import spliced
from mindlang.editing.edits.declarations import add
from mindlang.editing.project import project_alone
from mindlang.lock import Lock, lock_sources, read_locks
from mindlang.lock.signature import arrange
from mindlang.lock.status import ReadyMind, trained_weights
from mindlang.propose.candidates import Candidate
from mindlang.propose.static import Known
from mindlang.run.recorded_run import record_run
from mindlang.run.setup import RunSetup
from mindlang.training.subject import origin_weights

COMMON_LAYOUTS = 100  # on which candidates are compared
RECORDED_RUNS = 3  # of which the mean of a reading is taken
LESSON_GENERATIONS = 62  # of a whole lesson
STANDARD_ERRORS = 2.0  # by which what is better is better
WORTHWHILE_SHARE = 0.03  # of a score, below which a gain is not worth a line

Floats = NDArray[np.float64]
Counting = Callable[[str, int], AbstractContextManager[Callable[[float], None]]]


@dataclass(slots=True)
class Trial:
    """A candidate at work: its attempts, each with what it knows so far and the scores [layouts] of its champion."""

    candidate: Candidate
    graph: Graph
    weights: Mapping[str, Weights]
    rollout: Rollout
    course: Course | None
    states: list[AttemptState] = field(default_factory=list)
    scores: list[Floats] = field(default_factory=list)
    ticks: int = 0

    @property
    def best(self) -> int:
        """The attempt that does best on the common layouts, the first of equals."""
        return int(np.argmax([each.mean() for each in self.scores]))

    @property
    def score(self) -> float:
        """The mean of its best attempt on the common layouts."""
        return float(self.scores[self.best].mean())

    @property
    def champion(self) -> NDArray[np.float32]:
        """The genome [1, weights] of its best attempt; one without weights where it learns nothing."""
        return self.states[self.best].champion if self.states else np.zeros((1, 0), np.float32)


@dataclass(frozen=True)
class Stage:
    """The mind, the task and the seed with which all candidates are tried, on so many workers.

    `prepare` compiles a simulator, `counting` shows how far something is.
    """

    compiled: Compiled
    path: Path
    known: Known
    skill: str
    curriculum: str
    seed: int
    workers: int
    prepare: Callable[[Rollout], object]
    counting: Counting

    @property
    def lock(self) -> Lock:
        """What is taught, but for the skill that is proposed."""
        entries = read_locks(lock_sources(self.compiled.sources))
        return {name: entry for name, entry in entries.items() if name != self.skill}

    @property
    def common(self) -> list[int]:
        """The layouts on which candidates are compared."""
        return [int(seed) for seed in layouts(self.seed, 0, 0, COMMON_LAYOUTS, Purpose.COMPARISON)]

    @property
    def task(self) -> str:
        """The name of the task."""
        return self.known.task.name

    def lines(self, candidate: Candidate, remarks: Mapping[str, str] | None = None) -> list[str]:
        """All lines of a candidate, as they are added to the file."""
        return [
            *candidate.sensors(self.known),
            *candidate.skill(self.skill, remarks),
            *candidate.curriculum(self.skill, self.known.task, self.curriculum, LESSON_GENERATIONS),
        ]

    def graph_of(self, candidate: Candidate) -> Graph | None:
        """The mind with a candidate in it; None where that does not compile."""
        if candidate.way == "unchanged":
            return self.compiled.whole[1]
        project, main = project_alone(self.compiled), self.compiled.sources[0]
        text = spliced(main, add(project, ("\n".join(self.lines(candidate)),)).splices)
        found = compile_source(replace(main, text=text), main.path)
        return found.graph if found.is_valid else None

    def begin(self, candidate: Candidate) -> Trial | None:
        """A candidate ready to be taught, or to act; None where it does not compile or its skills lack weights."""
        if (graph := self.graph_of(candidate)) is None:
            return None
        lock, master = self.lock, candidate.origin if candidate.way == "unchanged" else self.skill
        graph = replace(arrange(graph, lock), master=master)
        own = () if not candidate.learns else (self.skill,)
        below = [each.name for each in reachable(graph, master) if each.name not in own]
        weights, refusals = trained_weights(graph, lock, below)
        if refusals:
            return None
        folder = self.compiled.sources[0].folder
        rollout = rollout_for(Policy(graph, weights), self.task, master, own, procedures=folder, workers=self.workers)
        self.prepare(rollout)
        return Trial(candidate, graph, weights, rollout, self._course(candidate, graph, lock, rollout))

    def _course(self, candidate: Candidate, graph: Graph, lock: Lock, rollout: Rollout) -> Course | None:
        if not candidate.learns:
            return None
        lesson = next(each for each in graph.lessons if each.curriculum == self.curriculum)
        start = np.empty((0, rollout.genome_length), np.float32)
        if lesson.starts_from:
            start = origin_weights(graph, lock, lesson, self.path)[self.skill][None]
        return Course(lesson, self.seed, start)

    def teach(self, trial: Trial, generations: int, attempts: int = 1) -> None:
        """Go on with so many attempts of a trial until each has had so many generations; then score their champions."""
        while trial.course and len(trial.states) < attempts:
            trial.states.append(begin_attempt(trial.course))
        for number, state in enumerate(trial.states):
            while trial.course and state.population.generation < generations:
                state, record = generation(trial.course, trial.rollout, number, state)
                trial.ticks += record.ticks
            trial.states[number] = state
        self.rate(trial)

    def rate(self, trial: Trial) -> None:
        """Score the champion of each attempt on the common layouts, or what acts without a lesson."""
        genomes = [state.champion for state in trial.states] or [np.zeros((1, 0), np.float32)]
        marks = mark(trial.rollout, np.concatenate(genomes), self.common)
        trial.scores = [*marks.each]
        trial.ticks += marks.ticks

    def holding(self, trial: Trial, names: Sequence[str], means: Mapping[str, tuple[float, ...]]) -> Floats:
        """The scores [layouts] of the champion of a trial with some of its readings held at their means."""
        candidate = trial.candidate.holding({name: means[name] for name in names})
        held = self.begin(candidate)
        if held is None:
            return np.full(COMMON_LAYOUTS, -np.inf)
        each = mark(held.rollout, trial.champion, self.common).each[0]
        return np.asarray(each, np.float64)

    def means(self, trial: Trial) -> dict[str, tuple[float, ...]]:
        """The mean of each reading of the skill of a trial over some of its runs."""
        graph, name = trial.graph, trial.candidate.origin if trial.candidate.way == "unchanged" else self.skill
        policy = Policy(graph, {**trial.weights, owner_of(graph, name): trial.champion[0]})
        task = next(each for each in graph.tasks if each.name == self.task)
        setup = RunSetup(task, name, ReadyMind(policy, (), ()), self.compiled.sources[0].folder)
        rollout = setup.rollout()
        self.prepare(rollout)
        rows = np.concatenate([record_run(setup, rollout, seed).readings for seed in self.common[:RECORDED_RUNS]])
        read = {each.name: each.place for each in graph.sensors if each.name in trial.candidate.reads}
        return {each: tuple(rows[:, place].mean(axis=0, dtype=np.float64).tolist()) for each, place in read.items()}


def gain(less: Floats, more: Floats) -> tuple[float, float]:
    """How much more one has than another on the same layouts, and the standard error of that."""
    each = more - less
    if not np.isfinite(each).all():
        return (float("inf") if np.isfinite(more).all() else float("-inf")), 0.0
    return float(each.mean()), float(each.std(ddof=1) / np.sqrt(len(each)))


def is_better(trial: Trial, than: Trial) -> bool:
    """True if the best attempt of one has more than that of another by two standard errors, and by 3 %."""
    return _is_worth(gain(than.scores[than.best], trial.scores[trial.best]), than)


def is_surely_better(trial: Trial, than: Trial) -> bool:
    """True if even the middle one of its attempts, of two the worse, is better so than the best of the other."""
    gains = sorted(gain(than.scores[than.best], scores) for scores in trial.scores)
    return _is_worth(gains[(len(gains) - 1) // 2], than)


def _is_worth(gained: tuple[float, float], than: Trial) -> bool:
    mean, error = gained
    return mean > max(STANDARD_ERRORS * error, WORTHWHILE_SHARE * abs(than.score))


def started(stage: Stage, candidates: Iterable[Candidate]) -> list[Trial]:
    """Those candidates that can be tried, in their order."""
    return [trial for trial in map(stage.begin, candidates) if trial]
