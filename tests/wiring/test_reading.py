"""From a raw value to a reading: as in training, and a fault where a number is none."""

from math import inf, isnan, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.robot.drivers.mock import MockSensor
from mindrun.wiring import SensorWire, reading

FINDER = SensorWire("p", MockSensor(), 0.0, 2.0, blank=1.0, dead_zone=0.1, rest=0.0)
BEARING = SensorWire("b", MockSensor(), 180.0, -180.0, blank=0.5, dead_zone=0.05, rest=0.5)


@pytest.mark.parametrize(
    ("wire", "raw", "expected"),
    [
        (FINDER, 0.0, 0.0), (FINDER, 1.0, 0.5), (FINDER, 2.0, 1.0), (FINDER, -1.0, 0.0), (FINDER, 99.0, 1.0),
        (FINDER, 0.19, 0.0), (FINDER, 0.21, 0.105), (FINDER, None, 1.0),
        (BEARING, 0.0, 0.5), (BEARING, 17.0, 0.5), (BEARING, -17.0, 0.5), (BEARING, 90.0, 0.25), (BEARING, -90.0, 0.75),
        (BEARING, 180.0, 0.0), (BEARING, None, 0.5), (BEARING, 1e300, 0.0),
    ],
)  # fmt: skip
def test_a_reading(wire: SensorWire, raw: float | None, expected: float) -> None:
    assert reading(wire, raw) == pytest.approx(expected)


@pytest.mark.parametrize("raw", [nan, inf, -inf])
def test_what_is_not_finite_is_a_fault_and_not_full_speed(raw: float) -> None:
    assert isnan(reading(FINDER, raw))
    assert isnan(reading(BEARING, raw))


@given(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6), st.floats() | st.none())
def test_a_reading_is_a_share_or_a_fault(low: float, high: float, raw: float | None) -> None:
    if low != high:
        found = reading(SensorWire("x", MockSensor(), low, high, dead_zone=0.01), raw)
        assert isnan(found) or 0 <= found <= 1
