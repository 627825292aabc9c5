"""Procedures inside the lanes: formulas are compiled, and called through their addresses.

Any other procedure runs in Python, between the two halves of every tick, and so does a function in numpy, for all runs
at once. Where a compiled one fails it says in which
lane, the run stops, and Python is asked for the reason: the same call fails on the robot.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from mindrun.engine.engine import procedure_sources
from mindrun.errors import ProcedureError
from mindrun.graph.graph import Graph, Skill, Task
from mindrun.graph.skill_sets import acting, masters_of
from mindrun.kinds import procedure_call
from mindrun.kinds.procedure_call import load
from mindrun.kinds.procedure_text import module_of
from mindrun.kinds.registry import names
from mindrun.numbers.arrays import Singles
from mindrun.sim.units import call


def call_procedure(address, gathered, hidden, n):
    """Run a compiled procedure over the gathered inputs into `hidden`; return the first lane where it fails, or −1."""
    return np.int64(call(address, gathered.ctypes.data, hidden.ctypes.data, n, gathered.shape[1]))


class Procedures:
    """The procedures of skills that act in a task, by skill: which Python function each `calls`.

    `addresses` are those of the compiled ones, `slow` has the others, with the reason. ProcedureError where a module or
    function is not there.
    """

    def __init__(self, graph: Graph, task: Task, master: str, folder: Path | None) -> None:
        self.addresses: dict[str, int] = {}
        self.slow: dict[str, str] = {}
        self._kept: list[Any] = []
        acts = acting(graph, task, master)
        skills = [skill for skill in acts if skill.function.calls is not None]
        self.calls = {skill.name: str(skill.function.calls) for skill in skills}
        self._outputs = {skill.name: skill.outputs for skill in skills}
        self._sources: dict[str, str | bytes] = {}
        for leader in masters_of(task, master):
            self._sources |= procedure_sources(graph, folder or Path(), leader)
        for skill in skills:
            self._prepare(skill)
        found = {skill.name: skill.function for skill in acts if skill.function.in_arrays}
        self.arrays: dict[str, Any] = found  # of skills that are computed in numpy
        self.slow |= {skill: f"{names()[type(each)]} is computed in numpy" for skill, each in found.items()}

    def function(self, skill: str) -> Callable[..., Any]:
        """The function of a skill, in a module of its own that remembers nothing."""
        return load(self.calls[skill], self._sources)

    def explain(self, skill: str, inputs: Singles) -> ProcedureError:
        """The error of a compiled procedure that failed, which Python gives for the same inputs."""
        calls = self.calls[skill]
        try:
            procedure_call.call(calls, self.function(skill), self._outputs[skill], inputs)
        except ProcedureError as error:
            return error
        said = f"procedure {calls} fails for {inputs.tolist()} where it is compiled, and not in Python"
        return ProcedureError(said, "please report this")

    def _prepare(self, skill: Skill) -> None:
        function = self.function(skill.name)
        if skill.outputs == 0:  # it is never called
            return
        from mindrun.sim.formulas import NoFormulaError, compile_formula  # with numba, which few minds need

        try:
            source = str(self._sources[module_of(self.calls[skill.name])])
            found = compile_formula(function, source, len(skill.inputs), skill.outputs)
        except NoFormulaError as error:
            self.slow[skill.name] = str(error)
        else:
            self._kept.append(found)
            self.addresses[skill.name] = found.address


def compute_arrays(function: Any, row: Any, tables: Any, mind: Any, count: int) -> None:
    """Compute a function in numpy for all lanes at once in which it has influence and its inputs are sound."""
    inputs, outputs, first = int(row["inputs"]), int(row["outputs"]), int(row["weights"])
    lanes = mind.active[:count]
    at = np.flatnonzero((mind.influence[row["index"], lanes] != 0) & (mind.sound[:count] == 0))
    if not at.size:
        return
    lanes, genes = lanes[at], slice(first, first + function.genome_length(inputs, outputs))
    remembered = slice(row["state"], row["state"] + function.state_length(inputs, outputs))
    genome = mind.genome[genes, lanes].T if row["own"] else tables.weights[genes]
    state = mind.recurrent[remembered, lanes].T
    sent, after = function.computed(mind.gathered[:inputs, at].T, genome, state, outputs)
    mind.hidden[:outputs, at], mind.recurrent[remembered, lanes] = sent.T, after.T


@dataclass(frozen=True, slots=True)
class Memories:
    """The procedures of every run that goes on: each robot has modules of its own, as one that has just started."""

    procedures: Procedures
    functions: dict[tuple[str, int, int], Callable[..., Any]] = field(default_factory=dict)

    def run(self, skill: str, row: Any, tables: Any, state: Any, count: int) -> None:
        """Call a skill's function for what `count` lanes have gathered; its outputs are the first rows of `hidden`."""
        mind, outputs = state.mind, int(row["outputs"])
        if skill in self.procedures.arrays:
            compute_arrays(self.procedures.arrays[skill], row, tables, mind, count)
            return
        for k in range(count):
            inputs = mind.gathered[: row["inputs"], k]
            if np.isfinite(inputs).all():
                lane = int(mind.active[k])
                function = self._of(skill, int(state.run.job[lane]), lane % len(tables.robots))
                mind.hidden[:outputs, k] = procedure_call.call(self.procedures.calls[skill], function, outputs, inputs)

    def forget(self, but: set[int]) -> None:
        """Forget the procedures of all runs but these jobs'."""
        for key in [key for key in self.functions if key[1] not in but]:
            del self.functions[key]

    def _of(self, skill: str, job: int, robot: int) -> Callable[..., Any]:
        if (skill, job, robot) not in self.functions:
            self.functions[skill, job, robot] = self.procedures.function(skill)
        return self.functions[skill, job, robot]
