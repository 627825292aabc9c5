"""Sensors that are computed, not measured: in the lanes they read the bits that the engine reads."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from mindrun.kinds.sensors.derived import Average, Derivative, Latch, Reading
from mindrun.kinds.sensors.sensor import Scene
from mindrun.kinds.sensors.waves import Clock, Sine
from mindrun.sim.codes import SENSOR, records

from tests.sensors.plain_lanes import plain_lane

SOURCE, START, ROWS, LANES, TICKS = slice(1, 3), 4, 7, 2, 200
NUMBERS = (0.0, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.98, 1.0, np.nan)


@pytest.mark.parametrize("turns", [False, True])
@pytest.mark.parametrize(
    "kind",
    [
        *(Average("x", over) for over in (1, 2, 5)),
        *(Derivative("x", *each) for each in ((0.5, 0.0), (9.0, 0.1), (4.0, 0.05))),
        *(Latch("x", *each) for each in ((0.3, 0.7), (0.5, 0.5), (0.0, 0.9))),
        *(Reading(number, "x") for number in (1, 2)),
        *(wave(period) for wave in (Clock, Sine) for period in (0.1, 0.3, 0.77, 3.0)),
    ],
)
def test_lanes_read_what_the_engine_reads(kind: Any, turns: bool) -> None:
    scene, rng = Scene(0.1, {"x": SOURCE}, {"x"} if turns else set()), np.random.default_rng(5)
    width = 2 if kind.shape is None else 1
    columns = {"start": START, "width": width, "before": 1, "turns": turns, **kind.row(scene)}
    row = records([columns], SENSOR).view(np.recarray)[0]
    lanes = SimpleNamespace(
        readings=np.zeros((ROWS, LANES), np.float32), before=np.ones((1 + width * kind.remembered, LANES), np.float32),
        tick=np.zeros(LANES, np.int64), stack=np.zeros((1, LANES)),
    )  # fmt: skip
    readers, last = [kind.reader(scene) for _ in range(LANES)], None
    for number in range(TICKS):
        expected = lanes.readings.copy()
        drawn = np.where(rng.random((2, LANES)) < 0.5, rng.random((2, LANES)), rng.choice(NUMBERS, (2, LANES)))
        expected[SOURCE] = lanes.readings[SOURCE] = drawn
        lanes.tick[:] = number
        for lane, read in enumerate(readers):
            before = None if last is None else last[:, lane]
            expected[START : START + width, lane] = read(number, expected[:, lane], before)
        plain_lane(kind.lane)(None, lanes, LANES, number, row)
        assert np.array_equal(lanes.readings, expected, equal_nan=True)
        last = expected
