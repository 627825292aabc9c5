"""Several robots as agents of PettingZoo: clean, reproducible, and the run of their mind, to the bit."""

import pickle
import warnings
from functools import partial
from pathlib import Path
from shutil import copytree

import numpy as np
import pytest
from mindrun.errors import MindError

import mindlang
from tests.sim.test_teams import TOGETHER

pytest.importorskip("pettingzoo")

from gymnasium.error import ResetNeeded
from pettingzoo.utils import parallel_to_aec

from mindlang.environments import ParallelTask, TaskEnv

with warnings.catch_warnings():  # of PettingZoo about itself
    warnings.simplefilter("ignore")
    from pettingzoo.test import parallel_api_test, parallel_seed_test, state_test

TEAM = """task Team in arena size 16
  contains mate is robot count 3
  contains object is item size 1 count 2
  lasts 300 ticks
  rewards 1 per tick
  rewards 30 on collision
  rewards -20 on collision with mate
  counts collision with mate
"""
TURN = """skill Turn is rule
  reads quick
  drives left_wheel at quick
  drives right_wheel at 0.8
"""
ALONE = """task Alone in arena size 16
  contains object is item size 1
  lasts 9 ticks
  rewards 1 on collision
"""
COLLECT = Path(__file__).parents[2] / "examples" / "collect"
AGENTS = ["robot_0", "robot_1", "robot_2", "robot_3"]


@pytest.fixture
def team(tmp_path: Path) -> Path:
    (path := tmp_path / "team.mind").write_text(f"mind 1\n{TOGETHER}{TURN}{TEAM}{ALONE}", encoding="utf-8")
    return path


@pytest.mark.parametrize("task", ["Team", "Alone"])
def test_pettingzoo_finds_nothing_wrong(team: Path, task: str) -> None:
    env = ParallelTask(team, task)
    parallel_api_test(env, 1000)  # a warning would be an error here, and in all of them
    parallel_seed_test(partial(ParallelTask, team, task))
    state_test(parallel_to_aec(env), env)


@pytest.mark.parametrize(
    ("old", "new", "end"),
    [
        ("", "", "time"),
        ("  counts", "  ends on collision with mate\n  counts", "collision with mate"),
        ("count 3", "\n  contains rival is robot count 2 paid 0 under Turn", "time"),
    ],
)
def test_under_the_commands_of_their_minds_it_is_the_run_of_its_layout(
    team: Path, old: str, new: str, end: str
) -> None:
    team.write_text(team.read_text("utf-8").replace(TEAM, TEAM.replace(old, new) if old else TEAM), "utf-8")
    mind, env = mindlang.load(team), ParallelTask(team, "Team")
    masters = ["Drift", "Drift", *["Turn" if "rival" in new else "Drift"] * 2]
    rollout, minds = mind.rollout("Team"), {a: mind.engine(m) for a, m in zip(AGENTS, masters, strict=True)}
    teammates = [agent for agent, master in zip(AGENTS, masters, strict=True) if master == "Drift"]
    rows, ended, paid_apart = env._episodes.readings, set(), 0
    for seed in range(8):
        scores = rollout.score(np.zeros((1, 0), np.float32), [seed])
        runs = {agent: [*mind.trace("Team", seed, robot=robot).moments] for robot, agent in enumerate(AGENTS)}
        seen, told = env.reset(seed=seed)
        assert told == {agent: {"layout": seed} for agent in AGENTS}
        total, own, ticks = 0.0, dict.fromkeys(AGENTS, 0.0), 0
        for engine in minds.values():
            engine.reset()
        while env.agents:
            assert all(np.array_equal(seen[agent], runs[agent][ticks].readings[rows]) for agent in AGENTS)
            assert np.array_equal(env.state(), np.concatenate([*seen.values()]))
            readings = {agent: np.zeros(mind.graph.width, np.float32) for agent in AGENTS}
            for agent in AGENTS:
                readings[agent][rows] = seen[agent]
            seen, paid, *over, told = env.step({agent: minds[agent].tick(readings[agent]) for agent in AGENTS})
            assert [*map(set, (seen, paid, *over, told))] == [set(AGENTS)] * 5
            total, ticks = total + sum(paid[agent] for agent in teammates) / len(teammates), ticks + 1
            own = {agent: own[agent] + paid[agent] for agent in AGENTS}
            assert [own[agent] for agent in teammates] == [runs[agent][ticks - 1].lines.sum() for agent in teammates]
        assert ticks == scores.ticks[0, 0]
        assert total == scores.total[0, 0]  # whole numbers, and a half or a quarter of their sum
        paid_apart += len({own[agent] for agent in teammates}) > 1
        assert {own[agent] for agent in AGENTS if agent not in teammates} <= {0.0}
        ends = {name: {*each.values()} for name, each in zip(("terminated", "truncated"), over, strict=True)}
        assert ends == {"terminated": {ticks < 300}, "truncated": {ticks == 300}}
        outcome = {"layout": seed, "score": scores.total[0, 0], "count": scores.counts[0, 0]}
        assert told == {agent: outcome | {"ended_by": told["robot_0"]["ended_by"]} for agent in AGENTS}
        ended.add(told["robot_0"]["ended_by"])
    assert ended == {end}
    assert paid_apart


def test_a_skill_that_all_play_as_it_was_taught_makes_the_same_run(tmp_path: Path) -> None:
    text = TEAM.replace("in arena size 16", "in Rocks").replace(
        "size 1 count 2", "size 1 count 2\n  contains drop_zone is zone"
    )
    (path := copytree(COLLECT, tmp_path / "collect") / "team.mind").write_text(
        f'mind 1\nuse "collect.mind"\nmaster Collect\n{text}', "utf-8"
    )
    mind, env = mindlang.load(path), ParallelTask(path, "Team", skill="Avoid", master="Collect")
    policy = mind.policy("Collect")
    [skill] = [each for each in policy.graph.skills if each.name == "Avoid"]
    compute = skill.function.ready(len(skill.inputs), skill.outputs, policy.weights["Avoid"], {})
    seen, told = env.reset(seed=5)
    while env.agents:
        seen, _, _, _, told = env.step({agent: compute(seen[agent]) for agent in env.agents})
    scores = mind.rollout("Team", "Collect").score(np.zeros((1, 0), np.float32), [5])
    assert {each["score"] for each in told.values()} == {scores.total[0, 0]}
    for robot, body in enumerate(env._episodes.lanes.state.world.body[:, :4].T):
        assert np.array_equal(body, [*mind.trace("Team", 5, "Collect", robot).moments][-1].body)


def test_who_cannot_act_is_told(team: Path) -> None:
    env = ParallelTask(team, "Team")
    for step in (env.step, lambda actions: (env.reset(seed=1), [env.step(actions) for _ in range(301)])):
        with pytest.raises(ResetNeeded):
            step({agent: np.full(3, 0.5, np.float32) for agent in AGENTS})
    env.reset()
    with pytest.raises(MindError, match=r"^there is no action for robot_1 or robot_3$"):
        env.step({agent: np.full(3, 0.5, np.float32) for agent in AGENTS[::2]})
    with pytest.raises(MindError, match=r"^actions have the shape"):
        env.step({agent: np.full(2, 0.5, np.float32) for agent in AGENTS})


def test_an_image_has_all_robots(team: Path) -> None:
    env = ParallelTask(team, "Team", render_mode="rgb_array")
    env.reset(seed=1)
    before = env.render()
    rests, drives = np.array([0.5, 0.5, 0.0], np.float32), np.array([0.9, 0.9, 0.0], np.float32)
    for _ in range(20):
        env.step(dict.fromkeys(AGENTS, rests) | {"robot_2": drives})
    assert before.shape == (480, 480, 3)
    assert (before != env.render()).any()


def test_layouts_are_drawn_from_the_seed(team: Path) -> None:
    def drawn(env: ParallelTask) -> list[object]:
        return [env.reset(seed=4)[1], env.reset()[1], env.reset()[1]]

    env = ParallelTask(team, "Team")
    first = drawn(env)
    assert first == drawn(env) == drawn(pickle.loads(pickle.dumps(env)))
    assert len({each["robot_0"]["layout"] for each in first}) == 3


def test_one_agent_in_a_world_of_several_robots_is_refused(team: Path) -> None:
    with pytest.raises(MindError, match=r"^Team has 4 robots, and this has one agent$") as raised:
        TaskEnv(team, "Team")
    assert raised.value.hint == "mindlang.environments.ParallelTask has an agent for each"


def test_ppo_learns_on_it(team: Path) -> None:
    supersuit, learners = pytest.importorskip("supersuit"), pytest.importorskip("stable_baselines3")
    side_by_side = supersuit.pettingzoo_env_to_vec_env_v1(ParallelTask(team, "Team"))
    env = supersuit.concat_vec_envs_v1(side_by_side, 2, base_class="stable_baselines3")
    model = learners.PPO("MlpPolicy", env, n_steps=16, batch_size=32, n_epochs=1, device="cpu")
    before = [each.detach().clone() for each in model.policy.parameters()]
    model.learn(16 * 8)
    assert any((old != new).any() for old, new in zip(before, model.policy.parameters(), strict=True))
