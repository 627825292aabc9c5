"""A skill with weights from elsewhere at work in its lesson: its readings there, and its score."""

from dataclasses import dataclass
from math import isfinite
from pathlib import Path

import numpy as np
from mindrun.graph.graph import Lesson
from mindrun.graph.policy import Policy
from mindrun.graph.weights import Weights, owners, reachable
from mindrun.sim.rollout import Rollout
from mindrun.sim.rollouts import rollout_for
from mindrun.sim.trace import trace
from mindrun.terminal.command_line import command_line
from mindrun.train import RunError
from mindrun.train.scoring import Purpose, Seeds, layouts, mark
from numpy.typing import NDArray

from mindlang.compiler.diagnostic import listed
from mindlang.lock.status import trained_weights
from mindlang.training.lock_update import COMPARED_LAYOUTS, Comparison, needed_success
from mindlang.training.subject import Subject
from mindlang.weights.network import Network
from mindlang.whatif.recorded_readings import recorded_readings

READINGS_SEED = 1  # of the run whose readings are taken
LAYOUTS_SEED = 0  # of the layouts on which weights are tried


@dataclass(frozen=True, slots=True)
class Trial:
    """A lesson in which a network can act: `others` are the weights of all other skills below the lesson's master."""

    subject: Subject
    lesson: Lesson
    network: Network
    others: dict[str, Weights]
    rollout: Rollout

    def readings(self, genome: Weights) -> NDArray[np.float32]:
        """What the skill reads [ticks, inputs] in a run of the lesson's task with these weights."""
        inputs = list(self.network.skill.inputs)
        moments = trace(self.rollout, READINGS_SEED, genome).moments
        return np.array([moment.readings[inputs] for moment in moments], np.float32)

    def recorded(self, said: str) -> NDArray[np.float32]:
        """What it has read in a recording, `day.rec` or `day.rec,ball.bundle`; MindError where that cannot be said."""
        graph, columns = self.subject.graph, {}
        for name in (read.partition(":")[0] for read in self.network.signature.reads):
            for change in recorded_readings(graph, name, said, self.subject.source, 1, None):
                columns[change.row] = change.values
        rows = [columns[row] for row in self.network.skill.inputs]
        return np.array(rows, np.float32).T

    def score(self, genome: Weights, old: Weights | None) -> tuple[float, Comparison | None]:
        """The mean score on fresh layouts and, where there are old weights, both beside each other.

        RunError where the new ones have no score that is a finite number.
        """
        scores = mark(self.rollout, np.stack([genome] if old is None else [genome, old]), self._layouts).scores
        if not isfinite(scores[0]):
            why = f"{self.network.skill.name} with these weights: a reward or a command was not a finite number"
            raise RunError(why, f"look at the weights, and at the rewards of the task {self.lesson.task}")
        return float(scores[0]), None if old is None else Comparison(float(scores[1]), float(scores[0]))

    def success(self, genome: Weights) -> float | None:
        """The share of runs that succeed on these layouts; None where the lesson does not need any."""
        return needed_success(self.lesson, self.rollout, genome, self._layouts)

    @property
    def _layouts(self) -> Seeds:
        last = self.lesson.generations
        return layouts(LAYOUTS_SEED, attempt=0, generation=last, count=COMPARED_LAYOUTS, purpose=Purpose.COMPARISON)


def open_trial(subject: Subject, lesson: Lesson, network: Network, shown: Path) -> Trial:
    """The trial of a network in a lesson; RunError where a skill that acts in it has not been taught."""
    name = network.skill.name
    needed = [each for each in owners(reachable(subject.graph, lesson.master)) if each != name]
    others, refusals = trained_weights(subject.graph, subject.lock, needed)
    if refusals:
        first = [each for each in reversed(needed) if each not in others]
        raise RunError(
            f"{name} cannot be tried on {lesson.task} yet: {listed(refusals, 'and')}",
            f"first: {command_line('mindc', 'train', shown, *first)}",
        )
    policy = Policy(subject.graph, others)
    rollout = rollout_for(policy, lesson.task, lesson.master, (name,), procedures=subject.folder)
    return Trial(subject, lesson, network, others, rollout)
