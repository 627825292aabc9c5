"""Where a mind says how long a unit is, a driver's range follows the sensor's, unless robot.yaml says it."""

import pytest

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source
from mindlang.wiring.wire import check_wiring

MIND = """\
{unit}
tick 1/30 s
master Go
body Robot is disc
actuator wheel is wheel side left neutral 0.5
sensor eye is range_finder at 0 deg range 12
skill Go is rule
  reads eye
  drives wheel at eye
"""
WIRING = """\
robot: any
sensors:
  eye:
    driver: ultrasonic
    trigger: 5
    echo: 6
{}
actuators:
  wheel:
    driver: mock
"""


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
    mind = compile_source(Source("any.mind", MIND.format(unit=unit)))
    assert mind.mind is not None
    assert mind.graph is not None
    checked = check_wiring(Source("robot.yaml", WIRING.format(said)), mind.graph, mind.mind.unit_metres)
    assert checked.wiring is not None
    [wire] = checked.wiring.sensors
    assert (wire.low, wire.high) == (0.0, pytest.approx(far))
