"""`mindc plot --mean`: means over all attempts of a lesson's runs, which no attempt that was given up flatters."""

import json
from math import sqrt
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.train.run_folder import create
from mindrun.train.training import train

from mindlang.pictures.curves import mean_figure
from mindlang.pictures.learning_log import Curve, MeanPoint, by_lesson, load_curves
from tests.calling import Call
from tests.train.climbing import Sphere, lesson, manifest, unwatched

GENERATIONS = 12
HEADER = "attempt,generation,best,reevaluated,verdict\n"


def logged(*scores: float, verdict: float | None = None, number: int = 0) -> Curve:
    """A run of one attempt with these best scores."""
    records = [
        {"attempt": 1, "generation": i, "best": score, "verdict": verdict if i == len(scores) else None}
        for i, score in enumerate(scores, 1)
    ]
    return Curve("Climb", records, Path(f"{number}.csv"))


def points(*curves: Curve) -> list[MeanPoint]:
    [found] = by_lesson(curves)
    return found.points("best")


@pytest.fixture
def runs(tmp_path: Path) -> Path:
    """Three runs of one lesson with three seeds, and one of a longer lesson of the same name."""
    for seed in (1, 2, 3):
        train(create(tmp_path / "runs", manifest(lesson(GENERATIONS), seed), {}, {}), Sphere(), unwatched(1e9))
    train(create(tmp_path / "runs", manifest(lesson(GENERATIONS + 3), 4), {}, {}), Sphere(), unwatched(1e9))
    return tmp_path / "runs"


@given(st.lists(st.lists(st.integers(-9, 9), min_size=5, max_size=5), min_size=2, max_size=6))
def test_the_mean_of_attempts_of_one_length_is_their_mean(scores: list[list[int]]) -> None:
    found = points(*(logged(*each, verdict=1.0, number=i) for i, each in enumerate(scores)))
    table = np.array(scores, float)
    assert [point.generation for point in found] == [1, 2, 3, 4, 5]
    assert [point.mean for point in found] == pytest.approx(table.mean(axis=0))
    errors = table.std(axis=0, ddof=1) / sqrt(len(scores))
    assert [point.error for point in found] == pytest.approx(errors.tolist(), abs=1e-12)


def test_an_attempt_that_was_given_up_keeps_what_it_had() -> None:
    found = points(logged(0.0, 0.0, verdict=0.0), logged(10.0, 10.0, 10.0, 10.0, verdict=10.0, number=1))
    assert [(point.generation, point.mean) for point in found] == [(1, 5.0), (2, 5.0), (3, 5.0), (4, 5.0)]


def test_the_mean_goes_as_far_as_the_attempt_that_still_goes_on() -> None:
    [found] = by_lesson([logged(1.0, 2.0, 3.0, verdict=3.0), logged(3.0, 4.0, number=1)])
    assert [point.generation for point in found.points("best")] == [1, 2]
    assert found.verdict() is None


def test_a_score_that_was_never_finite_leaves_no_mean_to_draw() -> None:
    assert points(logged(1.0, 2.0), logged(float("-inf"), float("-inf"), number=1)) == []


def test_runs_of_one_lesson_become_one_panel(mindc: Call, runs: Path, tmp_path: Path) -> None:
    lessons = by_lesson(load_curves([runs]))
    assert [(each.name, each.note) for each in lessons] == [
        ("Climb", "3 attempts in 3 runs"),
        ("Climb", "1 attempt in 1 run"),
    ]
    picture = tmp_path / "curves.svg"
    said = mindc("plot", runs, "--mean", "-o", picture, "--json")
    assert (said.code, said.err) == (0, f"{picture}: how 4 runs were learnt\n")
    first, second = json.loads(said.out)["curves"]
    verdicts = [curve.points(1, "verdict")[-1][1] for curve in lessons[0].runs]
    assert first["verdict_mean"] == pytest.approx(np.mean(verdicts))
    assert first["verdict_standard_error"] == pytest.approx(np.std(verdicts, ddof=1) / sqrt(3))
    assert (first["attempts"], first["generations"], len(first["runs"])) == (3, GENERATIONS, 3)
    assert (second["verdict_standard_error"], second["generations"]) == (None, GENERATIONS + 3)
    before = picture.read_bytes()
    mindc("plot", runs, "--mean", "-o", picture)
    assert picture.read_bytes() == before


def test_the_lines_and_the_band_are_the_means(runs: Path) -> None:
    lessons = by_lesson(load_curves([runs]))
    figure = mean_figure(lessons)
    lines = {str(line.get_label()): line.get_xydata().tolist() for line in figure.axes[0].get_lines()}
    means = lessons[0].points("best")
    assert lines["best"] == [[point.generation, point.mean] for point in means]
    bands = {str(band.get_label()): band.get_paths()[0].vertices for band in figure.axes[0].collections[:2]}
    low, high = bands["best band"][:, 1].min(), bands["best band"][:, 1].max()
    assert low == pytest.approx(min(point.mean - (point.error or 0) for point in means))
    assert high == pytest.approx(max(point.mean + (point.error or 0) for point in means))
    assert not [band for band in figure.axes[1].collections if "band" in str(band.get_label())]
    assert "± the standard error of the mean" in [text.get_text() for text in figure.legends[0].get_texts()]


def test_tables_of_one_name_are_one_lesson(mindc: Call, tmp_path: Path) -> None:
    for folder, score in (("a", 1.0), ("b", 3.0)):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "Climb.csv").write_text(f"{HEADER}1,1,{score},,{score}\n")
    tables = [tmp_path / folder / "Climb.csv" for folder in "ab"]
    said = mindc("plot", *tables, "--mean", "-o", tmp_path / "c.svg", "--json", "-q")
    assert [(each["verdict_mean"], each["attempts"]) for each in json.loads(said.out)["curves"]] == [(2.0, 2)]
