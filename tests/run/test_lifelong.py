"""The benchmark of lifelong learning: its formulas, and that agents keep what they should."""

import doctest
from pathlib import Path

import numpy as np
import pytest

from benchmarks.lifelong import metrics
from benchmarks.lifelong.agents import AGENTS, Known, importance
from benchmarks.lifelong.generated import drawn
from benchmarks.lifelong.lives import live, read
from benchmarks.lifelong.report import numbers, page
from benchmarks.lifelong.sequence import network_on
from benchmarks.lifelong.sequences import sequence
from benchmarks.lifelong.teaching import Anchored, Part, Replay
from benchmarks.lifelong.written import mind_text
from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source

TICKS, FEW_TICKS, LAYOUTS, SEEDS = 100_000.0, 1000.0, 2, np.arange(4, dtype=np.uint64)
EIGHT, CROSS = ("eight", 1), ("cross", 1)


def test_the_formulas_have_answers() -> None:
    assert doctest.testmod(metrics).failed == 0


@pytest.mark.parametrize("of", [EIGHT, CROSS])
def test_what_a_hierarchy_has_learnt_it_scores_for_ever_and_a_life_that_was_stopped_goes_on_as_it_would_have(
    tmp_path: Path, of: tuple[str, int]
) -> None:
    for folder, halts in ((tmp_path / "once", (3,)), (tmp_path / "twice", (1, 3))):
        for lessons in halts:
            live("hierarchy", 7, of, lessons, TICKS, LAYOUTS, folder)
    once, twice = (read(tmp_path / name, ["hierarchy"], [7]) for name in ("once", "twice"))
    spent = {"seconds": 0, "seconds_played": 0}
    assert [record | spent for record in once] == [record | spent for record in twice]
    assert [record["lesson"] for record in once] == [1, 2, 3]
    assert once[2]["scores"][:2] == [once[0]["scores"][0], once[1]["scores"][1]]
    assert once[0]["scores"][0] != once[1]["scores"][1]
    assert [score is None for score in once[2]["scores"][:4]] == [False, False, False, True]
    tasks = sequence(of)
    found = numbers(once, tasks, 3, {"ticks": TICKS, "layouts": LAYOUTS, "tasks": tasks.tasks})
    assert found["agents"]["hierarchy"]["unchanged"] == [2]
    assert found["agents"]["hierarchy"]["forgetting"] == [0]
    assert "2 fresh layouts" in page(Path("docs/lifelong.md").read_text(encoding="utf-8"), found)


def test_a_seed_has_its_hundred_lessons() -> None:
    lessons = drawn(5, 100)
    assert drawn(5, 100) == lessons != drawn(6, 100)
    assert drawn(5, 30) == lessons[:30]
    graph = compile_source(Source("hundred.mind", mind_text("hundred.mind", lessons))).graph
    assert graph
    assert [task.name for task in graph.tasks] == [lesson.name for lesson in lessons]
    assert len({(task.scene, task.things, task.rewards, task.varies) for task in graph.tasks}) == 100


def test_what_a_masked_network_keeps_for_a_task_acts_in_it_after_another_lesson() -> None:
    agent = AGENTS["monolith, masked"](sequence(EIGHT))
    known: Known = agent.learn({}, 0, 7, FEW_TICKS).known
    before, after = agent.player(known, 0), agent.player(agent.learn(known, 1, 8, FEW_TICKS).known, 0)
    assert before
    assert after
    assert before[1].any()
    np.testing.assert_array_equal(before[1], after[1])


def test_scorers_that_add_nothing_score_as_the_rollout_does() -> None:
    task, earlier = (network_on(sequence(EIGHT), task) for task in (3, 0))
    genomes = task.draw(3, np.random.default_rng(1))
    plain, old = task.score(genomes, SEEDS, ticks=300), earlier.score(genomes, SEEDS, ticks=300)
    some = np.arange(0, task.genome_length, 3)
    part = Part(task, genomes[0], some).score(genomes[:, some], SEEDS, ticks=300)
    np.testing.assert_array_equal(part.total[0], plain.total[0])
    free = Anchored(task, genomes[0], np.zeros(task.genome_length, np.float32), 50.0)
    np.testing.assert_array_equal(free.score(genomes, SEEDS, ticks=300).total, plain.total)
    good = sequence(EIGHT).good
    mixed = Replay(task, [earlier], [good[0], good[3]]).score(genomes, SEEDS, ticks=300)
    np.testing.assert_array_equal(mixed.total[:, ::2], plain.total[:, ::2] / good[3])
    np.testing.assert_array_equal(mixed.total[:, 1::2], old.total[:, 1::2] / good[0])
    np.testing.assert_array_equal(mixed.counts, plain.counts[:, ::2])


def test_leaving_a_weight_costs_what_it_changes_in_the_outputs() -> None:
    task = network_on(sequence(EIGHT), 0)
    genome = task.draw(1, np.random.default_rng(3))
    found = importance(sequence(EIGHT), task, genome[0], np.full(task.genome_length, 0.5, np.float32))
    assert found.min() >= 0
    assert found.max() > 0
    anchored = Anchored(task, genome[0], found, 50.0)
    moved = genome.copy()
    place = int(found.argmax())
    moved[0, place] += 2.0
    less = task.score(moved, SEEDS).total - anchored.score(moved, SEEDS).total
    np.testing.assert_allclose(less, 50.0 * 4.0 * found[place], rtol=1e-5)
