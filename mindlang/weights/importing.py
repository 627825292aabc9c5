"""Imports weights: compared with the engine, tried in their lesson, and written into the lock if they do well."""

from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import partial
from hashlib import sha256
from math import isfinite
from pathlib import Path
from typing import Any
from urllib.parse import quote

import numpy as np
from mindrun.graph.graph import Lesson
from mindrun.graph.policy import Policy
from mindrun.graph.skill_sets import acting, learners, owners
from mindrun.graph.weights import Weights
from mindrun.numbers.network import Terms, matrices
from mindrun.sim.rollout import Rollout
from mindrun.sim.rollouts import rollout_for
from mindrun.sim.trace import trace
from mindrun.terminal.command_line import command_line
from mindrun.train import RunError
from mindrun.train.scoring import Purpose, Seeds, layouts, mark
from numpy.typing import NDArray

from mindlang.compiler.diagnostic import listed
from mindlang.lock import FILE_ORIGIN, Taught, read_locks
from mindlang.lock.blobs import digest, record
from mindlang.lock.status import elsewhere_sentences, status, trained_weights
from mindlang.lock.world_facts import Worlds
from mindlang.training.lesson_choice import chosen_lessons
from mindlang.training.lock_update import COMPARED_LAYOUTS, WeightsComparison, genome_there, needed_figures
from mindlang.training.subject import Subject
from mindlang.weights.network import SkillNetwork, genome_in, network_of, read_bytes
from mindlang.whatif.request import recorded_readings

READINGS_SEED = 1  # of the run whose readings are taken
LAYOUTS_SEED = 0  # of the layouts on which weights are tried
Rows = NDArray[np.float32]  # [ticks, values]
Compute = Callable[[Rows], Rows]  # inputs [ticks, inputs] of a run to outputs [ticks, outputs], in 0..1


@dataclass(frozen=True, slots=True)
class Deviation:
    """The largest `difference` of an output from that of the `reference`, in the `ticks` that were compared.

    `faults` are the outputs that were finite in one of both alone, or in none: the engine sends nothing there.
    """

    reference: str
    ticks: int
    difference: float
    faults: int


def engine_deviation(network: SkillNetwork, genome: Weights, inputs: Rows) -> Deviation:
    """How far the engine deviates from PyTorch or, if that is not installed, from matrix products in float64."""
    sound = inputs[np.isfinite(inputs).all(axis=1)]
    name, compute = _reference(network, genome)
    with np.errstate(all="ignore"):
        theirs = compute(sound)
        sends = network.skill.function.ready(network.inputs, network.outputs, genome, {})  # tick by tick, as on a robot
        ours = _clamped(np.array([sends(row) for row in sound], np.float32).reshape(len(sound), network.outputs))
    finite = np.isfinite(theirs) & np.isfinite(ours)
    difference = np.abs(theirs.astype(np.float64) - ours, where=finite, out=np.zeros(ours.shape))
    return Deviation(name, len(sound), float(difference.max(initial=0.0)), int((~finite).sum()))


def _clamped(values: NDArray[np.floating]) -> Rows:
    return np.where(np.isfinite(values), np.clip(values, 0, 1), np.nan).astype(values.dtype)


def _reference(network: SkillNetwork, genome: Weights) -> tuple[str, Compute]:
    """The function of `mindlang.torch.Skill` or, without PyTorch, products of matrices and 1/(1 + e^−x) in float64."""
    try:
        import torch
    except ImportError:
        return "float64", partial(_computed, network, genome, FLOAT64, partial(np.asarray, dtype=np.float64))
    from mindlang.weights.torch_skill import TERMS

    return f"PyTorch {torch.__version__}", partial(_computed, network, genome, TERMS, torch.tensor)


def _computed(network: SkillNetwork, genome: Weights, terms: Terms, made: Callable[[Any], Any], inputs: Rows) -> Rows:
    """The outputs in these terms, of numbers that are `made` theirs; of a network that remembers tick by tick."""
    found = [made(matrix) for matrix in matrices(genome, network.shapes)]
    state, outputs = made(np.zeros(network.state, np.float32)), []
    for rows in inputs if network.state else inputs[np.newaxis]:
        sent, state = network.skill.function.forward(terms, found, made(rows), state)
        outputs.append(np.asarray(sent))
    return _clamped(np.array(outputs).reshape(len(inputs), network.outputs))


FLOAT64 = Terms(
    product=lambda values, matrix: values @ matrix.T,
    sigmoid=lambda values: 1 / (1 + np.exp(-values)),
    joined=lambda one, other: np.concatenate([one, other]),
    biased=lambda values: np.insert(values, 0, 1.0, axis=-1),
)


@dataclass(frozen=True, slots=True)
class Trial:
    """Weights that fit a skill, and the lesson in which they are tried.

    They were brought in the file at `path`, of the SHA-256 `file_digest`, or fitted to recordings: then these are the
    lineage that the lock keeps of them. `others` are the weights of all other skills below the lesson's master.
    """

    subject: Subject
    path: Path
    file_digest: str
    network: SkillNetwork
    genome: Weights
    lesson: Lesson
    others: dict[str, Weights]
    rollout: Rollout

    def readings(self) -> NDArray[np.float32]:
        """The skill's inputs [ticks, inputs] in a run of the lesson's task with these weights."""
        inputs = list(self.network.skill.inputs)
        moments = trace(self.rollout, READINGS_SEED, self.genome).moments
        return np.array([moment.readings[inputs] for moment in moments], np.float32)

    def recorded(self, said: str) -> NDArray[np.float32]:
        """The skill's inputs [ticks, inputs] in a recording (`day.rec` or `day.rec,ball.bundle`); MindError without."""
        graph, columns = self.subject.graph, {}
        for name in (read.partition(":")[0] for read in self.network.signature.reads):
            for change in recorded_readings(graph, name, said, self.subject.source, 1, None):
                columns[change.row] = change.values
        rows = [columns[row] for row in self.network.skill.inputs]
        return np.array(rows, np.float32).T

    def score(self, old: Weights | None) -> tuple[float, WeightsComparison | None]:
        """The mean score on fresh layouts and, where there are old weights, both beside each other.

        RunError where the new ones have no score that is a finite number.
        """
        genomes = [self.genome] if old is None else [self.genome, old]
        scores = mark(self.rollout, np.stack(genomes), self._layouts, self.lesson.learner.lowest).scores
        if not isfinite(scores[0]):
            why = f"{self.network.skill.name} with these weights: a reward or a command was not a finite number"
            raise RunError(why, f"look at the weights, and at the rewards of the task {self.lesson.task}")
        return float(scores[0]), None if old is None else WeightsComparison(float(scores[1]), float(scores[0]))

    def figures(self) -> tuple[float | None, str]:
        """What else than a score the lesson needs, of runs on these layouts, as a lock has it."""
        return needed_figures(self.lesson, self.rollout, self.genome, self._layouts)

    @property
    def _layouts(self) -> Seeds:
        last = self.lesson.generations
        return layouts(LAYOUTS_SEED, attempt=0, generation=last, count=COMPARED_LAYOUTS, purpose=Purpose.COMPARISON)


def open_trial(subject: Subject, name: str, path: Path) -> Trial:
    """The trial of a skill's weights in a file; MindError where they do not fit, or nothing would come of them."""
    network = network_of(subject.graph, name)
    lesson = chosen_lessons(subject.graph, None, [name])[-1]
    others = other_weights(subject, name, lesson)
    data = read_bytes(path)
    return trial_of(subject, network, genome_in(path, data, network), lesson, others, path, sha256(data).hexdigest())


def other_weights(subject: Subject, name: str, lesson: Lesson) -> dict[str, Weights]:
    """The weights of all others that act in a lesson; RunError where these lack some, or the skill is frozen."""
    if name not in learners(subject.graph, lesson):
        raise RunError(f"{name} is frozen", command_line("mindc", "edit", "unfreeze", subject.shown, name, "--write"))
    task = next(task for task in subject.graph.tasks if task.name == lesson.task)
    needed = [each for each in owners(acting(subject.graph, task, lesson.master)) if each != name]
    others, refusals = trained_weights(subject.graph, subject.lock, needed)
    if refusals:
        first = [each for each in reversed(needed) if each not in others]
        raise RunError(
            f"{name} cannot be tried on {lesson.task} yet: {listed(refusals, 'and')}",
            f"first: {command_line('mindc', 'train', subject.shown, *first)}",
        )
    return others


def trial_of(
    subject: Subject,
    network: SkillNetwork,
    genome: Weights,
    lesson: Lesson,
    others: dict[str, Weights],
    path: Path,
    sha: str,
) -> Trial:
    """The trial of weights in a lesson, beside those of the others that act there."""
    name = network.skill.name
    policy = Policy(subject.graph, others)
    rollout = rollout_for(policy, lesson.task, lesson.master, (name,), procedures=subject.folder)
    return Trial(subject, path, sha, network, genome, lesson, others, rollout)


@dataclass(frozen=True, slots=True)
class Imported:
    """The outcome of a trial: the scores, and whether the lock has the weights now.

    `deviation` is the engine's, of weights from another program. `scores` has the old ones beside them, where there
    were any that fit. `notes` say which skills were taught with those that were there. The lock `is_unchanged` where it
    had these very weights.
    """

    trial: Trial
    deviation: Deviation | None
    score: float
    scores: WeightsComparison | None
    is_kept: bool
    is_unchanged: bool = False
    notes: tuple[str, ...] = ()

    def data(self) -> dict[str, Any]:
        trial, compared = self.trial, self.deviation
        return {
            "skill": trial.network.skill.name,
            "file": str(trial.path),
            "file_sha256": trial.file_digest,
            "weights": digest(trial.genome),
            "kept": self.is_kept,
            **(asdict(compared) if compared else {}),
            "task": trial.lesson.task,
            "master": trial.lesson.master,
            "score": self.score,
            "score_before": None if self.scores is None else self.scores.old,
            "notes": [*self.notes],
        }


def import_weights(trial: Trial, recording: str | None, force: bool) -> Imported:
    """Compare and try weights, and write them into the lock, unless what is there does better; with `force` even then.

    LockError where the lock cannot be read or written.
    """
    rows = trial.recorded(recording) if recording else trial.readings()
    return try_weights(trial, force, engine_deviation(trial.network, trial.genome, rows))


def try_weights(trial: Trial, force: bool, compared: Deviation | None = None) -> Imported:
    """Try weights, and write them into the lock, unless what is there does better; with `force` even then."""
    old = genome_there(trial.subject, trial.lesson, (trial.network.skill.name,))
    if old is not None and np.array_equal(old, trial.genome):
        return Imported(trial, compared, *trial.score(None), True, True)
    score, scores = trial.score(old)
    if scores and scores.is_worse and not force:
        return Imported(trial, compared, score, scores, False)
    return Imported(trial, compared, score, scores, True, notes=_write(trial, score))


def _write(trial: Trial, score: float) -> tuple[str, ...]:
    """Write the line of the skill; a sentence for each skill that was taught with what was there before."""
    subject, lesson, name = trial.subject, trial.lesson, trial.network.skill.name
    reached = score, lesson.number, lesson.curriculum, *trial.figures()
    record(
        subject.keep_path(lesson),
        subject.graph,
        {name: trial.genome},
        Taught(lesson.task, lesson.master, False, 0, 0, 0, *reached),
        trial.others,
        Worlds(subject.graph, subject.folder).of(lesson),
        origins={name: (f"{FILE_ORIGIN}{quote(trial.path.name, safe=';=,')}", trial.file_digest)},
        accepted=True,
    )
    before = status(subject.graph, subject.lock, subject.folder)
    now = status(subject.graph, read_locks(subject.taught), subject.folder)
    return (*elsewhere_sentences({skill: state for skill, state in now.items() if state != before[skill]}),)
