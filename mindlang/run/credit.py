"""The credit of a skill, or of what it learnt: what a whole mind comes to, less what it comes to without that."""

from collections.abc import Mapping
from dataclasses import replace
from math import inf

from mindrun.graph.graph import Gate, Graph, Task
from mindrun.graph.policy import Policy
from mindrun.graph.run_scores import Scores
from mindrun.graph.skill_sets import reachable

from mindlang.run.comparison import Benched
from mindlang.run.paired_difference import PairedDifference, difference

NEVER = (("number", 0.0), ("number", 0.0), ("<", 0))  # a condition that does not hold
WHOLE = ""  # the name of what is left out of the whole mind


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
