"""PPO teaches a skill in examples/ppo; what comes of it takes minutes, and stands in the README there."""

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mindlang
from tests.calling import Call
from tests.language.examples import COLLECT, ROOT

pytest.importorskip("torch", reason="pip install 'mindlang[torch]'")
pytest.importorskip("stable_baselines3", reason="pip install 'mindlang[sb3]'")

PPO = ROOT / "examples" / "ppo"
ROBOTS = 4


@pytest.fixture(scope="module")
def program() -> Any:
    """teach.py as a module."""
    sys.path.insert(0, str(PPO))
    try:
        import teach
    finally:
        sys.path.remove(str(PPO))
    return teach


def test_two_updates_change_all_weights_and_collect_takes_them(program: Any, mindc: Call, tmp_path: Path) -> None:
    ticks = 2 * program.ROLLOUT_STEPS * program.HELD_TICKS * ROBOTS
    skill, again, other = (program.teach(ticks, seed, ROBOTS) for seed in (1, 1, 2))
    assert again.genome().tobytes() == skill.genome().tobytes()
    assert not np.array_equal(other.genome(), skill.genome())
    begun = mindlang.torch.Skill(mindlang.load(PPO / "goto.mind"), program.SKILL, from_scratch=True)
    program.first_weights(begun, 1)
    assert (begun.genome() != skill.genome()).all()
    skill.save(tmp_path / "goto.safetensors")
    (tmp_path / "collect.mind").write_bytes(COLLECT.read_bytes())
    said = mindc("weights", "import", tmp_path / "collect.mind", program.SKILL, tmp_path / "goto.safetensors")
    assert said.code == 0, said.err
    assert "the engine differ by at most 0 in" in said.err


def test_a_command_is_held_and_paid_for(program: Any) -> None:
    held = program.HeldCommands(_robots(program))
    single = _robots(program)
    assert np.array_equal(held.reset(), single.reset())
    for _ in range(64):
        actions = np.random.default_rng(1).random((ROBOTS, 2)).astype(np.float32)
        seen, paid, ended, _ = held.step(actions)
        each = [single.step(actions) for _ in range(program.HELD_TICKS)]
        assert np.array_equal(seen, each[-1][0])
        assert np.allclose(paid, sum(rewards for _, rewards, _, _ in each), atol=1e-5)
        assert np.array_equal(ended, np.any([over for _, _, over, _ in each], axis=0)), "an episode is whole commands"
    assert ended.all()


def _robots(program: Any) -> Any:
    many = mindlang.environments.TaskVectorEnv(
        program.FILE, skill=program.SKILL, num_envs=ROBOTS, autoreset_mode="SameStep"
    )
    robots = mindlang.environments.StableBaselinesEnv(many)
    robots.seed(3)
    return robots
