"""Every fault of every kind of sensor, whenever it comes: what was declared happens within two ticks."""

from itertools import product
from math import inf, isnan, nan

import numpy as np
import pytest
from mindrun.graph.wiring import SensorWire, reading

from tests.robot.faults import FAULTS, SENSORS, TICK, Robot, Scripted, good, robot

NEUTRAL = np.array([0.5, 0.5, 0.0], np.float32)
PHASES = {"start": 0, "running": 7, "stopping": 18}
TICKS = 20


def sound(of: Robot) -> None:
    """No command that is not finite, or out of range."""
    for commands in of.sent.commands:
        assert np.isfinite(commands).all()
        assert (commands >= 0).all()
        assert (commands <= 1).all()


def moves(commands: np.ndarray) -> bool:
    return not np.array_equal(commands, NEUTRAL)


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_makes_everything_neutral_at_once(fault: str) -> None:
    for kind, (phase, begin) in product(SENSORS, PHASES.items()):
        of = robot(kind, [good] * begin + [FAULTS[fault]])
        for _ in range(TICKS):
            of.tick()
        sound(of)
        moved = [moves(commands) for commands in of.sent.commands]
        assert moved == of.sent.armed == [tick < begin for tick in range(TICKS)], (kind, phase)
        assert "sense" in of.loop.faulty, (kind, phase)


@pytest.mark.parametrize(("kind", "phase"), list(product(SENSORS, PHASES)))
def test_a_sensor_that_hangs_is_too_old_within_two_ticks(kind: str, phase: str) -> None:
    """A time-out, a blocked read, a stuck driver, a disconnected one: nothing new comes."""
    begin = PHASES[phase]
    of = robot(kind, [good])
    for tick in range(TICKS):
        of.hangs = tick >= begin
        of.tick()
    sound(of)
    assert all(moves(commands) for commands in of.sent.commands[:begin])
    assert not any(moves(commands) for commands in of.sent.commands[begin + 2 :])


@pytest.mark.parametrize("kind", SENSORS)
def test_it_goes_on_when_the_sensor_is_back(kind: str) -> None:
    of = robot(kind, [good] * 5 + [FAULTS["bus error"]] * 5 + [good])
    for _ in range(15):
        of.tick()
    assert [moves(commands) for commands in of.sent.commands] == [True] * 5 + [False] * 5 + [True] * 5
    assert of.loop.faulty == set()
    assert of.driver.closed == 5, "a device that failed is closed and opened anew"


@pytest.mark.parametrize("fault", FAULTS)
def test_a_reading_is_held_for_so_long(fault: str) -> None:
    of = robot("bearing", [good] * 5 + [FAULTS[fault]], on_fault="hold")
    readings = []
    for _ in range(15):
        of.tick()
        readings.append(of.loop.engine.readings[0])
    held = [moves(commands) for commands in of.sent.commands]
    assert held[:7] == [True] * 7, "it is a tick old when it is seen, and may become three and a half"
    assert not any(held[7:])
    assert set(readings[:7]) == {np.float32(0.6)}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_reading_can_be_blank(fault: str) -> None:
    of = robot("range_finder", [good] * 5 + [FAULTS[fault]], on_fault="blank")
    for _ in range(10):
        of.tick()
    assert all(moves(commands) for commands in of.sent.commands)
    assert list(of.loop.engine.readings[:3]) == [1, 1, 1]


def test_nothing_there_is_no_fault() -> None:
    of = robot("range_finder", [lambda count: [0.4, None, 0.6]])
    of.tick()
    assert of.loop.faulty == set()
    np.testing.assert_allclose(of.loop.engine.readings[:3], [0.4, 1.0, 0.6])


def test_a_median_leaves_out_a_spike() -> None:
    script = [good, good, lambda count: [0.0] * count, good, good]
    of = robot("range_finder", script, median=3)
    readings = []
    for _ in range(6):
        of.tick()
        readings.append(float(of.loop.engine.readings[0]))
    np.testing.assert_allclose(readings, 0.6)


@pytest.mark.parametrize("kind", ["bearing", "compass"])
def test_a_median_of_directions_goes_round(kind: str) -> None:
    script = [[0.99], [0.01], [0.02], [0.5], [0.98], [0.97]]
    of = robot(kind, script, median=3)
    readings = []
    for _ in script:
        of.tick()
        readings.append(float(of.loop.engine.readings[0]))
    np.testing.assert_allclose(readings[2:], [0.01, 0.02, 0.02, 0.97])
    assert min(readings[1], 1 - readings[1]) < 1e-6


@pytest.mark.parametrize(("kind", "expected"), [("compass", [0.25, 0.75, 0.4]), ("inertial", [1, 0, 0.4])])
def test_beyond_its_ends_a_direction_goes_round_and_nothing_else(kind: str, expected: list[float]) -> None:
    of = robot(kind, [[1.25], [-0.25], [0.4]])
    of.driver.possible = -9.0, 9.0
    readings = []
    for _ in expected:
        of.tick()
        readings.append(float(of.loop.engine.readings[0]))
    np.testing.assert_allclose(readings, expected, rtol=1e-6)


def test_what_begins_and_ends_is_told() -> None:
    of = robot("bearing", [good, FAULTS["bus error"], FAULTS["bus error"], good])
    told: list[str] = []
    of.loop.tell = told.append
    for _ in range(4):
        of.tick()
    assert told == ["sense the bus does not answer; is it wired?", "sense is fine again"]


@pytest.mark.parametrize(("missed", "stops"), [(0, False), (2, False), (3, True), (50, True)])
def test_three_ticks_that_were_missed_in_a_row_are_neutral_once(missed: int, stops: bool) -> None:
    of = robot("bearing", [good])
    of.tick()
    of.loop.pace.clock.now += (1.5 + missed) * TICK  # type: ignore[attr-defined]
    of.tick()
    of.tick()
    assert [moves(commands) for commands in of.sent.commands] == [True, not stops, True]
    assert of.loop.pace.missed == missed


@pytest.mark.parametrize(("ticks", "stops"), [(1.9, False), (2.1, True)])
def test_thoughts_that_took_two_ticks_are_not_sent(ticks: float, stops: bool) -> None:
    of = robot("bearing", [good])
    think = of.loop.engine.tick

    def slowly(readings: np.ndarray) -> np.ndarray:
        of.loop.pace.clock.now += ticks * TICK  # type: ignore[attr-defined]
        return think(readings)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(of.loop.engine, "tick", slowly)
        of.tick()
    of.tick()
    assert [moves(commands) for commands in of.sent.commands] == [not stops, True]


@pytest.mark.parametrize(("raw", "ends"), [(nan, (0, 1)), (inf, (0, 1)), (-inf, (1, 0)), (1e308, (0, 1e-300))])
def test_what_is_no_number_is_no_reading(raw: float, ends: tuple[float, float]) -> None:
    """max(0, min(1, NaN)) is 1: free sight, or full speed. What overflows is no number either."""
    assert isnan(reading(SensorWire("sense", Scripted(1, []), *ends), raw))
