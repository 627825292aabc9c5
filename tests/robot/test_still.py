"""What may not move yet moves nothing: not even a camera's neck."""

from mindrun.robot.drivers.ball_tracker import BallTracker
from mindrun.robot.drivers.mock import MockSensor
from mindrun.robot.wiring import SensorWire, still


def test_a_camera_looks_straight_ahead() -> None:
    wire = still(SensorWire("ball_bearing", BallTracker(pan=0, tilt=1), 180.0, -180.0))
    assert wire.driver == BallTracker()
    assert (wire.low, wire.high) == (180.0, -180.0)


def test_other_sensors_are_as_they_are() -> None:
    wire = SensorWire("charge", MockSensor(0.3), 0.0, 1.0)
    assert still(wire) == wire
