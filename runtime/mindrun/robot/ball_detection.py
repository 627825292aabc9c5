"""Finding a luminous ball in a camera's frames, and turning the camera after it: pure functions on OpenCV.

A frame is an array [row, column, blue green red] of bytes. Angles are in degrees, to the left and upwards positive.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, degrees, hypot, pi, radians, tan
from typing import TYPE_CHECKING, Any

from mindrun.robot.driver_support import library

if TYPE_CHECKING:
    from mindrun.numbers.arrays import Frame

BLACK_BRIGHTNESS = 12  # a brightness at and below which there is no light
WHITE_BRIGHTNESS = 250  # a brightness from which there is only light
BLIND_SHARES = 0.005, 0.6  # shares of the frame: at least so much must not be black, at most so much may be white
OVEREXPOSED_BRIGHTNESS = 245  # a brightness from which a colour may be gone
ROUNDNESS_TOLERANCE = 0.14  # how far a blob's area may be off a round one's
MAX_STREAK_RATIO = 2.8  # length of a streak to its width


@dataclass(frozen=True, slots=True)
class BallTarget:
    """What a ball looks like: its hue (0 red, 120 green, 240 blue), how strong its colour and how bright it is.

    `diameter` is the least, in pixels. `view` is how much the camera sees from left to right.
    """

    hue: float = 120.0
    tolerance: float = 25.0
    colour: float = 0.4
    brightness: float = 0.5
    diameter: float = 5.0
    view: float = 60.0


@dataclass(frozen=True, slots=True)
class Ball:
    """A ball in a frame: where it is, seen from the camera, how big, and how sure that is (0 to 1)."""

    bearing: float
    elevation: float
    diameter: float
    confidence: float


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


def find_ball(frame: Frame, target: BallTarget) -> Ball | None:
    """The largest round thing that is bright and of the right colour, None where there is none."""
    height, width = frame.shape[:2]
    if blindness(frame):
        return None
    candidates = (blob for blob in blobs(frame, target) if blob.diameter >= target.diameter and blob.roundness > 0)
    best = max(candidates, key=lambda blob: blob.diameter, default=None)
    if best is None:
        return None
    focus = focal_length(width, target.view)
    aside, up = (width - 1) / 2 - best.x, (height - 1) / 2 - best.y
    bearing, elevation = degrees(atan2(aside, focus)), degrees(atan2(up, hypot(focus, aside)))
    return Ball(bearing, elevation, best.diameter, best.roundness)


def distance(diameter: float, size: float, width: int, view: float) -> float:
    """How far a ball of that size is when it is so many pixels wide in a frame of that width, in the unit of size."""
    return size * focal_length(width, view) / diameter


def focal_length(width: int, view: float) -> float:
    """The focal length of the camera, in pixels."""
    return width / 2 / tan(radians(view) / 2)


def blobs(frame: Frame, target: BallTarget) -> list[Blob]:
    """Everything bright that has the colour, or is overexposed and has it around its rim."""
    cv2 = library("cv2")
    hsv = cv2.cvtColor(cv2.GaussianBlur(frame, (5, 5), 0), cv2.COLOR_BGR2HSV)
    coloured = in_colour(hsv, target)
    glare = cv2.inRange(hsv, (0, 0, OVEREXPOSED_BRIGHTNESS), (180, round(target.colour * 255), 255))
    mask = cv2.morphologyEx(coloured | glare, cv2.MORPH_OPEN, cv2.getStructuringElement(cv2.MORPH_RECT, (3, 3)))
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    large = [contour for contour in contours if len(contour) >= 2 * target.diameter]
    return [blob(contour, mask.shape) for contour in large if is_coloured(contour, coloured)]


def in_colour(hsv: Frame, target: BallTarget) -> Frame:
    """Which pixels are bright and of the colour; hues go round, and OpenCV counts them in steps of two degrees."""
    cv2, floor = library("cv2"), (round(target.colour * 255), round(target.brightness * 255))
    first, last = round((target.hue - target.tolerance) / 2) % 180, round((target.hue + target.tolerance) / 2) % 180
    if first <= last:
        mask: Frame = cv2.inRange(hsv, (first, *floor), (last, 255, 255))
    else:
        mask = cv2.inRange(hsv, (0, *floor), (last, 255, 255)) | cv2.inRange(hsv, (first, *floor), (180, 255, 255))
    return mask


def is_coloured(contour: Any, coloured: Frame) -> bool:
    """Whether most of a contour has the colour: a white lamp has it nowhere, an overexposed ball around its rim."""
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
    """Where the camera points, seen from the robot, and for how long there has been no ball."""

    pan: float = 0.0
    tilt: float = 0.0
    alone: float = 0.0


@dataclass(frozen=True, slots=True)
class PanTiltLimits:
    """How a camera is turned: by up to `pan` and `tilt` to either side, `speed` degrees a second at most."""

    pan: float = 90.0
    tilt: float = 45.0
    speed: float = 120.0
    gain: float = 6.0  # a second: how fast it goes towards a ball that is a degree off
    patience: float = 1.0  # seconds without a ball until it looks straight ahead again


def follow(aim: Aim, ball: Ball | None, seconds: float, limits: PanTiltLimits) -> Aim:
    """Where the camera should point so many seconds later."""
    if ball is None and aim.alone + seconds < limits.patience:
        return Aim(aim.pan, aim.tilt, aim.alone + seconds)
    pan, tilt = (ball.bearing, ball.elevation) if ball else (-aim.pan, -aim.tilt)
    share, most = min(1.0, limits.gain * seconds), limits.speed * seconds
    return Aim(
        clamp(aim.pan + clamp(share * pan, most), limits.pan),
        clamp(aim.tilt + clamp(share * tilt, most), limits.tilt),
        0.0 if ball else aim.alone + seconds,
    )


def clamp(value: float, most: float) -> float:
    """A value that is at most so far from 0."""
    return max(-most, min(most, value))
