"""A camera that looks for a luminous ball, and turns after it where it can."""

import atexit
from dataclasses import dataclass, replace
from time import sleep
from typing import Annotated, Literal, get_args

from mindrun.driver import DeviceError
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import Reference
from mindrun.robot import camera
from mindrun.robot.camera import FRAME_SECONDS, BallCamera, BallSighting, Joint, TrackingCamera, distance
from mindrun.robot.driver_support import ADDRESS, BUS, CHANNEL, DEGREES, MICROSECONDS, SharedParts, answering
from mindrun.robot.drivers.pca9685 import Pca9685
from mindrun.robot.i2c import on_bus

Measure = Literal["bearing", "elevation", "distance"]
MEASURE = Reference("measure", get_args(Measure))
MAX_FRAME_AGE_SECONDS = 0.2  # seconds without a frame that are a fault
FIRST_FRAME_SECONDS = 5.0  # until the first frame: cameras take their time to start
CENTRING_SECONDS = 0.4  # seconds that servos need to the middle

cameras = SharedParts["BallTracker", TrackingCamera]()
atexit.register(cameras.close)  # Python must not end threads while they are inside OpenCV


@dataclass(slots=True)
class BallTrackerDevice:
    """One thing that is measured of the ball."""

    driver: "BallTracker"
    tracking: TrackingCamera
    number: int = 0
    closed: bool = False

    def read(self) -> tuple[float | None]:
        """The value in the newest frame that was not read before, degrees or metres; None where no ball is in it."""
        sighting, driver = self.sighting(), self.driver
        if sighting.ball is None:
            return (None,)
        match driver.measure:
            case "bearing":
                return ((sighting.aim.pan + sighting.ball.bearing + 180) % 360 - 180,)
            case "elevation":
                return (sighting.aim.tilt + sighting.ball.elevation,)
        return (distance(sighting.ball.diameter, driver.size, sighting.width, driver.view),)

    def sighting(self) -> BallSighting:
        """The sighting in the newest frame that was not read before."""
        sighting = self.tracking.after(self.number, MAX_FRAME_AGE_SECONDS)
        self.number = sighting.number
        return sighting

    def close(self) -> None:
        """Let go of the camera; the last one who looks through it turns it off."""
        if self.closed:
            return
        self.closed = True
        cameras.release(self.driver.camera_alone())


@kind("sensor driver", "ball_tracker")
class BallTracker(BallCamera):
    """A camera that looks for the largest round thing that is bright and has a hue: 0 red, 120 green, 240 blue.

    `measure` says what is read: the bearing or the elevation in degrees, to the left and up positive, or the distance
    in metres to a ball of diameter `size`. Several sensors can read of one camera, where all else is written the same.
    Where no ball is seen there is none; no frame, the same one, a black or a white one is a fault.

    `camera` is a path: /dev/video0, or a film. With `pan` and `tilt`, channels of a PCA9685 servo card, it turns after
    the ball and back to the middle when it has lost it; each servo does `travel` degrees between its pulses, negative
    where the longest one turns it to the right, or down. The servos turn only where the robot is armed.
    """

    measure: Annotated[Measure, MEASURE] = "bearing"
    pan: Annotated[int | None, CHANNEL] = None
    tilt: Annotated[int | None, CHANNEL] = None
    travel: Annotated[float, DEGREES] = 90.0
    tilt_travel: Annotated[float, DEGREES] = 90.0
    shortest: Annotated[float, MICROSECONDS] = 1000.0
    longest: Annotated[float, MICROSECONDS] = 2000.0
    bus: Annotated[int, BUS] = 1
    address: Annotated[int, ADDRESS] = 0x40

    readings = 1
    seconds = FRAME_SECONDS

    @property
    def unit(self) -> str:
        return "m" if self.measure == "distance" else "deg"

    @property
    def usual(self) -> tuple[float, float]:
        """A bearing is 0.5 straight ahead, less on the left and more on the right; so is an elevation, less above."""
        return (0.0, 3.0) if self.measure == "distance" else (180.0, -180.0)

    @property
    def possible(self) -> tuple[float, float]:
        return (0.0, 100.0) if self.measure == "distance" else (-180.0, 180.0)

    def camera_alone(self) -> "BallTracker":
        """This driver, whatever it measures: equal for those that share a camera."""
        return replace(self, measure="bearing")

    @property
    def device(self) -> str:
        """The card of its neck's servos, which only one process may drive; "" where it has no neck."""
        return "" if self.pan is None and self.tilt is None else on_bus(self.bus, self.address)

    @property
    def motionless(self) -> "BallTracker":
        """This camera without its neck: for a robot that may not move yet."""
        return replace(self, pan=None, tilt=None)

    def open(self) -> BallTrackerDevice:
        tracking = cameras.acquire(self.camera_alone(), self.open_tracking)
        return answering(BallTrackerDevice(self, tracking), lambda: tracking.after(0, FIRST_FRAME_SECONDS))

    def open_tracking(self) -> TrackingCamera:
        """The camera, and its servos, in the middle."""
        tracking = TrackingCamera(camera.open_camera(self.camera, self.width, self.height), self)
        try:
            tracking.pan = self.joint(self.pan, self.travel)
            tracking.tilt = self.joint(self.tilt, self.tilt_travel)
            tracking.point()
        except Exception:
            tracking.let_go()
            raise
        if tracking.pan or tracking.tilt:
            sleep(CENTRING_SECONDS)
        tracking.thread.start()
        return tracking

    def joint(self, channel: int | None, travel: float) -> Joint | None:
        """A servo of the neck, where it has one."""
        if channel is None:
            return None
        if not travel:
            raise DeviceError(f"the servo on channel {channel} has no travel")
        servo = Pca9685(channel, self.shortest, self.longest, self.bus, self.address)
        return Joint(servo.open(), travel)
