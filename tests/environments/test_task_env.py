"""One robot as a gymnasium.Env: clean, reproducible, and the episodes of mindc run, to the bit."""

import pickle
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from mindrun.errors import MindError

import mindlang

gymnasium = pytest.importorskip("gymnasium")

from gymnasium.error import ResetNeeded  # noqa: E402
from gymnasium.utils.env_checker import check_env  # noqa: E402

from mindlang.environments import TaskEnv, register  # noqa: E402

OUTSIDE = """mind 1
tick 1/50 s
master Go
sensor height is observation 0 range -1 to 1
actuator torque is action 0 neutral 0.5
skill Go is rule
  reads height
  drives torque at height
task Swing in gymnasium Pendulum-v1
  lasts 100 ticks
  rewards its reward
"""
COLLECT = Path(__file__).parents[2] / "examples" / "collect" / "collect.mind"


@pytest.fixture(scope="module", autouse=True)
def registered() -> list[str]:
    return register(COLLECT)


@pytest.mark.parametrize("options", [{}, {"skill": "Avoid", "master": "Collect"}, {"render_mode": "rgb_array"}])
def test_gymnasium_finds_nothing_wrong(options: dict[str, str]) -> None:
    env = gymnasium.make("mind/Collect-v0", **options)
    check_env(env.unwrapped)  # a warning would be an error here
    assert env.observation_space.contains(env.reset(seed=1)[0])
    assert env.metadata["render_fps"] == 60


def test_every_task_has_a_name(registered: list[str]) -> None:
    assert registered[-1] == "mind/Collect-v0"
    env = gymnasium.make("mind/GoToObject.Avoid-v0")
    assert env.unwrapped.spec.kwargs == {"file": str(COLLECT), "task": "GoToObject+Avoid"}
    assert env.action_space.shape == (3,)


def test_any_mind_has_a_name_without_being_registered() -> None:
    words = {"file": str(COLLECT), "task": "GoToObject"}
    env = gymnasium.make("mindlang.environments:Mind-v0", **words)
    assert env.reset(seed=3)[1] == {"layout": 3}
    many = gymnasium.make_vec("mindlang.environments:Mind-v0", num_envs=2, **words)
    assert many.reset(seed=3)[0].shape == (2, *env.observation_space.shape)
    with pytest.raises(TypeError, match="file"):
        gymnasium.make("Mind-v0")


def test_a_mind_may_be_registered_twice(registered: list[str]) -> None:
    assert register(COLLECT) == registered  # a warning would be an error here


def test_the_mind_that_is_registered_last_has_the_name(tmp_path: Path) -> None:
    (other := tmp_path / "other.mind").write_text(OUTSIDE.replace("Swing", "Dash"), encoding="utf-8")
    register(other)
    (last := tmp_path / "last.mind").write_text(OUTSIDE.replace("Swing", "Dash"), encoding="utf-8")
    with pytest.warns(UserWarning, match="Overriding environment"):
        assert register(last) == ["mind/Dash-v0"]
    assert gymnasium.spec("mind/Dash-v0").kwargs == {"file": str(last), "task": "Dash"}


def test_a_task_in_an_environment_of_gymnasium_is_refused(tmp_path: Path) -> None:
    (swing := tmp_path / "swing.mind").write_text(OUTSIDE, encoding="utf-8")
    assert register(swing) == ["mind/Swing-v0"]
    for asked in (partial(gymnasium.make, "mind/Swing-v0"), partial(TaskEnv, swing)):
        with pytest.raises(MindError) as raised:
            asked()
        assert str(raised.value) == "Swing is in the environment Pendulum-v1, which cannot be simulated otherwise"
        assert raised.value.hint == "mindc run, bench, train and view step it."


def test_an_engine_in_it_makes_the_run_of_its_layout() -> None:
    """Rewards, ticks, outcome: what `mind.trace` has, from observations alone."""
    mind = mindlang.load(COLLECT)
    env, engine = TaskEnv(COLLECT, "Collect"), mind.engine()
    for seed in (46, 57):  # which do not last long
        moments = list(mind.trace("Collect", seed).moments)
        seen, told = env.reset(seed=seed)
        assert told == {"layout": seed}
        engine.reset()
        total, ticks, ended = 0.0, 0, (False, False)
        while not any(ended):
            readings = np.zeros(mind.graph.width, np.float32)
            readings[: len(seen)] = seen  # Collect reads all its sensors
            assert np.array_equal(readings, moments[ticks].readings)
            seen, reward, *ended, told = env.step(engine.tick(readings))
            total, ticks = total + reward, ticks + 1
        assert ticks == len(moments)
        assert told["score"] == sum(moments[-1].lines.tolist())
        assert total == pytest.approx(told["score"])
        assert ended == [told["ended_by"] == "collision", told["ended_by"] == "time"]


def test_a_skill_that_is_played_as_it_was_taught_makes_the_same_run() -> None:
    mind = mindlang.load(COLLECT)
    env = TaskEnv(COLLECT, "Collect", "Collect", skill="Avoid")
    policy = mind.policy("Collect")
    [skill] = [each for each in policy.graph.skills if each.name == "Avoid"]
    compute = skill.function.ready(len(skill.inputs), skill.outputs, policy.weights["Avoid"], {})
    moments = list(mind.trace("Collect", 5).moments)
    seen, _ = env.reset(seed=5)
    for moment in moments:
        assert np.array_equal(seen, moment.readings[list(skill.inputs)])
        seen, _, terminated, truncated, told = env.step(compute(seen))
    assert terminated or truncated
    assert told["score"] == sum(moments[-1].lines.tolist())


def test_layouts_are_drawn_from_the_seed() -> None:
    def drawn(env: TaskEnv) -> list[object]:
        return [env.reset(seed=4)[1], env.reset()[1], env.reset()[1]]

    env = TaskEnv(COLLECT, "GoToObject")
    first = drawn(env)
    assert first == drawn(env) == drawn(pickle.loads(pickle.dumps(env)))
    assert len({each["layout"] for each in first}) == 3


def test_time_truncates_and_an_end_terminates() -> None:
    env = TaskEnv(COLLECT, "GoToObject")  # ends with its time alone
    env.reset(seed=1)
    for tick in range(10_000):
        _, _, terminated, truncated, told = env.step(np.full(3, 0.5, np.float32))
        assert (terminated, truncated) == (False, tick == 9_999)
    assert told == {"layout": 1, "score": told["score"], "count": 0, "ended_by": "time"}
    with pytest.raises(ResetNeeded):
        env.step(np.full(3, 0.5, np.float32))


def test_it_is_seen_as_an_image() -> None:
    env = TaskEnv(COLLECT, "Collect", render_mode="rgb_array")
    env.reset(seed=1)
    begin = env.render()
    for _ in range(40):
        env.step(np.array([1.0, 0.9, 0.0], np.float32))
    later = env.render()
    assert begin is not None
    assert later is not None
    assert begin.shape == (480, 480, 3)
    assert 0 < (begin != later).any(axis=2).sum() < 20_000
    assert TaskEnv(COLLECT, "Collect").render() is None


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ({"task": "Colect"}, "there is no task called Colect"),
        ({"master": "Nobody"}, "there is no skill called Nobody"),
        ({"skill": "Nobody"}, "there is no skill called Nobody"),
        ({"task": "Collect", "skill": "Grab"}, "Grab has no outputs"),
        ({"task": "Avoid", "master": "Avoid", "skill": "Collect"}, "Collect is not below Avoid"),
    ],
)
def test_what_is_not_there_is_said(words: dict[str, str], said: str) -> None:
    with pytest.raises(MindError, match=said) as raised:
        TaskEnv(COLLECT, **words)
    assert raised.value.hint


def test_actions_of_another_shape_are_refused() -> None:
    env = TaskEnv(COLLECT, "Collect")
    env.reset(seed=1)
    with pytest.raises(MindError, match=r"actions have the shape \(2,\)"):
        env.step(np.zeros(2, np.float32))
