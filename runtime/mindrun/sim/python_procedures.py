"""Ticks with procedures that run in Python: the compiled stages one by one, and the procedures between them."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mindrun.graph.graph import Graph
from mindrun.kinds.procedure_call import call
from mindrun.sim.lanes.stages import after, before, run_skills, send, wake
from mindrun.sim.procedures import Procedures
from mindrun.sim.state import FAILED_SKILL, Jobs, State
from mindrun.sim.tables import Tables


@dataclass(frozen=True, slots=True)
class Memories:
    """The procedures of every run that goes on: each has modules of its own, as on a robot that has just started.

    What a procedure remembers is of its run alone, whatever runs beside it, before it or after it.
    """

    procedures: Procedures
    functions: dict[tuple[str, int], Callable[..., Any]] = field(default_factory=dict)

    def of(self, skill: str, job: int) -> Callable[..., Any]:
        """The function of a skill in a run."""
        key = skill, job
        if key not in self.functions:
            self.functions[key] = self.procedures.function(skill)
        return self.functions[key]

    def forget(self, but: set[int]) -> None:
        """Forget the runs that are over."""
        for key in [key for key in self.functions if key[1] not in but]:
            del self.functions[key]


def advance_slowly(
    graph: Graph, memories: Memories, tables: Tables, state: State, jobs: Jobs, ticks: int, interrupt: bool
) -> None:
    """As `lanes.advance`, for a mind whose procedures are not all compiled."""
    for _ in range(ticks):
        if jobs.lanes[0] == 0:
            break
        before(tables, state, jobs)
        think_slowly(graph, memories, tables, state, int(jobs.lanes[0]), 0, len(tables.skills))
        if state.run.failed[FAILED_SKILL] >= 0:
            return
        after(tables, state, jobs, interrupt)
    memories.forget(set(state.run.job[: jobs.lanes[0]].tolist()))


def think_slowly(
    graph: Graph, memories: Memories, tables: Tables, state: State, lanes: int, first: int, last: int
) -> None:
    """As `lanes.think`: the skills first..last of the table; it ends where a compiled procedure fails."""
    if not memories.procedures.slow:
        run_skills(tables, state, np.int64(lanes), first, last)
        return
    for row in range(first, last):
        name = graph.skills[int(tables.skills[row]["index"])].name
        if name in memories.procedures.slow:
            _run(memories, name, tables, state, lanes, row)
        else:
            run_skills(tables, state, np.int64(lanes), row, row + 1)
            if state.run.failed[FAILED_SKILL] >= 0:
                return


def _run(memories: Memories, name: str, tables: Tables, state: State, lanes: int, row: int) -> None:
    count = wake(tables, state, lanes, row)
    if count == 0:
        return
    skill, mind = tables.skills[row], state.mind
    calls = memories.procedures.calls[name]
    for k in range(count):
        inputs = mind.gathered[: skill["inputs"], k]
        if np.isfinite(inputs).all():
            plain = memories.of(name, int(state.run.job[mind.active[k]]))
            mind.hidden[: skill["outputs"], k] = call(calls, plain, int(skill["outputs"]), inputs)
    send(tables, state, row, 0, count, lanes)
