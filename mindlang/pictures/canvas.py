"""An image to draw on in world units or in pixels, smooth to a sixteenth of a pixel."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from mindlang.pictures.theme import Colour

Image = NDArray[np.uint8]
Places = NDArray[np.int32]
COORDINATE_BITS = 4  # OpenCV takes coordinates as whole sixteenths
CAPITAL_PIXELS = 22.0  # pixels: the height of a line of text at OpenCV's size 1


def blank(width: int, height: int, colour: Colour) -> Image:
    image = np.empty((height, width, 3), np.uint8)
    image[:] = np.full((width, 3), colour, np.uint8)  # whole rows are copied five times as fast as pixels
    return image


def paste(page: Image, part: Image, x: int, y: int) -> None:
    page[y : y + part.shape[0], x : x + part.shape[1]] = part


def reduced(image: Image, scale: float) -> Image:
    """The image so much smaller: pixels are means."""
    height, width, _ = image.shape
    size = max(1, round(scale * width)), max(1, round(scale * height))
    return cv2.resize(image, size, interpolation=cv2.INTER_AREA).astype(np.uint8)


def letterbox(seen: Image, width: int, height: int, around: Colour) -> Image:
    """An image, red first, as one of that size: as large as fits, in the middle."""
    high, wide, _ = seen.shape
    scale = min(width / wide, height / high)
    size = max(1, round(wide * scale)), max(1, round(high * scale))
    how = cv2.INTER_AREA if scale < 1 else cv2.INTER_CUBIC
    inner = cv2.resize(np.ascontiguousarray(seen[:, :, ::-1]), size, interpolation=how)
    page = blank(width, height, around)
    paste(page, inner.astype(np.uint8), (width - size[0]) // 2, (height - size[1]) // 2)
    return page


class Region(NamedTuple):
    """A rectangle by the corner from which both coordinates grow, in units or pixels."""

    left: float
    low: float
    width: float
    height: float

    def overlaps(self, other: "Region") -> bool:
        is_beside = self.left >= other.left + other.width or other.left >= self.left + self.width
        return not (is_beside or self.low >= other.low + other.height or other.low >= self.low + self.height)

    def is_within(self, other: "Region") -> bool:
        right, top = other.left + other.width, other.low + other.height
        ends_in = self.left + self.width <= right and self.low + self.height <= top
        return other.left <= self.left and other.low <= self.low and ends_in


@dataclass(frozen=True, slots=True)
class Viewport:
    """The part of the world that an image shows: its top left corner, and how many pixels a unit has."""

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

    @classmethod
    def of_page(cls, image: Image, pen: int = 1) -> "Canvas":
        """A canvas for a page, in pixels from its upper left corner, of which the image has `pen` for each."""
        return cls(image, Viewport(0.0, 0.0, pen), pen, down=True)

    @property
    def pixel(self) -> float:
        """How many units a line of width 1 is wide."""
        return self.pen / self.view.scale

    def places(self, points: ArrayLike) -> Places:
        """Points [n, 2] in sixteenths of a pixel."""
        corner = np.array([self.view.left, self.view.top])
        pixels = (np.atleast_2d(np.asarray(points, float)) - corner) * self.view.scale * [1.0, self._up]
        # Half a pixel: OpenCV's whole numbers are the middles of pixels.
        places: Places = np.rint((pixels - 0.5) * 2**COORDINATE_BITS).astype(np.int32)
        return places

    def disc(self, x: float, y: float, radius: float, colour: Colour, alpha: float = 1.0, width: float = 0.0) -> None:
        """Draw a disc, or with a width its rim."""
        size = round(radius * self.view.scale * 2**COORDINATE_BITS)
        line = self._line(width) if width else cv2.FILLED
        room = size / 2**COORDINATE_BITS + width * self.pen
        how = size, colour, line, cv2.LINE_AA, COORDINATE_BITS
        self._blend(alpha, self.places([x, y]), room, lambda image, at: cv2.circle(image, at[0].tolist(), *how))

    def polygon(self, points: ArrayLike, colour: Colour, alpha: float = 1.0) -> None:
        how = colour, cv2.LINE_AA, COORDINATE_BITS
        self._blend(alpha, self.places(points), 1.0, lambda image, at: cv2.fillConvexPoly(image, at, *how))

    def line(
        self, points: ArrayLike, colour: Colour, width: float = 1.0, alpha: float = 1.0, closed: bool = False
    ) -> None:
        wide = self._line(width)
        how = closed, colour, wide, cv2.LINE_AA, COORDINATE_BITS
        self._blend(alpha, self.places(points), wide, lambda image, at: cv2.polylines(image, [at], *how))

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
    ) -> None:
        """Draw text with capitals of `size` pixels that begins, is centred or ends in x, y; a halo sets it off."""
        font, scale, line = _font(size * self.pen, bold)
        start = {"left": 0.0, "centre": 0.5, "right": 1.0}[align] * text_width(text, size * self.pen, bold)
        column, row = self.places([x, y])[0] / 2**COORDINATE_BITS
        left, low, far = round(column - start), round(row), round(1.5 * self.pen)
        if halo is not None:
            for aside, up in product((-far, 0, far), repeat=2):
                cv2.putText(self.image, text, (left + aside, low + up), font, scale, halo, line, cv2.LINE_AA)
        cv2.putText(self.image, text, (left, low), font, scale, colour, line, cv2.LINE_AA)

    def width(self, text: str, size: float) -> float:
        """How many pixels of the page a text with capitals of `size` is wide."""
        return text_width(text, size * self.pen) / self.pen

    def _line(self, width: float) -> int:
        return max(1, round(width * self.pen))

    def _blend(self, alpha: float, places: Places, room: float, draw: Callable[[Image, Places], object]) -> None:
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


def _font(size: float, bold: bool) -> tuple[int, float, int]:
    """OpenCV's font, its size and the width of its lines, for capitals of so many pixels."""
    font = cv2.FONT_HERSHEY_DUPLEX if bold else cv2.FONT_HERSHEY_SIMPLEX
    return font, size / CAPITAL_PIXELS, max(1, round(size / 20))


def text_width(text: str, size: float, bold: bool = False) -> float:
    """How many pixels wide a text with capitals of that size is."""
    (width, _), _ = cv2.getTextSize(text, *_font(size, bold))
    return float(width)


def flow_layout(widths: Sequence[float], gap: float, room: float) -> list[tuple[float, int]]:
    """The left end and the line of each of some texts of these widths, side by side in lines as wide as the room."""
    places, along, line = [], 0.0, 0
    for width in widths:
        if along and along + width > room:
            along, line = 0.0, line + 1
        places.append((along, line))
        along += width + gap
    return places


def rectangle_corners(x: float, y: float, half_x: float, half_y: float) -> Sequence[tuple[float, float]]:
    """The corners of a rectangle around a place."""
    left, right, low, high = x - half_x, x + half_x, y - half_y, y + half_y
    return (left, low), (right, low), (right, high), (left, high)
