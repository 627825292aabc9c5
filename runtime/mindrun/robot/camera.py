"""A camera that looks for a luminous ball, and turns after it, watched by a thread of its own: one that hangs holds up
nobody.

A frame is an array [row, column, blue green red] of bytes. Angles are in degrees, to the left and upwards positive.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, field, replace
from math import atan2, degrees, hypot, pi, radians, tan
from pathlib import Path
from threading import Condition, Event, Thread
from time import monotonic, sleep
from typing import TYPE_CHECKING, Annotated, Any, Protocol

from mindrun.driver import ActuatorDevice, DeviceError
from mindrun.numbers.quantity import COUNT, RATIO, Quantity
from mindrun.robot.driver_support import METRES, PATH, library

if TYPE_CHECKING:
    from mindrun.numbers.arrays import Frame

HUE = Quantity("a hue", {"deg": 1.0}, low=0.0, high=360.0)
TOLERANCE = Quantity("how far a hue may be off", {"deg": 1.0}, low=1.0, high=90.0)
VIEW = Quantity("an angle of view", {"deg": 1.0}, low=5.0, high=170.0)
LEAST_DIAMETER = 5.0  # of a ball, in pixels
STILL_IMAGE_STRIDE = 8  # every so many pixels are compared with the frame before
FRAME_SECONDS = 1 / 30  # of most cameras
STALE_SECONDS = 0.2  # for which the same frame may come
RETRY_SECONDS = 0.02  # between two questions to a camera that has no frame
LETTING_GO = 1.0  # seconds that the thread may need to end
BLACK_BRIGHTNESS = 12  # a brightness at and below which there is no light
WHITE_BRIGHTNESS = 250  # a brightness from which there is only light
BLIND_SHARES = 0.005, 0.6  # shares of the frame: at least so much must not be black, at most so much may be white
OVEREXPOSED_BRIGHTNESS = 245  # a brightness from which a colour may be gone
ROUNDNESS_TOLERANCE = 0.14  # how far a blob's area may be off a round one's
MAX_STREAK_RATIO = 2.8  # length of a streak to its width
DEGREES_PER_SECOND = 120.0  # at most, of a neck
GAIN_PER_SECOND = 6.0  # how fast a neck goes towards a ball that is a degree off
PATIENCE_SECONDS = 1.0  # without a ball, until it looks straight ahead again


@dataclass(frozen=True, slots=True, kw_only=True)
class BallCamera:
    """A camera and the ball to look for: the options that drivers of such a camera have in common.

    `view` is how much it sees from left to right; `colour` and `brightness` are the least that a ball has.
    """

    camera: Annotated[str, PATH] = "/dev/video0"
    width: Annotated[int, COUNT] = 320
    height: Annotated[int, COUNT] = 240
    view: Annotated[float, VIEW] = 60.0
    size: Annotated[float, METRES] = 0.1
    hue: Annotated[float, HUE] = 120.0
    tolerance: Annotated[float, TOLERANCE] = 25.0
    colour: Annotated[float, RATIO] = 0.4
    brightness: Annotated[float, RATIO] = 0.5


@dataclass(frozen=True, slots=True)
class SeenBall:
    """A ball in a frame: where it is, seen from the camera, and how big."""

    bearing: float
    elevation: float
    diameter: float


@dataclass(frozen=True, slots=True)
class Blob:
    """Something of the right colour: its centre and diameter in pixels, and how round it is."""

    x: float
    y: float
    diameter: float
    roundness: float


def blindness(frame: Frame) -> str:
    """Why nothing could be seen in a frame, "" where something could."""
    cv2, (least, most) = library("cv2"), BLIND_SHARES
    brightness = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    if (brightness > BLACK_BRIGHTNESS).sum() < least * brightness.size:
        return "black"
    return "all white" if (brightness >= WHITE_BRIGHTNESS).sum() > most * brightness.size else ""


def find_ball(frame: Frame, target: BallCamera) -> SeenBall | None:
    """The largest round thing that is bright and of the right colour, None where there is none."""
    height, width = frame.shape[:2]
    candidates = (blob for blob in blobs(frame, target) if blob.diameter >= LEAST_DIAMETER and blob.roundness > 0)
    best = max(candidates, key=lambda blob: blob.diameter, default=None)
    if best is None:
        return None
    focus = focal_length(width, target.view)
    aside, up = (width - 1) / 2 - best.x, (height - 1) / 2 - best.y
    bearing, elevation = degrees(atan2(aside, focus)), degrees(atan2(up, hypot(focus, aside)))
    return SeenBall(bearing, elevation, best.diameter)


def distance(diameter: float, size: float, width: int, view: float) -> float:
    """The distance of a ball, in the unit of `size`, that is `diameter` pixels wide in a frame of `width` pixels."""
    return size * focal_length(width, view) / diameter


def focal_length(width: int, view: float) -> float:
    """The focal length of the camera, in pixels."""
    return width / 2 / tan(radians(view) / 2)


def blobs(frame: Frame, target: BallCamera) -> list[Blob]:
    """Everything bright that has the colour, or is overexposed and has it around its rim."""
    cv2 = library("cv2")
    hsv = cv2.cvtColor(cv2.GaussianBlur(frame, (5, 5), 0), cv2.COLOR_BGR2HSV)
    coloured = in_colour(hsv, target)
    glare = cv2.inRange(hsv, (0, 0, OVEREXPOSED_BRIGHTNESS), (180, round(target.colour * 255), 255))
    mask = cv2.morphologyEx(coloured | glare, cv2.MORPH_OPEN, cv2.getStructuringElement(cv2.MORPH_RECT, (3, 3)))
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    large = [contour for contour in contours if len(contour) >= 2 * LEAST_DIAMETER]
    return [blob(contour, mask.shape) for contour in large if is_coloured(contour, coloured)]


def in_colour(hsv: Frame, target: BallCamera) -> Frame:
    """A mask of the pixels that are bright and of the colour; hues go round, which OpenCV counts in two degrees."""
    cv2, floor = library("cv2"), (round(target.colour * 255), round(target.brightness * 255))
    first, last = round((target.hue - target.tolerance) / 2) % 180, round((target.hue + target.tolerance) / 2) % 180
    if first <= last:
        mask: Frame = cv2.inRange(hsv, (first, *floor), (last, 255, 255))
    else:
        mask = cv2.inRange(hsv, (0, *floor), (last, 255, 255)) | cv2.inRange(hsv, (first, *floor), (180, 255, 255))
    return mask


def is_coloured(contour: Any, coloured: Frame) -> bool:
    """True if most of a contour has the colour: a white lamp has it nowhere, an overexposed ball around its rim."""
    x, y = contour[:, 0].T
    return bool((coloured[y, x] > 0).mean() > 0.6)


def blob(contour: Any, shape: tuple[int, int]) -> Blob:
    """The measures of a contour; one that moved while the shutter was open is a streak with round ends."""
    cv2 = library("cv2")
    (x, y), (one, other), _ = cv2.minAreaRect(contour)
    short, long = min(one, other) + 1, max(one, other) + 1
    area = cv2.contourArea(contour) + len(contour) / 2 + 1  # the contour runs through the middles of its pixels
    left, top, width, height = cv2.boundingRect(contour)
    if left == 0 or top == 0 or left + width == shape[1] or top + height == shape[0]:  # partly out of the frame
        convex = cv2.contourArea(cv2.convexHull(contour)) + len(contour) / 2 + 1
        return Blob(x, y, long, 0.5 if area / convex > 0.85 and long <= MAX_STREAK_RATIO * short else 0.0)
    stretch = long / short
    off = abs(area / (short * long) - (stretch - 1 + pi / 4) / stretch) / (ROUNDNESS_TOLERANCE + 1 / short)
    return Blob(x, y, short, max(0.0, 1 - off) if stretch <= MAX_STREAK_RATIO else 0.0)


@dataclass(frozen=True, slots=True)
class Aim:
    """The direction of the camera, seen from the robot, in degrees, and the seconds for which it has seen no ball."""

    pan: float = 0.0
    tilt: float = 0.0
    alone: float = 0.0


def follow(aim: Aim, ball: SeenBall | None, seconds: float, pan_reach: float, tilt_reach: float) -> Aim:
    """The aim so many seconds later of a camera that turns up to so many degrees to either side, and up and down."""
    if ball is None and aim.alone + seconds < PATIENCE_SECONDS:
        return Aim(aim.pan, aim.tilt, aim.alone + seconds)
    pan, tilt = (ball.bearing, ball.elevation) if ball else (-aim.pan, -aim.tilt)
    share, most = min(1.0, GAIN_PER_SECOND * seconds), DEGREES_PER_SECOND * seconds
    return Aim(
        clamp(aim.pan + clamp(share * pan, most), pan_reach),
        clamp(aim.tilt + clamp(share * tilt, most), tilt_reach),
        0.0 if ball else aim.alone + seconds,
    )


def clamp(value: float, most: float) -> float:
    """A value that is at most so far from 0."""
    return max(-most, min(most, value))


AHEAD = Aim()


class Camera(Protocol):
    """A source of frames: `read` blocks until there is one, and says whether there is."""

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
        """Turn the servo to an angle, in degrees from the middle."""
        self.servo.write(min(1.0, max(0.0, 0.5 + angle / self.travel)))


def reach(joint: Joint | None) -> float:
    """How many degrees a joint turns to either side: 0 where there is none."""
    return abs(joint.travel) / 2 if joint else 0.0


@dataclass(frozen=True, slots=True)
class BallSighting:
    """The ball in a frame, if any, where the camera pointed, and how wide the frame was; or why there was no frame."""

    number: int = 0
    ball: SeenBall | None = None
    aim: Aim = AHEAD
    width: int = 1
    error: DeviceError | None = None


@dataclass(slots=True, eq=False)
class TrackingCamera:
    """A camera, what it looks for, and the joints that turn it, pan and tilt, as far as it has them."""

    camera: Camera
    target: BallCamera
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
        """Find the ball in a frame, and turn the camera after it; DeviceError for a blind camera, or one that hangs."""
        now, sample = monotonic(), frame[::STILL_IMAGE_STRIDE, ::STILL_IMAGE_STRIDE].copy()
        if self.sample is None or sample.tobytes() != self.sample.tobytes():
            self.sample, self.changed = sample, now
        if now - self.changed > STALE_SECONDS:
            raise DeviceError("the camera repeats the same frame")
        if reason := blindness(frame):
            raise DeviceError(f"the camera sees nothing: its frames are {reason}")
        sighting = BallSighting(0, find_ball(frame, self.target), self.aim, frame.shape[1])
        self.aim, self.then = follow(self.aim, sighting.ball, now - self.then, *map(reach, (self.pan, self.tilt))), now
        self.point()
        return sighting

    def point(self) -> None:
        """Turn the joints to the aim."""
        for joint, angle in ((self.pan, self.aim.pan), (self.tilt, self.aim.tilt)):
            if joint:
                joint.point(angle)

    def publish(self, sighting: BallSighting) -> None:
        """Give a sighting to everybody who waits for one."""
        with self.news:
            self.sighting = replace(sighting, number=self.sighting.number + 1)
            self.news.notify_all()

    def after(self, number: int, seconds: float) -> BallSighting:
        """The newest sighting after that number; DeviceError if none comes in so many seconds, or the camera fails."""
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
