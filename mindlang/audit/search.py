"""The second stage of an audit: the task's own learner looks for points without what is counted."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from mindrun.graph.policy import Policy
from mindrun.kinds.learners import Genetic
from mindrun.sim.rollout import Rollout
from mindrun.train.ask_and_tell import ask, tell
from mindrun.train.population import empty_population, order, worst_if_nan
from mindrun.train.scoring import breeding_generator, layouts, marks_of

from mindlang.audit.findings import Findings
from mindlang.audit.probes import Evidence, evidence, learning_probe, probe_layouts

TICKS_PER_SECOND = 5_000_000  # of an idle core: a search is as long as it says there, and the same anywhere
KEPT_GENOMES = 4  # genomes of the last generation that are tried on the layouts of the probes
ATTEMPT_NUMBER = 1


def search(
    found: Findings,
    policy: Policy,
    folder: Path,
    seed: int,
    seconds: int,
    workers: int,
    ready: Callable[[Rollout], None],
    told: Callable[[float], None],
) -> Evidence | None:
    """The best genomes for score − λ·count, on the layouts of the probes; None where nothing learns.

    λ is the largest score that anybody had for one of what is counted. A search ends with the generation in which it
    has simulated so many seconds at TICKS_PER_SECOND, so that it is the same for any machine and number of workers.
    """
    task, learning = found.task, learning_probe(policy, found.task)
    if not learning.learners:
        return None
    rollout = learning.rollout(task.name, folder, workers)
    ready(rollout)
    lesson = next((each for each in policy.graph.lessons if each.task == task.name), None)
    learner = lesson.learner if lesson else Genetic()
    population, none = empty_population(rollout.genome_length), np.empty((0, rollout.genome_length), np.float32)
    price, spent = found.price, 0
    while spent < seconds * TICKS_PER_SECOND:
        rng = breeding_generator(seed, ATTEMPT_NUMBER, population.generation)
        genomes = ask(population, learner, none, rollout.draw, rng)
        scores = rollout.score(genomes, layouts(seed, ATTEMPT_NUMBER, population.generation, learner.layouts).tolist())
        population = tell(population, learner, none, genomes, marks_of(scores).scores - price * found.counted(scores))
        spent += int(scores.ticks.sum())
        told(int(scores.ticks.sum()) / TICKS_PER_SECOND)
    best = population.genomes[order(worst_if_nan(population.scores))[:KEPT_GENOMES]]
    probe = replace(learning, name="found", group="found", genomes=best)
    seeds = probe_layouts(task, replace(probe, genomes=best[:1]), seed)
    return evidence(task, probe, rollout.score(best, seeds))
