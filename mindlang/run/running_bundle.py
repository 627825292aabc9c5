"""What was running when a recording was made: the bundle, read or built in memory from its source, and the task."""

from __future__ import annotations

from hashlib import sha256
from pathlib import Path

import numpy as np
from mindrun.engine.engine import procedure_sources
from mindrun.graph.bundle import Bundle, digest, pack, read_bundle
from mindrun.graph.graph import Task
from mindrun.graph.measured import measured_in_world, measured_on_robot, rows_of
from mindrun.graph.recording_header import About, RecordingError
from mindrun.terminal.command_line import command_line
from numpy.typing import NDArray

from mindlang.compiler.compile import load
from mindlang.lock.ready import ReadyMind, make_ready

SOURCE_SUFFIX = ".mind"


def running_bundle(path: Path, of: About) -> Bundle:
    """The bundle of a recording, which `path` names, or the source that it is built from.

    MindError where it cannot be read or built, or the recording was made with another.
    """
    is_source = path.suffix == SOURCE_SUFFIX
    found, sha = _built(path, of) if is_source else (read_bundle(path), digest(path))
    if is_source and sha != of.bundle:
        raise RecordingError(
            f"{path} is not what was recorded: its bundle would be {sha[:8]}…, not {of.bundle[:8]}…",
            "take the bundle that was running (one with --robot is another), or the source and the lock as they were",
        )
    of.refuse_another(sha, found.graph)
    return found


def task_of(of: About, mind: Bundle) -> Task | None:
    """The task in whose world a recording was made, with the mind of this bundle; None of a robot's."""
    return next((task for task in mind.graph.tasks if of.world and task.name == of.world.task), None)


def measured_in(of: About, mind: Bundle) -> NDArray[np.bool_]:
    """The readings [graph.width] that a recording made with this bundle has measured: 0.1.0 wrote 0 for all others."""
    task = task_of(of, mind)
    simulated = measured_in_world(mind.graph, of.master, task) if task else []
    return rows_of(mind.graph, [*measured_on_robot(mind.graph, of.sensors), *simulated])


def bundle_digest(ready: ReadyMind, folder: Path) -> str:
    """The SHA-256 of the bundle that `mindc build` writes of a mind, which has no robot."""
    return sha256(pack(_unwired(ready, folder))).hexdigest()


def _unwired(ready: ReadyMind, folder: Path) -> Bundle:
    return Bundle(ready.policy, procedure_sources(ready.policy.graph, folder))


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
        found = _unwired(ready, compiled.sources[0].folder)
        sha = sha256(pack(found)).hexdigest()
        if sha == of.bundle:
            break
    assert found is not None
    return found, sha
