"""Ticks of a run in which something is changed: the compiled stages one by one, and the changes between them.

A reading is replaced after its sensor and before whatever derives from it, so that all others take it for what the
sensor said. Influence is replaced after all above a skill have sent theirs and before the skill runs.
"""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from mindrun.engine.changes import Change, Changed, calm_ticks, in_tick
from mindrun.sim.lanes.stages import after, before, run_skills
from mindrun.sim.rollout import Rollout, Tile
from mindrun.sim.state import Jobs, State
from mindrun.sim.tables import Tables

Advance = Callable[[Tile, Jobs, int], int]


def changed(rollout: Rollout, changes: Sequence[Change]) -> Advance:
    """`rollout.advance` of a tile of one lane, with changes: the same bits where none is made."""

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


def compile_stages(rollout: Rollout) -> None:
    """Compile what such ticks take, where no cache has it: up to a minute, otherwise under a second."""
    tile = rollout.tile(1)
    jobs = rollout.jobs(np.zeros((0, rollout.genome_length), np.float32), np.zeros(0, np.uint64))
    before(rollout.tables, tile.state, jobs)
    run_skills(rollout.tables, tile.state, np.int64(0), 0, 0)
    after(rollout.tables, tile.state, jobs, rollout.interrupt)


def _tick(rollout: Rollout, tile: Tile, jobs: Jobs, made: Changed) -> int:
    """One tick with what is changed in it; ProcedureError where a procedure fails."""
    readings = tile.state.mind.readings
    for row, value in made.memory.items():
        readings[row, 0] = value
    rollout.observe(tile, jobs)
    _sense(rollout.tables, tile.state, jobs, made.reading)
    _think(rollout, tile, jobs, made.influence)
    rollout.conclude(tile, jobs)
    return int(jobs.lanes[0])


def _sense(tables: Tables, state: State, jobs: Jobs, replaced: Mapping[int, float]) -> None:
    """The first half of a tick, in parts of the table of sensors: each ends with one that is replaced."""
    begin = 0
    for end in _ends(tables, replaced):
        before(tables._replace(sensors=tables.sensors[begin:end]), state, jobs)
        for sensor in tables.sensors[begin:end]:
            for row in range(int(sensor["start"]), int(sensor["start"] + sensor["width"])):
                if row in replaced:
                    state.mind.readings[row, 0] = replaced[row]
        begin = end


def _ends(tables: Tables, replaced: Mapping[int, float]) -> list[int]:
    """Behind which sensors of the table to stop: those that are replaced, and the last."""
    starts, widths = tables.sensors["start"], tables.sensors["width"]
    found = {len(tables.sensors)}
    for row in replaced:
        found |= {int(i) + 1 for i in ((starts <= row) & (row < starts + widths)).nonzero()[0]}
    return sorted(found)


def _think(rollout: Rollout, tile: Tile, jobs: Jobs, replaced: Mapping[int, float]) -> None:
    """All skills in their order, in parts: each begins with one whose influence is replaced."""
    skills, begin = rollout.tables.skills["index"], 0
    for row in [i for i, index in enumerate(skills) if int(index) in replaced]:
        rollout.think(tile, jobs, begin, row)
        tile.state.mind.influence[skills[row], 0] = replaced[int(skills[row])]
        begin = row
    rollout.think(tile, jobs, begin, len(skills))
