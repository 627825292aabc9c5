"""Paired differences: their interval holds what it promises, and says nothing where the numbers say nothing."""

from math import inf, log, nan, sqrt
from statistics import fmean, pstdev, stdev

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mindlang.run.comparison import SCORE, SUCCESS, conclusion
from mindlang.run.paired_difference import MAX_RUNS, MIN_RUNS, PairedDifference, difference, t_quantile

STUDENT = {1: 12.7062, 2: 4.30265, 4: 2.77645, 9: 2.26216, 30: 2.04227, 199: 1.97196, 10**6: 1.95997}  # any table
WHOLE = st.lists(st.tuples(st.integers(-50, 50), st.integers(-50, 50)), min_size=2, max_size=60)


@pytest.mark.parametrize("degrees", STUDENT)
def test_the_quantiles_are_those_of_the_tables(degrees: int) -> None:
    assert t_quantile(degrees) == pytest.approx(STUDENT[degrees], abs=1e-5)


@given(WHOLE)
def test_every_pair_is_counted_and_the_other_way_round_the_signs_change(pairs: list[tuple[int, int]]) -> None:
    first, second = np.array(pairs, float).T
    found, turned = difference(first, second), difference(second, first)
    assert found.more + found.less + found.equal == found.runs == len(pairs)
    assert (found.more, found.less) == (turned.less, turned.more)
    assert found.mean == pytest.approx(second.mean() - first.mean())
    assert (found.low is None) == (found.differing == 0)
    if found.low is not None:
        assert turned.high == pytest.approx(-found.low)
        assert found.low <= found.mean <= (found.high or 0)
        assert found.leaves_zero_out == turned.leaves_zero_out == (found.low > 0 or (found.high or 0) < 0)


@pytest.mark.parametrize("turned", [1, -1])
@pytest.mark.parametrize("offset", [-3.0, 0.2])
def test_its_figures_are_those_of_the_books(turned: int, offset: float) -> None:
    """Of skewed differences: Student's interval to one side, and Hall's, whose t bends, to the other."""
    each = (turned * (np.random.default_rng(7).exponential(1, 40) ** 2 + offset)).tolist()
    found, error = difference(np.zeros(40), np.array(each)), stdev(each) / sqrt(40)
    assert (found.runs, found.more, found.less) == (40, sum(d > 0 for d in each), sum(d < 0 for d in each))
    assert (found.mean, found.std, found.standard_error) == pytest.approx((fmean(each), stdev(each), error))
    a = fmean([((d - fmean(each)) / pstdev(each)) ** 3 for d in each]) / (3 * sqrt(40))
    ends = [(fmean(each) - end) / error for end in (found.high or 0, found.low or 0)]
    student, hall = ends if turned < 0 else ends[::-1]
    assert abs(student) == pytest.approx(2.02269, abs=1e-5)
    assert abs(hall + a * hall**2 + a**2 * hall**3 / 3 + a / 2) == pytest.approx(2.02269, abs=1e-5)
    assert abs(hall) > 3
    farthest = max(abs(score - mean) for score in [0.0, *each] for mean in (0.0, fmean(each)))
    assert found.unseen == pytest.approx((1 - 0.05 ** (1 / 40)) * farthest)
    assert found.most_that_differ == pytest.approx(0.0721575, abs=1e-6)
    assert found.detectable == pytest.approx(max(1.96 * error, found.unseen or 0) + 0.8416 * error, rel=1e-4)
    assert not found.is_widened


@given(st.floats(0.01, 20), st.floats(0.01, 10), st.booleans())
def test_one_run_less_than_it_says_would_not_tell(mean: float, std: float, turned: bool) -> None:
    each = np.tile([-std, std], 20) + mean * (-1 if turned else 1)
    found = difference(np.zeros(40), each)

    def tells(runs: int) -> bool:
        left = mean - 0.8416 * (found.std or 0) / sqrt(runs)
        return left > max(1.96 * (found.std or 0) / sqrt(runs), log(20) * 1.2 * (mean + std) / runs)

    assert found.runs_to_tell
    assert found.runs_to_tell >= MIN_RUNS
    assert tells(found.runs_to_tell + 1)
    assert found.runs_to_tell == MIN_RUNS or not tells(found.runs_to_tell - 1)


def test_an_interval_is_as_wide_as_layouts_without_an_example_make_it() -> None:
    scores = np.tile([0.0, 100.0], 20)
    found = difference(scores, scores + np.tile([0.0, 0.0, 1.0, 1.0], 10))
    assert (found.low, found.high) == pytest.approx((0.5 - found.unseen, 0.5 + found.unseen))  # type: ignore[operator]
    assert found.unseen == pytest.approx(51 * 0.0721575, rel=1e-5)
    assert found.is_widened
    assert not found.leaves_zero_out
    same = difference(scores, scores + 100)
    assert (same.low, same.high) == pytest.approx((100 - same.unseen, 100 + same.unseen))  # type: ignore[operator]
    assert same.leaves_zero_out
    for low, high, is_widened in ((0.5, 9.0, True), (-9.0, 1.5, True), (-9.0, 9.0, False)):
        assert PairedDifference(12, 12, 0, 0, 0, 1.0, low=low, high=high, unseen=0.5).is_widened == is_widened


def test_of_differences_that_are_not_skewed_it_is_students() -> None:
    found = difference(np.zeros(40), np.tile([-1.0, 1.0], 20) + 0.3)
    reach = 2.02269 * sqrt(40 / 39) / sqrt(40)
    assert (found.low, found.high) == (pytest.approx(0.3 - reach, abs=1e-5), pytest.approx(0.3 + reach, abs=1e-5))


def test_of_few_runs_less_is_known() -> None:
    one, none = difference(np.zeros(1), np.ones(1)), difference(np.ones(4), np.ones(4))
    assert one == PairedDifference(1, 1, 0, 0, 0, 1.0)
    assert none == PairedDifference(4, 0, 0, 4, 0, 0.0, 0.0, 0.0)
    for each in (one, none, PairedDifference(1, 0, 0, 0, 1)):
        assert (each.is_widened, each.leaves_zero_out) == (False, False)
    assert conclusion("A", "B", "Go", {SCORE: one}) == "A single run says nothing of other layouts of Go."


def test_the_interval_contains_the_truth_as_often_as_it_says() -> None:
    rng = np.random.default_rng(1)
    layouts = rng.exponential(100, (2000, 40))  # what is common to both: as much as what differs
    first = layouts + rng.exponential(100, layouts.shape)
    second = layouts + 3 + rng.exponential(100, layouts.shape)
    found = [difference(*both) for both in zip(first, second, strict=True)]
    share = np.mean([each.low <= 3 <= each.high for each in found])  # type: ignore[operator]
    assert 0.935 < share < 0.965
    unpaired = np.hypot(first.std(axis=1), second.std(axis=1)) / sqrt(40)
    assert np.mean([each.standard_error or 0 for each in found]) < 0.75 * unpaired.mean()
    assert np.mean([each.is_widened for each in found]) < 0.25


@pytest.mark.parametrize("runs", [20, 50, 200, 1000])
def test_minds_that_rarely_differ_are_not_told_apart_by_the_runs_in_which_they_agree(runs: int) -> None:
    """What is seen in most runs is a tiny difference for one, and what counts is one layout in fifty for the other."""
    rng = np.random.default_rng(runs)
    scores = rng.normal(250, 20, (500, runs))
    other = scores + rng.normal(0.01, 0.01, scores.shape) - 10 * (rng.random(scores.shape) < 0.02)
    found = [difference(*both) for both in zip(scores, other, strict=True)]
    assert np.mean([each.low <= -0.19 <= each.high for each in found]) > 0.93  # type: ignore[operator]
    assert np.mean([each.low > 0 for each in found]) < 0.01  # type: ignore[operator]
    assert np.mean([each.is_widened for each in found]) > 0.9


@pytest.mark.parametrize("runs", [20, 50, 100, 200, 500])
@pytest.mark.parametrize("shares", [(0.0, 0.03), (0.02, 0.02), (0.02, 0.05)])
def test_where_few_runs_differ_the_interval_contains_the_truth_too(runs: int, shares: tuple[float, float]) -> None:
    """An interval in every comparison in which any run differs: none is chosen for what was seen."""
    rng = np.random.default_rng(runs)
    drawn = [(rng.random((1000, runs)) < share) * 100.0 for share in shares]
    found = [difference(*both) for both in zip(*drawn, strict=True)]
    told = [(each.low, each.high) for each in found if each.low is not None and each.high is not None]
    assert len(told) == sum(each.differing > 0 for each in found)
    truth = 100 * (shares[1] - shares[0])
    assert np.mean([low <= truth <= high for low, high in told]) > 0.92


@pytest.mark.parametrize("std", [1.0, 30.0])
def test_so_many_runs_are_enough_for_layouts_without_an_example_too(std: float) -> None:
    rng = np.random.default_rng(5)
    layouts = rng.normal(0, 20, 400)
    pilot = difference(layouts, layouts + rng.normal(0.5, std, 400))
    assert pilot.mean
    assert pilot.std
    assert pilot.runs_to_tell
    told = []
    for _ in range(400):
        again = rng.normal(0, 20, pilot.runs_to_tell)
        told.append(difference(again, again + rng.normal(pilot.mean, pilot.std, len(again))).leaves_zero_out)
    assert np.mean(told) > 0.74


def test_more_runs_make_the_interval_narrower() -> None:
    rng = np.random.default_rng(6)
    layouts = rng.normal(0, 20, 100_000)
    other = layouts + rng.normal(0.5, 1.0, len(layouts))
    found = [difference(layouts[:runs], other[:runs]) for runs in (100, 1000, 10_000)]
    widths = [(each.high or 0) - (each.low or 0) for each in found]
    assert widths[0] > 3 * widths[1] > 6 * widths[2]


def test_so_many_runs_as_it_says_tell_four_times_in_five() -> None:
    rng = np.random.default_rng(2)
    pilot = difference(np.zeros(40), rng.normal(0.3, 1.0, 40))
    assert pilot.mean
    assert pilot.std
    assert pilot.runs_to_tell
    told = [
        difference(np.zeros(pilot.runs_to_tell), rng.normal(pilot.mean, pilot.std, pilot.runs_to_tell)).leaves_zero_out
        for _ in range(2000)
    ]
    assert 0.76 < np.mean(told) < 0.84
    assert pilot.detectable == pytest.approx(2.8 * pilot.std / sqrt(40), rel=1e-2)


def test_what_no_number_of_runs_tells_has_no_number() -> None:
    alike = np.tile([1.0, -1.0], 20)
    assert difference(np.zeros(40), alike).runs_to_tell is None
    barely = alike + 1.0 / MAX_RUNS
    assert difference(np.zeros(40), barely).runs_to_tell is None
    assert difference(np.zeros(41), np.array([*alike, 1e-170])).runs_to_tell is None


@pytest.mark.parametrize("broken", [nan, inf, -inf])
def test_what_is_not_finite_is_compared_with_nothing(broken: float) -> None:
    first, second = np.arange(20.0), np.arange(20.0)[::-1].copy()
    first[3] = second[3] = second[5] = broken
    found = difference(first, second)
    assert (found.not_finite, found.mean, found.low, found.leaves_zero_out) == (2, None, None, False)
    assert "In 2 runs the score is not a finite number" in conclusion("A", "B", "Go", {SCORE: found})


def test_what_is_said_is_no_more_than_the_interval_says() -> None:
    zero, rng = np.zeros(200), np.random.default_rng(3)
    better = difference(zero, rng.normal(5, 1, 200))
    said = conclusion("A", "B", "Go", {SCORE: better})
    assert said.startswith("On layouts of Go, B scores ")
    assert f"{better.low:.3f} to {better.high:.3f} more" in said
    worse = conclusion("A", "B", "Go", {SCORE: difference(zero, rng.normal(-5, 1, 200))})
    assert worse.startswith("On layouts of Go, A scores ")
    assert "-" not in worse
    unsure = difference(zero, np.tile([1.0, -1.0], 100))
    low, high = f"{-(unsure.low or 0):.3f}", f"{unsure.high:.3f}"
    said = conclusion("A", "B", "Go", {SCORE: unsure})
    assert said.startswith(f"200 runs do not tell B from A: on layouts of Go, B scores from {low} less to {high} more")
    same = conclusion("A", "B", "Go", {SCORE: difference(zero, zero)})
    assert "the same score in 200 runs: they differ on at most 1.5 % of the layouts" in same
    few = conclusion("A", "B", "Go", {SCORE: difference(zero, np.where(np.arange(200) < 2, 1.0, 0.0))})
    assert few.startswith("200 runs do not tell B from A: on layouts of Go, B scores from 0.00")
    assert conclusion("A", "B", "Go", {}).startswith("There is no figure that both have")


def test_a_share_is_said_in_percentage_points_and_an_event_by_its_name() -> None:
    zero, half = np.zeros(200), np.tile([0.0, 1.0], 100)
    said = conclusion("A", "B", "Go", {SUCCESS: difference(zero, half)})
    assert "B succeeds 50.0 percentage points more often than A on average" in said
    said = conclusion("A", "B", "Go", {"reach of ball": difference(zero, half)})
    assert "B counts 0.500 more (reach of ball) than A on average" in said


def test_small_differences_have_the_digits_that_they_need() -> None:
    tiny = difference(np.zeros(200), np.random.default_rng(4).normal(5e-5, 1e-5, 200))
    assert "B scores 0.0000" in conclusion("A", "B", "Go", {SCORE: tiny})
    assert "0.00 " not in conclusion("A", "B", "Go", {SCORE: tiny})
