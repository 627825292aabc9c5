"""Why a command was what it was, said to a page: the share of each path, by the numbers of its nodes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Any

import numpy as np
from mindrun.functions.function import Stateful
from mindrun.graph import Skill

from mindlang.run.edge_flow import EdgeFlows
from mindlang.run.shares import shares
from mindlang.view.about_hierarchy import node_numbers
from mindlang.view.messages import RefusedError, Why
from mindlang.view.row_blocks import Singles
from mindlang.view.viewed import SeenMind, Viewed


@dataclass(frozen=True, slots=True)
class KeptRows:
    """Rows of a run, the last of which is asked about."""

    readings: Singles
    influence: Singles


def command_shares(viewed: Viewed, asked: Why) -> dict[str, Any]:
    """What each path has contributed to a command; RefusedError where there is no such actuator or tick."""
    mind = viewed.mind
    graph = mind.policy.graph
    if asked.actuator >= len(graph.actuators):
        raise RefusedError(f"there is no actuator {asked.actuator}")
    if asked.tick > viewed.known:
        raise RefusedError(f"tick {asked.tick} is not known yet")
    first = _first(mind, asked.tick)
    ticks = np.arange(first, asked.tick + 1)
    rows = KeptRows(viewed.group("readings", ticks), viewed.group("influence", ticks))
    flows = EdgeFlows(mind.policy, mind.sources, mind.master, rows)
    row = asked.tick - first
    if _is_replaced(flows, row):
        raise RefusedError(f"the influence of tick {asked.tick} was replaced: nobody sent it")
    found = shares(flows, ("actuator", asked.actuator), range(row, row + 1))
    if not all(isfinite(number) for each in found.paths for number in (each.influence, each.share)):
        raise RefusedError(f"the influence of tick {asked.tick} is beyond all numbers")
    nodes = _nodes_by_name(mind)
    end = node_numbers(graph, mind.skills)["actuator", asked.actuator]
    return {
        "say": "why",
        "fork": asked.fork,
        "tick": asked.tick,
        "actuator": asked.actuator,
        "command": found.command,
        "neutral": found.neutral,
        "rounding": found.rounding,
        "paths": [
            {
                "path": [*(nodes[name] for name in each.path[:-1]), end],
                "value": each.value,
                "influence": each.influence,
                "share": each.share,
            }
            for each in found.paths
        ],
        "rest": found.rest.share,
        "rest_paths": found.rest.paths,
    }


def _first(mind: SeenMind, tick: int) -> int:
    """The first tick that is needed: where a skill remembers, that in which the mind was begun."""
    if not any(isinstance(skill.compute, Stateful) for skill in mind.hierarchy.skills):
        return tick
    begins = tuple(mind.begins)  # to which another thread adds
    return max((begin for begin in begins if begin <= tick), default=1)


def _is_replaced(flows: EdgeFlows, row: int) -> bool:
    """Whether a skill below the master has other influence than was sent to it, as in a run that was changed."""
    carried = flows.at(row).carried
    with np.errstate(all="ignore"):
        sent = [
            np.add.accumulate(carried[flows.links_to.get(("skill", skill), [])], dtype=np.float32)[-1:].sum()
            for skill in flows.skills[1:]
        ]
    had = flows.rows.influence[row, flows.skills[1:]]
    return not np.array_equal(np.array(sent, np.float32), had, equal_nan=True)


def _nodes_by_name(mind: SeenMind) -> dict[str, int]:
    numbers = node_numbers(mind.policy.graph, mind.skills)
    places: Sequence[Skill] = mind.policy.graph.skills
    return {skill.name: numbers["skill", place] for place, skill in enumerate(places) if ("skill", place) in numbers}
