"""What skills promise is judged as it is said, in parts of any size."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.engine.promises import BY_INFLUENCE, BY_SKILL, HELD, NOT_JUDGED, PromiseWatcher
from mindrun.graph.graph import Graph, Promise
from mindrun.numbers.expression import evaluate
from numpy.typing import NDArray

from tests.draws import cases
from tests.hierarchies import random_graph

ROWS = 12


def judged_one_by_one(promises: list[Promise], readings: NDArray[np.float32], acts: list[bool]) -> list[list[int]]:
    """The definition: tick by tick, looking back to where the skill began to act."""
    found = []
    for tick, row in enumerate(readings):
        acted = tick > 0 and acts[tick - 1]
        stretch = range(next((t + 1 for t in range(tick - 1, -1, -1) if not acts[t]), 0), tick)
        required = [each for each in promises if each.word == "requires"]
        was_unmet = any(evaluate(each.when, readings[t]) == 0 for each in required for t in stretch)
        verdicts = []
        for each in promises:
            due = {"requires": acts[tick], "maintains": acted, "achieves": acted and not acts[tick]}[each.word]
            holds = evaluate(each.when, row) if due else np.nan
            broken = BY_INFLUENCE if was_unmet or each.word == "requires" else BY_SKILL
            verdicts.append(HELD if holds > 0 else broken if holds == 0 else NOT_JUDGED)
        found.append(verdicts)
    return found


@given(random_graph(), st.data())
@settings(max_examples=cases(50))
def test_promises_are_judged_as_they_are_said(graph: Graph, data: st.DataObject) -> None:
    words = ("requires", "maintains", "achieves", "requires")
    over = [(("reading", row % graph.width), ("number", 0.4), (">", 0)) for row in range(len(words))]
    promises = [Promise(word, word, when) for word, when in zip(words, over, strict=True)]
    master = replace(graph.skills[0], promises=tuple(promises))
    graph = replace(graph, skills=(master, *(replace(each, promises=()) for each in graph.skills[1:])))
    rng = np.random.default_rng(data.draw(st.integers(0, 2**32)))
    readings = rng.choice(np.array([0, 0.5, 1, np.nan], np.float32), (ROWS, graph.width), p=[0.3, 0.3, 0.3, 0.1])
    influence = rng.choice(np.array([0, 0, 0.2, 1, np.nan], np.float32), (ROWS, len(graph.skills)))
    watcher = PromiseWatcher(graph, master.name)
    assert watcher.promises == tuple((master.name, each) for each in promises)
    ends = sorted(data.draw(st.sets(st.integers(0, ROWS), max_size=4)) | {0, ROWS})
    parts = [watcher.feed(readings[a:b], influence[a:b]) for a, b in pairwise(ends)]
    acts = [bool(value > 0) for value in influence[:, 0]]
    assert np.concatenate(parts).tolist() == judged_one_by_one(promises, readings, acts)
    assert watcher.acting.tolist() == [acts[-1]] * len(promises)
