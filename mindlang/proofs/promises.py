"""Proofs of what skills require: that no skill above one lets it act against that, whatever is read.

The box of all readings is cut at the numbers with which conditions compare single readings: a cell on each side, and
the number itself, which is a cell of no width. In a cell such a condition holds everywhere or nowhere. Where what is
sent is learnt, branch and bound goes on from there. What a skill maintains and achieves depends on its world.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from math import prod
from typing import Literal

import numpy as np
from mindrun.graph.graph import Graph, Program, Promise, Skill
from mindrun.graph.skill_sets import reachable
from mindrun.numbers.arrays import Bools, Singles, WeightsBySkill
from mindrun.numbers.expression import leaves
from networkx import DiGraph

from mindlang.compiler.hierarchy import with_ancestors
from mindlang.proofs.branch_and_bound import can_close
from mindlang.proofs.interval import Boxes, expression_bounds, is_known, whole_box
from mindlang.proofs.reach import MAX_BOX_SKILLS, MAX_BOXES, ProvedReach, flow, sway_of_all
from mindlang.proofs.trying import TRIED_READINGS, readings_to_try, think_rows

Claim = Literal["always", "can be broken", "not excluded"]
COMPARISONS = ("<", "<=", ">", ">=")


@dataclass(frozen=True, slots=True)
class Requirement:
    """The claim about a line `requires` of a skill; `readings` are some for which it acts against it, if any is known.

    `weights` names the skills above it on whose weights that rests.
    """

    skill: str
    promise: Promise
    holds: Claim
    readings: Singles | None
    weights: tuple[str, ...]


def prove_requirements(graph: Graph, weights: WeightsBySkill, found: ProvedReach) -> Iterator[Requirement]:
    """A claim for each line, of the skills below the master; `found` are the bounds of the hierarchy."""
    skills = reachable(graph, graph.master)
    known = all(is_known(skill, weights.get(skill.owner)) for skill in skills)
    sent = DiGraph((s.name, graph.skills[e.target].name) for s in skills for e in s.edges if e.to == "skill")
    for skill in skills:
        names = with_ancestors(sent, [skill.name]) - {skill.name} if skill.name in sent else set()
        above = [each for each in skills if each.name in names]
        own = tuple(dict.fromkeys(each.owner for each in above if each.owner in weights))
        for promise in (each for each in skill.promises if each.word == "requires"):
            cells, place = _cells(graph, above, promise.when), graph.skill_numbers[skill.name]
            broken = _broken(graph, weights, cells, promise.when, place) if known else None
            is_open = broken is None and _may_break(graph, weights, found, cells, promise.when, place, above)
            holds: Claim = "can be broken" if broken is not None else "not excluded" if is_open else "always"
            yield Requirement(skill.name, promise, holds, broken, own)


def _cells(graph: Graph, above: list[Skill], program: Program) -> Boxes:
    """Boxes that cover all readings, cut where the program, or one of the skills above, compares a single reading."""
    programs = [program, *(each for skill in above for edge in skill.edges for each in edge.programs)]
    ends: dict[int, set[float]] = {}
    for each in programs:
        for (word, row), (other, number), (compare, _) in zip(each, each[1:], each[2:], strict=False):
            if (word, other) == ("reading", "number") and compare in COMPARISONS and 0 < number < 1:
                ends.setdefault(int(row), set()).add(float(np.float32(number)))
    ends = {row: its for row, its in ends.items() if row in leaves(program, "reading")} | ends
    sides: dict[int, list[tuple[float, float]]] = {}
    for row, its in ends.items():
        marks = [np.float32(mark) for mark in sorted(its)]
        lows = [np.float32(0), *(each for mark in marks for each in (mark, np.nextafter(mark, np.float32(2))))]
        highs = [*(each for mark in marks for each in (np.nextafter(mark, np.float32(-1)), mark)), np.float32(1)]
        if prod(map(len, sides.values())) * len(lows) <= MAX_BOXES:
            sides[row] = [(float(low), float(high)) for low, high in zip(lows, highs, strict=True)]
    cells = list(product(*sides.values()))
    made = np.array(cells, np.float32).reshape(len(cells), len(sides), 2)
    low, high = (np.repeat(bound, len(made), axis=0) for bound in whole_box(graph.width))
    low[:, [*sides]], high[:, [*sides]] = made[:, :, 0], made[:, :, 1]
    return Boxes(low, high)


def _bounds(program: Program, boxes: Boxes) -> tuple[Singles, Singles]:
    with np.errstate(all="ignore"):
        return expression_bounds(program, boxes)


def _broken(graph: Graph, weights: WeightsBySkill, cells: Boxes, program: Program, skill: int) -> Singles | None:
    """Readings for which a skill acts where the program does not hold; None where none of those tried are such."""
    tried = np.concatenate([cells.low, cells.high, readings_to_try(graph.width, TRIED_READINGS)])
    acts = think_rows(graph, weights, tried).influence[:, skill] > 0
    low, high = _bounds(program, Boxes(tried, tried))
    rows = np.flatnonzero(acts & (low == 0) & (high == 0))
    return tried[rows[0]] if len(rows) else None


def _may_break(
    graph: Graph,
    weights: WeightsBySkill,
    found: ProvedReach,
    cells: Boxes,
    program: Program,
    skill: int,
    above: list[Skill],
) -> bool:
    """False if in all boxes, cut as often as that helps, the skill has no influence or the program holds."""
    sway = sway_of_all(graph, above, weights, program)
    most = min(MAX_BOXES, MAX_BOX_SKILLS // len(found.edges)) + len(cells.low)

    def is_open(boxes: Boxes) -> Bools:
        acts = flow(graph, weights, found, boxes).high[:, skill] > 0
        return acts & ~(_bounds(program, boxes)[0] > 0)

    return not can_close(cells, sway, most, is_open)
