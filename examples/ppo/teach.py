"""GoToObject of the Collect example taught by PPO, whose policy is the skill itself; needs stable-baselines3.

    python examples/ppo/teach.py --steps 2000000 --seed 1 --out goto.safetensors
    mindc weights import collect.mind GoToObject goto.safetensors

PPO draws each command from a normal distribution about what the skill sends; the engine sends the mean. The critic is a
network of Stable-Baselines3's own, and is thrown away.
"""

import argparse
from pathlib import Path
from typing import Any

import torch
from stable_baselines3 import PPO
from stable_baselines3.common.policies import ActorCriticPolicy
from stable_baselines3.common.vec_env import VecMonitor, VecNormalize
from torch import nn

import mindlang
from mindlang.environments import StableBaselinesEnv, TaskVectorEnv
from mindlang.torch import Skill

COLLECT = Path(__file__).parents[1] / "collect" / "collect.mind"
SKILL = "GoToObject"
INITIAL_LOG_DEVIATION = -1.0  # of the commands: exp(−1) = 0.37 about the mean, in 0..1


class SkillPolicy(ActorCriticPolicy):
    """An actor that is a skill of a mind, and a critic of two layers of 64."""

    def __init__(self, *args: Any, skill: Skill, **kwargs: Any) -> None:
        self._skill = [skill]  # not yet a module's own: nn.Module has not been set up
        super().__init__(*args, log_std_init=INITIAL_LOG_DEVIATION, net_arch={"pi": [], "vf": [64, 64]}, **kwargs)

    def _build(self, lr_schedule: Any) -> None:
        super()._build(lr_schedule)
        self.action_net = self._skill[0]
        self.optimizer = self.optimizer_class(self.parameters(), lr=lr_schedule(1), **self.optimizer_kwargs)


def teach(steps: int, seed: int, robots: int, file: Path = COLLECT) -> Skill:
    """The skill, taught from random weights for so many steps of all robots together."""
    torch.manual_seed(seed)
    torch.set_num_threads(1)
    skill: Skill = Skill(mindlang.load(file), SKILL, from_scratch=True)
    many = TaskVectorEnv(file, SKILL, skill=SKILL, num_envs=robots, autoreset_mode="SameStep")
    worlds = VecNormalize(VecMonitor(StableBaselinesEnv(many)), norm_obs=False, gamma=0.995)
    learner = PPO(
        SkillPolicy,
        worlds,
        policy_kwargs={"skill": skill},
        n_steps=256,
        batch_size=4096,
        n_epochs=4,
        gamma=0.995,
        learning_rate=1e-3,
        seed=seed,
        device="cpu",
        verbose=1,
    )
    learner.learn(steps, log_interval=5)
    assert isinstance(learner.policy.action_net, nn.Module)
    return skill


def main() -> None:
    """Teach it, and write its weights."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--steps", type=int, default=2_000_000, help="of all robots together")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--robots", type=int, default=64)
    parser.add_argument("--out", type=Path, default=Path("goto.safetensors"))
    said = parser.parse_args()
    teach(said.steps, said.seed, said.robots).save(said.out)
    print(f"{said.out}: mindc weights import {COLLECT} {SKILL} {said.out}")


if __name__ == "__main__":
    main()
