"""GoToObject of the Collect example taught by PPO, whose actor is the skill itself: pip install 'mindlang[sb3,torch]'.

    python examples/ppo/teach.py --seed 1 --out goto.safetensors
    mindc weights import collect.mind GoToObject goto.safetensors

PPO (Schulman et al., 2017; that of Stable-Baselines3) draws each command from a normal distribution about what the
skill says before the clamp to 0..1, and the engine sends the mean. The critic is a network of its own, and is thrown
away. README.md says what comes of it.
"""

import argparse
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np
import torch
from mindrun.train.population import MAX_WEIGHT
from numpy.typing import NDArray
from stable_baselines3 import PPO
from stable_baselines3.common.policies import ActorCriticPolicy
from stable_baselines3.common.vec_env import VecEnvWrapper, VecNormalize

import mindlang
from mindlang.environments import StableBaselinesEnv, TaskVectorEnv
from mindlang.torch import Skill

FILE = Path(__file__).with_name("goto.mind")
SKILL = "GoToObject"  # and the task in which it is taught
HELD_TICKS = 15  # for which a command is held: a quarter of a second
DISCOUNT_FACTOR = 0.97  # per command
ROLLOUT_STEPS = 64  # of each robot, from one update of the weights to the next
BATCH_SIZE, EPOCH_COUNT = 2048, 6
SKILL_RATE, SPREAD_RATE, CRITIC_RATE = 0.1, 3e-3, 3e-3  # of Adam; they fall to 0 in the end
CRITIC_WIDTHS = [16, 16]
INITIAL_SPREAD = 0.4  # of commands about the mean
LAST_LAYER_SPREAD = 0.1  # of its first weights about 1 / width, with which both wheels get about a half


class HeldCommands(VecEnvWrapper):
    """Every action is held for some ticks, and paid for all of them, also those in which another episode begins."""

    def step_async(self, actions: NDArray[np.float32]) -> None:
        """Keep the actions for `step_wait`."""
        self._actions = actions

    def reset(self) -> Any:
        """The first observations."""
        return self.venv.reset()

    def step_wait(self) -> Any:
        """What is seen after the last tick, what all of them paid, and where an episode has ended."""
        paid, ended = np.zeros(self.num_envs, np.float32), np.zeros(self.num_envs, np.bool_)
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for _ in range(HELD_TICKS):
            seen, rewards, over, told = self.venv.step(self._actions)
            paid += rewards
            ended |= over
            for robot in np.flatnonzero(over):
                infos[robot] = told[robot]
        return seen, paid, ended, infos


class BeforeClamp(torch.nn.Module):
    """What a skill sends, before it is clamped to 0..1: a mean that a clamp cannot take the derivative from."""

    def __init__(self, skill: Skill) -> None:
        super().__init__()
        self.skill = skill

    def forward(self, readings: torch.Tensor) -> torch.Tensor:
        """Readings [robots, inputs] to [robots, outputs]."""
        return self.skill.before_clamp(readings)


class SkillPolicy(ActorCriticPolicy):
    """An actor that is a skill of a mind, and a critic of its own."""

    def __init__(self, *args: Any, skill: Skill, **kwargs: Any) -> None:
        self._skill = [skill]  # in a list: it becomes a part of the module in `_build`, when there is one
        layers = {"pi": [], "vf": CRITIC_WIDTHS}
        super().__init__(*args, log_std_init=float(np.log(INITIAL_SPREAD)), net_arch=layers, **kwargs)

    def _build(self, lr_schedule: Any) -> None:
        super()._build(lr_schedule)
        self.action_net = BeforeClamp(self._skill[0])
        critic = [*self.mlp_extractor.parameters(), *self.value_net.parameters()]
        parts = ((self.action_net.parameters(), SKILL_RATE), ([self.log_std], SPREAD_RATE), (critic, CRITIC_RATE))
        self.optimizer = torch.optim.Adam([{"params": [*part], "lr": rate, "first_lr": rate} for part, rate in parts])


class RatesOfTheirOwn(PPO):
    """PPO with a rate for each part of the policy; all fall to 0 as the schedule does, from 1."""

    def _update_learning_rate(self, optimizers: Any) -> None:
        for group in self.policy.optimizer.param_groups:
            group["lr"] = group["first_lr"] * max(0.0, self._current_progress_remaining)


def first_weights(skill: Skill, seed: int) -> None:
    """First weights as a lesson draws them, but for the last layer: both wheels begin about a half."""
    rng, own = np.random.default_rng(seed), skill.network
    genome = own.skill.function.draw(own.inputs, own.outputs, 1, rng)[0]
    width, outputs = own.shapes[-1]
    genome[-width * outputs :] = 1 / width + LAST_LAYER_SPREAD * rng.standard_normal(width * outputs)
    skill.take(genome)


def teach(ticks: int, seed: int, robots: int, file: Path = FILE, name: str = SKILL) -> Skill:
    """The skill, taught from random weights for so many ticks of all robots together."""
    torch.set_num_threads(1)
    skill: Skill = Skill(mindlang.load(file), name, from_scratch=True)
    first_weights(skill, seed)
    many = TaskVectorEnv(file, skill=name, num_envs=robots, autoreset_mode="SameStep")
    worlds = VecNormalize(HeldCommands(StableBaselinesEnv(many)), norm_obs=False, gamma=DISCOUNT_FACTOR)
    learner = RatesOfTheirOwn(
        SkillPolicy,
        worlds,
        policy_kwargs={"skill": skill},
        n_steps=ROLLOUT_STEPS,
        batch_size=min(BATCH_SIZE, robots * ROLLOUT_STEPS),
        n_epochs=EPOCH_COUNT,
        gamma=DISCOUNT_FACTOR,
        max_grad_norm=np.inf,
        seed=seed,
        device="cpu",
    )
    learner.learn(ticks // HELD_TICKS)
    with torch.no_grad():  # as learning here bounds them
        for weights in skill.parameters():
            weights.clamp_(-MAX_WEIGHT, MAX_WEIGHT)
    return skill


def main() -> None:
    """Teach it, and write its weights."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--ticks", type=float, default=12e6, help="of all robots together")
    parser.add_argument("--mind", type=Path, default=FILE, help="whose GoToObject; default: goto.mind, in short runs")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--robots", type=int, default=256)
    parser.add_argument("--out", type=Path, default=Path("goto.safetensors"))
    said = parser.parse_args()
    teach(int(said.ticks), said.seed, said.robots, said.mind).save(said.out)
    spent = f"{said.ticks / 1e6:g} M ticks and {process_time():.0f} s of CPU time"
    print(f"{said.out}: {SKILL} of seed {said.seed} after {spent}")


if __name__ == "__main__":
    main()
