"""Skills that were taught and break what they promise themselves."""

from mindrun.errors import ProcedureError
from mindrun.sim.rollouts import rollout_for
from mindrun.train.attempt import verdict_layouts
from mindrun.train.population import Genomes
from mindrun.train.run_folder import RunFolder

from mindlang.run.promises import FEW_TICKS, promises_in
from mindlang.training.held_influence import taught_policy
from mindlang.training.subject import Subject


def broken_promises(run: RunFolder, subject: Subject, genome: Genomes) -> list[str]:
    """A sentence for each promise that a learner breaks itself, in a few fresh runs of its lesson.

    None where a procedure beside it cannot be run on its own.
    """
    lesson, learners = run.manifest.lesson, run.manifest.learners
    taught = {skill.name for skill in subject.graph.skills if skill.promises and skill.owner in learners}
    if not taught:
        return []
    policy = taught_policy(run, subject, genome)
    rollout = rollout_for(policy, lesson.task, lesson.master, procedures=subject.folder)
    seeds = verdict_layouts(run.manifest.seed, lesson.generations).tolist()[: 1 if rollout.is_one_world else None]
    try:
        found = promises_in(rollout, lesson.master, seeds, FEW_TICKS)
    except ProcedureError:
        return []
    return [
        f"{each['skill']} breaks its own promise in {each['broken_runs_by_skill']} of {each['runs']} runs, "
        f"{each['promise']}: let the task pay for it, or promise less"
        for each in found
        if each["skill"] in taught and each.get("broken_runs_by_skill")
    ]
