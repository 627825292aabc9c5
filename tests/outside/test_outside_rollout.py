"""A rollout in an environment is what the engine and the environment do by themselves, to the bit."""

import numpy as np
import pytest

pytest.importorskip("gymnasium")

import gymnasium
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.engine.changes import Change
from mindrun.engine.engine import Engine
from mindrun.errors import MindError
from mindrun.graph.policy import Policy
from mindrun.sim.codes import BROKEN_OFF
from mindrun.sim.rollout import SLOW_SLICE_TICKS
from mindrun.sim.rollouts import rollout_for
from mindrun.sim.trace import take_over, trace

from tests.outside import minds, worlds

PARTS = "sensor place is observation point.at 0 0 range -2 to 2\nsensor late is observation late 0 range 0 to 1"
FOUR = "\n".join(f"actuator push{i} is choice {i + 1} neutral 0.5" for i in range(4))
TWO = "\n".join(f"actuator way{i}{j} is choice {i} {j} neutral 0.5" for i, n in ((0, 3), (1, 2)) for j in range(n))
MINDS = {
    "numbers": minds.text(),
    "parts": minds.text(PARTS, FOUR, worlds.name(worlds.Parts)),
    "several": minds.text(actuators=TWO, scene=worlds.name(worlds.Several)),
    "computed": minds.text(more="memory past is cell decay 0.9\nsensor faster is derivative of speed"),
    "own range": minds.text(actuators="actuator push is action 0 neutral 0.5 range -0.5 to 0.5 delay 2 ticks"),
}


def by_hand(source: str, genome: np.ndarray, seed: int) -> tuple[float, int, bool]:
    """The rewards, the length and the end of a run: the engine, and the environment stepped beside it."""
    graph = minds.graph_of(source)
    skill, task = graph.skills[0], graph.tasks[0]
    engine = Engine(Policy(graph, {skill.name: genome}))
    environment = gymnasium.make(task.scene.environment, max_episode_steps=-1).unwrapped
    observed, _ = environment.reset(seed=seed)
    waiting = [[actuator.kind.neutral] * actuator.kind.delay for actuator in graph.actuators]
    total, ended, ticks = 0.0, False, 0
    while ticks < task.ticks and not ended:
        readings = np.zeros(graph.width, np.float32)
        for sensor in graph.sensors:
            if slot := sensor.kind.slot:
                inner = observed
                for key in slot.part.split(".") if slot.part else ():
                    inner = inner[key]
                value = float(np.asarray(inner).reshape(np.shape(inner) or (1,))[slot.index])
                share = (value - slot.range.first) / (slot.range.last - slot.range.first)
                readings[sensor.start] = np.clip(share, 0, 1)
        commands = []
        for late, command in zip(waiting, engine.tick(readings), strict=True):
            late.append(command)
            commands.append(late.pop(0))
        observed, reward, ended, _, _ = environment.step(action_of(environment, graph, commands))
        total += reward
        ticks += 1
    return total, ticks, ended


def action_of(environment, graph, commands):
    """What the commands do, in the obvious way."""
    slots = [actuator.kind.slot for actuator in graph.actuators]
    space = environment.action_space
    if isinstance(space, gymnasium.spaces.Box):
        low, high = (slots[0].range.first, slots[0].range.last) if slots[0].range else (space.low[0], space.high[0])
        return np.array([np.float64(low) + np.float64(commands[0]) * (np.float64(high) - np.float64(low))], np.float32)
    best = {}
    for slot, command in zip(slots, commands, strict=True):
        if slot.index not in best or command > best[slot.index][0]:
            best[slot.index] = command, slot.chosen
    chosen = [number for _, number in best.values()]
    return np.int64(chosen[0]) if isinstance(space, gymnasium.spaces.Discrete) else np.array(chosen)


@pytest.mark.parametrize("source", MINDS.values(), ids=MINDS)
@settings(max_examples=5, deadline=None)
@given(draw=st.integers(0, 1000), seed=st.integers(0, 2**64 - 1))
def test_it_is_what_the_engine_does(source: str, draw: int, seed: int) -> None:
    rollout = minds.rollout_of(source)
    genome = minds.genomes(rollout, 1, draw)
    scores = rollout.score(genome, [seed])
    total, ticks, ended = by_hand(source, genome[0], seed % (1 << 31))
    assert (float(scores.total[0, 0]), int(scores.ticks[0, 0]), int(scores.ended_by[0, 0])) == (
        pytest.approx(total, rel=1e-12), ticks, 0 if ended else -1,
    )  # fmt: skip


@pytest.mark.parametrize("world", [worlds.Line, worlds.Worn])
def test_a_result_depends_on_its_genome_and_its_seed_alone(world: type[worlds.Line]) -> None:
    rollouts = [minds.rollout_of(minds.text(scene=worlds.name(world)), lanes) for lanes in (1, 3, 64)]
    drawn = minds.genomes(rollouts[0], 5)
    found = [rollout.score(drawn, [3, 1, 4]).total for rollout in rollouts]
    again = rollouts[1].score(drawn[::-1], [3, 1, 4]).total[::-1]  # in environments that were used before
    assert all(np.array_equal(found[0], each) for each in (*found, again))


def test_an_environment_is_looked_after_every_few_ticks() -> None:
    """So often can a run be stopped, and is it told how far it is: a step of an environment may take a second."""
    gentle = minds.text(actuators="actuator push is action 0 neutral 0.5 range -0.01 to 0.01")
    rollout, told = minds.rollout_of(gentle, lanes=1), list[float]()
    scores = rollout.score(np.zeros((1, rollout.genome_length), np.float32), [1], ran=told.append)
    assert scores.ticks[0, 0] == rollout.task.ticks == 2 * SLOW_SLICE_TICKS
    assert told[0] == 0.5


def test_the_limit_of_the_environment_is_taken_off() -> None:
    rollout = minds.rollout_of(minds.text(lines="rewards 1 per tick"))
    ticks = rollout.score(np.zeros((1, rollout.genome_length), np.float32), range(5)).ticks
    assert ticks.max() > 7


def test_what_breaks_off_is_no_end() -> None:
    rollout = minds.rollout_of(minds.text(scene=worlds.name(worlds.Impatient)))
    scores = rollout.score(minds.genomes(rollout, 2), [1, 2])
    assert (scores.ended_by == BROKEN_OFF).all()
    assert (scores.met == -1).all()
    assert (scores.ticks == 4).all()


def test_an_end_ends_even_where_nothing_interrupts() -> None:
    source = minds.text(actuators="actuator push is action 0 neutral 0.5 range 1 to 2")
    plain, going_on = (minds.rollout_of(source, interrupt=each) for each in (True, False))
    drawn = minds.genomes(plain, 3)
    ours, theirs = plain.score(drawn, [1]), going_on.score(drawn, [1])
    assert np.array_equal(ours.ticks, theirs.ticks)
    assert (ours.ended_by == 0).all()
    assert (theirs.ended_by == BROKEN_OFF).all()
    assert (theirs.met == 0).all()


def test_what_is_beyond_a_range_is_counted() -> None:
    rollout = minds.rollout_of(minds.text(sensors="sensor place is observation 0 range 5 to 6"))
    scores = rollout.score(minds.genomes(rollout, 2), [1])
    assert rollout.observed == scores.ticks.sum()
    assert rollout.clipped.tolist() == [rollout.observed]


def test_a_trace_is_the_run_that_was_scored() -> None:
    rollout = minds.rollout_of(MINDS["computed"])
    drawn = minds.genomes(rollout, 1)
    moments = list(trace(rollout, 7, drawn[0]).moments)
    scores = rollout.score(drawn, [7])
    assert len(moments) == scores.ticks[0, 0]
    assert moments[-1].lines.sum() == scores.total[0, 0]


def test_a_reading_that_is_changed_is_another_run_from_there_on() -> None:
    rollout = minds.rollout_of(MINDS["numbers"])
    drawn = minds.genomes(rollout, 1) * np.float32(0.1)  # far from where an output is cut off
    plain, other, same = (
        [moment.commands.tolist() for moment in trace(rollout, 7, drawn[0], changes).moments]
        for changes in ((), (Change("reading", 0, (1.0,), 3, 3),), (Change("memory", 0, (0.0,), 1000, 1000),))
    )
    assert plain == same
    assert plain[:2] == other[:2]
    assert plain[2:] != other[2:]


def test_another_mind_takes_over_in_the_middle() -> None:
    graph = minds.graph_of(MINDS["numbers"])
    weights = minds.genomes(minds.rollout_of(MINDS["numbers"]), 1)[0]
    ours, theirs = (rollout_for(Policy(graph, {"Go": weights}), "Go", "Go") for _ in range(2))
    plain = list(trace(ours, 7).moments)
    later = list(take_over(ours, 7, 4, theirs).moments)
    assert [moment.readings.tolist() for moment in later] == [moment.readings.tolist() for moment in plain[3:]]


@pytest.mark.parametrize(
    ("world", "said"),
    [
        (
            worlds.Raising,
            "in step 3 of the run of seed 5, and the fault is the environment's: RuntimeError: the motor is hot.",
        ),
        (worlds.Misshapen, "an observation has the shape (3,), and its space says (2,)"),
    ],
)
def test_an_environment_that_fails_is_told_from_the_mind(world: type[worlds.Line], said: str) -> None:
    rollout = minds.rollout_of(minds.text(scene=worlds.name(world)))
    with pytest.raises(MindError, match="failed") as found:
        rollout.score(minds.genomes(rollout, 1), [5])
    assert said in found.value.hint


def test_what_is_no_number_is_not_sent() -> None:
    rollout = minds.rollout_of(minds.text(scene=worlds.name(worlds.Blind)))
    scores = rollout.score(minds.genomes(rollout, 1), [5])
    assert (scores.faults > 0).all()
    said = "the environment tests/Blind-v0 itself gave what is no number: place in {0}, speed in {0} of the ticks"
    assert said.format(f"{1 - 1 / rollout.observed:.1%}") in rollout.notes


def test_a_reward_that_is_no_number_is_the_worst() -> None:
    rollout = minds.rollout_of(minds.text(scene=worlds.name(worlds.Generous)))
    scores = rollout.score(minds.genomes(rollout, 2), [5])
    assert (scores.total == -np.inf).all()
    said = "the environment tests/Generous-v0 itself gave what is no number: the reward in 100.0% of the ticks"
    assert said in rollout.notes
