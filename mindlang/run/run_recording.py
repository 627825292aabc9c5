"""A simulated run as a recording, and a recording that has a world as such a run."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from mindrun.engine.engine import Engine
from mindrun.graph.bundle import Bundle
from mindrun.graph.graph import Task
from mindrun.graph.named_readings import physical
from mindrun.graph.recording_header import GOES_ON, POSE_COLUMNS, THING_COLUMNS, About, RecordedWorld
from mindrun.graph.skill_sets import reachable
from mindrun.graph.wiring import read_by
from mindrun.robot.recording import recording_bytes
from numpy.typing import NDArray

from mindlang.lock.ready import ReadyMind
from mindlang.run.recorded_run import Floats, RecordedRun
from mindlang.run.running_bundle import bundle_digest, measured_in, task_of
from mindlang.run.setup import RunSetup

Rows = NDArray[Any]


class Written(Protocol):
    """What the lanes have written down, with a row for each tick: `mindrun.sim.trace.Ticks`, or most of it."""

    @property
    def body(self) -> Floats: ...
    @property
    def things(self) -> Floats: ...
    @property
    def turned(self) -> Floats: ...
    @property
    def held(self) -> NDArray[np.int64]: ...
    @property
    def battery(self) -> Floats: ...
    @property
    def touching(self) -> NDArray[np.bool_]: ...
    @property
    def readings(self) -> NDArray[np.float32]: ...
    @property
    def influence(self) -> NDArray[np.float32]: ...
    @property
    def commands(self) -> NDArray[np.float32]: ...
    @property
    def lines(self) -> Floats: ...


def run_bytes(run: RecordedRun, setup: RunSetup, seed: int) -> bytes:
    """A recording of a run; the events are those of the setup's task, though the run may have noticed more.

    It names the bundle that `mindc build` writes of the setup's mind under its master. MindError where the world is too
    large to be recorded.
    """
    graph = setup.ready.policy.graph
    read = read_by(graph, setup.master)
    sensors = tuple(name for name in physical(graph) if name in read)
    about = About.of(graph, bundle_digest(setup.ready, setup.folder), setup.master, sensors)
    about = replace(about, world=world_of(setup.task, seed, run.boxes, run.body[0], run.things[0], run.turned[0]))
    after = replace(run, body=run.body[1:], things=run.things[1:], turned=run.turned[1:], held=run.held[1:])
    rows = recorded_rows(about, 1, after, run.events)
    if _has_delays(setup):  # what reaches an actuator is what was sent some ticks ago
        engine = Engine(setup.ready.policy, setup.folder, setup.master)
        rows["commands"] = [engine.tick(readings) for readings in rows["readings"]]
    if len(rows):
        rows["world"]["ended"][-1] = run.ended
    return recording_bytes(about, rows)


def _has_delays(setup: RunSetup) -> bool:
    varies = any((each.noun, each.argument) == ("actuator", "delay") for each in setup.task.varies)
    return varies or any(actuator.kind.delay for actuator in setup.ready.policy.graph.actuators)


def world_of(task: Task, seed: int, boxes: Floats, pose: Floats, things: Floats, turned: Floats) -> RecordedWorld:
    """The world of a run that begins so: x, y, angle; x, y, size [things, 3]; turned [things]."""
    return RecordedWorld.of(task, seed, boxes, [*pose, *np.column_stack([things, turned]).ravel()])


def recorded_rows(about: About, first: int, written: Written, events: NDArray[np.int64]) -> Rows:
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
    world["pose"] = written.body[:, :POSE_COLUMNS]
    world["things"][:, :, : THING_COLUMNS - 1], world["things"][:, :, -1] = written.things, written.turned
    world["battery"], world["rewards"] = written.battery, written.lines
    world["events"] = events[:, : about.world.events]
    world["held"], world["touching"], world["ended"] = written.held, written.touching, GOES_ON
    return rows


def run_of(about: About, rows: Rows, mind: Bundle, folder: Path) -> RecordedRun:
    """The run whose recording this is; of a dry run, as its world was seen tick by tick."""
    task, world, said = task_of(about, mind), rows["world"], about.world
    assert said
    assert task
    begin = np.array(said.begin, np.float64)
    reached = np.isin(about.skills, [skill.name for skill in reachable(mind.graph, about.master)])
    things = np.concatenate([begin[POSE_COLUMNS:].reshape(1, -1, THING_COLUMNS), world["things"]])
    return RecordedRun(
        RunSetup(task, about.master, ReadyMind(mind.policy, (), ()), folder),
        np.array(said.boxes, np.float64).reshape(-1, 4),
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
    )
