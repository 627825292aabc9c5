"""Two minds on the same layouts: what both can be compared by, and what came of that."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from mindrun.graph.graph import Task
from mindrun.train.scoring import succeeded
from numpy.typing import NDArray

from mindlang.run.conclusion import SCORE, SUCCESS, conclusion, conclusion_of_one_world
from mindlang.run.outcome import events
from mindlang.run.paired_difference import CONFIDENCE_LEVEL, Difference, difference

if TYPE_CHECKING:
    from mindrun.graph.run_scores import Scores


@dataclass(frozen=True, slots=True)
class Benched:
    """A mind that has run: what it is called beside the other, its task, and what came of each layout."""

    name: str
    task: Task
    scores: Scores

    def figures(self) -> dict[str, NDArray[np.float64]]:
        """What each run came to [runs], by name."""
        counted = {events(self.task)[event]: self.scores.by_event[0, :, event] for event in self.task.counts}
        success = {SUCCESS: succeeded(self.task, self.scores)[0]} if self.task.can_succeed else {}
        found = {SCORE: self.scores.total[0], **success, **counted}
        return {name: np.asarray(figure, np.float64) for name, figure in found.items()}


@dataclass(frozen=True, slots=True)
class Comparison:
    """Two minds, and how much the second differs from the first in each figure by name; the first one decides."""

    first: Benched
    second: Benched
    differences: Mapping[str, Difference]
    is_one_world: bool = False

    @property
    def conclusion(self) -> str:
        """What may be said, in a sentence."""
        names = self.first.name, self.second.name
        if self.is_one_world:
            return conclusion_of_one_world(*names, self.second.task.name, self.differences)
        return conclusion(*names, self.second.task.name, self.differences)

    def data(self) -> dict[str, Any]:
        """What `mindc bench --json` says of two minds beside what it says of each."""
        plain = {name: found.data() for name, found in self.differences.items()}
        by_event = {name: plain.pop(name) for name in list(plain) if name not in (SCORE, SUCCESS)}
        differences = {**plain, "by_event": by_event}
        return {"confidence": CONFIDENCE_LEVEL, "differences": differences, "conclusion": self.conclusion}


def compare(first: Benched, second: Benched, is_one_world: bool = False) -> Comparison:
    """The differences in what both say in the same words; of the score only where it is paid for the same.

    In one world, where nothing is drawn for either, each has made its only run.
    """
    ours, theirs = first.figures(), second.figures()
    if _paid_for(first.task) != _paid_for(second.task):
        del ours[SCORE]
    both = [name for name in ours if name in theirs]
    return Comparison(first, second, {name: difference(ours[name], theirs[name]) for name in both}, is_one_world)


def differing_tasks(file: str, ours: Task, theirs: Task) -> list[str]:
    """What must be known where a task is another in a second file."""
    if ours == theirs:
        return []
    paid = _paid_for(ours) == _paid_for(theirs)
    return [
        f"task {theirs.name} is another in {file}; one seed need not give one world",
        *[f"the scores are not compared: in {file} {theirs.name} has other rewards"] * (not paid),
    ]


def _paid_for(task: Task) -> list[str]:
    return [reward.text for reward in task.rewards]
