"""Where a mind says how long a unit is, a driver's range follows the sensor's, unless robot.yaml says it."""

import pytest

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source
from mindlang.robot.wire import check_wiring

MIND = """\
{unit}
tick 1/30 s
master Go
body Robot is disc
actuator wheel is wheel side left neutral 0.5
sensor it is {sensor}
skill Go is rule
  reads it
  drives wheel at it
task Roam in plain
  contains ball is item
  lasts 9 s
"""
WIRING = """\
robot: any
sensors:
  it:
{driver}
actuators:
  wheel:
    driver: mock
"""
SONAR = "    driver: ultrasonic\n    trigger: 5\n    echo: 6\n"


@pytest.mark.parametrize(
    ("unit", "said", "far"),
    [
        ("", "", 1.0),
        ("unit 8.5 cm", "", 12 * 0.085),
        ("unit 8.5 cm", "    range: 2 m", 2.0),
        ("unit 8.5 cm", "    to: 0.5 m", 0.5),
        ("number span is 50 mm\nunit span", "", 12 * 0.05),
    ],
)
def test_a_driver_sees_as_far_as_the_sensor(unit: str, said: str, far: float) -> None:
    assert _ends(unit, "range_finder at 0 deg range 12", f"{SONAR}{said}\n") == (0.0, pytest.approx(far))


ENCODER = "    driver: encoder\n    a: 5\n    b: 6\n    steps: 20\n"
CAMERA = "    driver: ball_tracker\n    measure: distance\n"


@pytest.mark.parametrize(
    ("sensor", "driver", "in_units", "usual"),
    [
        ("odometer side left range 10", ENCODER, (-10, 10), (-1, 1)),
        ("speed range 6", ENCODER, (-6, 6), (-1, 1)),
        ("position along x range 50", f"{ENCODER}    measure: distance\n", (-50, 50), (0, 1)),
        ("distance of ball range 40", CAMERA, (0, 40), (0, 3)),
        ("eye of ball at 0 deg range 30", "    driver: ball_eye\n    angles: [0 deg]\n", (0, 30), (0, 3)),
        ("range_finder at 0 deg range 12", CAMERA, (0, 12), (0, 3)),
    ],
)
def test_lengths_and_speeds_are_those_of_the_world(
    sensor: str, driver: str, in_units: tuple[float, float], usual: tuple[float, float]
) -> None:
    for unit, low, high in (
        ("unit 8.5 cm", *(0.085 * end for end in in_units)),
        ("unit 20 mm", *(0.02 * end for end in in_units)),
        ("", *usual),
    ):
        assert _ends(unit, sensor, driver) == (pytest.approx(low), pytest.approx(high))
    unit_ends = _ends("unit 8.5 cm", sensor, f"{driver}    to: 0.25 {'m/s' if usual[0] == -1 else 'm'}\n")
    assert unit_ends == (pytest.approx(0.085 * in_units[0]), 0.25)


@pytest.mark.parametrize(
    ("sensor", "driver", "usual"),
    [
        ("light of ball range 10", "    driver: ads1115\n    channel: 0\n", None),
        ("odometer side left", f"{ENCODER}    measure: angle\n", (0, 360)),
        ("bearing of ball", "    driver: ball_tracker\n", (180, -180)),
    ],
)
def test_what_is_no_length_is_as_its_driver_says(sensor: str, driver: str, usual: tuple[float, float] | None) -> None:
    assert _ends("unit 8.5 cm", sensor, driver) == _ends("", sensor, driver)
    assert usual in (None, _ends("", sensor, driver))


def _ends(unit: str, sensor: str, driver: str) -> tuple[float, float]:
    mind = compile_source(Source("any.mind", MIND.format(unit=unit, sensor=sensor)))
    assert mind.mind, mind.diagnostics
    assert mind.graph
    checked = check_wiring(Source("robot.yaml", WIRING.format(driver=driver)), mind.graph, mind.mind.unit_metres)
    assert checked.wiring, checked
    [wire] = checked.wiring.sensors
    return wire.low, wire.high
