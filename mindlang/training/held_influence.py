"""Masters that were taught, and their subskills: whom they never influence, or always with the same number."""

from collections import defaultdict
from itertools import islice

import numpy as np
from mindrun.engine.engine import procedure_sources
from mindrun.errors import ProcedureError
from mindrun.graph.policy import Policy
from mindrun.graph.weights import parts
from mindrun.sim.rollouts import rollout_for
from mindrun.sim.trace import joined, trace
from mindrun.train.attempt import verdict_layouts
from mindrun.train.population import Genomes
from mindrun.train.run_folder import RunFolder
from numpy.typing import NDArray

from mindlang.compiler.diagnostic import listed
from mindlang.run.edge_flow import edge_flows
from mindlang.training.subject import Subject

LOOKED_RUNS, MOMENTS_EACH = 4, 500  # that are looked at, and in each run so many, evenly spaced
MAX_CHUNKS = 400  # of a run: 100,000 ticks, which fit into memory
ALIKE_INFLUENCE = 0.01  # so far apart may be numbers that are the same

Spans = dict[tuple[int, int], tuple[float, float]]  # the least and the most over each edge, by its skills


def held_influence(run: RunFolder, subject: Subject, genome: Genomes) -> list[str]:
    """A sentence for each master among the learners that lets a subskill never act, or never lets it go.

    None where a procedure beside it can only be run in the simulator.
    """
    skills, held = subject.graph.skills, defaultdict[str, dict[str, list[str]]](lambda: defaultdict(list))
    try:
        spans = _spans(run, subject, genome)
    except ProcedureError:
        return []
    for (master, subskill), (least, most) in spans.items():
        if most - least < ALIKE_INFLUENCE:
            does = "never influences {}" if most < ALIKE_INFLUENCE else f"always influences {{}} with {most:.2f}"
            held[skills[master].name][does].append(skills[subskill].name)
    return [
        f"{master} {listed([does.format(listed(names, 'and')) for does, names in of.items()], 'and')}, in "
        f"{LOOKED_RUNS} runs: more attempts may find one that decides; mindc prove says whether this one can"
        for master, of in held.items()
    ]


def taught_policy(run: RunFolder, subject: Subject, genome: Genomes) -> Policy:
    """The mind of a run with a genome of its learners."""
    return Policy(subject.graph, {**run.weights, **parts(subject.graph, run.manifest.learners, genome)})


def _spans(run: RunFolder, subject: Subject, genome: Genomes) -> Spans:
    """The numbers that learners send to subskills by their weights, while they have influence, in a few fresh runs."""
    lesson, learners, graph = run.manifest.lesson, run.manifest.learners, subject.graph
    learnt = {
        (index, edge.target)
        for index, skill in enumerate(graph.skills)
        for edge in skill.edges
        if skill.owner in learners and edge.to == "skill" and edge.output is not None
    }
    found: Spans = {}
    if not learnt:
        return found
    policy = taught_policy(run, subject, genome)
    rollout = rollout_for(policy, lesson.task, lesson.master, procedures=subject.folder)
    sources = procedure_sources(graph, subject.folder, lesson.master)
    for seed in verdict_layouts(run.manifest.seed, lesson.generations)[:LOOKED_RUNS].tolist():
        ticks = joined(islice(trace(rollout, seed).chunks, MAX_CHUNKS))
        flows = edge_flows(policy, sources, lesson.master, ticks)
        flow = flows.flow_at(np.unique(np.linspace(0, len(ticks) - 1, MOMENTS_EACH).astype(np.int64)))
        value = np.where(flow.carried > 0, flow.value, 0.0)
        for place, link in enumerate(flows.links):
            between = link.source, link.target[1]
            sent: NDArray[np.float64] = value[flow.behind[:, place] > 0, place]
            if link.target[0] == "skill" and between in learnt and len(sent):
                least, most = found.get(between, (np.inf, -np.inf))
                found[between] = min(least, float(sent.min())), max(most, float(sent.max()))
    return found
