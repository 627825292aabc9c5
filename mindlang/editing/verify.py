"""Verifies an edit: every trained skill that it does not touch computes the same, to the bit."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import numpy as np
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Graph, Skill
from mindrun.graph.policy import Policy
from mindrun.graph.weights import Weights, owner_of, reachable
from mindrun.sim.rollout import Rollout
from mindrun.sim.rollouts import rollout_for
from mindrun.sim.trace import trace
from numpy.typing import NDArray

from mindlang.editing.apply import Edited
from mindlang.editing.lock_update import new_names
from mindlang.editing.project import EditError
from mindlang.editing.world_names import NounNames, Renaming, renamed
from mindlang.lock import Lock, merged
from mindlang.lock.signature import arrange
from mindlang.lock.status import Trained, status, trained_weights

VERIFIED_TICKS = 2000  # of a run that is recorded
VERIFIED_SEED = 1
ROUNDING_DIFFERS = (
    "Nothing has been changed. Only the rounding differs: what skills send adds up in the order of their names, "
    "and this edit changes that order."
)


@dataclass(frozen=True, slots=True)
class MindVersion:
    """A mind before or after an edit; `fresh` are weights that have not been written yet, by the path of their file."""

    graph: Graph
    lock: Lock
    fresh: Mapping[Path, Weights]
    folder: Path

    def weights(self, master: str) -> dict[str, Weights] | None:
        """The weights of all skills below a master; None where one is missing or stale."""
        names = {skill.name for skill in reachable(self.graph, master)}
        weights, refusals = trained_weights(self.graph, self.lock, names, self.fresh)
        return None if refusals else weights

    def engine(self, master: str, weights: Mapping[str, Weights]) -> Engine:
        """The engine of a master, as it runs on a robot."""
        return Engine(Policy(self.graph, weights), self.folder, master)


def verify_unchanged(edited: Edited, prepare: Callable[[Rollout], None] = Rollout.compile) -> list[str]:
    """The trained skills that did the same before and after, each in charge of the task on which it was taught.

    What they read is recorded from a run in the simulator, as the mind was; `prepare` compiles it. EditError where one
    did something else. Runs the Python code of the mind's procedures.
    """
    lock, now = merged(edited.locks, edited.project.taught), merged(edited.followed.locks, edited.sources)
    folder = edited.project.main.source.folder
    before = MindVersion(arrange(edited.project.graph, lock), lock, {}, folder)
    after = MindVersion(arrange(edited.graph, now), now, edited.followed.weights, folder)
    names = new_names(edited.change)
    called = renamed(before.graph, Renaming(names, ()).name)
    done = []
    for skill, state in status(before.graph, lock).items():
        master = names["skill"].get(skill, skill)
        old = before.weights(skill) if isinstance(state, Trained) else None
        new = after.weights(master) if old and owner_of(after.graph, master) in after.lock else None
        if isinstance(state, Trained) and old and new and _is_untouched(called, old, after.graph, new, master, names):
            recorded = _recorded(before, skill, state.entry.taught.task, old, prepare)
            _hold(recorded, called, after.graph, before.engine(skill, old), after.engine(master, new), master)
            done.append(master)
    return done


def _is_untouched(
    before: Graph, old: Mapping[str, Weights], after: Graph, new: Mapping[str, Weights], master: str, names: NounNames
) -> bool:
    """True if all that a skill reaches is declared as before, or has been widened to do as before.

    `before` has the names that are called otherwise now, and `old` the weights by the names that they had.
    """
    skills = {found.name: found for found in after.skills}
    widths = {names["skill"].get(owner, owner): len(weights) for owner, weights in old.items()}
    for found in reachable(before, master):
        if found.name not in skills:
            return False
        owner = skills[found.name].owner
        is_widened = owner in new and widths.get(found.owner, len(new[owner])) != len(new[owner])
        if not is_widened and _shape(before, found) != _shape(after, skills[found.name]):
            return False
    return True


def _shape(graph: Graph, skill: Skill) -> object:
    """The function, readings and edges of a skill, all by name, so that two graphs can be compared."""
    readings = graph.readings
    edges = [
        (
            edge.to,
            graph.named(edge.to, edge.target),
            edge.output,
            [(word, readings[int(value)] if word == "reading" else value) for word, value in edge.value],
        )
        for edge in skill.edges
    ]
    return skill.function, [readings[index] for index in skill.inputs], edges


def _hold(recorded: NDArray[np.float32], before: Graph, after: Graph, old: Engine, new: Engine, master: str) -> None:
    """Run a skill before and after on the same readings; EditError at the first tick that differs.

    `before` has the names that are called otherwise now.
    """
    columns = {reading: column for column, reading in enumerate(before.readings)}
    places = [columns.get(reading, -1) for reading in after.readings]
    with_zero = np.concatenate([recorded, np.zeros((len(recorded), 1), np.float32)], axis=1)  # for what is new
    actuators = [actuator.name for actuator in after.actuators]
    order = [actuators.index(actuator.name) for actuator in before.actuators]
    for tick, readings in enumerate(with_zero):
        commands = old.tick(readings[:-1]), new.tick(readings[places])[order]
        if commands[0].tobytes() != commands[1].tobytes():
            raise EditError(
                f"{master} would do something else: at tick {tick} of a recorded run it commands "
                f"{commands[1].tolist()} instead of {commands[0].tolist()}.",
                ROUNDING_DIFFERS if np.allclose(*commands, rtol=0, atol=1e-6) else "Nothing has been changed.",
            )


def _recorded(
    side: MindVersion, skill: str, task: str, weights: Mapping[str, Weights], prepare: Callable[[Rollout], None]
) -> NDArray[np.float32]:
    """The readings [ticks, graph.width] of a run of the task on which a skill was taught; 0 for those that are NaN."""
    tasks = [each.name for each in side.graph.tasks]
    policy = Policy(side.graph, weights)
    rollout = rollout_for(policy, task if task in tasks else tasks[0], skill, procedures=side.folder)
    prepare(rollout)
    moments = islice(trace(rollout, VERIFIED_SEED).moments, VERIFIED_TICKS)
    readings = np.array([moment.readings for moment in moments])
    return np.where(np.isnan(readings), np.float32(0.0), readings)
