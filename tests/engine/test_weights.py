"""Genomes: which skills a lesson teaches, where the weights of each are, and which weights fit none."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.errors import WeightsError
from mindrun.files.npy import to_npy
from mindrun.graph.graph import Graph, Lesson
from mindrun.graph.weights import below, genes, learners, parts, reachable, read_weights, weights_of
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.learners import Genetic

from tests.hierarchies import random_graph
from tests.minds import rule, skill


def influenced(graph: Graph, name: str) -> set[str]:
    """A skill and all that it can influence, asked for one by one."""
    own = next(each for each in graph.skills if each.name == name)
    return {name}.union(*(influenced(graph, graph.skills[e.target].name) for e in own.edges if e.to == "skill"))


@given(random_graph(), st.data())
@settings(max_examples=12)
def test_a_lesson_teaches_a_skill_or_all_that_learn_below_it(graph: Graph, data: st.DataObject) -> None:
    """A genome is the weights of those who learn, one after the other."""
    frozen = data.draw(st.sets(st.sampled_from(range(len(graph.skills)))))
    skills = tuple(replace(each, frozen=number in frozen) for number, each in enumerate(graph.skills))
    graph = replace(graph, skills=skills)
    for number, each in enumerate(skills):
        found = influenced(graph, each.name)
        assert reachable(graph, each.name) == below(graph, number)
        assert below(graph, number) == tuple(other for other in skills if other.name in found)
        lesson = Lesson("All", each.name, "Go", "S0", 1, False, False, Genetic())
        owners = {other.owner for other in below(graph, number) if genes(other) > 0}
        taught = [other for other in skills if other.name in owners and not other.frozen]
        assert learners(graph, replace(lesson, with_subskills=True)) == tuple(other.name for other in taught)
        assert learners(graph, lesson) == tuple(other.name for other in taught if other.name == each.owner)
    learning = [each for each in graph.skills if genes(each)]
    chosen = data.draw(st.lists(st.sampled_from(learning), unique=True, min_size=1)) if learning else []
    genome = np.arange(sum(map(genes, chosen)), dtype=np.float32)
    if chosen:
        found = parts(graph, [each.name for each in chosen], genome)
        assert list(found) == [each.name for each in chosen]
        assert [len(weights) for weights in found.values()] == list(map(genes, chosen))
        assert np.concatenate(list(found.values())).tolist() == genome.tolist()


GO = skill("Go", Mlp(1, 2), (0, 1), ("actuator", 0))
RIGHT = np.arange(6, dtype=np.float32)


def test_weights_that_fit_are_given_as_they_are() -> None:
    found = weights_of(GO, {"Go": np.arange(12, dtype=np.float32)[::2], "Other": RIGHT})
    assert (found.tolist(), found.flags.c_contiguous) == ([0, 2, 4, 6, 8, 10], True)
    none = weights_of(rule("Rule"), {"Rule": RIGHT})
    assert (none.shape, none.dtype) == ((0,), np.float32)


@pytest.mark.parametrize(
    ("weights", "said"),
    [
        ({"Other": RIGHT}, "skill Go has no weights"),
        ({"Go": RIGHT[1:]}, "skill Go needs 6 float32 weights, not 5 of float32"),
        ({"Go": RIGHT.reshape(2, 3)}, "skill Go needs 6 float32 weights, not 2×3 of float32"),
        ({"Go": RIGHT.astype(np.float64)}, "skill Go needs 6 float32 weights, not 6 of float64"),
        ({"Go": np.where(RIGHT == 3, np.float32(np.nan), RIGHT)}, "skill Go has weights that are not finite"),
        ({"Go": np.where(RIGHT == 3, np.float32(np.inf), RIGHT)}, "skill Go has weights that are not finite"),
    ],
)
def test_weights_that_do_not_fit_are_refused(weights: dict[str, np.ndarray], said: str) -> None:
    with pytest.raises(WeightsError) as caught:
        weights_of(GO, weights)
    assert str(caught.value) == said


def test_weights_are_read_or_refused() -> None:
    assert read_weights(to_npy(RIGHT)).tolist() == RIGHT.tolist()
    with pytest.raises(WeightsError, match="not whole weights"):
        read_weights(to_npy(RIGHT)[:-1])
