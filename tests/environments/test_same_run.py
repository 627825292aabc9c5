"""An environment is the run that `mindc run` makes and films: its readings, its rewards, its images, its end."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from mindrun.errors import MindError
from mindrun.sim.trace import trace
from numpy.typing import NDArray

import mindlang
from mindlang.pictures.film_images import FilmImages
from mindlang.run.recorded_run import RecordedRun, recorded
from tests.calling import write_rules
from tests.edits.taught import MIND, teach, write_mind

pytest.importorskip("gymnasium")

from mindlang.environments import TaskEnv, TaskVectorEnv
from mindlang.environments.episodes import Episodes

SEEDS = (4, 5, 11)
TICKS = 60
SHOWN_TICKS = (1, 2, 30, TICKS)
PLAYED = (
    ("Chase is rule", "Chase is mlp hidden 2"),
    ("at 3 * ball_bearing - 0.7", ""),
    ("at 2.3 - 3 * ball_bearing", ""),
)


@pytest.fixture
def rules(tmp_path: Path) -> Path:
    """Tasks that last a second, the second of which ends with a collision."""
    path = write_rules(tmp_path)
    text = path.read_text("utf-8").replace("lasts 1200 ticks", "lasts 60 ticks").replace("lasts 600", "lasts 60")
    text = text.replace("in plain\n", "in plain\n  contains crate is box size 3 at 6 3\n")
    path.write_text(text.replace("arena size 40", "arena size 40 20").replace("grid 10", "grid 5"), "utf-8")
    return path


def run_of(agent: Episodes, seed: int, genome: NDArray[np.float32] | None = None) -> RecordedRun:
    """The run of an agent's task that the hierarchy makes of a seed."""
    learners = [agent.played] if agent.played else []
    mind, setup = mindlang.load(agent.setup.folder / "rules.mind"), agent.setup
    rollout = mind.rollout(setup.task.name, setup.master, learners=learners)
    return recorded(agent.setup, trace(rollout, seed, genome))


def filmed(run: RecordedRun, tick: int, size: tuple[int, int]) -> NDArray[np.uint8]:
    """What a film shows of the world after a tick, in that size, with what the robot reads then."""
    films = FilmImages(
        replace(run, readings=np.roll(run.readings, -1, axis=0)), {"counted": ["reach of ball"], "seed": 1}, 1.0, 0, 0.0
    )
    films.layout = SimpleNamespace(world=size)  # type: ignore[assignment]
    films._empty_world = None
    return films._world(tick)[:, :, ::-1]


@pytest.mark.parametrize(("task", "size"), [("Roam", (480, 258)), ("Chase", (480, 480))])
def test_under_the_commands_of_a_run_it_is_that_run(rules: Path, task: str, size: tuple[int, int]) -> None:
    many = TaskVectorEnv(rules, task, task, num_envs=3, autoreset_mode="SameStep", render_mode="rgb_array")
    one = TaskEnv(rules, task, task, render_mode="rgb_array")
    agent = many._episodes
    runs = [run_of(agent, seed) for seed in SEEDS]
    seen, alone = many.reset(seed=[*SEEDS])[0], one.reset(seed=SEEDS[1])[0]
    begins, outcomes, over = [len(run.commands) for run in runs], {}, False
    for tick in range(min(begins)):
        assert np.array_equal(seen, [run.readings[tick][agent.readings] for run in runs])
        assert over or np.array_equal(alone, seen[1])
        if tick in SHOWN_TICKS:
            for run, image in zip(runs, many.render() or (), strict=True):
                assert np.array_equal(image, filmed(run, tick, size))
            assert np.array_equal(one.render(), filmed(runs[1], tick, size))
        actions = np.array([run.commands[tick] for run in runs])
        seen, rewards, *_, infos = many.step(actions)
        alone, reward, *ended, told = one.step(actions[1])
        over = any(ended)
        for lane, run in enumerate(runs):
            before = run.lines[tick - 1].sum() if tick else 0.0
            assert rewards[lane] == pytest.approx(run.lines[tick].sum() - before)
            if len(run.commands) == tick + 1:
                outcomes[lane] = {name: values[lane] for name, values in infos["final_info"].items() if name[0] != "_"}
        assert reward == rewards[1]
        if over:
            assert {**told, "layout": SEEDS[1]} == {**outcomes[1]}
            break
    assert outcomes
    for lane, outcome in outcomes.items():
        lines, counts = runs[lane].lines[-1], runs[lane].counts[-1]
        assert outcome["layout"] == SEEDS[lane]
        assert outcome["score"] == pytest.approx(lines.sum())
        assert outcome["count"] == counts.sum()
        assert outcome["ended_by"] == ("time" if begins[lane] == TICKS else "collision")


def test_a_skill_that_is_played_as_it_computes_makes_the_run_of_its_weights(rules: Path) -> None:
    text = rules.read_text("utf-8")
    for old, new in PLAYED:
        text = text.replace(old, new)
    rules.write_text(text, "utf-8")
    env = TaskEnv(rules, "Roam", skill="Chase")
    agent = env._episodes
    skill = next(each for each in mindlang.load(rules).graph.skills if each.name == "Chase")
    genome = np.random.default_rng(1).normal(0, 2, skill.function.genome_length(1, 2)).astype(np.float32)
    compute, run = skill.function.ready(1, 2, genome, {}), run_of(agent, 4, genome)
    seen, _ = env.reset(seed=4)
    for tick in range(len(run.commands)):
        assert np.array_equal(seen, run.readings[tick][[*skill.inputs]])
        seen, *_ = env.step(np.clip(compute(seen), 0, 1))
        assert np.array_equal(agent.lanes.state.mind.commands[:2, 0], run.commands[tick])
    assert len(run.commands) > 20


YARD = "task Yard in arena size 40\n  contains ball is item\n  lasts 9 ticks\n  counts reach of ball\n"
READING = MIND.replace("  reads ball_bearing\n  reads eye\n", "  reads ball_bearing\n  reads eye\n  reads mood\n")
LESSONS = READING + "  teaches Avoid on Yard under Drive for 3 generations\n" + YARD


@pytest.mark.parametrize(
    ("words", "task", "master", "seen", "sent"),
    [
        ({"task": "Roam"}, "Roam", "Drive", 4, 3),
        ({"task": "Roam", "master": "Go"}, "Roam", "Go", 1, 3),
        ({"skill": "Go"}, "Roam", "Go", 1, 2),
        ({"skill": "Go", "task": "Yard"}, "Yard", "Drive", 1, 2),
        ({"skill": "Go", "task": "Roam", "master": "Drive"}, "Roam", "Drive", 1, 2),
        ({"skill": "Go", "master": "Drive"}, "Roam", "Drive", 1, 2),
        ({"skill": "Avoid"}, "Roam", "Avoid", 3, 3),
        ({"skill": "Drive", "task": "Yard"}, "Yard", "Drive", 5, 2),  # its memory, too,
    ],
)
def test_who_acts_where(tmp_path: Path, words: dict[str, str], task: str, master: str, seen: int, sent: int) -> None:
    teach(write_mind(tmp_path, LESSONS))
    env = TaskEnv(tmp_path / "drive.mind", **words)
    setup = env._episodes.setup
    assert (setup.task.name, setup.master, env._episodes.played) == (task, master, words.get("skill"))
    assert (env.observation_space.shape, env.action_space.shape) == ((seen,), (sent,))
    assert (env.observation_space.low.max(), env.observation_space.high.min()) == (0, 1)
    env.reset(seed=1)
    env.step(np.full(sent, 0.5, np.float32))


def test_where_nothing_is_counted_no_count_is_told(tmp_path: Path) -> None:
    env = TaskEnv(write_mind(tmp_path, MIND), "Roam")
    env.reset(seed=2**64 + 7)
    over = False
    while not over:
        *_, over, told = env.step(np.full(3, 0.5, np.float32))
    assert told == {"layout": 7, "score": told["score"], "ended_by": "time"}


def test_an_image_is_no_thinner_than_a_pixel(tmp_path: Path) -> None:
    thin = write_mind(tmp_path, MIND.replace("Roam in plain", "Roam in arena size 8000 3"))
    env = TaskEnv(thin, "Roam", render_mode="rgb_array")
    env.reset(seed=1)
    image = env.render()
    assert image is not None
    assert image.shape == (1, 480, 3)
    assert env.address is None, "no page shows it"


def test_who_cannot_act_is_told(tmp_path: Path) -> None:
    path = write_mind(tmp_path, LESSONS)
    teach(path, "Go")
    assert TaskEnv(path, skill="Go", master="Go")
    with pytest.raises(MindError, match="Avoid has not been taught") as raised:
        TaskEnv(path, skill="Go", master="Drive")
    assert str(raised.value.hint).endswith("drive.mind Avoid Drive")
    with pytest.raises(MindError, match=r"^Go is not below Avoid$"):
        TaskEnv(path, skill="Go", master="Avoid")
    follow = "skill Follow is like Go\n  reads charge for ball_bearing\n\n"
    both = LESSONS.replace("skill Grab", f"{follow}skill Grab").replace(
        "  influences Go\n", "  influences Go\n  influences Follow\n"
    )
    path.write_text(both)
    for skill, other in (("Go", "Follow"), ("Follow", "Go")):
        with pytest.raises(MindError, match=rf"^{skill} shares its weights with {other}$"):
            TaskEnv(path, skill=skill, task="Roam", master="Drive")
