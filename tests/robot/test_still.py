"""What may not move yet moves nothing: not even a camera's neck."""

import pytest
from mindrun.driver import SensorDriver
from mindrun.graph.wiring import SensorWire, still
from mindrun.robot.drivers.ball_tracker import BallTracker
from mindrun.robot.drivers.lsm9ds1 import MagneticCompass, Motion, Turn
from mindrun.robot.drivers.mock import MockSensor


def test_a_camera_looks_straight_ahead() -> None:
    wire = still(SensorWire("ball_bearing", BallTracker(pan=0, tilt=1), 180.0, -180.0))
    assert wire.driver == BallTracker()
    assert (wire.low, wire.high) == (180.0, -180.0)


@pytest.mark.parametrize("driver", [MockSensor(0.3), Turn(still=0.2), Motion(), MagneticCompass()])
def test_other_sensors_are_as_they_are(driver: SensorDriver) -> None:
    wire = SensorWire("any", driver, 0.0, 1.0)
    assert still(wire) == wire
