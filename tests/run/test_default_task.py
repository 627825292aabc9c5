"""Which task is run where nobody names one: the same one by `mindc run`, `bench` and `mindrun --dry`."""

from pathlib import Path

import pytest
from mindrun.graph.tasks import default_task

from mindlang.compiler.compile import load
from mindlang.run.chosen_task import master_of
from tests.calling import RULES, Call

MIND = """tick 1/60 s
master MASTER
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
sensor feeler is range_finder at 0 deg
skill Over is mlp hidden 1
  reads feeler
  influences Roam
skill Roam is mlp hidden 1
  reads feeler
  influences Turn
skill Turn is mlp hidden 1
  reads feeler
  drives left_wheel
task Chase in plain
  lasts 10 ticks
task Roam in plain
  lasts 10 ticks
curriculum School is genetic population 10
"""
IDLE = """
skill Idle is mlp hidden 1
  reads feeler
  drives left_wheel
curriculum School is genetic population 10
  teaches Idle on Roam for 5 generations
"""
WHY = "no lesson is under {}, so the task is {}; --task names another"


@pytest.mark.parametrize(
    ("master", "lessons", "task", "why"),
    [
        ("Roam", ["Turn on Chase", "Roam on Roam", "Roam on Chase"], "Roam", ""),
        ("Over", ["Turn on Chase", "Roam on Roam"], "Roam", WHY.format("Over", "Roam, on which Roam is taught")),
        ("Roam", ["Over on Chase", "Turn on Roam"], "Roam", WHY.format("Roam", "Roam, on which Turn is taught")),
        ("Roam", ["Over on Chase", "Turn on Chase"], "Roam", WHY.format("Roam", "Roam, which has its name")),
        ("Turn", ["Roam on Roam"], "Chase", WHY.format("Turn", "Chase, the first")),
        ("Roam", [], "Chase", ""),
    ],
)
def test_the_default_is_the_masters_or_the_reason_is_said(
    tmp_path: Path, master: str, lessons: list[str], task: str, why: str
) -> None:
    path = tmp_path / "roam.mind"
    taught = "".join(f"  teaches {lesson} for 5 generations\n" for lesson in lessons)
    path.write_text(MIND.replace("MASTER", master) + taught)
    graph = load(path).graph
    assert graph
    found, reason = default_task(graph)
    assert (found.name, reason) == (task, why)


@pytest.mark.parametrize(
    ("master", "lessons", "leader"),
    [
        ("Roam", ["Turn on Chase under Over", "Roam on Chase", "Over on Chase"], "Roam"),
        ("Turn", ["Turn on Chase under Over", "Roam on Chase"], "Over"),
        ("Roam", ["Roam on Roam", "Turn on Chase under Over", "Turn on Chase"], "Over"),
        ("Turn", ["Roam on Roam"], "Turn"),
    ],
)
def test_the_minds_master_is_in_charge_where_it_is_taught(
    tmp_path: Path, master: str, lessons: list[str], leader: str
) -> None:
    path = tmp_path / "roam.mind"
    taught = "".join(f"  teaches {lesson} for 5 generations\n" for lesson in lessons)
    path.write_text(MIND.replace("MASTER", master) + taught)
    graph = load(path).graph
    assert graph
    assert master_of(graph, graph.tasks[0], None) == leader


def test_it_is_said_before_the_run(mindc: Call, rules: Path) -> None:
    mindc("run", rules, "--seed", 3)  # so that the simulator is compiled
    rules.write_text(RULES + IDLE)
    said = mindc("run", rules, "--seed", 3)
    assert (said.code, said.err) == (0, f"note: {WHY.format('Roam', 'Chase, the first')}\n")
    assert mindc("run", rules, "--seed", 3, "--task", "Chase").err == ""
    assert mindc("run", rules, "--seed", 3, "--quiet").err == ""
