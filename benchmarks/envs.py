"""Steps per second and core of environments with actions from an array: python benchmarks/envs.py [--steps N].

Each is asked for what a learner asks for: observations, rewards, both kinds of ends, next episodes begun. What a step
is of differs: ours are 1/60 s of a robot among obstacles with ten range finders, contacts by Chipmunk and the task's
rewards, also where four robots are in one world; CartPole's is one Euler step of four numbers; VMAS's a step of agents
that push each other, in torch.
Times are of the CPU, all threads together.
"""

import argparse
import os
import time
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

os.environ |= {"OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}

import gymnasium
import numpy as np
from mindrun.errors import MindError

from mindlang.environments import register

COLLECT = Path(__file__).resolve().parent.parent / "examples" / "collect" / "collect.mind"
ROBOT_COUNT = 1024
TEAM = """
task Team in Rocks
  contains mate is robot count 3
  contains object is item count 4 size 1
  contains drop_zone is zone size 10
  lasts 30000 ticks
  rewards 30 on delivery of object
  rewards -20 on collision with mate
"""
ACTION_BATCHES = 16  # of actions, drawn before anything is measured
Step = Callable[[int], object]


def rate(step: Step, steps: int, robots: int) -> float:
    """Robots times steps in a second of CPU time, after as many steps that are not measured."""
    for i in range(steps):
        step(i)
    began = time.process_time()
    for i in range(steps):
        step(i)
    return robots * steps / (time.process_time() - began)


def single(task: str, **options: str) -> Step:
    """One robot, whose episodes are begun by the caller."""
    env = gymnasium.make(f"mind/{task}-v0", **options)
    env.reset(seed=1)
    actions = np.random.default_rng(1).random((ACTION_BATCHES, *env.action_space.shape), np.float32)

    def step(i: int) -> None:
        _, _, terminated, truncated, _ = env.step(actions[i % ACTION_BATCHES])
        if terminated or truncated:
            env.reset()

    return step


def many(name: str, **options: str) -> Step:
    """1,024 of them in a vector environment, whatever its actions are."""
    env = gymnasium.make_vec(name, num_envs=ROBOT_COUNT, vectorization_mode="vector_entry_point", **options)
    env.reset(seed=1)
    env.action_space.seed(1)
    actions = [env.action_space.sample() for _ in range(ACTION_BATCHES)]
    return lambda i: env.step(actions[i % ACTION_BATCHES])


def forward(task: str) -> Step:
    """1,024 robots that drive ahead in bends: they come near obstacles, and hit them."""
    env = gymnasium.make_vec(f"mind/{task}-v0", num_envs=ROBOT_COUNT)
    env.reset(seed=1)
    rng = np.random.default_rng(1)
    actions = (0.6 + 0.4 * rng.random((ROBOT_COUNT, *env.single_action_space.shape))).astype(np.float32)
    return lambda i: env.step(actions)


def team() -> Step:
    """Four robots of Collect in one world, whose episodes are begun by the caller."""
    from mindlang.environments import ParallelTask

    with TemporaryDirectory() as folder:
        (mind := Path(folder) / "team.mind").write_text(COLLECT.read_text(encoding="utf-8") + TEAM, encoding="utf-8")
        env = ParallelTask(mind, "Team", "Collect")
    env.reset(seed=1)
    rng, agents = np.random.default_rng(1), env.agents
    drawn = rng.random((ACTION_BATCHES, len(agents), *env.action_space(agents[0]).shape), np.float32)
    actions = [dict(zip(agents, each, strict=True)) for each in drawn]

    def step(i: int) -> None:
        env.step(actions[i % ACTION_BATCHES])
        if not env.agents:
            env.reset()

    return step


def vmas() -> Step:
    """1,024 worlds of balance of VMAS, on the CPU: three agents carry a bar with a ball on it."""
    import torch
    from vmas import make_env

    torch.set_num_threads(1)
    env = make_env("balance", num_envs=ROBOT_COUNT, device="cpu", seed=1)
    env.reset()
    agents = range(env.n_agents)
    actions = [[torch.rand((ROBOT_COUNT, 2)) * 2 - 1 for _ in agents] for _ in range(ACTION_BATCHES)]
    return lambda i: env.step(actions[i % ACTION_BATCHES])


def main() -> None:
    """Measure all, and print a line for each."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=500, help="of 1,024 robots; one robot makes ten times as many")
    steps = parser.parse_args().steps
    register(COLLECT)
    alone = rate(single("Collect"), 10 * steps, 1)
    print(f"{alone:12,.0f}  Collect, one robot, gymnasium.make")
    try:
        print(f"{rate(team(), 10 * steps, 4):12,.0f}  Collect, four robots in one world, ParallelTask")
    except MindError as error:  # without PettingZoo
        print(f"{'':12}  {error}: {error.hint}")
    kinds = {
        "Collect, 1,024 robots, random commands": lambda: many("mind/Collect-v0"),
        "Collect, the same, SameStep": lambda: many("mind/Collect-v0", autoreset_mode="SameStep"),
        "Collect, 1,024 robots that drive ahead and collide": lambda: forward("Collect"),
        "Collect, a program plays the skill Avoid": lambda: many("mind/Collect-v0", master="Collect", skill="Avoid"),
        "CartPole-v1 of Gymnasium, 1,024": lambda: many("CartPole-v1"),
        "balance of VMAS, 1,024 worlds of three agents": vmas,
    }
    for name, ready in kinds.items():
        try:
            found = rate(ready(), steps, ROBOT_COUNT)
        except ModuleNotFoundError as error:
            print(f"{'':12}  {name}: {error.name} is not installed")
        else:
            print(f"{found:12,.0f}  {name} ({found / alone:,.0f} times one robot)")


if __name__ == "__main__":
    main()
