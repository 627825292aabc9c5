"""A result depends on its genome and its seed alone: not on lanes, workers, batch or order."""

from pathlib import Path

import numpy as np
import pytest
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.run_scores import Scores
from mindrun.graph.weights import genes
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from mindlang.compiler.compile import load

COLLECT = Path(__file__).parents[2] / "examples" / "collect" / "collect.mind"


@pytest.fixture(scope="module")
def collect() -> Graph:
    graph = load(COLLECT).graph
    assert graph
    return graph


def some_weights(graph: Graph, seed: int = 0) -> dict[str, np.ndarray]:
    """Random weights; the last layers lean up, so that influence reaches the wheels."""
    rng = np.random.default_rng(seed)
    weights = {}
    for skill in graph.skills:
        genome = rng.normal(0.0, 1.5, genes(skill))
        genome[-len(genome) // 4 :] += 0.3
        weights[skill.name] = genome.astype(np.float32)
    return weights


def same(a: Scores, b: Scores) -> bool:
    return all(
        np.array_equal(getattr(a, name), getattr(b, name), equal_nan=True)
        for name in ("total", "by_line", "counts", "by_event", "ticks", "ended_by", "met", "faults")
    )


def test_a_run_that_is_cut_short_is_the_beginning_of_a_whole_one(collect: Graph) -> None:
    rollout = Rollout(Policy(collect, some_weights(collect, 4)), "Collect", "Collect", lanes=3)
    scores, none = rollout.score(np.zeros((1, 0), np.float32), range(8), ticks=200), np.zeros((1, 0), np.float32)
    for seed in range(8):
        moments = [*trace(rollout, seed).moments][:200]
        assert scores.ticks[0, seed] == len(moments)
        assert scores.by_line[0, seed].tolist() == moments[-1].lines.tolist()
    assert same(rollout.score(none, range(8), ticks=10**9), rollout.score(none, range(8)))


@pytest.mark.parametrize(("task", "learner"), [("Avoid", "Avoid"), ("Collect", "Collect"), ("Collect", "Avoid")])
def test_lanes_workers_and_order_change_nothing(collect: Graph, task: str, learner: str) -> None:
    weights = some_weights(collect, 4)
    master = task
    rng = np.random.default_rng(1)

    def rollout(**options: int) -> Rollout:
        return Rollout(Policy(collect, weights), task, master, [learner], **options)

    genomes = rng.normal(0.2, 1.0, (7, rollout().genome_length)).astype(np.float32)
    seeds = [3, 4]
    first = rollout(lanes=64).score(genomes, seeds)
    assert len(np.unique(first.total)) > 3
    assert same(first, rollout(lanes=1).score(genomes, seeds))
    assert same(first, rollout(lanes=7, workers=2).score(genomes, seeds))
    order = rng.permutation(7)
    again = rollout(lanes=16, workers=2).score(genomes[order], seeds)
    assert np.array_equal(first.total[order], again.total)
    assert np.array_equal(first.by_line[order], again.by_line)


def test_a_genome_that_is_not_finite_is_refused(collect: Graph) -> None:
    rollout = Rollout(Policy(collect, {}), "GoToObject", "GoToObject", ["GoToObject"])
    genomes = np.zeros((2, rollout.genome_length), np.float32)
    genomes[1, 3] = np.nan
    with pytest.raises(ValueError, match="finite"):
        rollout.score(genomes, [1])


def test_random_genomes_are_drawn_skill_by_skill_in_the_order_in_which_they_are_named(collect: Graph) -> None:
    taught = [skill for skill in collect.skills if skill.name in ("Avoid", "GoToObject")]
    rollout = Rollout(
        Policy(collect, some_weights(collect)), "Avoid", "Avoid", [skill.name for skill in reversed(taught)]
    )
    genomes, rng = rollout.draw(5, np.random.default_rng(1)), np.random.default_rng(1)
    assert genomes.shape == (5, rollout.genome_length)
    each = [skill.function.draw(len(skill.inputs), skill.outputs, 5, rng) for skill in reversed(taught)]
    np.testing.assert_array_equal(genomes, np.concatenate(each, axis=1))
    none = Rollout(Policy(collect, some_weights(collect)), "Avoid", "Avoid")
    assert none.draw(5, rng).shape == (5, 0)
