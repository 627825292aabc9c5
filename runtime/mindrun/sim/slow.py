"""Ticks with procedures that run in Python: the compiled stages one by one, and the procedures between them."""

import numpy as np

from mindrun.functions import Procedure
from mindrun.functions.procedure import call
from mindrun.graph import Graph
from mindrun.sim.lanes.stages import after, before, run_skills, send, wake
from mindrun.sim.procedures import Procedures
from mindrun.sim.state import Jobs, State
from mindrun.sim.tables import Tables


def advance_slowly(
    graph: Graph, procedures: Procedures, tables: Tables, state: State, jobs: Jobs, ticks: int, interrupt: bool
) -> int:
    """As `lanes.advance`, for a mind of which numba cannot compile every procedure."""
    for _ in range(ticks):
        if jobs.lanes[0] == 0:
            break
        before(tables, state, jobs)
        for i in range(len(tables.skills)):
            name = graph.skills[int(tables.skills[i]["index"])].name
            if name in procedures.slow:
                _run(graph, procedures, name, tables, state, int(jobs.lanes[0]), i)
            else:
                run_skills(tables, state, jobs.lanes[0], i, i + 1)
        after(tables, state, jobs, interrupt)
    return int(jobs.lanes[0])


def _run(graph: Graph, procedures: Procedures, name: str, tables: Tables, state: State, lanes: int, i: int) -> None:
    count = wake(tables, state, lanes, i)
    if count == 0:
        return
    skill = tables.skills[i]
    function = next(s.function for s in graph.skills if s.name == name)
    assert isinstance(function, Procedure)
    for k in range(count):
        inputs = state.gathered[: skill["inputs"], k]
        if np.isfinite(inputs).all():
            state.hidden[: skill["outputs"], k] = call(
                function, procedures.functions[name], int(skill["outputs"]), inputs
            )
    send(tables, state, i, 0, count, lanes)
