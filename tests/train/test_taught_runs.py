"""`mindc lifelong`: what a mind could do after each of its lessons."""

import json
from pathlib import Path

import pytest

from tests.calling import Call

MIND = """\
tick 1/60 s
master Go
body Robot is disc
actuator left_wheel is wheel side left thrust 80 neutral 0.5
actuator right_wheel is wheel side right thrust 80 neutral 0.5
sensor near is bearing of object
sensor home is bearing of base
skill Go is mlp hidden 1
  reads near
  reads home
  drives left_wheel
  drives right_wheel
skill Stay is mlp hidden 1
  reads home
  influences Go
task Fetch in plain
  contains object is item size 3 reached moves
  lasts 300 ticks
  rewards 10 on reach of object
  rewards progress toward object per tick
  counts reach of object
task Return in plain
  contains base is zone size 3 reached moves
  lasts 300 ticks
  rewards progress toward base per tick
  rewards forward per tick
curriculum School is genetic population 8 mutation 4 mutated 50%
  teaches Go on Fetch for 2 generations
  teaches Go on Return for 3 generations
  teaches Stay on Return for 2 generations
"""


@pytest.fixture
def taught(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, mindc: Call) -> Path:
    """A mind that was taught all of its lessons, in the folder where one is."""
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "go.mind"
    path.write_text(MIND, encoding="utf-8")
    assert mindc("train", path, "--seed", 3, "-q").code == 0
    return path


def test_what_a_task_has_after_the_last_lesson_is_what_bench_measures_now(taught: Path, mindc: Call) -> None:
    found = json.loads(mindc("lifelong", taught, "--layouts", 20, "--seed", 5, "--json").out)
    assert [lesson["lesson"] for lesson in found["lessons"]] == ["Go-on-Fetch", "Go-on-Return", "Stay-on-Return"]
    fetch, home, stay = found["tasks"]
    for task, measure in ((fetch, "count_mean"), (home, "score_mean"), (stay, "score_mean")):
        place = "--task", task["task"], "--master", task["master"]
        benched = json.loads(mindc("bench", taught, *place, "--runs", 20, "--seed", 5, "--json").out)
        assert task["means"][-1] == pytest.approx(benched[measure], abs=1e-9)
    assert fetch["means"][0] != fetch["means"][1] == fetch["means"][2]
    assert stay["means"][:2] == [None, None]
    assert home["kept"] == 1.0


def test_it_fits_a_terminal_and_leaves_out_what_was_taught_otherwise(taught: Path, mindc: Call) -> None:
    said = mindc("lifelong", taught, "--layouts", 2)
    assert said.code == 0
    assert "Return under Stay" in said.out
    taught.write_text(MIND.replace("influences Go", "influences Go\n  drives left_wheel"), encoding="utf-8")
    said = mindc("lifelong", taught, "--layouts", 2)
    assert "note: lessons whose weights fit no more: 1; they are left out" in said.err
    assert "Go-on-Return" in said.out
    assert "Stay" not in said.out
    assert mindc("lifelong", taught, "--runs", "elsewhere").code == 2
