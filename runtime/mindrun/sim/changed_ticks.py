"""Ticks of a run in which something is changed: the compiled stages one by one, and the changes between them.

A reading is replaced after its sensor and before whatever derives from it, so that all others take it for what the
sensor said. Influence is replaced after all above a skill have sent theirs and before the skill runs.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

from mindrun.engine.changes import Change, Changed, calm_ticks, in_tick
from mindrun.sim.lanes.advance import before
from mindrun.sim.rollout import Rollout, Tile
from mindrun.sim.state import Jobs, State
from mindrun.sim.tables import Tables

Advance = Callable[[Tile, Jobs, int], int]


def changed(rollout: Rollout, changes: Sequence[Change]) -> Advance:
    """A function that advances a tile of one lane and makes changes; without any, the bits of `rollout.advance`."""

    def advance(tile: Tile, jobs: Jobs, ticks: int) -> int:
        working = int(jobs.lanes[0])
        while ticks and working:
            tick = int(tile.state.world.tick[0]) + 1
            made = in_tick(changes, tick)
            count = 1 if made else calm_ticks(changes, tick, ticks)
            working = _tick(rollout, tile, jobs, made) if made else rollout.advance(tile, jobs, count)
            ticks -= count
        return working

    return advance


def _tick(rollout: Rollout, tile: Tile, jobs: Jobs, made: Changed) -> int:
    """Make one tick with its changes; ProcedureError where a procedure fails."""
    readings = tile.state.mind.readings
    for row, value in made["memory"].items():
        readings[row, 0] = value
    rollout.observe(tile, jobs)
    _sense(rollout.tables, tile.state, jobs, made["reading"])
    _think(rollout, tile, jobs, made["influence"])
    rollout.conclude(tile, jobs)
    return int(jobs.lanes[0])


def _sense(tables: Tables, state: State, jobs: Jobs, replaced: Mapping[int, float]) -> None:
    """Make the first half of a tick in parts of the table of sensors, each of which ends with one that is replaced."""
    starts, widths = tables.sensors["start"], tables.sensors["width"]
    ends = {int(i) + 1 for row in replaced for i in ((starts <= row) & (row < starts + widths)).nonzero()[0]}
    for begin, end in pairwise([0, *sorted({*ends, len(tables.sensors)})]):
        before(replace(tables, sensors=tables.sensors[begin:end]), state, jobs)
        for start, width in zip(starts[end - 1 : end], widths[end - 1 : end], strict=True):
            for row in {*range(start, start + width)} & replaced.keys():
                state.mind.readings[row, 0] = replaced[row]


def _think(rollout: Rollout, tile: Tile, jobs: Jobs, replaced: Mapping[int, float]) -> None:
    """Run all skills in their order, in parts: each begins with one whose influence is replaced."""
    skills, begin = rollout.tables.skills["index"], 0
    for row in [i for i, index in enumerate(skills) if int(index) in replaced]:
        rollout.think(tile, jobs, begin, row)
        tile.state.mind.influence[skills[row], 0] = replaced[int(skills[row])]
        begin = row
    rollout.think(tile, jobs, begin, len(skills))
