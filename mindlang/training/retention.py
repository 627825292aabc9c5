"""Retention: the scores of earlier lessons before and after another one, on the same fresh layouts."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import isfinite

import numpy as np
from mindrun.graph.graph import Lesson
from mindrun.graph.policy import Policy
from mindrun.graph.weights import learners, owners, parts, reachable
from mindrun.sim.rollouts import rollout_for
from mindrun.train.population import Genomes
from mindrun.train.run_folder import RunFolder
from mindrun.train.scoring import Purpose, layouts, mark

from mindlang.lock.status import key_of, key_of_taught, trained_weights
from mindlang.number_format import short_score
from mindlang.run.summary import aligned
from mindlang.training.subject import Subject

TOLD_LAYOUTS, KEPT_LAYOUTS = 50, 400  # on which an earlier lesson is tried, to tell of it and where it is to be kept


@dataclass(frozen=True, slots=True)
class Retention:
    """An earlier lesson before and after another: the mean scores of its skill on so many fresh layouts."""

    lesson: Lesson
    layouts: int
    before: float
    after: float

    def is_kept(self, share: float) -> bool:
        """True if this share is left, at least; of a score below 0 as large a part of its size may be lost."""
        return self.after >= self.before - (1.0 - share) * abs(self.before)


def retentions(run: RunFolder, subject: Subject, genome: Genomes, workers: int) -> list[Retention]:
    """The earlier lessons of which a run has changed a skill that acts in them, before and after it.

    Where its lesson `keeps` nothing, only those that are simulated fast: a second or so for each.
    """
    lesson, graph = run.manifest.lesson, subject.graph
    keeps = lesson.learner.keeps > 0
    learnt = parts(graph, run.manifest.learners, genome)
    count = KEPT_LAYOUTS if keeps else TOLD_LAYOUTS
    seeds = layouts(run.manifest.seed, 0, lesson.generations, count, Purpose.RETENTION)
    found = []
    for other in earlier_lessons(subject, lesson):
        known, refusals = trained_weights(graph, subject.lock, owners(reachable(graph, other.master)))
        changed = [skill for skill in learnt if skill in known and not np.array_equal(known[skill], learnt[skill])]
        if refusals or not changed:
            continue
        here = Policy(graph, known), other.task, other.master, changed
        rollout = rollout_for(*here, procedures=subject.folder, workers=workers)
        if keeps or (rollout.simulates and not rollout.procedures.slow):
            genomes = np.stack([np.concatenate([of[skill] for skill in changed]) for of in (known, learnt)])
            before, after = mark(rollout, genomes, seeds, other.learner.lowest).scores.tolist()
            if isfinite(before):
                found.append(Retention(other, count, before, after))
    return found


def earlier_lessons(subject: Subject, lesson: Lesson) -> Iterator[Lesson]:
    """The lessons that the lock says were taught, each task under a master once.

    But for those that come after this one in its curriculum, which stand on it, and what is taught in its own place.
    """
    seen = {(lesson.task, lesson.master)}
    for other in subject.graph.lessons:
        entries = [subject.lock.get(skill) for skill in learners(subject.graph, other)]
        taught = all(
            each and key_of(other) in {key_of_taught(each.taught), *(world.lesson for world in each.worlds)}
            for each in entries
        )
        is_later = other.curriculum == lesson.curriculum and other.number > lesson.number
        if entries and taught and not is_later and (other.task, other.master) not in seen:
            seen.add((other.task, other.master))
            yield other


def retention_table(found: Sequence[Retention]) -> list[str]:
    """A line for each earlier lesson, one at least: its scores before and now, and which share of them is left."""
    rows = [(f"on {found[0].layouts} fresh layouts", "before", "now", "")]
    for each in found:
        share = f"{each.after / each.before:.0%}" if each.before > 0 and isfinite(each.after) else ""
        rows.append((each.lesson.name, short_score(each.before), short_score(each.after), share))
    return [f"  {line}" for line in aligned(rows, left=(0,)).plain.split("\n")]
