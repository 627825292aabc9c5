"""Why a command was what it was, said to a page: the share of each path, by the numbers of its nodes."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite
from typing import Any

from mindrun.graph.graph import Skill

from mindlang.attribution.shares import shares
from mindlang.view.about_hierarchy import node_numbers
from mindlang.view.messages import RefusedError, Why
from mindlang.view.viewed import SeenMind, Viewed


def command_shares(viewed: Viewed, asked: Why) -> dict[str, Any]:
    """What each path has contributed to a command; RefusedError where there is no such actuator or tick."""
    mind = viewed.mind
    graph = mind.policy.graph
    if viewed.about["source"] == "environment":
        raise RefusedError("a program acts here: no path of influence has made its commands")
    if asked.actuator >= len(graph.actuators):
        raise RefusedError(f"there is no actuator {asked.actuator}")
    if asked.tick > viewed.known:
        raise RefusedError(f"tick {asked.tick} is not known yet")
    found = shares(viewed.flows, ("actuator", asked.actuator), range(asked.tick, asked.tick + 1))
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


def _nodes_by_name(mind: SeenMind) -> dict[str, int]:
    numbers = node_numbers(mind.policy.graph, mind.skills)
    places: Sequence[Skill] = mind.policy.graph.skills
    return {skill.name: numbers["skill", place] for place, skill in enumerate(places) if ("skill", place) in numbers}
