"""The choice between the lanes' own worlds and environments, by a task's scene: no other place knows."""

from collections.abc import Sequence
from pathlib import Path

from mindrun.graph.policy import Policy
from mindrun.sim.outside.rollout import EnvironmentRollout
from mindrun.sim.rollout import Rollout


def rollout_for(
    policy: Policy,
    task: str,
    master: str,
    learners: Sequence[str] = (),
    *,
    procedures: Path | None = None,
    interrupt: bool = True,
    workers: int = 1,
) -> Rollout:
    """A rollout in the lanes' own worlds, or in environments where the scene of the task is one.

    Environments are stepped in one thread, however many `workers` there may be, in a process of their own.
    """
    if not next(each for each in policy.graph.tasks if each.name == task).scene.environment:
        return Rollout(policy, task, master, learners, procedures=procedures, interrupt=interrupt, workers=workers)
    return EnvironmentRollout(policy, task, master, learners, procedures=procedures, interrupt=interrupt)
