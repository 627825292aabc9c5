"""`mindc bench --worlds`: each world is that of a file with one number changed, on the same layouts."""

import csv
import json
from pathlib import Path

import pytest
from mindrun.graph.codec import decode_part, encode
from mindrun.graph.graph import Graph

from mindlang.compiler.compile import load
from mindlang.run.worlds import AS_TAUGHT, worlds
from tests.calling import RULES, Call
from tests.language.examples import ROOT, compiled

RULES_DELAYED = RULES.replace("neutral 0.5", "neutral 0.5 delay 6 ticks")
VARIED = "  varies thrust of left_wheel 60 to 80\n  lasts 600"
CHANGED = {
    "arena size 50": ("size 40", "size 50"),
    "rock grid 12.5": ("grid 10", "grid 12.5"),
    "rock size 1.5 to 2.25": ("size 2 to 3", "size 1.5 to 2.25"),
    "body density 2.5": ("disc", "disc density 2.5"),
    "wheel thrust 60": ("neutral 0.5", "neutral 0.5 thrust 60"),
    "left_wheel thrust 72": ("side left", "side left thrust 72"),
    "bearing noise 0.05": ("bearing of ball", "bearing of ball noise 5%"),
    "range_finder range 9": ("330 deg", "330 deg range 9"),
    "actuators delay 6 ticks": ("neutral 0.5", "neutral 0.5 delay 6 ticks"),
}


def graph_of(text: str) -> Graph:
    """The graph of a text."""
    graph = compiled(text).graph
    assert graph
    return graph


def worlds_of(text: str, task: str = "Roam") -> dict[str, Graph]:
    """The graph of each world of a task, by the world's name."""
    graph = graph_of(text)
    found = worlds(graph, next(each for each in graph.tasks if each.name == task), graph.master)
    return {world.name: world.graph for world in found}


def only(graph: Graph, task: str = "Roam") -> object:
    """All of a graph that a run of a task depends on."""
    return graph.body, graph.sensors, graph.actuators, next(each for each in graph.tasks if each.name == task)


@pytest.mark.parametrize("name", CHANGED)
def test_a_world_is_that_of_a_file_which_says_so(name: str) -> None:
    was, now = CHANGED[name]
    assert was in RULES
    assert only(worlds_of(RULES)[name]) == only(graph_of(RULES.replace(was, now)))


def test_what_varies_varies_elsewhere() -> None:
    text = RULES.replace("  lasts 600", VARIED)
    now = text.replace("60 to 80", "45 to 60").replace("side right", "side right thrust 60")
    assert only(worlds_of(text)["wheel thrust 45 to 60 …"]) == only(graph_of(now))


def test_no_world_is_one_that_no_file_could_say() -> None:
    placed = RULES.replace("ball is item size 2 reached moves\n  lasts 600", "ball is item size 2 at 18 0\n  lasts 600")
    assert "arena size 30" in worlds_of(RULES)
    assert "arena size 30" not in worlds_of(placed)
    assert "arena size 30" not in worlds_of(RULES.replace("  lasts 600", "  starts at 18 0\n  lasts 600"))
    assert "bearing noise 0.05" not in worlds_of(RULES.replace("of ball\n", "of ball noise 98%\n", 1))


def test_a_row_for_each_world_the_worst_first(mindc: Call, rules: Path, tmp_path: Path) -> None:
    late, path = tmp_path / "late.mind", tmp_path / "runs.csv"
    rules.write_text(RULES.replace("lasts 1200", "lasts 400"), encoding="utf-8")
    late.write_text(RULES_DELAYED.replace("lasts 1200", "lasts 400"), encoding="utf-8")
    options = ("--task", "Chase", "--runs", 3, "--seed", 3)
    found = json.loads(mindc("bench", rules, late, *options, "--worlds", "--csv", path, "--json").out)
    first, *others = found["worlds"]
    assert (first["world"], [each["of_as_taught"] for each in first["minds"]]) == (AS_TAUGHT, [1, 1])
    worst = [min(each["of_as_taught"] for each in row["minds"]) for row in others]
    assert worst == sorted(worst)
    assert worst[0] < 1
    delayed = next(row["minds"][0] for row in others if row["world"] == "actuators delay 6 ticks")
    assert delayed["by_event"] == first["minds"][1]["by_event"]
    assert delayed["changes"][0] == {
        "noun": "actuator", "name": "left_wheel", "was": "delay 0 ticks", "now": "delay 6 ticks",
    }  # fmt: skip
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert {(row["world"], row["mind"]) for row in rows} >= {("wheel thrust 60", f"{rules}"), (AS_TAUGHT, f"{late}")}
    assert [row["seed"] for row in rows[:3]] == [row["seed"] for row in rows[-3:]]
    text = mindc("bench", rules, late, *options, "--worlds").out
    assert all(len(line) <= 80 for line in text.splitlines() if "in charge" not in line)
    assert "actuators delay 12 ticks" in text
    assert "–" in text


def test_where_a_world_has_runs_and_the_one_as_taught_a_single_one(mindc: Call, rules: Path) -> None:
    rules.write_text(RULES.replace("ball is item size 2 reached moves\n  lasts 1200", "ball is item size 2 at 9 9\n"
        "  starts at 0 0 facing 0 deg\n  lasts 1200"), encoding="utf-8")  # fmt: skip
    found = json.loads(mindc("bench", rules, "--task", "Chase", "--runs", 5, "--worlds", "--json").out)
    runs = {row["world"]: row["minds"][0]["runs"] for row in found["worlds"]}
    assert (runs[AS_TAUGHT], runs["wheel thrust 60"], runs["bearing noise 0.05"]) == (1, 1, 5)


@pytest.mark.parametrize("folder", ["line", "soccer", "walker"])
def test_every_world_can_be_written_into_a_bundle(folder: str) -> None:
    graph = load(ROOT / "examples" / folder / f"{folder}.mind").graph
    assert graph
    for task in graph.tasks:
        found = worlds(graph, task, graph.master)
        assert len({encode_json(world.graph) for world in found}) == len(found) > 3
        assert all(decode_part(Graph, encode(world.graph), "graph") == world.graph for world in found)


def encode_json(graph: Graph) -> str:
    """A graph as text."""
    return json.dumps(encode(graph))
