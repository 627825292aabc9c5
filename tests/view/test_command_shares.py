"""Why a wheel turned, as a page hears it: shares that add up to the command of the row, over paths of its nodes."""

from math import fsum
from typing import Any

import numpy as np
import pytest

from tests.view.serving import Served, ViewingClient, unpacked

TICKS = [1, 2, 77, 664, 1200]


def why(viewer: ViewingClient, tick: int, actuator: int) -> dict[str, Any]:
    """The answer about a tick."""
    viewer.say(say="why", tick=tick, actuator=actuator)
    return viewer.hear("why")


@pytest.mark.parametrize("actuator", [0, 1])
def test_shares_add_up_to_the_command_of_the_row(view: Served, actuator: int) -> None:
    with view.viewer() as viewer:
        about = viewer.hear("about")
        viewer.run(1200)
        answers = {tick: why(viewer, tick, actuator) for tick in TICKS}
        data = viewer.frame(say="rows", **{"from": 0, "to": 1201})
    singles = unpacked(data, about["doubles"], about["singles"])[4]
    column = about["columns"]["commands"][1] + actuator
    for tick, found in answers.items():
        assert (found["tick"], found["actuator"]) == (tick, actuator)
        assert np.float32(found["command"]) == singles[tick, column]
        parts = [*(path["share"] for path in found["paths"]), found["rest"], found["neutral"], found["rounding"]]
        assert abs(fsum(parts) - found["command"]) < 1e-12
        assert abs(found["rounding"]) < 1e-6


def test_paths_go_from_the_master_over_edges_to_the_actuator(view: Served) -> None:
    with view.viewer() as viewer:
        about = viewer.hear("about")
        viewer.run(1200)
        found = why(viewer, 77, 0)
    edges = {(edge["from"], edge["to"]) for edge in about["edges"]}
    names = [[about["nodes"][node]["name"] for node in path["path"]] for path in found["paths"]]
    assert sorted(names) == [["Roam", "Chase", "left_wheel"], ["Roam", "Turn", "left_wheel"]]
    for path in found["paths"]:
        assert edges.issuperset(zip(path["path"], path["path"][1:], strict=False))
        assert about["nodes"][path["path"][0]]["master"]


def test_influence_that_nobody_sent_is_not_explained(view: Served) -> None:
    with view.viewer() as viewer:
        about = viewer.hear("about")
        viewer.run(1200)
        turn = next(node for node in about["nodes"] if node["name"] == "Turn")
        viewer.say(say="change", tick=77, what="influence", column=turn["columns"][0], value=0.25)
        viewer.run(1200, fork=viewer.hear("fork")["fork"])
        viewer.say(say="why", tick=77, actuator=0, fork=1)
        assert "was replaced" in viewer.hear("refused")["why"]
        viewer.say(say="why", tick=78, actuator=0, fork=1)
        assert viewer.hear("why")["tick"] == 78
