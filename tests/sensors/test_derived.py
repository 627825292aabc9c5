"""Sensors that are computed, not measured: in the lanes they read the bits that the engine reads."""

from types import SimpleNamespace
from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.kinds.sensors.derived import Average, Derivative, Latch, Reading
from mindrun.kinds.sensors.sensor import Scene
from mindrun.kinds.sensors.waves import Clock, Sine
from mindrun.sim.codes import SENSOR, records

from tests.draws import cases
from tests.sensors.plain_lanes import plain_lane

SOURCE, START, ROWS, LANES = slice(1, 3), 4, 7, 2
NUMBERS = st.floats(0, 1, width=32) | st.just(np.nan)
ENDS = st.tuples(st.floats(0, 1), st.floats(0, 1)).map(sorted)
KINDS = st.one_of(
    st.builds(Average, st.just("x"), st.integers(1, 5)),
    st.builds(Derivative, st.just("x"), st.floats(0.1, 9), st.floats(0, 0.6)),
    ENDS.map(lambda ends: Latch("x", *ends)),
    st.builds(Reading, st.integers(1, 2), st.just("x")),
    st.builds(Clock, st.floats(0.05, 3)),
    st.builds(Sine, st.floats(0.05, 3)),
)


@settings(max_examples=cases(100), deadline=None)
@given(KINDS, st.lists(st.tuples(*[NUMBERS] * 2 * LANES), min_size=1, max_size=12), st.booleans())
def test_lanes_read_what_the_engine_reads(kind: Any, ticks: list[tuple[float, ...]], turns: bool) -> None:
    scene = Scene(0.1, {"x": SOURCE}, {"x"} if turns else set())
    width = 2 if kind.shape is None else 1
    columns = {"start": START, "width": width, "before": 1, "turns": turns, **kind.row(scene)}
    row = records([columns], SENSOR).view(np.recarray)[0]
    lanes = SimpleNamespace(
        readings=np.zeros((ROWS, LANES), np.float32), before=np.zeros((1 + width * kind.remembered, LANES), np.float32),
        tick=np.zeros(LANES, np.int64), stack=np.zeros((1, LANES)),
    )  # fmt: skip
    readers, last = [kind.reader(scene) for _ in range(LANES)], None
    for number, now in enumerate(ticks):
        expected = lanes.readings.copy()
        expected[SOURCE] = lanes.readings[SOURCE] = np.reshape(now, (2, LANES))
        lanes.tick[:] = number
        for lane, read in enumerate(readers):
            before = None if last is None else last[:, lane]
            expected[START : START + width, lane] = read(number, expected[:, lane], before)
        plain_lane(kind.lane)(None, lanes, LANES, number, row)
        assert np.array_equal(lanes.readings, expected, equal_nan=True)
        last = expected
