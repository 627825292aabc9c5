"""Many robots side by side: the episodes that as many single environments have, to the bit, in both ways to go on."""

import pickle
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.errors import MindError

from tests.calling import write_rules

gymnasium = pytest.importorskip("gymnasium")

from gymnasium.error import ResetNeeded  # noqa: E402
from gymnasium.vector import AutoresetMode, SyncVectorEnv  # noqa: E402

from mindlang.environments import TaskEnv, TaskVectorEnv, register  # noqa: E402
from mindlang.run.setup import layouts  # noqa: E402

ROBOTS, TICKS = 4, 300  # several episodes of up to 120 ticks


@pytest.fixture
def roam(tmp_path: Path) -> Path:
    rules = write_rules(tmp_path)
    rules.write_text(rules.read_text("utf-8").replace("lasts 600 ticks", "lasts 120 ticks"), "utf-8")
    return rules


def assert_same(ours: object, theirs: object) -> None:
    """The same arrays, and dictionaries of them, in which None stands where nothing is said."""
    if isinstance(ours, dict):
        assert isinstance(theirs, dict)
        assert sorted(ours) == sorted(theirs)
        for name in ours:
            assert_same(ours[name], theirs[name])
    else:
        assert len(ours) == len(theirs)
        assert all(np.array_equal(a, b) for a, b in zip(ours, theirs, strict=True))


@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
@pytest.mark.parametrize("skill", [None, "Chase"])
def test_it_is_as_many_single_ones(roam: Path, mode: str, skill: str | None) -> None:
    if skill:
        text = roam.read_text("utf-8").replace("Chase is rule", "Chase is mlp hidden 2")
        text = text.replace("left_wheel at 3 * ball_bearing - 0.7", "left_wheel")
        roam.write_text(text.replace("right_wheel at 2.3 - 3 * ball_bearing", "right_wheel"), "utf-8")
    words = {"task": "Roam", "master": "Roam", "skill": skill}
    single = [partial(TaskEnv, roam, **words) for _ in range(ROBOTS)]
    theirs = SyncVectorEnv(single, autoreset_mode=mode)
    ours = TaskVectorEnv(roam, **words, num_envs=ROBOTS, autoreset_mode=mode)
    assert ours.metadata["autoreset_mode"] == theirs.metadata["autoreset_mode"] == AutoresetMode(mode)
    assert ours.observation_space == theirs.observation_space
    assert ours.action_space == theirs.action_space
    for mine, other in zip(ours.reset(seed=[*range(9, 9 + ROBOTS)]), theirs.reset(seed=9), strict=True):
        assert_same(mine, other)
    rng, ended = np.random.default_rng(3), np.zeros(2, int)
    for _ in range(TICKS):
        actions = (0.5 + 0.5 * rng.random((ROBOTS, ours.single_action_space.shape[0]))).astype(np.float32)
        step = ours.step(actions)
        for mine, other in zip(step, theirs.step(actions), strict=True):
            assert_same(mine, other)
        ended += step[2].sum(), step[3].sum()
    assert (ended > 0).all(), ended
    for mine, other in zip(ours.reset(), theirs.reset(), strict=True):
        assert_same(mine, other)


@settings(max_examples=10)
@given(st.lists(st.integers(0, 2**63 - 1) | st.integers(0, 5), min_size=2, max_size=3, unique=True))
def test_two_seeds_have_no_layout_in_common(seeds: list[int]) -> None:
    """Neither neighbours nor any others, now or in the episodes that follow."""
    with TemporaryDirectory() as folder:
        short = write_rules(Path(folder))
        short.write_text(short.read_text("utf-8").replace("lasts 600 ticks", "lasts 1 ticks"), "utf-8")
        env, all_begun = TaskVectorEnv(short, "Roam", num_envs=ROBOTS), []
        for seed in seeds:
            begun = [*env.reset(seed=seed)[1]["layout"].tolist()]
            assert begun == layouts(seed, ROBOTS)
            for _ in range(40):
                infos = env.step(np.full((ROBOTS, 2), 0.5, np.float32))[4]
                begun += infos["layout"][infos["_layout"]].tolist()
            all_begun += [*dict.fromkeys(begun)]
        assert len(all_begun) == len({*all_begun}) > 20 * ROBOTS * len(seeds)


def test_seeds_may_be_given_to_some(roam: Path) -> None:
    """The others go on with what they have drawn from, or draw as nobody has told them to."""
    one, many = TaskEnv(roam, "Roam"), TaskVectorEnv(roam, "Roam", num_envs=3)
    one.reset(seed=8)
    begun = [many.reset(seed=[7, 8, 9])[1]["layout"].tolist(), many.reset(seed=[1, None, 3])[1]["layout"].tolist()]
    assert begun == [[7, 8, 9], [1, one.reset()[1]["layout"], 3]]
    unknown = [TaskVectorEnv(roam, "Roam", num_envs=2).reset()[1]["layout"].tolist() for _ in range(2)]
    assert len({layout for both in unknown for layout in both}) == 4


def test_whoever_begins_anew_does_so_at_once(roam: Path) -> None:
    roam.write_text(roam.read_text("utf-8").replace("lasts 120 ticks", "lasts 2 ticks"), "utf-8")
    env, wheels = TaskVectorEnv(roam, "Roam", "Turn"), np.full((1, 2), 0.75, np.float32)
    assert (env.num_envs, env.metadata["render_fps"], env.render()) == (1, 60, None)
    env.reset(seed=[4])
    env.step(wheels)
    assert env.step(wheels)[3].tolist() == [True]
    env.reset(seed=[4], options={"anything": 1})
    _, _, _, over, infos = env.step(wheels)
    assert (over.tolist(), infos) == ([False], {})
    assert env.step(wheels)[3].tolist() == [True]
    _, rewards, *ended, infos = env.step(wheels)
    assert (rewards.tolist(), *(each.tolist() for each in ended), [*infos]) == (
        [0],
        [False],
        [False],
        ["layout", "_layout"],
    )


def test_gymnasium_makes_it(roam: Path) -> None:
    register(roam)
    env = gymnasium.make_vec("mind/Roam-v0", num_envs=3)
    assert isinstance(env, TaskVectorEnv)
    assert env.metadata["autoreset_mode"] == AutoresetMode.NEXT_STEP
    at_once = gymnasium.make_vec("mind/Roam-v0", num_envs=3, autoreset_mode="SameStep", render_mode="rgb_array")
    assert at_once.metadata["autoreset_mode"] == AutoresetMode.SAME_STEP
    at_once.reset(seed=1)
    assert [image.shape for image in at_once.render()] == [(480, 480, 3)] * 3
    copy = pickle.loads(pickle.dumps(at_once))
    assert copy.metadata["autoreset_mode"] == AutoresetMode.SAME_STEP
    assert np.array_equal(copy.reset(seed=2)[0], at_once.reset(seed=2)[0])


def test_what_cannot_be_is_said(roam: Path) -> None:
    with pytest.raises(MindError, match="begun one by one"):
        TaskVectorEnv(roam, "Roam", autoreset_mode="Disabled")
    with pytest.raises(MindError, match='cannot be rendered as "human"'):
        TaskVectorEnv(roam, "Roam", render_mode="human")
    env = TaskVectorEnv(roam, "Roam", num_envs=2)
    with pytest.raises(ResetNeeded):
        env.step(np.zeros((2, 2), np.float32))
    with pytest.raises(MindError, match="begun one by one"):
        env.reset(options={"reset_mask": np.ones(2, bool)})
    with pytest.raises(MindError, match="3 seeds for 2 robots"):
        env.reset(seed=[1, 2, 3])
    env.reset(seed=[1, 2])
    with pytest.raises(MindError, match=r"shape \(2, 3\)"):
        env.step(np.zeros((2, 3), np.float32))


def test_actions_that_are_no_numbers_are_not_sent(roam: Path) -> None:
    envs = [TaskVectorEnv(roam, "Roam", num_envs=2) for _ in range(2)]
    for env in envs:
        env.reset(seed=1)
    steps = [env.step(np.full((2, 2), action, np.float32)) for env, action in zip(envs, (np.nan, 0.5), strict=True)]
    for mine, other in zip(*steps, strict=True):
        assert_same(mine, other)
