"""Whoever is killed, stopped or told to end, whenever: every actuator ends at neutral, and one drives."""

import random
from pathlib import Path

import pytest

from tests.robot.campaign import play, rounds


@pytest.mark.parametrize("seed", [3])
def test_a_round_of_kills(tmp_path: Path, seed: int) -> None:
    play(tmp_path, random.Random(seed))


@pytest.mark.slow
def test_500_kills_and_stops() -> None:
    played = [*rounds(500, 1)]
    assert sum(len(round_.sent) for _, round_, _ in played) >= 500
    assert sum(bool(found.drivers) for *_, found in played) > len(played) / 3, "most of them never drove"
