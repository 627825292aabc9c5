"""An eye: how near the ball is that a camera sees, in some directions."""

from dataclasses import fields
from math import cos, radians, sin, sqrt
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.robot.camera import FRAME_SECONDS, BallCamera, BallSighting, distance
from mindrun.robot.driver_support import DEGREES, METRES, OpenSensor, Ranging
from mindrun.robot.drivers.ball_tracker import BallTracker


def along_ray(angle: float, metres: float, radius: float) -> float | None:
    """How far a ball's rim is along a ray at an angle to its middle, which is so many metres away; None beside it."""
    aside, ahead = metres * sin(angle), metres * cos(angle)
    if abs(aside) > radius or ahead < 0:
        return None
    return max(0.0, ahead - sqrt(radius * radius - aside * aside))


@kind("sensor driver", "ball_eye")
class BallEye(Ranging, BallCamera):
    """A camera that looks for a ball as `ball_tracker` does, for an `eye`: metres to it along each of some `angles`.

    They are those of the sensor, to the left positive; a ray that misses the ball of diameter `size`, or finds it
    farther away than `range`, reads none. Rays that the camera does not see, outside of half its `view` to either side,
    never find anything. Sensors can share the camera with others where all else is written the same.
    """

    angles: Annotated[tuple[float, ...], DEGREES]
    range: Annotated[float, METRES] = 3.0

    seconds = FRAME_SECONDS

    @property
    def readings(self) -> int:
        return len(self.angles)

    def open(self) -> OpenSensor:
        tracker = BallTracker(**{option.name: getattr(self, option.name) for option in fields(BallCamera)}).open()
        return OpenSensor(lambda: self.metres(tracker.sighting()), tracker.close)

    def metres(self, seen: BallSighting) -> tuple[float | None, ...]:
        """Metres to the ball along each ray in a frame; None where the ray misses it."""
        if seen.ball is None:
            return (None,) * self.readings
        metres = distance(seen.ball.diameter, self.size, seen.width, self.view)
        rays = (along_ray(radians(angle - seen.ball.bearing), metres, self.size / 2) for angle in self.angles)
        return tuple(found if found is not None and found <= self.range else None for found in rays)
