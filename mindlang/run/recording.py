"""Recordings and runs: a simulated run as a recording, a recording as such a run, and the mind that was running."""

from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.engine.engine import Engine, procedure_sources
from mindrun.graph.bundle import Bundle, digest, pack, read_bundle
from mindrun.graph.graph import Task
from mindrun.graph.measured import measured_in_world, measured_on_robot, rows_of
from mindrun.graph.named_readings import physical
from mindrun.graph.recording_header import GOES_ON, POSE_COLUMNS, THING_COLUMNS, About, RecordedWorld, RecordingError
from mindrun.graph.skill_sets import reachable
from mindrun.graph.tasks import robots_in
from mindrun.graph.wiring import read_by
from mindrun.robot.recording import recording_bytes
from mindrun.sim.codes import AWAY
from mindrun.sim.trace import Ticks
from mindrun.terminal.command_line import command_line
from numpy.typing import NDArray

from mindlang.compiler.compile import load
from mindlang.lock.status import ReadyMind, make_ready
from mindlang.run.recorded_run import Floats, RecordedRun
from mindlang.run.setup import RunSetup, with_zero_weights

NO_BOX = AWAY, AWAY, 0.0, 0.0  # in the place of an obstacle that is nowhere
SOURCE_SUFFIX = ".mind"
Rows = NDArray[Any]


def running_bundle(path: Path, of: About) -> Bundle:
    """The bundle at `path`, or of the source there; MindError where there is none, or not that of the recording."""
    is_source = path.suffix == SOURCE_SUFFIX
    found, sha = _built(path, of) if is_source else (read_bundle(path), digest(path))
    if is_source and sha != of.bundle:
        raise RecordingError(
            f"{path} is not what was recorded: its bundle would be {sha[:8]}…, not {of.bundle[:8]}…",
            "take the bundle that was running (one with --robot is another), or the source and the lock as they were",
        )
    of.refuse_another(sha, found.graph)
    return found


def recorded_task(of: About, mind: Bundle) -> Task | None:
    """The task in whose world a recording was made, with the mind of this bundle; None of a robot's."""
    return next((task for task in mind.graph.tasks if of.world and task.name == of.world.task), None)


def measured_in(of: About, mind: Bundle) -> NDArray[np.bool_]:
    """The readings [graph.width] that a recording made with this bundle has measured: 0.1.0 wrote 0 for all others.

    It knew no world with several robots, in which any may be measured for another one's skills.
    """
    task = recorded_task(of, mind)
    if task and robots_in(task) > 1:
        return np.ones(mind.graph.width, np.bool_)
    simulated = measured_in_world(mind.graph, of.master, task) if task else []
    return rows_of(mind.graph, [*measured_on_robot(mind.graph, of.sensors), *simulated])


def _built(path: Path, of: About) -> tuple[Bundle, str]:
    """The bundle of a source, under the master of the recording or, where that is not the one, under its own."""
    compiled = load(path)
    if compiled.graph is None:
        hint = f"{command_line('mindc', 'check', path)} says them"
        raise RecordingError(f"{path} has mistakes, or cannot be read", hint)
    names = {skill.name for skill in compiled.graph.skills}
    found, sha = None, ""
    for master in dict.fromkeys([compiled.graph.master, *({of.master} & names)]):
        ready = make_ready(compiled.graph, compiled.sources, master)
        if ready.refusals and found:
            continue
        found = bundle_without_robot(with_zero_weights(ready), compiled.sources[0].folder)
        sha = sha256(pack(found)).hexdigest()
        if sha == of.bundle:
            break
    assert found is not None
    return found, sha


def bundle_without_robot(ready: ReadyMind, folder: Path) -> Bundle:
    """The bundle that `mindc build` writes of a mind that is wired to nothing; `folder` has its procedures."""
    return Bundle(ready.policy, procedure_sources(ready.policy.graph, folder))


def about_of(setup: RunSetup, mind: Bundle, world: RecordedWorld, by_hand: tuple[str, ...] = ()) -> About:
    """The header of a recording of a run in a world, with what a person drove there; `mind` is its bundle."""
    read = read_by(mind.graph, setup.master)
    sensors = [name for name in physical(mind.graph) if name in read]
    about = About.of(mind.graph, sha256(pack(mind)).hexdigest(), setup.master, sensors)
    return replace(about, world=world, by_hand=by_hand)


def run_bytes(run: RecordedRun, setup: RunSetup, seed: int) -> bytes:
    """A recording of a run; the events are those of the setup's task, though the run may have noticed more.

    It names the bundle that `mindc build` writes of the setup's mind under its master. MindError where the world is too
    large to be recorded.
    """
    graph, world = run.graph, world_of(setup, seed, run.boxes, run.body[0], run.things[0], run.turned[0])
    about = about_of(setup, bundle_without_robot(setup.mind, setup.folder), world)
    rows = recorded_rows(about, 1, run, run.events)
    varies = any((each.noun, each.argument) == ("actuator", "delay") for each in setup.task.varies)
    if varies or any(each.kind.delay for each in graph.actuators):  # what reaches one was sent some ticks ago
        engine = Engine(setup.ready.policy, setup.folder, setup.master)
        rows["commands"] = [engine.tick(readings) for readings in rows["readings"]]
    if len(rows):
        rows["world"]["ended"][-1] = run.ended
    return recording_bytes(about, rows)


def world_of(setup: RunSetup, seed: int, boxes: Floats, pose: Floats, things: Floats, turned: Floats) -> RecordedWorld:
    """The world of a run that begins so: x, y, angle; x, y, size [things, 3]; turned [things]."""
    begin = [*pose, *np.column_stack([things, turned]).ravel()]
    return RecordedWorld.of(setup.task, seed, boxes, begin, setup.robot)


def recorded_rows(about: About, first: int, written: Ticks | RecordedRun, events: NDArray[np.int64]) -> Rows:
    """The rows of a recording for some ticks, of which `first` is the number, counted from 1.

    `events` [ticks, events] says how often each had happened by then. `commands` are those of `sent`, which reached the
    actuators.
    """
    assert about.world
    rows = np.zeros(len(events), about.row)
    rows["tick"] = np.arange(first - 1, first - 1 + len(rows))
    rows["time"] = np.arange(first, first + len(rows)) * about.tick
    rows["armed"], rows["ages"] = 1, np.nan  # what is simulated has no age
    rows["readings"] = written.readings[:, : about.readings]
    rows["influence"] = written.influence[:, : len(about.skills)]
    rows["commands"] = rows["sent"] = written.commands
    world = rows["world"]
    after = slice(len(written.body) - len(rows), None)  # without the beginning, where it is written
    world["pose"] = written.body[after, :POSE_COLUMNS]
    world["things"][:, :, : THING_COLUMNS - 1] = written.things[after]
    world["things"][:, :, -1] = written.turned[after]
    world["battery"], world["rewards"] = written.battery, written.lines
    world["events"] = events[:, : about.world.events]
    world["held"], world["touching"], world["ended"] = written.held[after], written.touching, GOES_ON
    return rows


def run_of(about: About, rows: Rows, mind: Bundle, folder: Path) -> RecordedRun:
    """The run whose recording this is; of a dry run, as its world was seen tick by tick."""
    task, world, said = recorded_task(about, mind), rows["world"], about.world
    assert said
    assert task
    begin = np.array(said.begin, np.float64)
    reached = np.isin(about.skills, [skill.name for skill in reachable(mind.graph, about.master)])
    things = np.concatenate([begin[POSE_COLUMNS:].reshape(1, -1, THING_COLUMNS), world["things"]])
    return RecordedRun(
        RunSetup(task, about.master, ReadyMind(mind.policy, (), ()), folder, robot=said.robot),
        np.array([box or NO_BOX for box in said.boxes], np.float64).reshape(-1, 4),
        np.concatenate([begin[None, :POSE_COLUMNS], world["pose"]]),
        things[:, :, :-1],
        things[:, :, -1],
        np.concatenate([[-1], world["held"]]),
        np.where(measured_in(about, mind), rows["readings"], np.float32(np.nan)),
        np.where(reached, rows["influence"], np.float32(np.nan)),
        rows["sent"],
        world["rewards"],
        world["touching"] != 0,
        world["battery"],
        world["events"].astype(np.int64),
        int(world["ended"][-1]) if len(rows) else GOES_ON,
        seed=said.seed,
    )
