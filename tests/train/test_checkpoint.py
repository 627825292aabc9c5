"""Checkpoints: read back to the bit, or not at all."""

from pathlib import Path

import numpy as np
import pytest
from mindrun.train import checkpoint
from mindrun.train.checkpoint import load, pack, save, unpack
from mindrun.train.errors import RunError
from mindrun.train.lesson import Course, State, begin, teach

from tests.train.climbing import LENGTH, Sphere, lesson

RUN = "a run"


@pytest.fixture(scope="module")
def states() -> list[State]:
    course = Course(lesson(8, population=6), 1, np.empty((0, LENGTH), np.float32))
    return [state for state, _ in teach(course, Sphere(), begin(course), lambda: 0.0)]


def test_a_state_reads_back_to_the_bit(states: list[State]) -> None:
    for state in states:
        again = unpack(pack(state, RUN), RUN)
        assert again is not None
        assert pack(again, RUN) == pack(state, RUN)


def test_every_truncation_is_refused(states: list[State]) -> None:
    whole = pack(states[2], RUN)
    assert all(unpack(whole[:length], RUN) is None for length in range(len(whole)))


def test_every_flipped_bit_is_refused(states: list[State]) -> None:
    whole, rng = pack(states[2], RUN), np.random.default_rng(0)
    for place in rng.choice(8 * len(whole), 1000, replace=False):
        damaged = bytearray(whole)
        damaged[place // 8] ^= 1 << place % 8
        assert unpack(bytes(damaged), RUN) is None


def test_another_run_s_checkpoint_is_refused(states: list[State]) -> None:
    assert unpack(pack(states[2], "another run"), RUN) is None


@pytest.mark.parametrize("damage", [b"", b"mind checkpoint 1\n", b"\0" * 5000])
def test_the_previous_one_is_taken_and_it_is_said(tmp_path: Path, states: list[State], damage: bytes) -> None:
    save(tmp_path, states[0], RUN)
    save(tmp_path, states[1], RUN)
    (tmp_path / checkpoint.NAME).write_bytes(damage)
    found = load(tmp_path, RUN)
    assert found is not None
    assert found.state.population.generation == 1
    assert "damaged" in found.warning


def test_a_damaged_one_never_replaces_the_good_previous_one(tmp_path: Path, states: list[State]) -> None:
    save(tmp_path, states[0], RUN)
    save(tmp_path, states[1], RUN)
    (tmp_path / checkpoint.NAME).write_bytes(b"damaged")
    save(tmp_path, states[2], RUN)
    (tmp_path / checkpoint.NAME).unlink()
    found = load(tmp_path, RUN)
    assert found is not None
    assert found.state.population.generation == 1


def test_a_crash_between_the_two_renames_costs_nothing_but_one_checkpoint(tmp_path: Path, states: list[State]) -> None:
    save(tmp_path, states[0], RUN)
    (tmp_path / checkpoint.NAME).rename(tmp_path / checkpoint.PREVIOUS)
    found = load(tmp_path, RUN)
    assert found is not None
    assert found.warning == ""


def test_with_nothing_whole_left_it_is_refused(tmp_path: Path, states: list[State]) -> None:
    save(tmp_path, states[0], RUN)
    (tmp_path / checkpoint.NAME).write_bytes(b"damaged")
    with pytest.raises(RunError, match="is damaged, and no other is left"):
        load(tmp_path, RUN)


def test_with_none_ever_written_there_is_none(tmp_path: Path) -> None:
    assert load(tmp_path, RUN) is None
