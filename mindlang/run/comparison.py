"""Two minds, or a mind without each of its skills, on the same layouts: how much they differ, in a sentence, too."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from math import ceil, floor, inf, log10
from typing import Any

import numpy as np
from mindrun.graph.graph import Gate, Graph, Task
from mindrun.graph.policy import Policy
from mindrun.graph.run_scores import Scores
from mindrun.graph.skill_sets import reachable
from mindrun.train.scoring import succeeded
from numpy.typing import NDArray

from mindlang.number_format import score
from mindlang.run.outcome import events
from mindlang.run.paired_difference import CONFIDENCE_LEVEL, PairedDifference, difference

SCORE, SUCCESS = "score", "success"  # the figures that are no events
PERCENT = f"{CONFIDENCE_LEVEL:.0%}".replace("%", " %")
MIN_DIGITS = 2  # behind the point
NEVER = (("number", 0.0), ("number", 0.0), ("<", 0))  # a condition that does not hold
WHOLE = ""  # the name of what is left out of the whole mind


@dataclass(frozen=True, slots=True)
class Benched:
    """A mind that was benched: its name beside the other, its task, and the scores of one genome on each layout."""

    name: str
    task: Task
    scores: Scores

    def figures(self) -> dict[str, NDArray[np.float64]]:
        """By name, of each run [runs]."""
        counted = {events(self.task)[event]: self.scores.by_event[0, :, event] for event in self.task.counts}
        success = {SUCCESS: succeeded(self.task, self.scores)[0]} if self.task.can_succeed else {}
        found = {SCORE: self.scores.total[0], **success, **counted}
        return {name: np.asarray(figure, np.float64) for name, figure in found.items()}


@dataclass(frozen=True, slots=True)
class MindComparison:
    """Two minds, and how much the second differs from the first in each figure by name; the first figure decides."""

    first: Benched
    second: Benched
    differences: Mapping[str, PairedDifference]
    is_one_world: bool = False

    @property
    def conclusion(self) -> str:
        said = one_world_conclusion if self.is_one_world else conclusion
        return said(self.first.name, self.second.name, self.second.task.name, self.differences)

    def data(self) -> dict[str, Any]:
        """The part of `mindc bench --json` that is about both minds."""
        plain = {name: asdict(found) for name, found in self.differences.items()}
        by_event = {name: plain.pop(name) for name in list(plain) if name not in (SCORE, SUCCESS)}
        differences = {**plain, "by_event": by_event}
        return {"confidence": CONFIDENCE_LEVEL, "differences": differences, "conclusion": self.conclusion}


def compare_minds(first: Benched, second: Benched, is_one_world: bool = False) -> MindComparison:
    """The differences in the figures that both name in the same words; in the score only where it is paid for the same.

    In one world, where nothing is drawn for either, each has made its only run.
    """
    ours, theirs = first.figures(), second.figures()
    if _paid_for(first.task) != _paid_for(second.task):
        del ours[SCORE]
    both = [name for name in ours if name in theirs]
    return MindComparison(first, second, {name: difference(ours[name], theirs[name]) for name in both}, is_one_world)


def differing_tasks(file: str, ours: Task, theirs: Task) -> list[str]:
    """Notes where a task is another in a second file."""
    if ours == theirs:
        return []
    notes = [f"task {theirs.name} is another in {file}; one seed need not give one world"]
    if _paid_for(ours) != _paid_for(theirs):
        notes.append(f"the scores are not compared: in {file} {theirs.name} has other rewards")
    return notes


def _paid_for(task: Task) -> list[str]:
    return [reward.text for reward in task.rewards]


def conclusion(first: str, second: str, task: str, differences: Mapping[str, PairedDifference]) -> str:
    """A sentence that says which of two minds does better on a task, by the first of the figures."""
    if not differences:
        return "There is no figure that both have: they are paid for other rewards, and count other events."
    name, found = next(iter(differences.items()))
    runs = "1 run" if found.runs == 1 else f"{found.runs:,} runs"
    if found.not_finite:
        faulty = "1 run" if found.not_finite == 1 else f"{found.not_finite:,} runs"
        return f"In {faulty} the {name} is not a finite number, so that nothing can be said."
    if not found.differing:
        return (
            f"{first} and {second} come to the same {name} in {runs}: they differ on at most "
            f"{100 * found.most_that_differ:.2g} % of the layouts of {task} ({PERCENT} confidence)."
        )
    if found.low is None or found.high is None:
        return f"A single run says nothing of other layouts of {task}."
    verb, of_what = _words(name)
    unseen = f"but for what happens on less than 1 layout in {ceil(1 / found.most_that_differ)}"
    if not found.leaves_zero_out:
        low, high = amount(name, -found.low, found), amount(name, found.high, found)
        return (
            f"{runs} do not tell {second} from {first}: on layouts of {task}, {second} {verb} from {low} less "
            f"to {high} more{of_what} on average ({PERCENT} confidence), {unseen}."
        )
    better, worse, bounds = (second, first, (found.low, found.high))
    if found.high < 0:
        better, worse, bounds = first, second, (-found.high, -found.low)
    mean, least, most = (amount(name, value, found) for value in (abs(found.mean or 0.0), *bounds))
    return (
        f"On layouts of {task}, {better} {verb} {mean} more{of_what} than {worse} on average, and with {PERCENT} "
        f"confidence {least} to {most} more, {unseen}."
    )


def one_world_conclusion(first: str, second: str, task: str, differences: Mapping[str, PairedDifference]) -> str:
    """A sentence that says which of two minds does better where nothing is drawn: each has one run."""
    name, found = next(iter(differences.items()), ("", None))
    if found is None:
        return conclusion(first, second, task, differences)
    if found.mean is None:
        return f"The {name} is not a finite number, so that nothing can be said."
    if not found.differing:
        return f"{first} and {second} come to the same {name} in the one world of {task}."
    better, worse = (second, first) if found.mean > 0 else (first, second)
    verb, of_what = _words(name)
    more = amount(name, abs(found.mean), found)
    return f"In the one world of {task}, {better} {verb} {more} more{of_what} than {worse}."


def amount(name: str, value: float, found: PairedDifference) -> str:
    """A difference, or one of its bounds, with as many digits as its standard error has a use for."""
    if name == SUCCESS:
        return f"{100 * value:.1f} percentage points"
    error = found.standard_error
    return score(value, max(MIN_DIGITS, 1 - floor(log10(error))) if error else MIN_DIGITS)


def _words(name: str) -> tuple[str, str]:
    """The verb for a figure, and the words behind `more` or `less`."""
    return {SCORE: ("scores", ""), SUCCESS: ("succeeds", " often")}.get(name, ("counts", f" ({name})"))


def silenced(policy: Policy, master: str) -> dict[str, Policy]:
    """The mind with each skill under a master silent in turn."""
    graph = policy.graph
    return {each.name: replace(policy, graph=without(graph, each.name)) for each in reachable(graph, master)}


def given_back(policy: Policy, earlier: Policy, master: str) -> dict[str, Policy]:
    """The mind with the weights that each skill under a master has in another mind, in turn.

    Left out is a skill that has the same weights there, none, or weights of something else.
    """
    names = [each.name for each in reachable(policy.graph, master) if policy.agrees(earlier, each.name)]
    minds = {name: replace(policy, weights={**policy.weights, name: earlier.weights[name]}) for name in names}
    return {name: mind for name, mind in minds.items() if (mind.weights[name] != policy.weights[name]).any()}


def without(graph: Graph, name: str) -> Graph:
    """The hierarchy in which a skill is silent: it commands nothing, influences nobody, and no memory hears it."""
    place, skills = graph.skill_numbers[name], [*graph.skills]
    silent = (replace(edge, gate=Gate(NEVER)) for edge in skills[place].edges)
    skills[place] = replace(skills[place], edges=tuple(silent))
    return replace(graph, skills=tuple(skills))


def credit_of(task: Task, scores: Mapping[str, Scores], figure: str) -> dict[str, PairedDifference]:
    """The credit of each skill in a figure, the greatest first, from the scores without it and of the whole mind."""
    figures = {name: Benched(name, task, each).figures()[figure] for name, each in scores.items()}
    whole = figures.pop(WHOLE)
    found = {name: difference(each, whole) for name, each in figures.items()}
    return dict(sorted(found.items(), key=lambda item: inf if item[1].mean is None else -item[1].mean))
