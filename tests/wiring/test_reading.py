"""From a raw value to a reading: as in training, and a fault where a number is none."""

from math import inf, isnan, nan
from statistics import median

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from mindrun.graph.wiring import SensorWire, reading
from mindrun.robot.drivers.mock import MockSensor
from mindrun.robot.sensing import median_direction

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


TURN_BEGINS = st.floats(-720, 720)


def apart(one: float, other: float) -> float:
    """How far two directions are from one another, in turns."""
    between = (one - other) % 1
    return min(between, 1 - between)


@given(TURN_BEGINS, st.sampled_from([360.0, -360.0]), st.floats(-1000, 1000), st.floats(-1000, 1000))
@example(180.0, -360.0, 175.0, 10.0)
@example(0.0, 360.0, 359.9, 5.0)
def test_a_direction_goes_round(low: float, turn: float, raw: float, more: float) -> None:
    """What is turned by so much more reads so much more, wherever its driver begins to count."""
    wire = SensorWire("north", MockSensor(), low, low + turn, rest=0.5)
    now, then = (reading(wire, value, circular=True) for value in (raw, raw + more))
    assert 0 <= now <= 1
    assert apart(then, now + more / turn) < 1e-9


def test_what_is_within_the_range_is_not_touched() -> None:
    wire = SensorWire("north", MockSensor(), 180.0, -180.0, rest=0.5)
    found = [reading(wire, raw, circular=True) for raw in (180.0, -180.0, 181.8, -181.8)]
    assert found == pytest.approx([0.0, 1.0, 0.995, 0.005])
    assert str(found[0]) == "0.0"


DIRECTIONS = st.floats(0, 1)
OFFSETS = st.lists(st.floats(-0.1, 0.1), min_size=1, max_size=8)


@given(st.data(), DIRECTIONS, OFFSETS)
def test_the_median_of_directions_is_that_of_what_lies_between_them(
    data: st.DataObject, middle: float, offsets: list[float]
) -> None:
    near = [(middle + offset) % 1 for offset in offsets]
    assert apart(median_direction(near), middle + median(offsets)) < 1e-9
    stray = data.draw(st.lists(DIRECTIONS, max_size=len(near) - 1))
    found = median_direction(data.draw(st.permutations([*near, *stray])))
    assert 0 <= found <= 1
    assert apart(found, middle) <= 0.1 + 1e-9
