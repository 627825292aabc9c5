"""What the lanes write down of a run: some ticks of it, as arrays."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.numbers.arithmetic import LOOSE_ROWS, SIZE, THING_ROWS, TURN
from mindrun.numbers.short_repr import ShortRepr
from mindrun.sim.rollout import Rollout
from mindrun.sim.state import Jobs, State

Array = NDArray[Any]
CHUNK_TICKS, CHUNK_BYTES = 256, 1 << 22  # of a run at once, or fewer where a tick is large
SCALARS = ("held", "battery", "touching")  # a column each, after the doubles


@dataclass(frozen=True, slots=True, repr=False)
class Ticks(ShortRepr):
    """The world and the mind after each of some ticks; every array has a row for each.

    `body` [6] is x, y, angle and their velocities; `things` [things, 3] is x, y and size of each, and `turned` [things]
    how far each has turned, counterclockwise in radians, or the direction of one that wanders; `held` the number of the
    thing in the claw or −1; `readings` as the skills read them, NaN of sensors that are not measured; `influence` NaN
    of skills that are not below the master; `battery` NaN where nobody asks for it; `acting` the commands with the
    noise of their actuators, and `grip` the share of its force that each kept; `events` how often each event happened
    in the tick; `lines` the sum of each reward line so far.
    """

    body: NDArray[np.float64]
    things: NDArray[np.float64]
    turned: NDArray[np.float64]
    held: NDArray[np.int64]
    battery: NDArray[np.float64]
    touching: NDArray[np.bool_]
    readings: NDArray[np.float32]
    influence: NDArray[np.float32]
    commands: NDArray[np.float32]
    acting: NDArray[np.float32]
    grip: NDArray[np.float64]
    events: NDArray[np.int64]
    lines: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.body)


def with_room(jobs: Jobs, state: State) -> Jobs:
    """The same jobs, which write down what the first lane does: as many ticks as they are run at once."""
    wide = sum(map(len, _doubles(state).values())) + len(SCALARS)
    narrow = sum(map(len, _singles(state).values()))
    ticks = max(1, min(CHUNK_TICKS, CHUNK_BYTES // (8 * wide + 4 * narrow)))
    return jobs._replace(doubles=np.zeros((ticks, wide)), singles=np.zeros((ticks, narrow), np.float32))


def written(rollout: Rollout, state: State, jobs: Jobs) -> Ticks:
    """What has been written down since this was asked last."""
    count = int(jobs.recorded[0])
    jobs.recorded[0] = 0
    columns = _cut(jobs.doubles[:count].copy(), _doubles(state)) | _cut(jobs.singles[:count].copy(), _singles(state))
    held, battery, touching = jobs.doubles[:count, -len(SCALARS) :].T.copy()
    tables = rollout.tables
    things, actuators = len(tables.things), len(tables.actuators)
    commands = columns["commands"][:, :actuators]
    reached = np.isin(np.arange(columns["influence"].shape[1]), tables.skills["index"])
    rough, slipping = (tables.actuators[name].astype(bool) for name in ("is_rough", "is_slipping"))
    return Ticks(
        body=columns["body"],
        things=columns["things"][:, : THING_ROWS * things].reshape(count, things, THING_ROWS)[:, :, : SIZE + 1],
        turned=turned(rollout, columns["loose"], columns["direction"]),
        held=held.astype(np.int64),
        battery=battery,
        touching=touching.astype(bool),
        readings=columns["readings"],
        influence=np.where(reached, columns["influence"], np.float32(np.nan)),
        commands=commands,
        acting=np.where(rough, columns["acting"][:, :actuators], commands),
        grip=np.where(slipping, columns["grip"][:, :actuators], 1.0),
        events=columns["events"][:, : len(rollout.task.events)].astype(np.int64),
        lines=columns["lines"][:, : len(rollout.task.rewards)],
    )


def joined(chunks: Iterable[Ticks]) -> Ticks:
    """All ticks of some chunks."""
    each = list(chunks)
    columns = {name: [getattr(ticks, name) for ticks in each] for name in Ticks.__slots__}
    return Ticks(**{name: np.concatenate(parts) for name, parts in columns.items()})


def turned(rollout: Rollout, loose: Array, direction: Array) -> NDArray[np.float64]:
    """How far each thing has turned [ticks, things], from the rows of what is loose and of what wanders."""
    found = np.zeros((len(loose), len(rollout.tables.things)))
    for i, row in enumerate(rollout.tables.loose):
        found[:, int(row["thing"])] = loose[:, LOOSE_ROWS * i + TURN]
    for i, row in enumerate(rollout.tables.walkers):
        found[:, int(row["thing"])] = direction[:, i]
    return found


def _doubles(state: State) -> dict[str, Array]:
    """The arrays whose rows are the columns of `jobs.doubles`, in the order in which `lanes.record` writes them."""
    world, judge = state.world, state.judge
    return {
        "body": world.body,
        "things": world.things,
        "loose": world.loose,
        "direction": world.direction,
        "grip": world.grip,
        "lines": judge.lines,
        "events": judge.events,
    }


def _singles(state: State) -> dict[str, Array]:
    """The same of `jobs.singles`."""
    mind = state.mind
    return {
        "readings": mind.readings,
        "influence": mind.influence,
        "commands": mind.commands,
        "acting": state.world.acting,
    }


def _cut(rows: Array, arrays: dict[str, Array]) -> dict[str, Array]:
    """The columns of each array in rows [ticks, columns]."""
    ends = np.cumsum([len(array) for array in arrays.values()])
    return {name: rows[:, end - len(array) : end] for (name, array), end in zip(arrays.items(), ends, strict=True)}
