"""What is planted is found: a rare failure, the corner of two numbers, and the same by any workers."""

from pathlib import Path

import numpy as np
import pytest

from mindlang.compiler.compile import load
from mindlang.falsify.failures import Criterion, Rate
from mindlang.falsify.numbers import Number, drawn_at, numbers_of
from mindlang.falsify.region import Box, Tried, worst_box
from mindlang.falsify.report import found_data, hard_text
from mindlang.falsify.search import Found, Search
from mindlang.run.outcome import run_names
from mindlang.run.setup import layouts, run_all, set_up

CAR = """tick 1/60 s
master Go
body Car is car size 3 2 linear_damping 2
actuator engine is motor thrust 600 neutral 0.5
sensor speed is speed range 100
skill Go is rule
  drives engine at 1
task Drive in plain
  lasts 1 s
  rewards -speed per tick
  varies thrust of engine 400 to 800
  varies linear_damping of Car 1 to 3
  draws wish from 3 7
"""
FAST = "  ends when speed > 0.64\n"


def search(folder: Path, text: str, workers: int = 1, runs: int = 200, seed: int = 1) -> Found:
    path = folder / "car.mind"
    path.write_text(text, encoding="utf-8")
    setup = set_up(str(path), load(path), None, None)
    numbers = numbers_of(setup.ready.policy.graph, setup.task)
    return Search(setup.rollout(workers=workers), Criterion(setup.task), numbers, seed).find(runs)


@pytest.mark.parametrize(
    ("failures", "runs", "low", "high"),
    # as R has them: binom::binom.wilson
    [(0, 10, 0.0, 0.27753), (1, 10, 0.01788, 0.40415), (5, 10, 0.23659, 0.76341), (10, 10, 0.72247, 1.0)],
)
def test_the_interval_is_that_of_wilson(failures: int, runs: int, low: float, high: float) -> None:
    rate = Rate.of(failures, runs)
    assert (rate.low, rate.high) == pytest.approx((low, high), abs=1e-5)


def test_a_corner_of_two_numbers_is_found_and_its_runs_can_be_made_again(tmp_path: Path) -> None:
    found = search(tmp_path, CAR + FAST)
    data = found_data(found, 1)
    assert found.region is not None
    assert [words.partition(" of ")[0] for words in data["region"]["numbers"]] == ["thrust", "linear_damping"]
    assert data["region"]["low"] > 2 * data["high"] or data["rate"] < data["region"]["rate"] / 2
    seeds = [each["seed"] for each in data["worst"]]
    setup = set_up(str(tmp_path / "car.mind"), load(tmp_path / "car.mind"), None, None)
    again = run_all(setup.rollout(), seeds)
    assert found.criterion.failed(again).all()
    assert layouts(1, int(data["worst"][0]["layout"].partition("/")[2]))[-1] == seeds[0]
    assert [line for line in hard_text(found, "").splitlines() if line[0] != "#"][:10] == [str(seed) for seed in seeds]


def test_any_workers_find_the_same(tmp_path: Path) -> None:
    one, two = (found_data(search(tmp_path, CAR + FAST, workers), 1) for workers in (1, 2))
    assert one == two


def test_numbers_of_a_run_are_known_before_it(tmp_path: Path) -> None:
    found = search(tmp_path, CAR + FAST, runs=50)
    setup = set_up(str(tmp_path / "car.mind"), load(tmp_path / "car.mind"), None, None)
    seeds = found.runs.seeds.tolist()
    assert (drawn_at(setup.rollout(), seeds) == found.runs.drawn).all()
    drawn = [run_names(setup.task, setup.master, seed)["drawn"]["wish"] for seed in seeds]
    assert found.runs.drawn[:, 2].tolist() == drawn


def test_a_failure_that_nobody_met_by_chance_is_found_where_the_score_leads_there(tmp_path: Path) -> None:
    found = search(tmp_path, CAR + FAST.replace("0.64", "0.705"), runs=100)
    assert found.rate.failures == 0
    assert found_data(found, 1)["worst"]


def test_what_a_failure_is_where_nothing_says_it(tmp_path: Path) -> None:
    found = search(tmp_path, CAR, runs=50)
    middle = float(np.median(found.uniform.scores.total[0]))
    assert found.criterion.below == pytest.approx(1.5 * middle)
    assert found.rate.failures == 0


def test_the_box_is_that_in_which_most_fail_and_no_number_that_does_not_matter_bounds_it() -> None:
    rng = np.random.default_rng(1)
    drawn = rng.random((4000, 3))
    failed = (drawn[:, 0] > 0.8) & (drawn[:, 1] < 0.3)
    whole = Box(np.zeros(3), np.ones(3))
    box = worst_box(whole, Tried(drawn, failed, np.full(4000, 1 / 4000)))
    assert box is not None
    assert box.low == pytest.approx([0.8, 0, 0], abs=0.05)
    assert box.high == pytest.approx([1, 0.3, 1], abs=0.05)
    assert worst_box(whole, Tried(drawn, np.ones(4000, np.bool_), np.full(4000, 1 / 4000))) is None


def test_runs_count_by_how_likely_they_were_chosen() -> None:
    rng = np.random.default_rng(1)
    drawn = np.concatenate([rng.random((500, 1)), 0.01 * rng.random((5000, 1))])
    failed = drawn[:, 0] < 0.2
    weights = 1 / np.where(drawn[:, 0] < 0.01, 500 + 5000 / 0.01, 500)
    box = worst_box(Box(np.zeros(1), np.ones(1)), Tried(drawn, failed, weights))
    assert box is not None
    assert box.high == pytest.approx([0.2], abs=0.03)


def test_numbers_in_words() -> None:
    assert Number("thrust of engine", 0, 9999).within(1234.5, 5678.9) == "thrust of engine 1230 to 5680"
    assert Number("turn of pan", 0, 6, "deg", np.pi / 180).within(np.pi, np.pi) == "turn of pan 180 deg"
