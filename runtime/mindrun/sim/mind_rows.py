"""The mind's rows of the tables: programs, skills and their edges, actuators, memories."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mindrun.engine.engine import scene_of
from mindrun.graph.graph import Edge, Graph, Program, Skill
from mindrun.graph.scopes import Scopes, influence_scopes
from mindrun.graph.weights import NO_WEIGHTS, genes, weights_of
from mindrun.kinds.registry import names
from mindrun.numbers.arrays import Array, Singles
from mindrun.numbers.stack_machine import COMMAND, NEGATE, NUMBER, OPERATIONS
from mindrun.sim.codes import ACTUATOR, ACTUATOR_CODES, EDGE, MEMORY, SKILL, Row, records
from mindrun.sim.kind_lanes import compute, remember, unit_of
from mindrun.sim.parameter_rows import SAME_IN_EVERY_RUN, Parameters

VARYING_COLUMNS = {
    "thrust": "thrust", "noise": "noise", "slip": "slip", "turn": "range", "speed": "speed", "starts": "starts",
}  # arguments that may vary  # fmt: skip


@dataclass(slots=True)
class Programs:
    """Collects postfix programs: `rows` of (operation, argument, number), and the `depth` of the stack they need.

    What a task tallies and draws are measures, from the number on that `first` says of each.
    """

    first: Mapping[str, int] = field(default_factory=dict)
    rows: list[tuple[int, int, float]] = field(default_factory=list)
    depth: int = 1

    def add(self, program: Program) -> tuple[int, int]:
        """Add a program; return the row at which it begins, and its length."""
        first, depth = len(self.rows), 0
        for name, value in program:
            if name in self.first:
                name, value = "measure", self.first[name] + value
            op = OPERATIONS[name]
            if op == NEGATE and len(self.rows) > first and self.rows[-1][0] == NUMBER:
                self.rows[-1] = NUMBER, 0, -self.rows[-1][2]
                continue
            depth += 1 if op <= COMMAND else 0 if op == NEGATE else -1
            self.depth = max(self.depth, depth)
            number = float(value) if op == NUMBER else 0.0
            self.rows.append((op, 0 if op == NUMBER else int(value), number))
        return first, len(self.rows) - first

    def columns(self, program: Program | None, first: str, length: str) -> Row:
        """Add a program, none where there is none; the columns that say where it stands."""
        return dict(zip((first, length), self.add(program or ()), strict=True))


def skill_rows(
    graph: Graph,
    reached: Sequence[Skill],
    weights: Mapping[str, Singles],
    learners: Sequence[str],
    addresses: Mapping[str, int],
    codes: Programs,
) -> tuple[dict[str, Array], dict[str, int]]:
    """The tables of the skills that a master reaches, their edges, inputs and weights, and the most of what any needs.

    A learner's weights begin at a place in the genome, the others' at one in what is shared. Skills that are like one
    another have one place. What a skill remembers goes in as its inputs do, and comes out as a layer.
    """
    lengths = {skill.owner: genes(skill) for skill in reached}
    starts = dict(zip(learners, np.cumsum([0, *(lengths.get(name, 0) for name in learners)]), strict=False))
    numbers, scopes = graph.skill_numbers, influence_scopes(graph)
    rows, edges, inputs = list[Row](), list[Row](), list[int]()
    shared, places = _shared_weights([skill for skill in reached if skill.owner not in starts], weights)
    most_inputs, scratch, state = 1, 1, 0
    for skill in reached:
        function, count, outputs = skill.function, len(skill.inputs), skill.outputs
        own, remembered = skill.owner in starts, function.state_length(count, outputs)
        row: Row = {
            "lane": unit_of(function, compute).place, "index": numbers[skill.name],
            "input": len(inputs), "inputs": count, "outputs": outputs,
            "weights": int(starts[skill.owner]) if own else places[skill.owner], "own": own,
            "edge": len(edges), "edges": len(skill.edges), "address": addresses.get(skill.name, 0), "state": state,
            "chooses": skill.chooses, **function.row(count, outputs),
        }  # fmt: skip
        rows.append(row)
        inputs.extend(skill.inputs)
        for edge in skill.edges:
            row, further = _scopes(edge, scopes, len(numbers))
            edges.append({**_edge(graph, edge, codes), **row, "scoped": len(inputs)})
            inputs.extend(further)
        most_inputs = max(most_inputs, function.gathered(count, outputs))
        scratch = max(scratch, function.scratch(count, outputs))
        state += remembered
    tables = {"skills": records(rows, SKILL), "edges": records(edges, EDGE), "inputs": np.array(inputs, np.int64)}
    return {**tables, "weights": shared}, {"inputs": most_inputs, "scratch": scratch, "recurrent": state}


def _shared_weights(skills: Sequence[Skill], weights: Mapping[str, Singles]) -> tuple[Singles, dict[str, int]]:
    """The weights of these skills one after the other, and where those of each owner begin."""
    first: dict[str, Skill] = {}
    for skill in skills:
        first.setdefault(skill.owner, skill)
    each = [weights_of(skill, weights) for skill in first.values()]
    begins = np.cumsum([0, *map(len, each)]).tolist()
    return np.concatenate([NO_WEIGHTS, *each]), dict(zip(first, begins, strict=False))


def _scopes(edge: Edge, scopes: Scopes, skills: int) -> tuple[Row, list[int]]:
    """The scope that weighs a command, and those in which influence counts, too, all as rows of `mind.scoped`."""
    further = [(number - 1) * skills for number in scopes.counting(edge) if number and edge.to == "skill"]
    scope = max(-1, (scopes.of.get((edge.to, edge.target), 0) - 1) * skills)
    return {"scope": scope, "scopes": len(further)}, further


def _edge(graph: Graph, edge: Edge, codes: Programs) -> Row:
    gate: Any = edge.gate
    sinks_before = len(graph.actuators) if edge.to == "memory" else 0
    return {
        "to_skill": edge.to == "skill", "target": edge.target + sinks_before,
        "output": -1 if edge.output is None else edge.output, "cuts": edge.cuts,
        **codes.columns(edge.value, "code", "length"), **codes.columns(gate and gate.when, "when", "whens"),
        **codes.columns(gate and gate.otherwise, "other", "others"),
    }  # fmt: skip


def actuator_rows(graph: Graph, parameters: Parameters) -> tuple[Array, int]:
    """Rows of ACTUATOR, and how many commands wait at any time."""
    rows: list[Row] = []
    ring = 0
    for actuator in graph.actuators:
        kind, fails = parameters.greatest("actuator", actuator.name, actuator.kind), parameters.failing(actuator.name)
        own = kind.row(graph.body)
        is_noisy = own.get("noise", 0.0) > 0.0
        row = {
            "kind": ACTUATOR_CODES[names()[type(kind)]], "neutral": kind.neutral, "delay": kind.delay, "ring": ring,
            "is_noisy": is_noisy, "is_slipping": own.get("slip", 0.0) > 0.0, "is_sticky": "starts" in own,
            "is_rough": is_noisy or fails != SAME_IN_EVERY_RUN, "fails": fails,
        }  # fmt: skip
        values = {column: getattr(actuator.kind, key) for column, key in VARYING_COLUMNS.items() if column in own}
        varying = {
            column: parameters.row("actuator", actuator.name, VARYING_COLUMNS[column], value)
            for column, value in values.items()
        }
        wait = parameters.row("actuator", actuator.name, "delay", actuator.kind.delay)
        rows.append({**own, **row, **varying, "wait": wait})
        ring += kind.delay
    return records(rows, ACTUATOR), ring


def memory_rows(graph: Graph) -> Array:
    scene = scene_of(graph)
    rows: list[Row] = [
        {
            "lane": unit_of(each.kind, remember).place, "row": each.start, "kept": each.kind.kept,
            "start": each.kind.start, **each.kind.row(scene),
        }
        for each in graph.memories
    ]  # fmt: skip
    return records(rows, MEMORY)
