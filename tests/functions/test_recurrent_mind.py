"""A recurrent mind with a compass, all the way: in a world that another process commands, recorded, replayed, stale."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mindrun.engine.changes import ChangedEngine
from mindrun.engine.engine import Engine
from mindrun.errors import WeightsError
from mindrun.graph.bundle import Bundle, pack, unpack
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes
from mindrun.graph.wiring import SensorWire
from mindrun.robot.loop import Loop, Rate
from mindrun.robot.recording import About, Recorder
from mindrun.robot.replay import replay
from mindrun.robot.sensing import ReadingFilter, Sampler
from mindrun.sim.commanded_lanes import CommandedWorld
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from mindlang.lock.signature import differences, signature
from tests.robot.faults import TICK, Clock, Scripted, Sent, bus_error
from tests.sim.minds import compile_text

MIND = """\
tick 1/20 s
master Top
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5 delay 1 ticks
actuator right_wheel is wheel side right neutral 0.5
sensor north is compass noise 5% lost 10% every 3 ticks delay 2 ticks
sensor turning is derivative of north
sensor pulse is sine period 1 s
skill Top is rule
  reads pulse
  influences Roam at 4 * pulse - 2
skill Roam is elman width 5
  reads north
  reads turning
  drives left_wheel
  drives right_wheel
task World in arena size 30
  lasts 200 ticks
  rewards forward per tick
"""
BUNDLE, TICKS = "ab" * 32, 120


def policy(seed: int = 1) -> Policy:
    graph = compile_text(MIND)
    return Policy(graph, {"Roam": np.random.default_rng(seed).uniform(-0.6, 1, 45).astype(np.float32)})


@pytest.mark.parametrize("seed", range(3))
def test_commanded_from_outside_it_is_the_run_of_the_rollout(seed: int) -> None:
    mind = policy()
    world, engine = CommandedWorld(mind.graph, "World", seed), Engine(mind)
    for moment in trace(Rollout(mind, "World", "Top"), seed).moments:
        assert np.array_equal(world.readings()[[0, 2]], moment.readings[[0, 2]])
        commands = engine.tick(world.readings())
        assert np.array_equal(engine.influence, moment.influence)
        world.step(commands)
        assert world.pose == tuple(moment.body[:3])
    assert world.ended == "time"


def test_two_of_them_remember_apart() -> None:
    also = "skill Also is elman width 3\n  reads pulse\n  drives left_wheel\nskill Roam"
    text = MIND.replace("skill Roam", also).replace(
        "  reads pulse\n  inf", "  reads pulse\n  influences Also at 1/2\n  inf"
    )
    rng, graph = np.random.default_rng(3), compile_text(text)
    weights = {s.name: rng.uniform(-0.6, 1, genes(s)).astype(np.float32) for s in graph.skills if genes(s)}
    mind = Policy(graph, weights)
    engine = Engine(mind)
    late = [np.float32(0.5)]  # the left wheel obeys a tick later
    for moment in trace(Rollout(mind, "World", "Top"), 1).moments:
        left, right = engine.tick(moment.readings)
        assert (late.pop(), right) == tuple(moment.commands)
        late.append(left)
    assert set(weights) == {"Also", "Roam"}


def recorded(path: Path, mind: Policy, runs: int) -> list[np.ndarray]:
    """What was sent in so many drives one after the other, recorded in one file; the compass fails now and then."""
    sent, rng = Sent(), np.random.default_rng(1)
    with Recorder(path, About.of(mind.graph, BUNDLE, "Top", ("north",))) as recorder:
        for _ in range(runs):
            script = [bus_error if n % 30 == 29 else [float(rng.random())] for n in range(TICKS)]
            clock = Clock()
            sampler = Sampler(SensorWire("north", Scripted(1, script), 0.0, 1.0, max_age=2 * TICK), clock)
            pace = Rate(TICK, clock, clock.sleep)
            loop = Loop(ChangedEngine(mind), ReadingFilter(mind.graph, [sampler]), sent, pace, True, recorder)
            pace.begin()
            device = None
            for _ in range(TICKS):
                device, sampler.latest = sampler._measured(device)
                loop.tick()
    return sent.commands


def test_what_it_remembered_on_a_robot_is_computed_again(tmp_path: Path) -> None:
    """From a bundle; where a recording begins anew, so does what it remembers."""
    mind = policy()
    commands = recorded(tmp_path / "day.rec", mind, runs=2)
    back = unpack(pack(Bundle(mind, {})))
    found = replay(tmp_path / "day.rec", BUNDLE, ChangedEngine(back.policy))
    assert (found.ticks, found.differs) == (2 * TICKS, None)
    assert len(np.unique(np.array(commands), axis=0)) > TICKS / 4


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("elman width 5", "elman width 6", ("width was 5, now 6",)),
        ("elman width 5", "elman", ("width was 5, now 4",)),
        ("elman width 5", "mlp hidden 1 width 5", ("was elman, now mlp",)),
        ("  reads turning\n", "  reads turning\n  reads pulse\n", ("reads pulse is new",)),
        ("  reads turning\n", "", ("reads turning is gone",)),
    ],
)
def test_what_makes_its_weights_stale_is_a_sentence(old: str, new: str, said: tuple[str, ...]) -> None:
    before, after = (_roam(compile_text(text)) for text in (MIND, MIND.replace(old, new)))
    assert differences(before[0], after[0], after[1]) == said


def _roam(graph: Graph) -> tuple[object, tuple[str, ...]]:
    skill = next(skill for skill in graph.skills if skill.name == "Roam")
    return signature(graph, skill), skill.function.derived


def test_a_width_that_follows_is_told_by_what_it_follows_from() -> None:
    text = MIND.replace("elman width 5", "elman")
    before, after = (
        _roam(compile_text(each)) for each in (text, text.replace("turning\n  dr", "turning\n  reads pulse\n  dr"))
    )
    assert before[0] != after[0]
    assert differences(before[0], after[0], after[1]) == ("reads pulse is new",)


def test_weights_of_another_width_are_refused() -> None:
    mind = policy()
    skills = tuple(
        replace(s, function=replace(s.function, width=6)) if s.name == "Roam" else s for s in mind.graph.skills
    )
    with pytest.raises(WeightsError, match="skill Roam needs 60 float32 weights, not 45"):
        Policy(replace(mind.graph, skills=skills), dict(mind.weights))
