"""Trainings while they are seen: logs of run folders, read again whenever they have grown, and champions that play."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from mindrun.errors import MindError
from mindrun.graph.policy import Policy
from mindrun.graph.weights import parts
from mindrun.sim.rollout import Rollout
from mindrun.train import NotFoundError, RunError
from mindrun.train.champion_log import CHAMPION_ROWS, Champion, read_champions, rows_that_fit
from mindrun.train.population import Genomes
from mindrun.train.progress import LINES, Position, read_progress
from mindrun.train.run_folder import MANIFEST, SOURCES, RunFolder, open_run

from mindlang.compiler.compile import load
from mindlang.compiler.drawing import text_after_name
from mindlang.files import Stamp, stamp
from mindlang.lock.status import ReadyMind
from mindlang.run.setup import RunSetup
from mindlang.training.subject import Subject, is_mind_of, open_subject
from mindlang.view.about import Texts
from mindlang.view.messages import RefusedError, shown
from mindlang.view.viewed import Viewed
from mindlang.view.viewed_run import ViewedRun

WATCH_SECONDS = 0.5  # between two looks at the files
MAX_GENERATIONS = 10_000  # that are told at once
RUN_HINT = "a run is a folder like runs/GoToObject/20260714T120000Z-1: mindc train MIND.mind begins one"
GROWING = LINES, CHAMPION_ROWS  # files of a run that grow

Generation = tuple[int, int, float | None, float | None, float | None]  # attempt, generation; the scores of SCORES
SCORES = "best", "reevaluated", "verdict"


@dataclass(slots=True)
class LearntRun:
    """A training run as far as it has been read: its generations in order, and the champions that can be played.

    `is_full`: if the last that was kept need not have stayed champion. `version` counts how often something has come.
    """

    run: RunFolder
    generations: list[Generation] = field(default_factory=list)
    champions: list[Champion] = field(default_factory=list)
    is_full: bool = False
    version: int = 0
    _known: set[Position] = field(default_factory=set)
    _stamps: tuple[Stamp, ...] = ()

    def read(self) -> bool:
        stamps = tuple(stamp(self.run.folder / name) for name in GROWING)
        if stamps == self._stamps:
            return False
        self._stamps = stamps
        for record in read_progress(self.run.folder):
            at = int(record["attempt"] or 0), int(record["generation"] or 0)
            if at not in self._known:  # what is done again after a crash comes to the same
                self._known.add(at)
                best, reevaluated, verdict = (record[name] for name in SCORES)
                self.generations.append((*at, best, reevaluated, verdict))
        kept = [each for each in read_champions(self.run.folder) if each.position in self._known]
        self.champions = kept
        self.is_full = bool(kept) and len(kept) >= rows_that_fit(len(kept[0].genome))
        self.version += 1
        return True

    @property
    def grown(self) -> int:
        """When its log grew last, in nanoseconds."""
        return self._stamps[0][0] if self._stamps and self._stamps[0] else 0

    def champion(self, attempt: int, generation: int) -> Champion:
        """The champion of an attempt in a generation; RefusedError where that is not known."""
        if (attempt, generation) not in self._known:
            raise RefusedError(f"attempt {attempt} has no generation {generation} yet")
        found = [each for each in self.champions if each.attempt == attempt and each.generation <= generation]
        stayed = not (self.is_full and found[-1:] == self.champions[-1:])
        if found and (stayed or found[-1].generation == generation):
            return found[-1]
        if self.is_full and self.champions[-1].position < (attempt, generation):
            raise RefusedError(
                f"{CHAMPION_ROWS} of this run was full before generation {generation} of attempt {attempt}"
            )
        raise RefusedError(f"this run has kept no champion of attempt {attempt}")

    def score(self, attempt: int, generation: int) -> float | None:
        """The score of a generation's champion in its last trial, on layouts that it had not seen; None before one."""
        tried = [row for row in self.generations if row[0] == attempt and row[1] <= generation and row[3] is not None]
        return tried[-1][3] if tried else None


@dataclass(slots=True)
class Learning:
    """The runs of a folder, in the order in which they were found, whose champions play in the world of that seed."""

    path: Path
    seed: int
    runs: list[LearntRun] = field(default_factory=list)
    _minds: dict[Path, tuple[Subject, Texts]] = field(default_factory=dict)  # compiled once for each run

    def read(self) -> bool:
        grown = [run.read() for run in self.runs]
        known = {run.run.folder for run in self.runs}
        found = [LearntRun(run) for run in _runs(self.path, known)]
        new = [run for run in found if run.read() and run.generations]
        self.runs.extend(new)
        return any(grown) or bool(new)

    def news(self, number: int, heard: int) -> dict[str, Any]:
        """The message about a run for a viewer who has got its first `heard` generations."""
        learnt = self.runs[number]
        return {
            "say": "learnt",
            "run": number,
            "name": shown(learnt.run.manifest.name),
            "folder": shown(learnt.run.folder.name),
            "generations": learnt.generations[heard : heard + MAX_GENERATIONS],
            "newest": self.newest(),
        }

    def newest(self) -> tuple[int, int, int]:
        """The run with the champion that was found last, its attempt and generation."""
        playable = [number for number, run in enumerate(self.runs) if run.champions]
        number = max(playable, key=lambda number: self.runs[number].grown)
        return number, *self.runs[number].champions[-1].position

    def begin(self, number: int, attempt: int, generation: int, seed: int | None = None, robot: int = 0) -> Viewed:
        """The run of a champion, which has not begun but for its beginning; MindError where it cannot be made."""
        learnt = self.runs[number]
        champion = learnt.champion(attempt, generation)
        setup, texts = self._setup(learnt.run, champion.genome)
        viewed = ViewedRun(setup.watching(robot), setup.rollout(), self.seed if seed is None else seed, texts).begun()
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
        viewed.watched = lambda robot: self.begin(number, attempt, generation, seed, robot)
        viewed.grow()
        return viewed

    def rollout(self, number: int) -> Rollout:
        learnt = self.runs[number]
        return self._setup(learnt.run, learnt.champions[-1].genome)[0].rollout()

    def _setup(self, run: RunFolder, genome: Genomes) -> tuple[RunSetup, Texts]:
        if run.folder not in self._minds:
            self._minds[run.folder] = trained_mind(run)
        subject, texts = self._minds[run.folder]
        lesson = run.manifest.lesson
        weights = dict(run.weights) | parts(subject.graph, run.manifest.learners, genome)
        policy = Policy(replace(subject.graph, master=lesson.master), weights)
        task = next(task for task in subject.graph.tasks if task.name == lesson.task)
        return RunSetup(task, lesson.master, ReadyMind(policy, (), ()), subject.folder), texts


def open_learning(path: Path, seed: int) -> Learning:
    """The run in a folder, or all beneath it; RunError where there is none of which a champion can be played."""
    if (path / MANIFEST).exists() or (path / LINES).exists():
        open_run(path)  # says what is damaged
    elif not any(path.rglob(MANIFEST)):
        raise NotFoundError(f"there is no run in {path}", RUN_HINT)
    learning = Learning(path, seed)
    learning.read()
    if not learning.runs:
        hint = f"wait for the first one; where {LINES} is damaged, mindc train --resume writes it again"
        raise NotFoundError(f"no run in {path} says of a generation yet", hint)
    if not any(run.champions for run in learning.runs):
        raise RunError(f"no run in {path} has kept a champion", "mindc plot draws its curves all the same")
    return learning


def _runs(path: Path, known: set[Path]) -> Iterator[RunFolder]:
    """The complete run folders at or below a path that are not among the known ones."""
    for manifest in sorted(each for each in path.rglob(MANIFEST) if each.parent not in known):
        try:
            yield open_run(manifest.parent)
        except RunError:
            continue


def trained_mind(run: RunFolder) -> tuple[Subject, Texts]:
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
            if is_mind_of(subject, run):
                edges = ((skill.name, edge) for skill in compiled.mind.skills for edge in skill.edges)
                return subject, {(name, edge.target): text_after_name(edge.fact) for name, edge in edges}
        except (MindError, OSError):
            continue
    raise RunError(
        f"{source} has changed since this run of {run.manifest.lesson.skill} began, and its champions do not fit",
        f"undo the change: {run.folder / SOURCES} has it as it was",
    )
