"""The adapter for Stable-Baselines3: what its own makes of single environments, and PPO runs on it."""

from functools import partial
from pathlib import Path

import numpy as np
import pytest

from tests.calling import write_rules

pytest.importorskip("stable_baselines3")

from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import DummyVecEnv

from mindlang.environments import StableBaselinesEnv, TaskEnv, TaskVectorEnv


@pytest.fixture
def roam(tmp_path: Path) -> Path:
    return write_rules(tmp_path)


def many(roam: Path, mode: str = "SameStep") -> TaskVectorEnv:
    return TaskVectorEnv(roam, "Roam", num_envs=3, autoreset_mode=mode)


def test_it_does_what_theirs_does(roam: Path) -> None:
    theirs, ours = DummyVecEnv([partial(TaskEnv, roam, "Roam")] * 3), StableBaselinesEnv(many(roam))
    for each in (theirs, ours):
        each.seed(4)
    assert np.array_equal(theirs.reset(), ours.reset())
    assert theirs.reset_infos == ours.reset_infos
    rng, ended = np.random.default_rng(1), 0
    for _ in range(1300):
        actions = (0.4 + 0.6 * rng.random((3, 2))).astype(np.float32)
        other, mine = theirs.step(actions), ours.step(actions)
        for a, b in zip(other[:3], mine[:3], strict=True):
            assert np.array_equal(a, b)
        for a, b, done in zip(other[3], mine[3], mine[2], strict=True):
            assert a["TimeLimit.truncated"] == b.get("TimeLimit.truncated", False)
            if done:
                ended += 1
                assert np.array_equal(a.pop("terminal_observation"), b.pop("terminal_observation"))
                assert a == b
        assert theirs.reset_infos == ours.reset_infos
    assert ended > 3


def test_ppo_learns_on_it(roam: Path) -> None:
    env = StableBaselinesEnv(many(roam))
    model = PPO("MlpPolicy", env, n_steps=64, batch_size=64, n_epochs=1, seed=1, device="cpu")
    model.learn(3 * 64 * 2)
    assert model.num_timesteps == 3 * 64 * 2


def test_another_way_to_go_on_is_refused(roam: Path) -> None:
    with pytest.raises(ValueError, match="SameStep"):
        StableBaselinesEnv(many(roam, "NextStep"))
    env = StableBaselinesEnv(many(roam))
    assert env.get_attr("num_envs", [0, 2]) == [3, 3]
    with pytest.raises(AttributeError, match="share one environment"):
        env.set_attr("x", 1)
