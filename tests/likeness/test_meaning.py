"""Skills that are like others: the same function, the same weights, other inputs and outputs."""

import json

import numpy as np
import pytest
from mindrun.engine.engine import Engine
from mindrun.errors import BundleError, WeightsError
from mindrun.graph.bundle import Bundle, pack, unpack
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes, learners

from mindlang.compiler.compile import Compiled, compile_source
from mindlang.compiler.model import Node
from mindlang.compiler.source import Source
from tests.engine.resealed import resealed

ROBOT = """\
tick 1/60 s
master Top
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor eyes is range_finder at 0 90 deg
sensor ears is range_finder at 180 270 deg
sensor near is battery
sensor far is battery
sensor charge is battery
"""
GO = """
skill Go is mlp
  reads eyes
  reads near
  drives left_wheel
  drives right_wheel at near / 2
"""
TOP = """
skill Top is rule
  influences Back at 1
"""
ALIKE = """
skill Back is like Go
  reads far for near
  reads ears for eyes
  drives right_wheel for left_wheel
  drives left_wheel for right_wheel
"""
WRITTEN_OUT = """
skill Back is mlp
  reads ears
  reads far
  drives right_wheel
  drives left_wheel at far / 2
"""
SCHOOL = """
task Roam in plain
  lasts 60 ticks
  rewards forward per tick
curriculum School is genetic
"""


def compiled(*texts: str) -> Compiled:
    return compile_source(Source("mind", ROBOT + "".join(texts)))


def graph(*texts: str) -> Graph:
    found = compiled(*texts)
    assert found.graph is not None, [each.message for each in found.diagnostics]
    return found.graph


def named(mind: Graph, name: str):
    return next(skill for skill in mind.skills if skill.name == name)


def test_it_does_what_it_would_do_if_it_were_written_out() -> None:
    alike, apart = graph(GO, ALIKE, TOP), graph(GO, WRITTEN_OUT, TOP)
    rng = np.random.default_rng(1)
    weights = rng.uniform(-1, 1, genes(named(alike, "Go"))).astype(np.float32)
    one = Engine(Policy(alike, {"Go": weights}))
    other = Engine(Policy(apart, {"Go": weights, "Back": weights}))
    for readings in rng.random((50, alike.width), np.float32):
        assert one.tick(readings).tobytes() == other.tick(readings).tobytes()
    assert one.faults == 0


def test_it_says_what_it_is_like_in_the_end() -> None:
    again = "\nskill Again is like Back\n  reads charge for far\n"
    mind = graph(GO, ALIKE, again, TOP)
    assert {skill.name: skill.owner for skill in mind.skills} == {
        "Go": "Go",
        "Back": "Go",
        "Again": "Go",
        "Top": "Top",
    }
    assert named(mind, "Again").inputs == (2, 3, 6)
    hierarchy = compiled(GO, ALIKE, again, TOP).mind.hierarchy
    read = [(source, edge["line"]) for source, _, edge in hierarchy.in_edges(("skill", "Again"), data=True)]
    assert sorted(read) == [(("sensor", "charge"), 25), (("sensor", "ears"), 20)]
    other_order = graph(again, ALIKE, TOP, GO)
    assert {skill.name: skill.inputs for skill in mind.skills} == {s.name: s.inputs for s in other_order.skills}


def test_a_line_of_each_that_it_is_like_says_what_it_reads() -> None:
    texts = ROBOT, GO, ALIKE, "\nskill Again is like Back\n  reads charge for far\n", TOP
    mind, lines = compiled(*texts[1:]).whole[0], "".join(texts).split("\n")
    into = mind.hierarchy.in_edges(Node("skill", "Again"), data=True)
    said = [lines[edge["line"] - 1] for _, _, edge in into if edge["relation"] == "reads"]
    assert said == ["  reads ears for eyes", "  reads charge for far"]


def test_it_has_no_weights_of_its_own() -> None:
    mind = graph(GO, ALIKE, TOP)
    weights = np.ones(genes(named(mind, "Go")), np.float32)
    with pytest.raises(WeightsError, match="weights of Back, but no such skill has its own"):
        Policy(mind, {"Back": weights})
    with pytest.raises(WeightsError, match="skill Go has no weights"):
        Engine(Policy(mind, {}))


def test_a_bundle_has_the_weights_once() -> None:
    mind = graph(GO, ALIKE, TOP)
    bundle = Bundle(Policy(mind, {"Go": np.ones(genes(named(mind, "Go")), np.float32)}), {})
    found = unpack(pack(bundle))
    assert found.graph == mind
    assert list(found.policy.weights) == ["Go"]


@pytest.mark.parametrize(
    ("skill", "change"),
    [
        ("Back", {"like": "Nobody"}),
        ("Back", {"like": "Top"}),
        ("Back", {"like": "Back"}),
        ("Back", {"inputs": [0]}),
        ("Back", {"frozen": True}),
        ("Go", {"like": "Back"}),
        ("Go", {"function": {"is": "mlp", "hidden": 1, "width": 0}}),
    ],
)
def test_a_bundle_in_which_it_has_another_shape_is_refused(skill: str, change: dict) -> None:
    def put(members: dict[str, bytes]) -> None:
        data = json.loads(members["graph.json"])
        for each in data["skills"]:
            if each["name"] == skill:
                each.update(change)
        members["graph.json"] = json.dumps(data).encode()

    mind = graph(GO, ALIKE, TOP)
    bundle = Bundle(Policy(mind, {"Go": np.ones(genes(named(mind, "Go")), np.float32)}), {})
    with pytest.raises(BundleError, match=r"like|damaged|which it is|shape|weights"):
        unpack(resealed(pack(bundle), put, {}))


def test_a_lesson_teaches_those_that_are_alike_once() -> None:
    both = "\nskill Both is mlp\n  reads near\n  influences Back\n  influences Go\n"
    lessons = (
        "  teaches Both on Roam for 2 generations with subskills\n  teaches Go on Roam under Top for 2 generations\n"
    )
    mind = graph(GO, ALIKE, TOP, both, SCHOOL, lessons)
    jointly, alone = mind.lessons
    assert set(learners(mind, jointly)) == {"Both", "Go"}
    assert learners(mind, alone) == ("Go",)


def test_who_is_alike_freezes_with_its_owner() -> None:
    lessons = "  teaches Top on Roam for 2 generations with subskills\n"
    mind = graph(GO, "  stays frozen\n", ALIKE, TOP, SCHOOL, lessons)
    assert learners(mind, mind.lessons[0]) == ()
