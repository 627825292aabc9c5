"""Where breakpoints stop a recording of a robot, whose rows come in parts of any size."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from mindrun.engine.think import hierarchy
from mindrun.graph.bundle import Bundle
from mindrun.graph.recording_header import About
from numpy.typing import NDArray

from mindlang.breakpoints.breakpoint import Breakpoint
from mindlang.breakpoints.robot_events import robot_events
from mindlang.breakpoints.subject import Subject
from mindlang.breakpoints.watch import Part, Stop, Watcher
from mindlang.run.running_bundle import task_of


class RecordingWatcher:
    """Where breakpoints stop a recording, of which it has been fed some rows from the first on."""

    def __init__(self, breakpoints: Sequence[Breakpoint], of: About, mind: Bundle) -> None:
        """WeightsError or ProcedureError where a skill of the bundle cannot be made ready."""
        ready, task = hierarchy(mind.policy, mind.procedures, of.master), task_of(of, mind)
        events = (*robot_events(of.sensors), *(task.events if task else ()))
        self._watcher = Watcher(breakpoints, events, ready, len(of.actuators))
        self._before = np.zeros((1, 1 + len(of.sensors)), bool)  # whether it had to stop, and the faults
        self._times = np.zeros((1, 2 + len(of.sensors)), np.int64)

    def feed(self, rows: NDArray[Any], readings: NDArray[np.float32]) -> list[Stop]:
        """All stops in the rows that follow, with the readings [rows, width] as the skills had them."""
        facts = np.concatenate([self._before, np.column_stack([rows["stopped"], rows["faults"]]) != 0])
        happened = self._times + np.cumsum(times(facts[:, 0], facts[:, 1:]), axis=0)
        self._before, self._times = facts[-1:], np.concatenate([self._times, happened])[-1:]
        if "world" in (rows.dtype.names or ()):
            happened = np.concatenate([happened, rows["world"]["events"].astype(np.int64)], axis=1)
        part = Part(readings, rows["influence"], rows["commands"], happened)
        return self._watcher.feed(part, np.flatnonzero(rows["tick"] == 0))


def recording_subject(of: About, mind: Bundle) -> Subject:
    """What the breakpoints of a recording are about, made with the mind of this bundle."""
    return Subject.of_recording(mind.graph, of.master, of.sensors, task_of(of, mind))


def times(stopped: NDArray[np.bool_], faults: NDArray[np.bool_]) -> NDArray[np.int64]:
    """How often each event begins in each row [rows, events]; of rows and the one before them.

    `stopped` [1 + rows] says where the robot had to stop, `faults` [1 + rows, sensors] which sensors were faulty.
    """
    begins = np.column_stack([stopped, faults]).astype(np.int64)
    begins = np.maximum(np.diff(begins, axis=0), 0)
    return np.insert(begins, 1, begins[:, 1:].sum(axis=1), axis=1)
