"""The figures that docs/safety.md promises, each with as many trials as it says: minutes.

No trial may miss, and 19 in 20 are in time: a machine with other work lets a process wait, before it dies, too.
"""

import random
import statistics
from pathlib import Path

import pytest

from tests.robot.guardian.driven import TICK
from tests.robot.guardian.scenes import HANGS, KILLS, LOSSES, NEUTRALS, hang, kill, lose, robot, start

pytestmark = pytest.mark.slow

AT_ONCE = 0.05  # seconds after a death
REPLACED = 2.0  # seconds after a guardian was killed or stopped
IN_TIME = 2 * TICK + 0.01  # seconds after the beginning of a hang


def most(what: str, times: list[float | None]) -> float:
    """The time that 19 in 20 keep, of which none is missing; they are printed."""
    assert None not in times
    found = [time for time in times if time is not None]
    print(f"{len(found)} {what}: median {statistics.median(found) * 1e3:.1f} ms, max {max(found) * 1e3:.1f} ms")
    return statistics.quantiles(found, n=20)[-1]


def test_500_kills(tmp_path: Path) -> None:
    rng = random.Random(1)
    for number in KILLS:
        times = [kill(tmp_path, number, rng) for _ in range(167)]
        assert most(number.name, times) <= AT_ONCE


def test_100_guardians_that_are_lost(tmp_path: Path) -> None:
    rng = random.Random(1)
    for number in LOSSES:
        assert most(f"lost by {number.name}", [lose(tmp_path, number, rng) for _ in range(50)]) <= REPLACED


def test_500_hangs(tmp_path: Path) -> None:
    rng = random.Random(1)
    for how in HANGS:
        times = []
        for _ in range(7):  # a log of many would take long to read
            with robot(tmp_path) as found:
                times += [hang(found, how, rng) for _ in range(24)]
        assert most(how, times) <= IN_TIME


def test_1000_starts(tmp_path: Path) -> None:
    for index in range(1000):
        written = start(tmp_path, eager=bool(index % 2))
        assert [next(write.value for write in written if write.channel == c) for c in range(3)] == list(NEUTRALS)
