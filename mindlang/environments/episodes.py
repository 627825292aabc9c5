"""Episodes side by side as arrays of observations, rewards and ends, from which the environments are made.

A program commands every actuator, or plays a skill of the hierarchy.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from gymnasium.spaces import Box
from mindrun.errors import MindError
from mindrun.graph.graph import Skill
from mindrun.graph.policy import Policy
from mindrun.graph.skill_sets import acting, owners
from mindrun.numbers.arrays import Bools
from mindrun.sim.commanded_lanes import CommandedLanes, commanded_lanes, ended_by
from mindrun.sim.rollout import Rollout
from mindrun.sim.state import State
from mindrun.terminal.command_line import command_line
from numpy.typing import ArrayLike, NDArray

from mindlang.api import Mind, load
from mindlang.compiler.diagnostic import listed
from mindlang.lock.status import ReadyMind, make_ready
from mindlang.pictures.canvas import Image
from mindlang.pictures.film_images import half_window, window
from mindlang.pictures.scene import draw_items, draw_names, draw_robot, draw_zones, empty_world
from mindlang.pictures.theme import NIGHT
from mindlang.run.chosen_task import master_of, task_of, unknown
from mindlang.run.recorded_run import RecordedRun
from mindlang.run.setup import RunSetup

Floats = NDArray[np.float32]
SEED_COUNT = 1 << 64  # layouts
REAL_NUMBERS = "biuf"  # kinds of arrays: truth values, whole numbers, others
MAX_DRAWN_SEED = 1 << 63  # so many that no two episodes are drawn the same
IMAGE_PIXELS = 480  # of the longer side
SHOWN_TICK = 1  # of a run that has one


@dataclass(eq=False, slots=True)
class Episodes:
    """Runs of a task side by side, with an agent for each robot: it sees the readings at these indices, its actions are
    in 0..1.

    `played` is the skill that it plays, and `row` that one's in the tables; None where it commands the actuators.
    """

    setup: RunSetup
    lanes: CommandedLanes
    readings: NDArray[np.int64]
    actions: int
    row: int | None = None
    played: str | None = None
    seeds: NDArray[np.uint64] = field(init=False)
    _paid: NDArray[np.float64] = field(init=False)

    def __post_init__(self) -> None:
        self.seeds, self._paid = np.zeros(self.lanes.count, np.uint64), np.zeros(self.lanes.lanes)

    def begin(self, runs: Bools, seeds: ArrayLike) -> None:
        """Begin the runs of these layouts in place of the marked ones; to be followed by `sense`."""
        self.seeds[runs] = seeds
        self.lanes.begin(runs, seeds)
        self._paid[np.repeat(runs, self.lanes.robots)] = 0.0

    def sense(self) -> Floats:
        """The observations of all agents [robots, readings]; to be called once in each tick."""
        self.lanes.sense()
        return self._seen(self.lanes.state, self.lanes.lanes)

    def last_seen(self, runs: Bools) -> Floats:
        """The last observations in the marked runs, before others take their places; `sense` is not disturbed."""
        return self._seen(self.lanes.sensed_aside(runs), int(runs.sum()) * self.lanes.robots)

    def step(self, actions: ArrayLike) -> tuple[NDArray[np.float64], Bools, Bools]:
        """Step all by actions [robots, actions]: the rewards [robots], the terminations and truncations [runs].

        An action that is not finite is not sent."""
        given = to_actions(actions, (self.lanes.lanes, self.actions))
        if self.row is None:
            self.lanes.command(given)
        else:
            self.lanes.play(self.row, given)
        self.lanes.act()
        paid = self.lanes.paid
        rewards, self._paid = paid - self._paid, paid
        terminated = self.lanes.terminated
        return rewards, terminated, self.lanes.timed_out & ~terminated

    def outcome(self, run: int) -> dict[str, Any]:
        """The outcome of a run that has ended: layout, score, the end that came, and a `count` where one is kept."""
        task, lanes = self.setup.task, self.lanes
        return {
            "layout": int(self.seeds[run]),
            "score": float(lanes.scores[run]),
            **({"count": int(lanes.counts[run, list(task.counts)].sum())} if task.counts else {}),
            "ended_by": ended_by(task, int(lanes.ended_by[run])),
        }

    def _seen(self, state: State, lanes: int) -> Floats:
        return np.ascontiguousarray(state.mind.readings[self.readings, :lanes].T)


def episodes_of(file: Path, task: str | None, master: str | None, skill: str | None, runs: int) -> Episodes:
    """Episodes in so many runs; MindError where the mind, the task or a skill cannot be so."""
    mind = load(file)
    if skill is not None:
        return _of_skill(mind, task, master, skill, runs)
    chosen, _ = task_of(mind.graph, task)
    leader = master_of(mind.graph, chosen, master)
    ready = ReadyMind(Policy(mind.graph, {}), (), ())  # no skill runs, so none needs its weights
    several = commanded_lanes(mind.graph, chosen.name, leader, runs)
    seen = {row for each in acting(mind.graph, chosen, leader) for row in each.inputs}
    sensed = sum(sensor.width for sensor in mind.graph.sensors)  # behind these are the memories of skills
    rows = np.array(sorted(row for row in seen if row < sensed), np.int64)
    setup = RunSetup(chosen, leader, ready, mind.path.absolute().parent)
    return Episodes(setup, several, rows, len(mind.graph.actuators))


def _of_skill(mind: Mind, task: str | None, master: str | None, skill: str, runs: int) -> Episodes:
    graph = mind.graph
    if skill not in (names := [each.name for each in graph.skills]):
        unknown("skill", skill, names)
    lesson = next((each for each in graph.lessons if each.skill == skill), None)
    chosen, _ = task_of(graph, task or (lesson.task if lesson else None))
    is_its_lesson = lesson is not None and lesson.task == chosen.name
    leader = master_of(graph, chosen, master or (lesson.master if lesson and is_its_lesson else None))
    acts = acting(graph, chosen, leader)
    played = _played(acts, leader, skill)
    ready = make_ready(graph, mind.compiled.sources, leader, chosen)
    if missing := [name for name in reversed(owners(acts)) if name not in {played.owner, *ready.policy.weights}]:
        raise MindError(ready.refusals[-1], command_line("mindc", "train", mind.path, *missing))
    folder = mind.path.absolute().parent
    rollout = Rollout(ready.policy, chosen.name, leader, [skill], procedures=folder)
    number = ready.policy.graph.skill_numbers[skill]
    row = int(np.flatnonzero(rollout.tables.skills["index"] == number)[0])
    inputs = np.array(ready.policy.graph.skills[number].inputs, np.int64)
    several = CommandedLanes(rollout, runs)
    return Episodes(RunSetup(chosen, leader, ready, folder), several, inputs, played.outputs, row, skill)


def _played(reached: Sequence[Skill], master: str, name: str) -> Skill:
    """The skill of that name among those that act; MindError where nobody can play it."""
    skill = next((each for each in reached if each.name == name), None)
    if skill is None:
        raise MindError(f"{name} is not below {master}", f"name a master that influences it: master={name!r}")
    if not skill.outputs:
        raise MindError(f"{name} has no outputs: all that it sends is said by `at`", "play another skill")
    if like := [each.name for each in reached if each.owner == skill.owner and each.name != name]:
        raise MindError(f"{name} shares its weights with {like[0]}", "a master above one of them can be played")
    return skill


def to_actions(actions: ArrayLike, shape: tuple[int, ...]) -> Floats:
    """Actions as float32 for the lanes; MindError where they are no real numbers of that shape."""
    try:
        given = np.asarray(actions)
    except ValueError as error:  # lists of several lengths
        raise MindError(f"actions are no array: {error}", f"give an array of the shape {shape}") from error
    if given.dtype.kind not in REAL_NUMBERS:
        raise MindError(f"actions are of {given.dtype}, which are no real numbers", f"give float32 {shape}")
    if given.shape != shape:
        raise MindError(f"actions have the shape {given.shape}", f"{shape} is what the action space says")
    if given.dtype != np.float32:  # what is finite stays so: it will be clamped
        given = np.where(np.isfinite(given), np.clip(given, 0.0, 1.0), given)
    return given.astype(np.float32, copy=False)


def to_layouts(seeds: list[int | None], streams: list[np.random.Generator]) -> NDArray[np.uint64]:
    """The layout of each seed, that of `mindc run --seed`; drawn from its stream where there is none."""
    drawn = (
        int(stream.integers(MAX_DRAWN_SEED)) if seed is None else seed % SEED_COUNT
        for seed, stream in zip(seeds, streams, strict=True)
    )
    return np.array([*drawn], np.uint64)


def check_render_mode(mode: str | None, metadata: Mapping[str, Any]) -> None:
    """MindError for a `render_mode` that the environment does not have."""
    if mode not in (None, *metadata["render_modes"]):
        known = listed([f'"{each}"' for each in metadata["render_modes"]])
        raise MindError(f'it cannot be rendered as "{mode}"', f"render_mode is {known}, or None")


def unit_box(length: int) -> Box:
    return Box(0.0, 1.0, (length,), np.float32)


def image_of(episodes: Episodes, lane: int) -> Image:
    """An image of the world around the robot of a lane, [height, width, 3] as red, green, blue."""
    run = as_run(episodes, lane)
    half = half_window(run)
    size = [max(1, round(IMAGE_PIXELS * side / max(half))) for side in half]
    canvas = empty_world(run, NIGHT, window(run, SHOWN_TICK, *size), *size)
    for draw in (draw_zones, draw_items, draw_robot, draw_names):
        draw(canvas, run, NIGHT, SHOWN_TICK)
    return np.ascontiguousarray(canvas.image[:, :, ::-1])


def as_run(episodes: Episodes, lane: int) -> RecordedRun:
    """The present of a lane as a run of one tick, in which nothing has moved."""
    lanes, here = episodes.lanes, slice(lane, lane + 1)
    world, mind, graph = lanes.world_columns(lane), lanes.state.mind, episodes.setup.ready.policy.graph
    return RecordedRun(
        setup=episodes.setup,
        boxes=lanes.boxes(lane),
        body=np.repeat([world["pose"]], 2, axis=0),
        things=np.repeat([world["things"][:, :-1]], 2, axis=0),
        turned=np.repeat([world["things"][:, -1]], 2, axis=0),
        held=np.repeat([world["held"]], 2),
        readings=mind.readings[: graph.width, here].T,
        influence=mind.influence[:, here].T,
        commands=mind.commands[: len(graph.actuators), here].T,
        lines=world["rewards"][None],
        touching=np.array([world["touching"]], np.bool_),
        battery=np.array([world["battery"]]),
        events=world["events"][None],
        ended=world["ended"],
    )
