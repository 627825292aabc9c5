"""The adapter for Stable-Baselines3: what its own makes of single environments, and PPO runs on it."""

from functools import partial
from pathlib import Path

import numpy as np
import pytest

from tests.calling import write_rules

pytest.importorskip("stable_baselines3")

from gymnasium.wrappers import RescaleAction
from stable_baselines3 import PPO
from stable_baselines3.common.env_checker import check_env
from stable_baselines3.common.vec_env import DummyVecEnv

from mindlang.environments import StableBaselinesEnv, TaskEnv, TaskVectorEnv
from mindlang.run.setup import layouts


@pytest.fixture
def roam(tmp_path: Path) -> Path:
    return write_rules(tmp_path)


def many(roam: Path, mode: str = "SameStep") -> TaskVectorEnv:
    return TaskVectorEnv(roam, "Roam", num_envs=3, autoreset_mode=mode)


def test_it_does_what_theirs_does(roam: Path) -> None:
    theirs, ours = DummyVecEnv([partial(TaskEnv, roam, "Roam")] * 3), StableBaselinesEnv(many(roam))
    assert ours.seed(4) == layouts(4, 3)
    theirs._seeds = layouts(4, 3)  # theirs would begin with 4, 5, 6
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


@pytest.mark.parametrize("skill", [None, "Chase"])
def test_theirs_finds_nothing_wrong(roam: Path, skill: str | None) -> None:
    """But for actions in 0..1 as a mind has them, where it advises -1..1: their policies begin about 0."""
    text = roam.read_text("utf-8").replace("Chase is rule", "Chase is mlp hidden 2")
    text = text.replace("left_wheel at 3 * ball_bearing - 0.7", "left_wheel")
    roam.write_text(text.replace("right_wheel at 2.3 - 3 * ball_bearing", "right_wheel"), "utf-8")
    env = TaskEnv(roam, "Roam", "Roam", skill=skill, render_mode="rgb_array")
    with pytest.warns(UserWarning, match="symmetric and normalized") as advised:
        check_env(env)
    assert len(advised) == 1
    check_env(RescaleAction(env, np.float32(-1), np.float32(1)))  # a warning would be an error here


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


@pytest.mark.parametrize("other", [None, 3, object()])
def test_it_adapts_nothing_else(other: object) -> None:
    with pytest.raises(ValueError, match="SameStep"):
        StableBaselinesEnv(other)  # type: ignore[arg-type]
