"""Workers that answer wrongly, late or never: the arrays are the same to the bit, or it is one sentence."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from mindrun.work import WorkError, blocks, child
from mindrun.work.child import Place
from mindrun.work.crew import MAX_LOSSES, Crew
from mindrun.work.job_scorer import JobScorer

from tests.work.counting import ASSIGNMENT, Counting
from tests.work.test_job_scorer import arrays, drawn
from tests.work.wrong import FAULTS

ROOT = Path(__file__).parents[2]
SLOW = ("never", "only alive")  # each costs a second


@pytest.fixture(autouse=True)
def surroundings(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(ROOT), str(ROOT / "runtime")]))
    monkeypatch.setattr(blocks, "MIN_JOB_SECONDS", 0.0)
    monkeypatch.setattr(blocks, "JOB_SECONDS", 1e-9)  # a job for each run
    monkeypatch.setattr(child, "START_SECONDS", 20.0)


def place(fault: str, every: int = 3) -> Place:
    return Place("a place", (sys.executable, "-m", "tests.work.wrong", fault, f"{every}"))


@contextmanager
def scorer_at(*places: Place) -> Iterator[JobScorer]:
    scorer = JobScorer(Counting(), Crew(places, ASSIGNMENT))
    try:
        yield scorer
    finally:
        scorer.close()


@pytest.mark.parametrize("fault", [fault for fault in FAULTS if fault not in SLOW])
def test_a_worker_that_is_wrong_now_and_then_changes_no_bit(fault: str) -> None:
    genomes, seeds = drawn((2, 12))
    with scorer_at(place(fault, 7), place("none")) as scorer:
        assert arrays(scorer.score(genomes, seeds)) == arrays(Counting().score(genomes, seeds))


@pytest.mark.parametrize("fault", ["mute", "dead", "loud"])
def test_one_that_never_begins_or_is_loud_leaves_the_work_to_others(
    fault: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(child, "START_SECONDS", 20.0 if fault == "loud" else 3.0)
    genomes, seeds = drawn((2, 30))
    with scorer_at(place(fault), place("none")) as scorer:
        assert arrays(scorer.score(genomes, seeds)) == arrays(Counting().score(genomes, seeds))


@pytest.mark.parametrize(
    ("fault", "words"),
    [
        ("of another job", "it answers another job than it was asked"),
        ("fewer", "are not of"),
        ("nan", "its scores are such as no run has"),
        ("counts less", "it does not say what its job has taken"),
        ("only alive", "it has said nothing for 1 seconds, in step 7 of the run of seed 3"),
    ],
)
def test_one_that_is_always_wrong_is_a_sentence(fault: str, words: str) -> None:
    genomes, seeds = drawn((1, 1))
    with scorer_at(place(fault, 1)) as scorer, pytest.raises(WorkError, match=f"ended {MAX_LOSSES} workers") as error:
        scorer.score(genomes, seeds)
    assert words in str(error.value)


def test_who_never_says_a_word_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(child, "START_SECONDS", 1.0)
    genomes, seeds = drawn((1, 1))
    with scorer_at(place("mute")) as scorer, pytest.raises(WorkError, match="no worker is left") as error:
        scorer.score(genomes, seeds)
    assert "it has said nothing for 1 seconds" in str(error.value)


@pytest.mark.parametrize(
    ("program", "began"),
    [
        ("while words := os.read(0, 9): os.write(1, words)", "\\n"),  # as cat does
        ("os.write(1, b'Hi'); os.read(0, 9); os.read(0, 9)", "Hi"),  # too short for a frame's beginning, and no more
        ("os.write(1, b'mindfrm2'); os.read(0, 9); os.read(0, 9)", "mindfrm2"),  # of another version
        ("os.write(1, b'Welcome to the cluster\\n')", "Welcome "),
    ],
)
def test_who_says_something_else_is_refused_at_its_first_bytes(
    program: str, began: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With a patience that would never end, and without being begun again."""
    monkeypatch.setattr(child, "START_SECONDS", 1e6)
    begun = tmp_path / "begun"
    words = f"import os; open({str(begun)!r}, 'a').write('.')\n{program}"
    genomes, seeds = drawn((1, 1))
    with scorer_at(Place("cat", (sys.executable, "-c", words))) as scorer, pytest.raises(WorkError) as error:
        scorer.score(genomes, seeds)
    said = f"no worker is left; the last, at cat, is none: its answer is no frame: it begins with b'{began}'"
    assert str(error.value).replace('b"', "b'") == said
    assert begun.read_text() == "."


def test_simulated_workers_come_to_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    from benchmarks import simulated_workers

    found = simulated_workers.cost(50, 1000)
    genomes = np.random.default_rng(1).standard_normal((25, 100), np.float32)
    assert found.lost > 0
    assert found.answers == dict.fromkeys(range(1000), float(genomes.sum()))
