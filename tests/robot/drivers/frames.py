"""Frames drawn as a camera would see them: a luminous ball, noise, a dark or a bright room, a shutter open too long."""

from collections.abc import Callable
from math import radians, tan
from threading import Event
from time import sleep

import cv2
import numpy as np
from mindrun.numbers.arrays import Frame
from mindrun.robot.camera import focal_length

WIDTH, HEIGHT, VIEW, GREEN = 320, 240, 60.0, 120
FINER = 8  # drawn so many times larger


def colour(hue: float, strength: float = 0.9, brightness: float = 0.9) -> np.ndarray:
    """Blue, green and red."""
    hsv = np.array([[[hue / 2, strength * 255, brightness * 255]]], np.uint8)
    return cv2.cvtColor(hsv, cv2.COLOR_HSV2BGR)[0, 0].astype(np.float32)


def room(brightness: float = 50.0) -> np.ndarray:
    """A grey wall, and a floor darker than that."""
    frame = np.full((HEIGHT, WIDTH, 3), brightness, np.float32)
    frame[160:] *= 0.6
    return frame


def disc(x: float, y: float, diameter: float) -> np.ndarray:
    """How much of each pixel a disc covers."""
    mask = np.zeros((HEIGHT * FINER, WIDTH * FINER), np.uint8)
    centre = round((x + 0.5) * FINER - 0.5), round((y + 0.5) * FINER - 0.5)
    cv2.circle(mask, centre, round(diameter * FINER / 2), 255, -1)
    return cv2.resize(mask, (WIDTH, HEIGHT), interpolation=cv2.INTER_AREA)[..., None] / np.float32(255)


def painted(frame: np.ndarray, cover: np.ndarray, paint: np.ndarray) -> np.ndarray:
    """The frame with something in it."""
    return frame * (1 - cover) + paint * cover


def ball(frame: np.ndarray, x: float, y: float, diameter: float, hue: float = GREEN) -> np.ndarray:
    """The frame with a ball in it."""
    return painted(frame, disc(x, y, diameter), colour(hue))


def taken(frame: np.ndarray, noise: float = 6.0, seed: int = 0) -> Frame:
    """What the camera gives: with noise, and nothing brighter than white."""
    noisy = frame + np.random.default_rng(seed).normal(0, noise, frame.shape)
    return np.clip(noisy, 0, 255).astype(np.uint8)


def column(angle: float) -> float:
    """Where something at an angle to the left is seen."""
    return (WIDTH - 1) / 2 - focal_length(WIDTH, VIEW) * tan(radians(angle))


class FakeCamera:
    """A camera that draws its frames, a hundred a second."""

    def __init__(self, draw: Callable[[int], Frame | None]) -> None:
        self.draw, self.count, self.stopped, self.released = draw, 0, Event(), 0

    def read(self) -> tuple[bool, Frame | None]:
        """The next frame; one that has stopped gives none for a long time."""
        if self.stopped.is_set():
            sleep(0.5)
            return False, None
        sleep(0.01)
        self.count += 1
        frame = self.draw(self.count)
        return frame is not None, frame

    def release(self) -> None:
        self.released += 1
