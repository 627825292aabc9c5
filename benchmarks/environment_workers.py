"""What processes cost where the worlds are environments: python benchmarks/environment_workers.py [--generations 5].

A generation is 40 genomes on 3 layouts, and is scored here, with the environments in this process or apart, in another
one, and by 1, 2 and 4 workers, which are warm. CPU
is that of all processes, and is the figure to trust on a machine that others use, too. The last column is what a job
takes beyond its runs: pickles, pipes, and the lanes that a smaller job leaves empty.
"""

import argparse
import os
from pathlib import Path
from time import perf_counter

import gymnasium
import numpy as np
from mindrun.graph.bundle import Bundle, pack
from mindrun.graph.policy import Policy
from mindrun.sim.outside.rollout import EnvironmentRollout
from mindrun.sim.outside.stepper import LocalStepper
from mindrun.sim.outside.subprocess_stepper import SubprocessStepper

import mindlang
from mindlang.executors.jobs import Assignment, JobScorer, Work
from mindlang.executors.processes import ProcessJobs

GENERATION_GENOMES, GENERATION_LAYOUTS, RUN_TICKS = 40, 3, 500
ENVIRONMENTS = ("CartPole-v1", "LunarLanderContinuous-v3", "BipedalWalker-v3")
TICKS_PER_SECOND = os.sysconf("SC_CLK_TCK")
LINE = "{name:<26} {where:<12} {rate:>8,.0f} ticks/s {cpu:>8,.0f} a CPU second {jobs:>4} jobs {cost:>7.2f} ms each"


class CountingJobs(ProcessJobs):
    """Processes whose jobs are counted."""

    jobs = 0

    def submit(self, number: int, work: Work) -> None:
        """Ask for a job, and count it."""
        self.jobs += 1
        super().submit(number, work)

    def cpu_seconds(self) -> float:
        """What this process and the workers have taken so far."""
        return sum(map(cpu_seconds, ["self", *(f"{each.process.pid}" for each in self.members if each.process)]))


def cpu_seconds(process: str) -> float:
    """What a process has taken so far."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / TICKS_PER_SECOND


def cpu_of_all() -> float:
    """What this process and those that it has begun have taken so far."""
    children = Path(f"/proc/self/task/{os.getpid()}/children").read_text().split()
    return sum(map(cpu_seconds, ["self", *children]))


def source(name: str) -> str:
    """A mind for an environment: one skill, which reads and drives everything."""
    made = gymnasium.make(name)
    seen, acted = made.observation_space, made.action_space
    assert isinstance(seen, gymnasium.spaces.Box)
    chosen = isinstance(acted, gymnasium.spaces.Discrete)
    count = int(acted.n) if isinstance(acted, gymnasium.spaces.Discrete) else int(np.prod(acted.shape or ()))
    sensors = [f"sensor s{i} is observation {i} range -3 to 3" for i in range(int(np.prod(seen.shape)))]
    kind = "choice {} neutral 0" if chosen else "action {} neutral 0.5"
    actuators = [f"actuator a{i} is {kind.format(i)}" for i in range(count)]
    uses = [f"  reads s{i}" for i in range(len(sensors))] + [f"  drives a{i}" for i in range(count)]
    skill = ["skill Go is mlp hidden 1", *uses]
    task = [f"task Go in gymnasium {name}", f"  lasts {RUN_TICKS} ticks", "  rewards its reward", "  ends on its end"]
    return "\n".join(["tick 1/50 s", "master Go", *sensors, *actuators, *skill, *task, ""])


def measured(name: str, generations: int) -> None:
    """Score the same generations in this process and in others."""
    graph = mindlang.loads(source(name)).graph
    here, apart = (
        EnvironmentRollout(Policy(graph, {}), "Go", "Go", ["Go"], steppers=steppers)
        for steppers in (LocalStepper, SubprocessStepper)
    )
    here.compile()
    rng = np.random.default_rng(1)
    drawn = [here.draw(GENERATION_GENOMES, rng) for _ in range(generations)]
    seeds = [[*range(GENERATION_LAYOUTS * each, GENERATION_LAYOUTS * (each + 1))] for each in range(generations)]
    alone, ticks = 0.0, 0
    for where, rollout in (("apart", apart), ("here", here)):
        rollout.score(drawn[0], seeds[0])
        began, cpu = perf_counter(), cpu_of_all()
        ticks = sum(int(rollout.score(*each).ticks.sum()) for each in zip(drawn, seeds, strict=True))
        alone = cpu_of_all() - cpu
        said = {"name": name, "rate": ticks / (perf_counter() - began), "cpu": ticks / alone}
        print(LINE.format(where=where, jobs=0, cost=0.0, **said), flush=True)
    assignment = Assignment(pack(Bundle(Policy(graph, {}), {})), "Go", "Go", ("Go",))
    for count in (1, 2, 4):
        processes = CountingJobs(count, 1, assignment)
        scorer = JobScorer(here, processes)
        for _ in range(2):
            scorer.score(drawn[0], seeds[0])
        processes.jobs, began, cpu = 0, perf_counter(), processes.cpu_seconds()
        again = sum(int(scorer.score(*each).ticks.sum()) for each in zip(drawn, seeds, strict=True))
        took = processes.cpu_seconds() - cpu
        said = {"name": name, "rate": again / (perf_counter() - began), "cpu": again / took}
        cost = 1000 * (took - alone) / processes.jobs
        print(LINE.format(where=f"{count} processes", jobs=processes.jobs, cost=cost, **said), flush=True)
        processes.close()
        assert again == ticks


def main() -> None:
    """Measure every environment that is installed."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--generations", type=int, default=5)
    options = parser.parse_args()
    for name in ENVIRONMENTS:
        try:
            gymnasium.make(name).close()
        except gymnasium.error.DependencyNotInstalled as error:
            print(f"{name}: {error}")
        else:
            measured(name, options.generations)


if __name__ == "__main__":
    main()
