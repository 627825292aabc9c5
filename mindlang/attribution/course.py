"""What is asked about: the ticks of a run in the simulator, or of a robot's recording, and what acted in them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.engine.engine import Engine, procedure_sources
from mindrun.robot.recording import RecordingError, read
from mindrun.robot.replay import computed_again
from numpy.typing import NDArray

from mindlang.run.edge_flow import EdgeFlows, Singles, edge_flows
from mindlang.run.recorded_run import RecordedRun
from mindlang.run.recording import run_of, running_bundle


@dataclass(frozen=True, slots=True)
class Course:
    """What flowed; `acted` [ticks, actuators] are the commands that reached the actuators, after delay or guardian.

    `stopped` [ticks] says when a robot was. `about` says whose course it is, `run` has the rewards where there are any.
    """

    about: dict[str, Any]
    flows: EdgeFlows
    acted: Singles
    stopped: NDArray[np.bool_]
    run: RecordedRun | None = None

    @property
    def ticks(self) -> int:
        """How many there are, the first of which is 1."""
        return len(self.acted)


@dataclass(frozen=True, slots=True)
class Thoughts:
    """What a robot has read and thought, computed again."""

    readings: Singles
    influence: Singles


def course_of_run(run: RecordedRun, seed: int) -> Course:
    """The course of a run in the simulator."""
    setup = run.setup
    sources = procedure_sources(run.graph, setup.folder, setup.master)
    flows = edge_flows(setup.ready.policy, sources, setup.master, run)
    about = {"task": run.task.name, "master": setup.master, "seed": seed}
    return Course(about, flows, run.commands, np.zeros(len(run.commands), bool), run)


def course_of_recording(path: Path, bundle: Path) -> Course:
    """The course of a robot's recording, whose ticks are its rows; what it does not have is computed again.

    RecordingError where it was made with another bundle, or is not what this one computes. Runs the Python code of the
    bundle's procedures.
    """
    of, parts = read(path)
    mind = running_bundle(bundle, of)
    rows = np.concatenate([*parts, np.zeros(0, of.row)])
    if not len(rows):
        raise RecordingError(f"{path} has no tick in it")
    computed = [*computed_again(path, of, rows, Engine(mind.policy, mind.procedures, of.master))]
    again = Thoughts(np.array([each.readings for each in computed]), rows["influence"])
    begins = np.flatnonzero(rows["tick"] == 0).tolist()
    flows = edge_flows(mind.policy, mind.procedures, of.master, again, begins)
    about = {"recording": path.name, "master": of.master}
    run = run_of(of, rows, mind, bundle.parent) if of.world else None
    return Course(about, flows, rows["sent"], rows["stopped"] != 0, run)
