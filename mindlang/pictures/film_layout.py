"""How the images of a film are divided: the world beside the hierarchy, or above it where the arena is long."""

from dataclasses import dataclass
from math import ceil

from mindlang.pictures.layout import Place

FILM_WIDTH, FILM_HEIGHT = 1280, 720  # pixels, the height where the world is square
LEAST_HEIGHT, LEAST_WORLD_WIDTH = 480, 240
LONG_RATIO = 16 / 9  # of width and depth, above which the world has the whole width
TITLE_PIXELS, MARGIN_PIXELS = 86, 8  # above the hierarchy, and around it
LOW_PANEL_PIXELS = 240  # the height of a hierarchy below its world
ROW_PIXELS, COLUMN_PIXELS = 20.0, 250.0  # of a sensor's readings
BELOW_SHARE, BESIDE_SHARE = 0.36, 0.36  # at most of the panel: readings below a hierarchy, or beside it


@dataclass(frozen=True, slots=True)
class FilmLayout:
    """The size of a film's images, that of the world in their upper left corner, and where all else begins."""

    width: int
    height: int
    world: tuple[int, int]
    left: int
    top: int

    @classmethod
    def of(cls, ratio: float) -> "FilmLayout":
        """The page for a world so many times as wide as deep. Video needs even numbers."""
        if ratio > LONG_RATIO:
            high = _even(FILM_WIDTH / ratio)
            return cls(FILM_WIDTH, high + TITLE_PIXELS + LOW_PANEL_PIXELS, (FILM_WIDTH, high), 0, high)
        wide, high = max(LEAST_WORLD_WIDTH, _even(FILM_HEIGHT * min(1.0, ratio))), _even(FILM_HEIGHT / max(1.0, ratio))
        return cls(FILM_WIDTH, max(LEAST_HEIGHT, high), (wide, high), wide, 0)

    @property
    def panel(self) -> Place:
        """The rectangle of the hierarchy and the readings, by its upper left corner."""
        left, top = self.left + MARGIN_PIXELS, self.top + TITLE_PIXELS
        return Place(left, top, self.width - left - MARGIN_PIXELS, self.height - top - MARGIN_PIXELS - 2)

    def divided(self, sensors: int, lower: float = 0.0) -> tuple[Place, Place]:
        """The rectangles of the hierarchy and of the readings of so many sensors: below it, or beside where it is low.

        The readings have at most their share, and show what fits. Both begin so many pixels `lower`, for a long title.
        """
        x, y, width, height = self.panel.x, self.panel.y + lower, self.panel.width, self.panel.height - lower
        if self.left == 0:
            wide = BESIDE_SHARE * width if sensors else 0.0
            return Place(x, y, width - wide, height), Place(x + width - wide, y, wide, height)
        rows = min(ceil(sensors / int(width // COLUMN_PIXELS)), int(BELOW_SHARE * height // ROW_PIXELS))
        high = ROW_PIXELS * rows
        return Place(x, y, width, height - high), Place(x, y + height - high, width, high)


def _even(pixels: float) -> int:
    return 2 * round(pixels / 2)
