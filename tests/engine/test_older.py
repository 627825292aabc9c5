"""Bundles of before things said what becomes of them: they are read, and mean what they meant."""

import json
from typing import Any

import pytest
from mindrun.errors import BundleError
from mindrun.graph.bundle import Bundle, decode, migrated, pack, unpack
from mindrun.graph.codec import encode
from mindrun.graph.graph import Task
from mindrun.graph.policy import Policy
from mindrun.kinds.learners import Restarting

from tests.engine.bundles import example
from tests.engine.resealed import resealed
from tests.sim.minds import DRIFTER, compile_text

TASKS = """
task Count in plain
  contains object is item
  contains home is zone
  lasts 9 ticks
  counts reach of object
  rewards 1 on reach of home
task Carry in arena
  contains object is item
  contains home is zone
  contains plug is power
  contains rock is obstacle count 2
  lasts 9 ticks
  ends on delivery of object
  counts reach of plug
task Neither in plain
  contains object is item
  contains home is zone
  lasts 9 ticks
  rewards progress toward object per tick when forward <= 1/2
"""


def old(data: bytes, form: Any = "mind bundle 1") -> bytes:
    """A bundle as it was written before."""
    return resealed(data, _silence, {"format": form})


def _silence(members: dict[str, bytes]) -> None:
    graph = json.loads(members["graph.json"])
    _without_programs(graph)
    for task in graph["tasks"]:
        for thing in task["things"]:
            thing["kind"] = {key: value for key, value in thing["kind"].items() if key not in ("reached", "delivered")}
    members["graph.json"] = json.dumps(graph).encode()


def _without_programs(graph: Any) -> None:
    """Conditions as they were written before they were programs: each was a comparison; edges had none."""
    for reward in (reward for task in graph["tasks"] for reward in task["rewards"] if reward["when"]):
        left, right, (compare, _) = reward["when"][:1], reward["when"][1:-1], reward["when"][-1]
        reward["when"] = {"left": left, "compare": compare, "right": right}
    for task in graph["tasks"]:
        task["ends"] = [end["event"] for end in task["ends"]]
    for edge in (edge for skill in graph["skills"] for edge in skill["edges"]):
        del edge["gate"], edge["cuts"]


def said(task: Task) -> dict[str, tuple[Any, ...]]:
    return {
        thing.name: tuple(getattr(thing.kind, word) for word in ("reached", "delivered") if hasattr(thing.kind, word))
        for thing in task.things
    }


def test_what_a_line_named_moves() -> None:
    now = Bundle(Policy(compile_text(DRIFTER + TASKS), {}), {})
    count, carry, neither = unpack(old(pack(now))).graph.tasks
    assert said(count) == {"object": ("moves", "stays"), "home": ("moves",)}
    assert said(carry) == {"object": ("stays", "moves"), "home": ("stays",), "plug": ("moves",), "rock": ()}
    assert said(neither) == {"object": ("stays", "stays"), "home": ("stays",)}
    assert unpack(pack(now)) == now


def test_a_bundle_of_today_that_does_not_say_it_is_damaged() -> None:
    now = Bundle(Policy(compile_text(DRIFTER + TASKS), {}), {})
    with pytest.raises(BundleError, match="damaged"):
        unpack(old(pack(now), "mind bundle 5"))


def test_what_had_no_word_is_as_where_nothing_is_said() -> None:
    """A `mind bundle 3` said what becomes of things, and not all that a kind takes today."""
    now = Bundle(Policy(compile_text(DRIFTER + TASKS), {}), {})

    def forget(members: dict[str, bytes]) -> None:
        graph = json.loads(members["graph.json"])
        _without_programs(graph)
        for task in graph["tasks"]:
            for thing in task["things"]:
                thing["kind"].pop("away")
        members["graph.json"] = json.dumps(graph).encode()

    assert unpack(resealed(pack(now), forget, {"format": "mind bundle 3"})) == now
    with pytest.raises(BundleError, match="damaged"):
        unpack(resealed(pack(now), forget, {}))


@pytest.mark.parametrize("form", ["mind bundle 2", "mind bundle 7", "", None, 3, ["mind bundle 1"]])
def test_other_formats_are_refused(form: Any) -> None:
    with pytest.raises(BundleError):
        unpack(old(pack(Bundle(Policy(compile_text(DRIFTER + TASKS), {}), {})), form))


@pytest.mark.parametrize("graph", [None, [], {}, {"tasks": 3}, {"tasks": [None]}, {"tasks": [{"events": [{}]}]}])
def test_what_is_no_graph_is_refused_as_ever(graph: Any) -> None:
    def put(members: dict[str, bytes]) -> None:
        members["graph.json"] = json.dumps(graph).encode()

    with pytest.raises(BundleError, match="damaged"):
        unpack(resealed(pack(Bundle(Policy(compile_text(DRIFTER + TASKS), {}), {})), put, {"format": "mind bundle 1"}))


def test_what_lessons_did_not_say_is_as_it_is_where_nothing_is_said() -> None:
    graph = example().graph
    data = encode(graph)
    (lesson,) = data["lessons"]
    del lesson["number"], lesson["learner"]["founders"], lesson["learner"]["rungs"]
    assert decode(migrated(data, "")) == graph
    lesson["learner"]["founders"] = 12
    assert decode(migrated(data, "")).lessons[0].learner == Restarting(founders=12)


def test_a_learner_that_this_version_does_not_know_stays_as_it_is() -> None:
    data = encode(example().graph)
    data["lessons"][0]["learner"]["is"] = "gradient"
    assert migrated(data, "") == data
