"""Many robots as the `VecEnv` of Stable-Baselines3."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode
from stable_baselines3.common.vec_env import VecEnv

from mindlang.environments.task_env import TaskVectorEnv
from mindlang.run.setup import layouts

Indices = None | int | Iterable[int]


class StableBaselinesEnv(VecEnv):
    """Adapts a `TaskVectorEnv` with `autoreset_mode="SameStep"`, the only way that Stable-Baselines3 knows."""

    def __init__(self, env: TaskVectorEnv) -> None:
        if getattr(env, "metadata", {}).get("autoreset_mode") != AutoresetMode.SAME_STEP:
            raise ValueError(
                'Stable-Baselines3 begins episodes at once: a TaskVectorEnv with autoreset_mode="SameStep"'
            )
        self.env = env
        super().__init__(env.num_envs, env.single_observation_space, env.single_action_space)

    def seed(self, seed: int | None = None) -> Sequence[int | None]:
        """Let the next `reset` begin with a seed: the layout of each robot, as `TaskVectorEnv.reset` has it of one."""
        self._seeds = [*layouts(super().seed(seed)[0], self.num_envs)]  # theirs are seed + i
        return self._seeds

    def reset(self) -> Any:
        given = self._seeds if any(seed is not None for seed in self._seeds) else None
        seen, infos = self.env.reset(seed=given)
        self.reset_infos = [{"layout": int(layout)} for layout in infos["layout"]]
        self._reset_seeds()
        return seen

    def step_async(self, actions: Any) -> None:
        self._actions = actions

    def step_wait(self) -> Any:
        """Observations, rewards, ends and infos; an end's has `terminal_observation` and `TimeLimit.truncated`."""
        seen, rewards, terminated, truncated, told = self.env.step(self._actions)
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for i in np.flatnonzero(terminated | truncated).tolist():
            outcome = {name: values[i] for name, values in told["final_info"].items() if not name.startswith("_")}
            infos[i] = outcome | {
                "terminal_observation": told["final_obs"][i],
                "TimeLimit.truncated": bool(truncated[i]),
            }
            self.reset_infos[i] = {"layout": int(told["layout"][i])}
        return seen, rewards.astype(np.float32), terminated | truncated, infos

    def close(self) -> None:
        self.env.close()

    def get_images(self) -> Sequence[Any]:
        return self.env.render() or [None] * self.num_envs

    def get_attr(self, attr_name: str, indices: Indices = None) -> list[Any]:
        """An attribute of the environment, which is one for all."""
        return [getattr(self.env, attr_name)] * len([*self._get_indices(indices)])

    def set_attr(self, attr_name: str, value: Any, indices: Indices = None) -> None:
        """AttributeError: the robots share one environment."""
        raise AttributeError(f"{attr_name} cannot be set for some robots: they share one environment")

    def env_method(self, method_name: str, *args: Any, indices: Indices = None, **kwargs: Any) -> list[Any]:
        """AttributeError: no robot has an environment of its own."""
        raise AttributeError(f"{method_name} cannot be called for some robots: they share one environment")

    def env_is_wrapped(self, wrapper_class: type, indices: Indices = None) -> list[bool]:
        return [False for _ in self._get_indices(indices)]
