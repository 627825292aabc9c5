"""A camera that a thread of its own watches, and turns after a ball, so that one that hangs holds up nobody."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from threading import Condition, Event, Thread
from time import monotonic, sleep
from typing import TYPE_CHECKING, Any, Protocol

from mindrun.driver import ActuatorDevice, DeviceError
from mindrun.robot.ball_detection import Aim, Ball, BallTarget, PanTiltLimits, blindness, find_ball, follow
from mindrun.robot.driver_support import library

if TYPE_CHECKING:
    from mindrun.numbers.arrays import Frame

FRAME_SECONDS = 1 / 30  # of most cameras
STALE_SECONDS = 0.2  # for which the same frame may come
RETRY_SECONDS = 0.02  # between two questions to a camera that has no frame
LETTING_GO = 1.0  # seconds that the thread may need to end
AHEAD = Aim()
STILL_IMAGE_STRIDE = 8  # every so many pixels are compared with the frame before


class Camera(Protocol):
    """Where frames come from: `read` blocks until there is one, and says whether there is."""

    def read(self) -> tuple[bool, Frame]: ...

    def release(self) -> None: ...


@dataclass(slots=True)
class RecordedFilm:
    """A recorded film, shown as fast as it was recorded."""

    capture: Any
    interval: float
    due: float = 0.0

    def read(self) -> tuple[bool, Frame]:
        """The next frame when it is due."""
        sleep(max(0.0, self.due - monotonic()))
        self.due = max(self.due, monotonic() - self.interval) + self.interval
        found: tuple[bool, Frame] = self.capture.read()
        return found

    def release(self) -> None:
        self.capture.release()


def open_camera(path: str, width: int, height: int) -> Camera:
    """The camera, or the film, of that path; tests put a camera of their own here."""
    cv2 = library("cv2")
    cv2.setNumThreads(1)  # more gain nothing at this size, and the other cores have other things to do
    film = Path(path).is_file()
    capture = cv2.VideoCapture(path, cv2.CAP_ANY if film else cv2.CAP_V4L2)
    if not capture.isOpened():
        raise DeviceError(f"the camera {path} cannot be opened", "is it there, and free? ls /dev/video*")
    if film:
        return RecordedFilm(capture, 1 / (capture.get(cv2.CAP_PROP_FPS) or 30.0))
    capture.set(cv2.CAP_PROP_FRAME_WIDTH, width)
    capture.set(cv2.CAP_PROP_FRAME_HEIGHT, height)
    capture.set(cv2.CAP_PROP_BUFFERSIZE, 1)  # an old frame is an old bearing
    opened: Camera = capture
    return opened


@dataclass(frozen=True, slots=True)
class Joint:
    """A servo of the neck: `travel` degrees from command 0 to 1, negative where that is to the right, or down."""

    servo: ActuatorDevice
    travel: float

    def point(self, angle: float) -> None:
        """Turn it to an angle from the middle."""
        self.servo.write(min(1.0, max(0.0, 0.5 + angle / self.travel)))


@dataclass(frozen=True, slots=True)
class BallSighting:
    """What was seen in a frame, where the camera pointed, and how wide the frame was; or why there was nothing."""

    number: int = 0
    ball: Ball | None = None
    aim: Aim = AHEAD
    width: int = 1
    error: DeviceError | None = None


@dataclass(slots=True, eq=False)
class TrackingCamera:
    """A camera, what it looks for, and the joints that turn it, pan and tilt, as far as it has them."""

    camera: Camera
    target: BallTarget
    limits: PanTiltLimits
    pan: Joint | None = None
    tilt: Joint | None = None
    sighting: BallSighting = field(default_factory=BallSighting)
    aim: Aim = AHEAD
    then: float = field(default_factory=monotonic)
    sample: Frame | None = None
    changed: float = field(default_factory=monotonic)
    news: Condition = field(default_factory=Condition)
    stop: Event = field(default_factory=Event)
    thread: Thread = field(init=False)

    def __post_init__(self) -> None:
        self.thread = Thread(target=self.watch, name="camera", daemon=True)

    def close(self) -> None:
        """Tell the thread to end; it lets go of the camera, at the latest when that answers."""
        self.stop.set()
        self.thread.join(LETTING_GO)

    def watch(self) -> None:
        """Look at one frame after another until told to stop, then let go of everything."""
        while not self.stop.is_set():
            try:
                seen, frame = self.camera.read()
                if not seen:
                    self.stop.wait(RETRY_SECONDS)
                    continue  # who waits for a frame notices that none comes
                self.publish(self.see(frame))
            except Exception as error:  # whatever OpenCV raises must reach who waits, not end the thread
                known = error if isinstance(error, DeviceError) else DeviceError(f"the camera failed: {error}")
                self.publish(BallSighting(aim=self.aim, error=known))
        self.let_go()

    def see(self, frame: Frame) -> BallSighting:
        """What is in a frame; turns the camera after it."""
        now, sample = monotonic(), frame[::STILL_IMAGE_STRIDE, ::STILL_IMAGE_STRIDE].copy()
        if self.sample is None or sample.tobytes() != self.sample.tobytes():
            self.sample, self.changed = sample, now
        if now - self.changed > STALE_SECONDS:
            raise DeviceError("the camera repeats the same frame")
        if reason := blindness(frame):
            raise DeviceError(f"the camera sees nothing: its frames are {reason}")
        sighting = BallSighting(0, find_ball(frame, self.target), self.aim, frame.shape[1])
        self.aim, self.then = follow(self.aim, sighting.ball, now - self.then, self.limits), now
        self.point()
        return sighting

    def point(self) -> None:
        """Turn the camera to where it should point."""
        for joint, angle in ((self.pan, self.aim.pan), (self.tilt, self.aim.tilt)):
            if joint:
                joint.point(angle)

    def publish(self, sighting: BallSighting) -> None:
        """Tell everybody who waits for a frame."""
        with self.news:
            self.sighting = replace(sighting, number=self.sighting.number + 1)
            self.news.notify_all()

    def after(self, number: int, seconds: float) -> BallSighting:
        """What was seen in a frame after the one of that number; DeviceError where none comes, or nothing is in it."""
        with self.news:
            if not self.news.wait_for(lambda: self.sighting.number > number, seconds):
                raise DeviceError(f"the camera has given no frame for {seconds:g} s")
            sighting = self.sighting
        if sighting.error:
            raise DeviceError(str(sighting.error), sighting.error.hint)
        return sighting

    def let_go(self) -> None:
        """Let go of the camera and of the servos, which stay where they are."""
        with suppress(Exception):  # closing never raises
            self.camera.release()
        for joint in (self.pan, self.tilt):
            if joint:
                joint.servo.close()
