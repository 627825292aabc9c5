"""How the images of a film are divided: the world beside the hierarchy, or above it where the arena is long."""

from dataclasses import dataclass

from mindlang.pictures.layout import Place

FILM_WIDTH, FILM_HEIGHT = 1280, 720  # pixels, the height where the world is square
LEAST_HEIGHT, LEAST_WORLD_WIDTH = 480, 240
LONG_RATIO = 16 / 9  # of width and depth, above which the world has the whole width
TITLE_PIXELS, MARGIN_PIXELS = 86, 8  # above the hierarchy, and around it
LOW_PANEL_PIXELS = 240  # the height of a hierarchy below its world


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
        """The rectangle of the hierarchy, by its upper left corner."""
        left, top = self.left + MARGIN_PIXELS, self.top + TITLE_PIXELS
        return Place(left, top, self.width - left - MARGIN_PIXELS, self.height - top - MARGIN_PIXELS - 2)


def _even(pixels: float) -> int:
    return 2 * round(pixels / 2)
