"""Remarks on what was taught: masters that hold a subskill, and skills that break what they promise themselves."""

from collections import defaultdict
from collections.abc import Sequence
from contextlib import suppress
from itertools import islice

import numpy as np
from mindrun.engine.engine import procedure_sources
from mindrun.errors import ProcedureError
from mindrun.graph.policy import Policy
from mindrun.graph.weights import parts
from mindrun.sim.rollout import Rollout
from mindrun.sim.rollouts import rollout_for
from mindrun.sim.trace import joined, trace
from mindrun.train.attempt import verdict_layouts
from mindrun.train.population import Genomes
from mindrun.train.run_folder import RunFolder
from numpy.typing import NDArray

from mindlang.compiler.diagnostic import listed
from mindlang.run.edge_flow import edge_flows
from mindlang.run.promises import FEW_TICKS, promises_in
from mindlang.training.subject import Subject

LOOKED_RUNS, MOMENTS_EACH = 4, 500  # that are looked at, and in each run so many, evenly spaced
MAX_CHUNKS = 400  # of a run: 100,000 ticks, which fit into memory
ALIKE_INFLUENCE = 0.01  # so far apart may be numbers that are the same

Edges = set[tuple[int, int]]  # by their skills
Spans = dict[tuple[int, int], tuple[float, float]]  # the least and the most over each edge


def remarks(run: RunFolder, subject: Subject, genome: Genomes) -> list[str]:
    """A sentence for each master among the learners that lets a subskill never act, or never lets it go.

    And one for each promise that a learner breaks itself, in a few fresh runs of its lesson. None where a procedure
    beside them can only be run in the simulator.
    """
    lesson, learners, graph = run.manifest.lesson, run.manifest.learners, subject.graph
    learnt = {
        (index, edge.target)
        for index, skill in enumerate(graph.skills)
        for edge in skill.edges
        if skill.owner in learners and edge.to == "skill" and edge.output is not None
    }
    promising = {skill.name for skill in graph.skills if skill.promises and skill.owner in learners}
    if not learnt and not promising:
        return []
    policy = Policy(graph, {**run.weights, **parts(graph, learners, genome)})
    rollout = rollout_for(policy, lesson.task, lesson.master, procedures=subject.folder)
    seeds = verdict_layouts(run.manifest.seed, lesson.generations).tolist()
    found = list[str]()
    with suppress(ProcedureError):
        found += _held(_spans(rollout, subject, policy, lesson.master, seeds, learnt), subject) if learnt else []
    with suppress(ProcedureError):
        found += _broken(rollout, lesson.master, seeds, promising) if promising else []
    return found


def _held(spans: Spans, subject: Subject) -> list[str]:
    skills, held = subject.graph.skills, defaultdict[str, dict[str, list[str]]](lambda: defaultdict(list))
    for (master, subskill), (least, most) in spans.items():
        if most - least < ALIKE_INFLUENCE:
            does = "never influences {}" if most < ALIKE_INFLUENCE else f"always influences {{}} with {most:.2f}"
            held[skills[master].name][does].append(skills[subskill].name)
    return [
        f"{master} {listed([does.format(listed(names, 'and')) for does, names in of.items()], 'and')}, in "
        f"{LOOKED_RUNS} runs: more attempts may find one that decides; mindc prove says whether this one can"
        for master, of in held.items()
    ]


def _spans(
    rollout: Rollout, subject: Subject, policy: Policy, master: str, seeds: Sequence[int], learnt: Edges
) -> Spans:
    """The numbers that learners send to subskills by their weights, while they have influence, in a few fresh runs."""
    found: Spans = {}
    sources = procedure_sources(policy.graph, subject.folder, master)
    for seed in seeds[:LOOKED_RUNS]:
        ticks = joined(islice(trace(rollout, seed).chunks, MAX_CHUNKS))
        flows = edge_flows(policy, sources, master, ticks)
        flow = flows.flow_at(np.unique(np.linspace(0, len(ticks) - 1, MOMENTS_EACH).astype(np.int64)))
        value = np.where(flow.carried > 0, flow.value, 0.0)
        for place, link in enumerate(flows.links):
            between = link.source, link.target[1]
            sent: NDArray[np.float64] = value[flow.behind[:, place] > 0, place]
            if link.target[0] == "skill" and between in learnt and len(sent):
                least, most = found.get(between, (np.inf, -np.inf))
                found[between] = min(least, float(sent.min())), max(most, float(sent.max()))
    return found


def _broken(rollout: Rollout, master: str, seeds: Sequence[int], promising: set[str]) -> list[str]:
    return [
        f"{each['skill']} breaks its own promise in {each['broken_runs_by_skill']} of {each['runs']} runs, "
        f"{each['promise']}: let the task pay for it, or promise less"
        for each in promises_in(rollout, master, seeds[: 1 if rollout.is_one_world else None], FEW_TICKS)
        if each["skill"] in promising and each.get("broken_runs_by_skill")
    ]
