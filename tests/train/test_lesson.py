"""One lesson, on a sphere."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.graph.graph import HardLayouts, Need
from mindrun.kinds.events.event import Collision
from mindrun.train.attempt import (
    REEVALUATED_CANDIDATES,
    REEVALUATION_GENERATIONS,
    REEVALUATION_LAYOUTS,
    VERDICT_LAYOUTS,
    is_better,
    judge,
    reevaluate,
)
from mindrun.train.attempts import InThisThread, Step, side_by_side
from mindrun.train.lesson_state import (
    AttemptState,
    Course,
    LessonState,
    Record,
    begin,
    begin_attempt,
    is_behind,
    is_over,
    rung_at,
)
from mindrun.train.population import Population
from mindrun.train.scoring import Purpose, layouts, lowest_mean, mark, with_hard

from tests.train.climbing import LENGTH, Faulty, Flat, Results, Sphere, lesson

UNKNOWN = np.empty((0, LENGTH), np.float32)


def taught(course: Course, scorer: Sphere) -> tuple[LessonState, list[Record]]:
    steps = stepped(course, scorer)
    assert all(len(step.records) == len(step.champions) == 1 for step in steps)
    return steps[-1].state, [record for step in steps for record in step.records]


def stepped(course: Course, scorer: Sphere) -> list[Step]:
    ticking = iter(range(10**6))
    executor = InThisThread(course, scorer, lambda: float(next(ticking)))
    return list(side_by_side(course, executor, begin(course), lambda: False))


def test_a_lesson_teaches() -> None:
    state, records = taught(Course(lesson(100), 1, UNKNOWN), Sphere())
    assert [record.generation for record in records] == list(range(1, 101))
    assert state.reevaluated > -2.0
    assert records[0].best < records[-1].best


@given(st.integers(1, 12), st.floats(0.001, 1), st.integers(0, 5))
def test_a_share_of_the_layouts_are_hard_and_the_others_are_what_they_were(
    count: int, share: float, generation: int
) -> None:
    usual, hard = layouts(1, 2, generation, count), HardLayouts(share, ("3", "5", "7", str(2**64 - 1)))
    seeds = with_hard(usual, hard, 1, 2, generation)
    replaced = int((seeds != usual).sum())
    assert int(share * count) <= replaced <= min(count, int(share * count) + 1)
    assert {*map(str, seeds[:replaced])} <= {*hard.seeds}
    assert (seeds[replaced:] == usual[replaced:]).all()
    assert (with_hard(usual, None, 1, 2, generation) == usual).all()


def test_hard_layouts_come_as_often_as_their_share_says() -> None:
    hard = HardLayouts(0.25, ("3", "5"))
    came = [np.isin(with_hard(layouts(1, 0, number, 2), hard, 1, 0, number), [3, 5]).sum() for number in range(400)]
    assert {*came} == {0, 1}
    assert 160 < sum(came) < 240


def test_runs_are_short_first_and_whole_in_the_end_with_a_third_of_the_ticks_for_each_length() -> None:
    asked = list[int | None]()

    class Timed(Sphere):
        def score(self, genomes: np.ndarray, seeds: np.ndarray, ticks: int | None = None) -> Results:
            if len(seeds) == 2:  # of a generation; all else is tried in whole runs
                asked.append(ticks)
            else:
                assert ticks is None
            return super().score(genomes, seeds)

    taught(Course(lesson(70, short=0.25), 1, UNKNOWN), Timed())
    assert asked == [25] * 40 + [50] * 20 + [100] * 10


def test_the_same_seed_gives_the_same_bits_and_another_seed_others() -> None:
    first, again, other = (taught(Course(lesson(), seed, UNKNOWN), Sphere())[0] for seed in (1, 1, 2))
    assert first.kept.tobytes() == again.kept.tobytes()
    assert first.kept.tobytes() != other.kept.tobytes()


def test_the_reevaluated_score_is_not_the_biased_maximum() -> None:
    state, _ = taught(Course(lesson(60), 1, UNKNOWN), Sphere(noise=5.0))
    honest = Sphere(noise=5.0).score(state.kept, np.arange(10_000)).total.mean()
    assert abs(state.reevaluated - honest) < 2.0
    assert state.best > state.reevaluated


@pytest.mark.parametrize(
    "needs",
    [(Need("score", -20.0),), (Need("success", 0.2),), (Need("score", 1.0),), (Need("event", 0.4, Collision()),)],
    ids=str,
)
def test_attempts_end_with_the_first_that_does_all_that_the_lesson_needs(needs: tuple[Need, ...]) -> None:
    """It is met on both halves of the layouts; each attempt is judged as if it were alone."""
    course, scorer = Course(lesson(8, needs, attempts=9), 2, UNKNOWN), Sphere(noise=9.0)
    state, _ = taught(course, scorer)
    everybody, _ = taught(replace(course, lesson=lesson(8, attempts=9)), scorer)
    seeds = layouts(2, 0, 8, 2 * VERDICT_LAYOUTS, Purpose.VERDICT)
    measured = [scorer.score(champion[None], seeds) for champion in everybody.champions]
    halves = [
        (each.total if needs[0].measure == "score" else (1 + (needs[0].measure == "event")) * each.met)[0]
        .reshape(2, VERDICT_LAYOUTS)
        .mean(axis=1)
        for each in measured
    ]
    passed = [all(map(needs[0].is_met, each)) for each in halves]
    count = passed.index(True) + 1 if True in passed else 9
    assert state.passed.tolist() == passed[:count]
    kept = count - 1 if True in passed else int(everybody.verdicts[:, 0].argmax())
    assert state.kept.tobytes() == everybody.champions[kept].tobytes()
    assert is_over(course.lesson, state)
    assert count == (9 if needs[0].above == 1.0 else 8), "the second attempt meets it on one half alone"


def test_several_attempts_keep_the_best_of_them() -> None:
    course = Course(lesson(5, attempts=4), 1, UNKNOWN)
    state, records = taught(course, Sphere())
    assert [record.attempt for record in records] == [attempt for attempt in range(1, 5) for _ in range(5)]
    alone = taught(replace(course, lesson=lesson(5)), Sphere())[0]
    assert state.verdicts[:, 0].max() >= alone.verdicts[0, 0]


def test_it_starts_from_what_the_skill_knows_and_never_ends_worse() -> None:
    known = np.ones((1, LENGTH), np.float32)
    state, records = taught(Course(lesson(5), 1, known), Sphere(noise=0.0))
    assert state.kept.tobytes() == known.tobytes()
    assert records[0].best == 0.0


def test_scores_that_are_not_numbers_come_last_and_are_counted() -> None:
    state, records = taught(Course(lesson(60), 1, UNKNOWN), Faulty())
    assert state.kept[0, 0] <= 0.0
    assert state.faults == sum(record.faults for record in records) > 0


def test_a_lesson_in_which_everything_fails_says_so_by_its_score() -> None:
    state, records = taught(Course(lesson(3), 1, UNKNOWN), Faulty(above=-1e9))
    assert state.reevaluated == -np.inf
    assert all(record.best == -np.inf for record in records)


def test_ticks_and_seconds_add_up() -> None:
    state, records = taught(Course(lesson(30), 1, UNKNOWN), Sphere())
    assert state.seconds == sum(record.seconds for record in records) == 30.0
    assert state.ticks == sum(record.ticks for record in records)


def test_an_attempt_without_patience_left_makes_room_for_the_next() -> None:
    """On a flat world nothing becomes better than the first: its generation and twenty more."""
    state, records = taught(Course(lesson(100, attempts=3, patience=20), 1, UNKNOWN), Flat())
    assert [record.attempt for record in records] == [1] * 21 + [2] * 21 + [3] * 21
    assert [record.generation for record in records if record.verdict is not None] == [21] * 3
    assert len(state.champions) == len(state.verdicts) == 3
    assert state.lengths.tolist() == [21] * 3
    assert state.kept_after == 21
    assert state.generations == 63


def test_patience_outlasts_a_climb() -> None:
    state, records = taught(Course(lesson(60, patience=20), 1, UNKNOWN), Sphere(noise=0.1))
    climbed = taught(Course(lesson(60), 1, UNKNOWN), Sphere(noise=0.1))[0]
    assert len(records) > 40
    assert state.reevaluated > climbed.reevaluated - 1.0


@pytest.mark.parametrize(
    ("scores", "than", "better"),
    [
        ([2.0, 3.1, 4.0, 5.0], [1.0, 2.0, 3.0, 4.0], True),
        ([9.0, 0.0, 9.0, 0.0], [1.0, 2.0, 3.0, 4.0], False),
        ([1.0, 2.0, 3.0, 4.0], [1.0, 2.0, 3.0, 4.0], False),
        ([1.0, 2.0, 3.0, 4.0], [-np.inf, 2.0, 3.0, 4.0], True),
        ([-np.inf, 2.0, 3.0, 4.0], [-np.inf, 2.0, 3.0, 4.0], False),
        ([-np.inf, 9.0, 9.0, 9.0], [1.0, 2.0, 3.0, 4.0], False),
    ],
)
def test_better_means_beyond_doubt(scores: list[float], than: list[float], better: bool) -> None:
    assert is_better(np.array(scores), np.array(than)) is better


def test_attempts_in_the_worse_half_at_a_rung_end_there() -> None:
    course = Course(lesson(17, attempts=16, rungs=3), 1, UNKNOWN)
    state, records = taught(course, Sphere(noise=20.0))
    assert state.rungs.shape == (16, 3)
    assert (state.now.climbed == -np.inf).all(), "of an attempt that never began"
    heights = [2, 4, 8, 17]
    for attempt, scores in enumerate(state.rungs):
        climbed = 0
        while climbed < 3 and not is_behind(state.rungs[: attempt + 1, climbed]):
            climbed += 1
        assert state.lengths[attempt] == heights[climbed]
        assert (scores[climbed + 1 :] == -np.inf).all()
    assert state.lengths[0] == 17, "nobody was there before"
    assert sorted(set(state.lengths.tolist())) == heights
    assert len(records) == state.lengths.sum() < 16 * 17 / 2
    assert len(state.champions) == len(state.verdicts) == 16


def test_all_attempts_meet_the_same_layouts_at_a_rung_and_no_others_do() -> None:
    told = Told()
    state, _ = taught(Course(lesson(20, attempts=3, rungs=1), 1, UNKNOWN), told)
    at_rungs = [seeds for count, seeds in told.asked if (count, len(seeds)) == (1, VERDICT_LAYOUTS)]
    known = layouts(1, 0, 10, VERDICT_LAYOUTS, Purpose.RUNG).tolist()
    assert [[int(seed) for seed in seeds] for seeds in at_rungs] == [known] * 3
    assert [int(seed) for _, seeds in told.asked for seed in seeds].count(known[0]) == 3
    assert (state.rungs[:3] > -np.inf).all()


@pytest.mark.parametrize(
    ("scores", "behind"),
    [
        ([3.0], False),
        ([-np.inf], False),
        ([3.0, 2.0], True),
        ([2.0, 3.0], False),
        ([3.0, 3.0], False),
        ([1.0, 3.0, 2.0], True),
        ([1.0, 3.0, 2.0, 2.5], False),
        ([1.0, 3.0, 2.0, 1.5], True),
        ([1.0, -np.inf, -np.inf, 2.0], False),
        ([1.0, 3.0, -np.inf], True),
        ([-np.inf, -np.inf], False),
    ],
)
def test_who_is_in_the_worse_half(scores: list[float], behind: bool) -> None:
    assert is_behind(np.array(scores)) is behind


def test_a_rung_is_at_a_half_a_quarter_and_so_on() -> None:
    climb = lesson(100, rungs=4)
    assert {n: rung for n in range(101) if (rung := rung_at(climb, n)) is not None} == {6: 0, 12: 1, 25: 2, 50: 3}
    few = lesson(3, rungs=4)
    assert {n: rung for n in range(1, 4) if (rung := rung_at(few, n)) is not None} == {1: 3}
    assert all(rung_at(lesson(100), n) is None for n in range(1, 101))


def test_every_attempt_leaves_its_champion_and_its_verdict() -> None:
    course = Course(lesson(5, attempts=3), 1, UNKNOWN)
    state, records = taught(course, Sphere())
    assert [record.verdict for record in records if record.verdict is not None] == state.verdicts[:, 1].tolist()
    best = int(state.verdicts[:, 0].argmax())
    assert state.kept.tobytes() == state.champions[best].tobytes()
    assert state.reevaluated == state.verdicts[best, 1]


class Told(Sphere):
    """A sphere that remembers on which seeds it was asked to score how many genomes."""

    def __init__(self) -> None:
        super().__init__()
        object.__setattr__(self, "asked", [])

    def score(self, genomes: np.ndarray, seeds: np.ndarray, ticks: int | None = None) -> Results:
        self.asked.append((len(genomes), [int(seed) for seed in seeds]))
        return super().score(genomes, seeds)


def test_nothing_is_chosen_and_reported_on_the_same_layouts() -> None:
    """Each generation, each trial on fresh ones and the verdict have layouts that no other has."""
    told = Told()
    _, records = taught(Course(lesson(25), 1, UNKNOWN), told)
    tried = [record.generation for record in records if record.reevaluated is not None]
    assert tried == [1, REEVALUATION_GENERATIONS, 2 * REEVALUATION_GENERATIONS, 25]
    again = [
        seeds
        for count, seeds in told.asked
        if count <= REEVALUATED_CANDIDATES + 2 and len(seeds) == REEVALUATION_LAYOUTS
    ]
    verdicts = [seeds for count, seeds in told.asked if len(seeds) == 2 * VERDICT_LAYOUTS]
    assert (len(again), len(verdicts), len(told.asked)) == (4, 1, 30)
    seeds = [seed for _, asked in told.asked for seed in asked]
    assert len(set(seeds)) == len(seeds)


def test_all_attempts_have_their_verdict_on_the_same_layouts() -> None:
    told = Told()
    taught(Course(lesson(3, attempts=3), 1, UNKNOWN), told)
    verdicts = [seeds for _, seeds in told.asked if len(seeds) == 2 * VERDICT_LAYOUTS]
    assert len(verdicts) == 3
    assert verdicts[0] == verdicts[1] == verdicts[2]
    known = layouts(1, 0, 3, 2 * VERDICT_LAYOUTS, Purpose.VERDICT).tolist()
    assert [int(seed) for seed in verdicts[0]] == known, "whoever has the seed can score it again"


def test_one_half_of_a_verdict_decides_and_the_other_is_reported() -> None:
    """The attempt that is kept is not the one whose reported score is the best."""
    state = begin(Course(lesson(5), 1, UNKNOWN))
    genomes = np.arange(3 * LENGTH, dtype=np.float32).reshape(3, LENGTH)
    verdicts = np.array([[1.0, 9.0], [3.0, 2.0], [3.0, 5.0]])
    passed = np.array([False, False, False])
    ended = replace(state, champions=genomes, lengths=np.array([7, 8, 9]), verdicts=verdicts, passed=passed)
    assert ended.kept.tobytes() == genomes[1].tobytes()
    assert ended.kept_after == 8
    assert ended.reevaluated == 2.0
    assert replace(ended, passed=np.array([True, False, False])).kept_after == 7, "who passed, before who did better"


class Listed(Sphere):
    """Scores by the first weight; faults where the second is above zero, only on the seeds given."""

    def __init__(self, faulty_on: range = range(2**64 - 1)) -> None:
        super().__init__()
        object.__setattr__(self, "faulty_on", faulty_on)

    def score(self, genomes: np.ndarray, seeds: np.ndarray, ticks: int | None = None) -> Results:
        total = np.repeat(genomes[:, :1].astype(np.float64), len(seeds), axis=1)
        faults = (genomes[:, 1:2] > 0) & np.array([int(seed) in self.faulty_on for seed in seeds])
        return Results(total, np.ones(total.shape, np.int64), faults.astype(np.int64), faults - 1)


def genomes_of(*firsts: float, faulty: float = 0.0) -> np.ndarray:
    genomes = np.zeros((len(firsts), LENGTH), np.float32)
    genomes[:, 0], genomes[:, 1] = firsts, faulty
    return genomes


def test_a_fault_makes_a_genome_worst_whatever_it_scored() -> None:
    marks = mark(Listed(range(3, 4)), np.concatenate([genomes_of(5.0), genomes_of(9.0, faulty=1.0)]), [3, 4, 5])
    assert marks.scores.tolist() == [5.0, -np.inf]
    assert marks.each.tolist() == [[5.0] * 3, [-np.inf, 9.0, 9.0]]
    assert marks.faults == 1
    assert marks.ticks == 6


@given(st.lists(st.integers(-9, 9), min_size=1, max_size=20), st.integers(1, 100))
def test_the_lowest_share_is_the_mean_of_the_worst_layouts(scores: list[int], percent: int) -> None:
    count = -(-len(scores) * percent // 100)
    worst = sorted(scores)[:count]
    assert lowest_mean(np.array([scores], np.float64), percent / 100)[0] == pytest.approx(sum(worst) / count)


def test_a_lesson_ends_once_its_champion_does_so_well_and_not_before() -> None:
    until = replace(lesson(100), until=Need("score", -8.0))
    state, records = taught(Course(until, 1, UNKNOWN), Sphere())
    whole, _ = taught(Course(lesson(100), 1, UNKNOWN), Sphere())
    assert len(records) < 100
    assert records[-1].reevaluated is not None
    assert -8.0 - 4.0 < state.reevaluated < whole.reevaluated


def test_a_fault_in_its_verdict_makes_an_attempt_the_worst() -> None:
    course = Course(lesson(5), 1, UNKNOWN)
    state = replace(begin_attempt(course), champion=genomes_of(9.0, faulty=1.0))
    verdict = judge(course, Listed(), state)
    assert verdict.scores.tolist() == [-np.inf, -np.inf]
    assert verdict.ticks == 2 * VERDICT_LAYOUTS
    assert verdict.faults == 2 * VERDICT_LAYOUTS


def tried(champion: np.ndarray, rival: np.ndarray, *scored: float) -> tuple[AttemptState, int, float]:
    """The state after a trial, its ticks, and the champion's score."""
    genomes = genomes_of(*scored)
    state = begin_attempt(Course(lesson(5), 1, UNKNOWN))
    state = replace(state, population=Population(genomes, genomes[:, 0].astype(np.float64), 12))
    state = replace(state, champion=champion, rival=rival, since=3)
    state, marks, score = reevaluate(state, Listed(), np.arange(REEVALUATION_LAYOUTS))
    return state, marks.ticks, score


def test_the_best_on_fresh_layouts_becomes_champion_but_never_the_rival() -> None:
    state, ticks, score = tried(genomes_of(4.0), genomes_of(9.0), 1.0, 5.0, 3.0)
    assert (state.champion[0, 0], score) == (5.0, 5.0)
    assert (state.rival[0, 0], state.since) == (9.0, 3)
    assert ticks == REEVALUATION_LAYOUTS * 5


def test_a_champion_that_is_best_stays_and_is_a_better_rival() -> None:
    state, _, score = tried(genomes_of(6.0), genomes_of(2.0), 1.0, 5.0)
    assert (state.champion[0, 0], score) == (6.0, 6.0)
    assert (state.rival[0, 0], state.since) == (6.0, 12)


def test_only_the_best_of_a_generation_are_tried_again() -> None:
    told = Told()
    genomes = genomes_of(*range(10))
    state = begin_attempt(Course(lesson(5), 1, UNKNOWN))
    state = replace(state, population=Population(genomes, -genomes[:, 0].astype(np.float64), 12))
    reevaluate(state, told, np.arange(REEVALUATION_LAYOUTS, dtype=np.uint64))
    assert [count for count, _ in told.asked] == [REEVALUATED_CANDIDATES]


def test_a_record_tells_of_its_generation_alone() -> None:
    course = Course(lesson(30), 1, UNKNOWN)
    one, two, *_ = stepped(course, Sphere(noise=0.0))
    (state, first), (after, second) = ((step.state, step.records[0]) for step in (one, two))
    scores = state.now.population.scores
    assert (first.best, first.mean) == (scores.max(), scores.mean())
    assert first.ticks == 100 * (20 * course.lesson.learner.layouts + REEVALUATED_CANDIDATES * REEVALUATION_LAYOUTS)
    assert first.generation == state.generations == state.now.population.generation == 1
    assert second.reevaluated is None
    assert second.ticks == 100 * 20 * course.lesson.learner.layouts
    assert after.best == max(first.best, second.best)


def test_whether_there_was_anything_to_learn_from() -> None:
    assert not taught(Course(lesson(3), 1, UNKNOWN), Flat())[0].told_apart
    assert not taught(Course(lesson(3), 1, UNKNOWN), Faulty(above=-1e9))[0].told_apart
    assert taught(Course(lesson(3), 1, UNKNOWN), Sphere())[0].told_apart
