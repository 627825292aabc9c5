"""Ticks with procedures that run in Python: the compiled stages one by one, and the procedures between them."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mindrun.functions.procedure import call
from mindrun.graph import Graph
from mindrun.sim.lanes.stages import after, before, run_skills, send, wake
from mindrun.sim.procedures import Procedures
from mindrun.sim.state import Jobs, State
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
        for i in range(len(tables.skills)):
            name = graph.skills[int(tables.skills[i]["index"])].name
            if name in memories.procedures.slow:
                _run(memories, name, tables, state, int(jobs.lanes[0]), i)
            else:
                run_skills(tables, state, jobs.lanes[0], i, i + 1)
                if state.failed[0] >= 0:
                    return
        after(tables, state, jobs, interrupt)
    memories.forget(set(state.job[: jobs.lanes[0]].tolist()))


def _run(memories: Memories, name: str, tables: Tables, state: State, lanes: int, i: int) -> None:
    count = wake(tables, state, lanes, i)
    if count == 0:
        return
    skill, calls = tables.skills[i], memories.procedures.calls[name]
    for k in range(count):
        inputs = state.gathered[: skill["inputs"], k]
        if np.isfinite(inputs).all():
            plain = memories.of(name, int(state.job[state.active[k]]))
            state.hidden[: skill["outputs"], k] = call(calls, plain, int(skill["outputs"]), inputs)
    send(tables, state, i, 0, count, lanes)
