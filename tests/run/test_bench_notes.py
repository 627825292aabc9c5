"""What `bench` says of runs that tell nothing: over where they began, or with a score that is no number."""

import json
from pathlib import Path

import pytest

from mindlang.api import load
from tests.calling import Call

MIND = """
mind 1
tick 1/20 s
master Stand
body Robot is disc size 2
actuator left is wheel side left neutral 0.5
actuator right is wheel side right neutral 0.5
sensor far is distance of lamp range 40
sensor flat is computed at greatest of (0.5 - far) 0
skill Stand is rule
  drives left at 0.5
  drives right at 0.5
task Near in arena size 40
  contains lamp is zone size 2 reached stays
  succeeds when far < 0.4
  lasts 20 ticks
  rewards REWARD
"""


def written(folder: Path, reward: str) -> Path:
    """A robot that stands, in worlds in which the lamp is near now and then."""
    path = folder / "near.mind"
    path.write_text(MIND.replace("REWARD", reward))
    return path


def test_runs_that_were_over_where_they_began_are_told(mindc: Call, tmp_path: Path) -> None:
    path = written(tmp_path, "1 per tick")
    found = json.loads(mindc("bench", path, "--runs", 40, "--json").out)
    share = found["success"]["mean"]
    assert 0 < share < 1
    assert found["success"]["at_least"] is found["success"]["at_most"] is None
    (note,) = found["notes"]
    assert note.startswith(f"{round(40 * share)} of 40 runs were over in the first tick, by far < 0.4")
    assert f"note: {note}" in mindc("bench", path, "--runs", 40).err
    assert load(path).bench(runs=40)["notes"] == [note]


def test_of_how_many_layouts_all_or_no_runs_are_an_example_is_said_in_both(mindc: Call, tmp_path: Path) -> None:
    path = written(tmp_path, "1 per tick")
    unseen = 1 - 0.05 ** (1 / 40)
    for when, bounds, words in (
        ("far <= 1", [1 - unseen, 1.0], "100.0% of the runs, at least 92.8% of all layouts"),
        ("far < 0 * far", [0.0, unseen], "0.0% of the runs, at most 7.2% of all layouts"),
    ):
        path.write_text(MIND.replace("REWARD", "1 per tick").replace("far < 0.4", when))
        success = json.loads(mindc("bench", path, "--runs", 40, "--json").out)["success"]
        assert [success["at_least"], success["at_most"]] == pytest.approx(bounds)
        assert words in mindc("bench", path, "--runs", 40).out


def test_a_score_that_is_no_number_is_neither_best_nor_worst(mindc: Call, tmp_path: Path) -> None:
    path = written(tmp_path, "0 / flat per tick")
    some = json.loads(mindc("bench", path, "--runs", 40, "--json").out)
    assert some["score_mean"] is None
    scores = [
        json.loads(mindc("run", path, "--seed", f"1/{some[run]}", "--json").out)["score"]
        for run in ("best_run", "worst_run")
    ]
    assert None not in scores
    pair = json.loads(mindc("bench", path, path, "--runs", 40, "--json").out)["differences"]["score"]
    assert (pair["more"], pair["less"], pair["equal"] + pair["not_finite"]) == (0, 0, 40)
    none = json.loads(mindc("bench", written(tmp_path, "0 / (far - far) per tick"), "--runs", 5, "--json").out)
    assert [none[name] for name in ("best_run", "worst_run", "best_seed", "worst_seed")] == [None] * 4
