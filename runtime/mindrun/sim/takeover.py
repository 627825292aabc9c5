"""Another mind that takes over a run in the middle: the world goes on as it is, and what was sensed stays known."""

from collections.abc import Sequence

import numpy as np

from mindrun.engine.changes import Change, ChangeError
from mindrun.sim.allocation import empty_state
from mindrun.sim.changed_ticks import changed
from mindrun.sim.python_procedures import Memories
from mindrun.sim.rollout import Rollout, Tile
from mindrun.sim.state import Mind
from mindrun.sim.ticks import with_room
from mindrun.sim.trace import Trace, traced

KEPT = ("readings", "before", "measured", "rings", "late", "commands")  # what sensors, memories and actuators remember
PARTS = ("tick", "body", "sensors", "memories", "actuators")  # of a graph
SENSED = ("kind", "start", "width", "before", "held", "ring", "ray", "number", "is_aside")  # what says where it stands


def take_over(rollout: Rollout, seed: int, tick: int, other: Rollout, changes: Sequence[Change] = ()) -> Trace:
    """The run of a seed from a tick on, counted from 1, in which `other` has the robot; its outcome is of the whole.

    Memory cells and what is derived of readings go on, and what skills remember where all are declared as before. What
    procedures remember begins anew. ChangeError where the other mind does not fit, or the run is over before.
    """
    refuse_another_world(rollout, other)
    jobs = rollout.jobs(np.zeros((1, 0), np.float32), np.array([seed], np.uint64))
    tile = rollout.tile(1)
    rollout.fill(tile, jobs)
    if tick > 1 and rollout.advance(tile, jobs, tick - 1) == 0:
        raise ChangeError(f"the run is over before tick {tick:,}", "say an earlier one")
    mind = _handed_over(
        tile.state.mind, empty_state(other.tables, other.sizes, 1).mind, rollout.graph.skills == other.graph.skills
    )
    state = tile.state._replace(mind=mind)
    taken = Tile(state, Memories(other.procedures), tile.kept)
    return traced(other, taken, with_room(jobs, state), changed(other, changes))


def refuse_another_world(rollout: Rollout, other: Rollout) -> None:
    """ChangeError where two minds have not the same body, sensors, memories, actuators and task."""
    unlike = [name for name in PARTS if getattr(rollout.graph, name) != getattr(other.graph, name)]
    unlike += [f"task {other.task.name}"] if rollout.task != other.task else []
    ours, theirs = rollout.tables, other.tables
    if unlike:
        said = f"its {unlike[0]} {'are others' if unlike[0].endswith('s') else 'is another'}"
    elif any(ours.sensors[name].tolist() != theirs.sensors[name].tolist() for name in SENSED):
        said = "its skills read other sensors"
    else:
        return
    raise ChangeError(
        f"the other mind cannot take over in the middle: {said}", "leave out --tick: let it begin the run"
    )


def _handed_over(ours: Mind, theirs: Mind, with_skills: bool) -> Mind:
    """Room for the other mind, with what stays known."""
    for name in (*KEPT, *(("recurrent",) if with_skills else ())):
        getattr(theirs, name)[:] = getattr(ours, name)
    return theirs
