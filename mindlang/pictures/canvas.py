"""An image to draw on in world units or in pixels, smooth to a sixteenth of a pixel."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from mindlang.pictures.theme import Colour

Image = NDArray[np.uint8]
Places = NDArray[np.int32]
COORDINATE_BITS = 4  # OpenCV takes coordinates as whole sixteenths
CAPITAL_PIXELS = 22.0  # pixels: the height of a line of text at OpenCV's size 1


def blank(width: int, height: int, colour: Colour) -> Image:
    """An image of one colour."""
    image = np.empty((height, width, 3), np.uint8)
    image[:] = np.full((width, 3), colour, np.uint8)  # whole rows are copied five times as fast as pixels
    return image


@dataclass(frozen=True, slots=True)
class Viewport:
    """Which part of the world an image shows: its top left corner, and how many pixels a unit has."""

    left: float
    top: float
    scale: float

    @classmethod
    def around(cls, low: ArrayLike, high: ArrayLike, width: int, height: int) -> "Viewport":
        """A view in which the rectangle between two corners is in the middle, as large as fits."""
        a, b = np.asarray(low, float), np.asarray(high, float)
        scale = float(min((width, height) / np.maximum(b - a, 1e-6)))
        middle = (a + b) / 2
        return cls(float(middle[0] - width / scale / 2), float(middle[1] + height / scale / 2), scale)


class Canvas:
    """Draws on an image, in the units of its view; `pen` makes every line wider. y grows upwards, or `down` a page."""

    def __init__(self, image: Image, view: Viewport, pen: float = 1.0, down: bool = False) -> None:
        self.image, self.view, self.pen = image, view, pen
        self._up = 1.0 if down else -1.0

    def places(self, points: ArrayLike) -> Places:
        """Points [n, 2] in sixteenths of a pixel."""
        corner = np.array([self.view.left, self.view.top])
        pixels = (np.atleast_2d(np.asarray(points, float)) - corner) * self.view.scale * [1.0, self._up]
        # Half a pixel: OpenCV's whole numbers are the middles of pixels.
        places: Places = np.rint((pixels - 0.5) * 2**COORDINATE_BITS).astype(np.int32)
        return places

    def disc(self, x: float, y: float, radius: float, colour: Colour, alpha: float = 1.0, width: float = 0.0) -> None:
        """A disc, or with a width its rim."""
        size = round(radius * self.view.scale * 2**COORDINATE_BITS)
        line = self._line(width) if width else cv2.FILLED

        def draw(image: Image, places: Places) -> None:
            middle = int(places[0, 0]), int(places[0, 1])
            cv2.circle(image, middle, size, colour, line, cv2.LINE_AA, COORDINATE_BITS)

        self._blend(alpha, self.places([x, y]), size / 2**COORDINATE_BITS + width * self.pen, draw)

    def polygon(self, points: ArrayLike, colour: Colour, alpha: float = 1.0) -> None:
        """A filled convex polygon."""

        def draw(image: Image, places: Places) -> None:
            cv2.fillConvexPoly(image, places, colour, cv2.LINE_AA, COORDINATE_BITS)

        self._blend(alpha, self.places(points), 1.0, draw)

    def line(
        self, points: ArrayLike, colour: Colour, width: float = 1.0, alpha: float = 1.0, closed: bool = False
    ) -> None:
        """A line through points."""
        wide = self._line(width)

        def draw(image: Image, places: Places) -> None:
            cv2.polylines(image, [places], closed, colour, wide, cv2.LINE_AA, COORDINATE_BITS)

        self._blend(alpha, self.places(points), wide, draw)

    def text(
        self,
        x: float,
        y: float,
        text: str,
        size: float,
        colour: Colour,
        bold: bool = False,
        align: str = "left",
        halo: Colour | None = None,
    ) -> float:
        """Text with capitals of `size` pixels on the line that begins, is centred or ends in x, y; its width.

        A halo sets it off from what is drawn below it.
        """
        font, scale, line = (cv2.FONT_HERSHEY_DUPLEX if bold else cv2.FONT_HERSHEY_SIMPLEX), *self._font(size)
        wide = text_width(text, size * self.pen, bold)
        start = {"left": 0.0, "centre": wide / 2, "right": wide}[align]
        column, row = self.places([x, y])[0] / 2**COORDINATE_BITS
        left, low, far = round(column - start), round(row), round(1.5 * self.pen)
        if halo is not None:
            for aside, up in product((-far, 0, far), repeat=2):
                cv2.putText(self.image, text, (left + aside, low + up), font, scale, halo, line, cv2.LINE_AA)
        cv2.putText(self.image, text, (left, low), font, scale, colour, line, cv2.LINE_AA)
        return wide

    def _font(self, size: float) -> tuple[float, int]:
        return size * self.pen / CAPITAL_PIXELS, max(1, round(size * self.pen / 20))

    def _line(self, width: float) -> int:
        return max(1, round(width * self.pen))

    def _blend(self, alpha: float, places: Places, room: float, draw: Callable[[Image, Places], None]) -> None:
        """Draw what lies within `room` pixels of the places; through it a share of 1 − alpha still shows."""
        if alpha >= 1.0:
            draw(self.image, places)
            return
        size = np.array(self.image.shape[1::-1])
        left, top = np.clip(places.min(axis=0) // 2**COORDINATE_BITS - int(room) - 2, 0, size)
        right, low = np.clip(places.max(axis=0) // 2**COORDINATE_BITS + int(room) + 3, 0, size)
        under = self.image[top:low, left:right]
        if under.size:
            over = under.copy()
            draw(over, places - np.array([left, top], np.int32) * 2**COORDINATE_BITS)
            under[:] = cv2.addWeighted(over, alpha, under, 1.0 - alpha, 0.0)


def text_width(text: str, size: float, bold: bool = False) -> float:
    """How many pixels wide a text with capitals of that size is."""
    font = cv2.FONT_HERSHEY_DUPLEX if bold else cv2.FONT_HERSHEY_SIMPLEX
    (width, _), _ = cv2.getTextSize(text, font, size / CAPITAL_PIXELS, max(1, round(size / 20)))
    return float(width)


def square(x: float, y: float, half: float) -> Sequence[tuple[float, float]]:
    """The corners of a square."""
    return rectangle(x, y, half, half)


def rectangle(x: float, y: float, half_x: float, half_y: float) -> Sequence[tuple[float, float]]:
    """The corners of a rectangle around a place."""
    left, right, low, high = x - half_x, x + half_x, y - half_y, y + half_y
    return (left, low), (right, low), (right, high), (left, high)


def pasted(page: Image, part: Image, x: int, y: int) -> None:
    """Put a part on a page."""
    page[y : y + part.shape[0], x : x + part.shape[1]] = part
