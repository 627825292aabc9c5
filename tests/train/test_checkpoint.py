"""Checkpoints: read back to the bit, or not at all."""

import json
from collections.abc import Callable
from dataclasses import replace
from hashlib import sha256
from pathlib import Path

import numpy as np
import pytest
from mindrun.train import RunError, checkpoint
from mindrun.train.checkpoint import load, pack, save, unpack
from mindrun.train.lesson_state import Course, LessonState, begin

from tests.train.climbing import LENGTH, Sphere, lesson
from tests.train.sequential import teach

RUN = "a run"


@pytest.fixture(scope="module")
def states() -> list[LessonState]:
    course = Course(lesson(8, population=6), 1, np.empty((0, LENGTH), np.float32))
    return [state for state, _ in teach(course, Sphere(), begin(course), lambda: 0.0)]


def test_a_state_reads_back_to_the_bit(states: list[LessonState]) -> None:
    for state in (*states, at(states[2], rival=2 * states[2].now.champion)):
        again = unpack(pack(state, RUN), RUN)
        assert again is not None
        assert pack(again, RUN) == pack(state, RUN)


def test_every_truncation_is_refused(states: list[LessonState]) -> None:
    whole = pack(states[2], RUN)
    assert all(unpack(whole[:length], RUN) is None for length in range(len(whole)))


def test_every_flipped_bit_is_refused(states: list[LessonState]) -> None:
    whole, rng = pack(states[2], RUN), np.random.default_rng(0)
    for place in rng.choice(8 * len(whole), 1000, replace=False):
        damaged = bytearray(whole)
        damaged[place // 8] ^= 1 << place % 8
        assert unpack(bytes(damaged), RUN) is None


@pytest.fixture(scope="module")
def second() -> LessonState:
    """A state in its second attempt, in which nothing is empty."""
    course = Course(lesson(4, population=6, attempts=2, rungs=1), 1, np.empty((0, LENGTH), np.float32))
    return list(teach(course, Sphere(), begin(course), lambda: 0.0))[4][0]


def among(array: np.ndarray, number: float) -> np.ndarray:
    """The array with one number in the place of its last."""
    return np.append(array.ravel()[:-1], np.array(number, array.dtype)).reshape(array.shape)


def of(state: LessonState, **changes: object) -> LessonState:
    """The state with another population."""
    return at(state, population=replace(state.now.population, **changes))


def at(state: LessonState, **changes: object) -> LessonState:
    """The state with another attempt at work."""
    return replace(state, now=replace(state.now, **changes))


BROKEN: dict[str, Callable[[LessonState], LessonState]] = {
    "a score too few": lambda s: of(s, scores=s.now.population.scores[:-1]),
    "a champion of other weights": lambda s: at(s, champion=s.now.champion[:, 1:]),
    "a rival of other weights": lambda s: at(s, rival=s.now.rival[:, 1:]),
    "champions of other weights": lambda s: replace(s, champions=s.champions[:, 1:]),
    "two champions": lambda s: at(s, champion=np.repeat(s.now.champion, 2, axis=0)),
    "two rivals": lambda s: at(s, rival=np.repeat(s.now.rival, 2, axis=0)),
    "a rung that is no number": lambda s: replace(s, rungs=among(s.rungs, np.nan)),
    "a height that is no number": lambda s: at(s, climbed=among(s.now.climbed, np.nan)),
    "rungs of an attempt too few": lambda s: replace(s, rungs=s.rungs[:-1]),
    "a length too many": lambda s: replace(s, lengths=np.repeat(s.lengths, 2)),
    "a verdict too few": lambda s: replace(s, verdicts=s.verdicts[:0]),
    "a pass too few": lambda s: replace(s, passed=s.passed[:0]),
    "half a verdict": lambda s: replace(s, verdicts=s.verdicts[:, :1]),
    "a genome that is not finite": lambda s: of(s, genomes=among(s.now.population.genomes, np.inf)),
    "a genome that is no number": lambda s: of(s, genomes=among(s.now.population.genomes, np.nan)),
    "a champion that is not finite": lambda s: at(s, champion=among(s.now.champion, -np.inf)),
    "a rival that is not finite": lambda s: at(s, rival=among(s.now.rival, np.inf)),
    "champions that are not finite": lambda s: replace(s, champions=among(s.champions, np.nan)),
    "a score that is no number": lambda s: of(s, scores=among(s.now.population.scores, np.nan)),
    "a verdict that is no number": lambda s: replace(s, verdicts=among(s.verdicts, np.nan)),
    "a best that is no number": lambda s: replace(s, best=np.nan),
    "seconds that are no number": lambda s: replace(s, seconds=np.nan),
    "an attempt too many": lambda s: replace(s, attempt=2),
    "an attempt too few": lambda s: replace(s, attempt=0),
    "genomes before the first generation": lambda s: of(s, generation=0),
    "no genomes after one": lambda s: of(s, genomes=s.now.population.genomes[:0], scores=np.empty(0)),
    "less than no time": lambda s: replace(s, ticks=-1),
    "a length of less than nothing": lambda s: replace(s, lengths=among(s.lengths, -1)),
    "more ticks than can be": lambda s: replace(s, ticks=2**53 + 1),
    "neither told apart nor not": lambda s: replace(s, told_apart=2),  # type: ignore[arg-type]
}
WHOLE: dict[str, Callable[[LessonState], LessonState]] = {
    "scores of faults": lambda s: of(s, scores=among(s.now.population.scores, -np.inf)),
    "a verdict of a fault": lambda s: replace(s, verdicts=among(s.verdicts, -np.inf)),
    "as many ticks as can be": lambda s: replace(s, ticks=2**53),
    "nothing told apart": lambda s: replace(s, told_apart=False),
    "no champion": lambda s: at(s, champion=s.now.champion[:0], rival=s.now.rival[:0]),
}


@pytest.mark.parametrize("what", BROKEN)
def test_a_state_that_no_run_has_is_refused_though_its_hash_is_right(second: LessonState, what: str) -> None:
    assert unpack(pack(BROKEN[what](second), RUN), RUN) is None


@pytest.mark.parametrize("what", WHOLE)
def test_a_state_that_a_run_can_have_is_read(second: LessonState, what: str) -> None:
    again = unpack(pack(WHOLE[what](second), RUN), RUN)
    assert again is not None
    assert pack(again, RUN) == pack(WHOLE[what](second), RUN)
    assert [type(each) for each in _plain(again)] == [int, int, int, int, float, float, bool]


def _plain(state: LessonState) -> tuple[object, ...]:
    generation = state.now.population.generation
    return state.attempt, generation, state.now.since, state.ticks, state.best, state.seconds, state.told_apart


def test_the_header_says_what_follows_and_nothing_else(second: LessonState) -> None:
    body = pack(second, RUN)[:-32]
    magic, line, rest = body.split(b"\n", 2)
    header = json.loads(line)

    def unsealed(header: object, rest: bytes = rest, magic: bytes = magic) -> LessonState | None:
        data = magic + b"\n" + json.dumps(header).encode() + b"\n" + rest
        return unpack(data + sha256(data).digest(), RUN)

    assert unsealed(header) is not None
    arrays = header["arrays"]
    for name, (dtype, shape) in arrays.items():
        for other in (">f4", "<i4", "<f4", "<f8", "<i8", None):
            if other != dtype:
                assert unsealed(header | {"arrays": arrays | {name: [other, shape]}}) is None
        for changed in (
            shape[:-1],
            [*shape, 1],
            [shape[0] + 1, *shape[1:]],
            [-1, *shape[1:]],
            [float(shape[0]), *shape[1:]],
        ):
            assert unsealed(header | {"arrays": arrays | {name: [dtype, changed]}}) is None
        assert unsealed(header | {"arrays": arrays | {name: [dtype, shape, 1]}}) is None
        assert unsealed(header | {"arrays": {key: arrays[key] for key in arrays if key != name}}) is None
    assert unsealed(header | {"arrays": dict(reversed(arrays.items()))}) is None
    assert unsealed(header | {"arrays": list(arrays.values())}) is None
    assert unsealed(header | {"more": 1}) is None
    assert unsealed({"run": RUN}) is None
    assert unsealed(header | {"run": "another run"}) is None
    assert unsealed([header]) is None
    assert unsealed(header, rest[:-1]) is None
    assert unsealed(header, rest + b"\0") is None
    assert unsealed(header, magic=b"mind checkpoint 3") is None
    data = magic + b"\n" + line[:-1] + b"\n" + rest
    assert unpack(data + sha256(data).digest(), RUN) is None


def test_another_run_s_checkpoint_is_refused(states: list[LessonState]) -> None:
    assert unpack(pack(states[2], "another run"), RUN) is None


@pytest.mark.parametrize("damage", [b"", b"mind checkpoint 1\n", b"\0" * 5000])
def test_the_previous_one_is_taken_and_it_is_said(tmp_path: Path, states: list[LessonState], damage: bytes) -> None:
    save(tmp_path, states[0], RUN)
    save(tmp_path, states[1], RUN)
    (tmp_path / checkpoint.NAME).write_bytes(damage)
    found = load(tmp_path, RUN)
    assert found is not None
    assert found[0].now.population.generation == 1
    assert "damaged" in found[1]


def test_a_damaged_one_never_replaces_the_good_previous_one(tmp_path: Path, states: list[LessonState]) -> None:
    save(tmp_path, states[0], RUN)
    save(tmp_path, states[1], RUN)
    (tmp_path / checkpoint.NAME).write_bytes(b"damaged")
    save(tmp_path, states[2], RUN)
    (tmp_path / checkpoint.NAME).unlink()
    found = load(tmp_path, RUN)
    assert found is not None
    assert found[0].now.population.generation == 1


def test_a_crash_between_the_two_renames_costs_nothing_but_one_checkpoint(
    tmp_path: Path, states: list[LessonState]
) -> None:
    save(tmp_path, states[0], RUN)
    (tmp_path / checkpoint.NAME).rename(tmp_path / checkpoint.PREVIOUS)
    found = load(tmp_path, RUN)
    assert found is not None
    assert found[1] == ""


def test_with_nothing_whole_left_it_is_refused(tmp_path: Path, states: list[LessonState]) -> None:
    save(tmp_path, states[0], RUN)
    (tmp_path / checkpoint.NAME).write_bytes(b"damaged")
    with pytest.raises(RunError, match="is damaged, and no other is left"):
        load(tmp_path, RUN)


def test_with_none_ever_written_there_is_none(tmp_path: Path) -> None:
    assert load(tmp_path, RUN) is None
