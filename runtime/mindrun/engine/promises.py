"""Promises of skills watched over a run, tick by tick or in parts of any size: which of them held, and who broke one.

A skill acts in a tick in which its influence is more than 0. What it `requires` is judged in every tick in which it
acts, by the readings with which it does. What it `maintains` is judged in the tick after each of these: only then is
sensed what came of it. What it `achieves` is judged in the first tick in which it acts no more; not where the run ends
before. What depends on a reading that is no number is not judged.
"""

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.graph import Graph, Promise, Skill
from mindrun.graph.skill_sets import reachable
from mindrun.numbers.arrays import Bools, Singles, columns, evaluate_rows

NOT_JUDGED, HELD, BY_SKILL, BY_INFLUENCE = range(4)  # what became of a promise in a tick: both last are broken


class PromiseWatcher:
    """Judges the `promises` of all skills below a master, each with its skill, in the rows of a run."""

    def __init__(self, graph: Graph, master: str) -> None:
        self._numbers = graph.skill_numbers
        self._skills = [skill for skill in reachable(graph, master) if skill.promises]
        self.promises: tuple[tuple[str, Promise], ...] = tuple(
            (skill.name, promise) for skill in self._skills for promise in skill.promises
        )
        self.reset()

    def reset(self) -> None:
        """Go back to before the first tick."""
        self._before = [(False, False)] * len(self._skills)  # whether each acted, and against what it requires

    @property
    def acting(self) -> Bools:
        """True for each promise [promises] whose skill acts in the last tick so far."""
        acted = (acts for skill, (acts, _) in zip(self._skills, self._before, strict=True) for _ in skill.promises)
        return np.fromiter(acted, bool)

    def feed(self, readings: Singles, influence: Singles) -> NDArray[np.int8]:
        """What became of each promise [rows, promises] in the next rows of readings and of influence [rows, skills].

        It is broken by those who influence the skill, and not by the skill, where they let it act against what it
        requires, now or since it began to act.
        """
        columns = [np.zeros((len(readings), 0), np.int8)]
        for place, skill in enumerate(self._skills):
            columns.append(self._judged(place, skill, readings, influence[:, self._numbers[skill.name]] > 0))
        return np.concatenate(columns, axis=1)

    def _judged(self, place: int, skill: Skill, readings: Singles, acts: Bools) -> NDArray[np.int8]:
        found, (acted, was_unmet) = np.zeros((len(acts), len(skill.promises)), np.int8), self._before[place]
        if not len(acts):
            return found
        was = np.concatenate([[acted], acts[:-1]])
        values = [evaluate_rows(each.when, columns(readings), len(acts)) for each in skill.promises]
        unmet = np.zeros(len(acts), bool)
        for each, value in zip(skill.promises, values, strict=True):
            unmet |= acts & (value == 0) & (each.word == "requires")
        many = was_unmet + np.cumsum(unmet)
        since_it_acts = many > np.maximum.accumulate(np.where(acts & ~was, many - unmet, 0))
        by_influence = np.concatenate([[was_unmet], since_it_acts[:-1]])
        self._before[place] = bool(acts[-1]), bool(acts[-1] and since_it_acts[-1])
        due = {"requires": acts, "maintains": was, "achieves": was & ~acts}
        for i, (each, value) in enumerate(zip(skill.promises, values, strict=True)):
            broken = np.where(by_influence | (each.word == "requires"), BY_INFLUENCE, BY_SKILL)
            judged = np.where(value > 0, HELD, np.where(value == 0, broken, NOT_JUDGED))
            found[:, i] = np.where(due[each.word], judged, NOT_JUDGED)
        return found
