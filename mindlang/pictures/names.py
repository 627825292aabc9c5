"""The names of things, each beside its thing and none over another."""

from collections import Counter
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
from mindrun.graph.graph import Thing
from numpy.typing import NDArray

from mindlang.pictures.canvas import Canvas, text_width
from mindlang.pictures.scene import each_thing
from mindlang.pictures.theme import Colour, Theme
from mindlang.run.recorded_run import RecordedRun

MAX_NAMED_COPIES = 6  # things of one name that each have it beside them
NAME_PIXELS = 10.0  # the capitals of a thing's name
GAP_PIXELS = 4.0  # between a thing and its name
MAX_LINES_AWAY = 8  # how far a name gives way to others


class Label(NamedTuple):
    """Where a text stands, in world units."""

    left: float
    low: float
    width: float
    height: float

    def overlaps(self, other: "Label") -> bool:
        """Whether both cover a place."""
        is_beside = self.left >= other.left + other.width or other.left >= self.left + self.width
        return not is_beside and self.low < other.low + other.height and other.low < self.low + self.height

    def is_within(self, other: "Label") -> bool:
        """Whether the other covers all of it."""
        right, top = other.left + other.width, other.low + other.height
        ends_in = self.left + self.width <= right and self.low + self.height <= top
        return other.left <= self.left and other.low <= self.low and ends_in


class Words(NamedTuple):
    """Words with capitals of so many `pixels`, and the place and size of what they are about."""

    words: str
    pixels: float
    colour: Colour
    x: float
    y: float
    size: float


def draw_names(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int, ending: Words | None = None) -> None:
    """The name of each thing in sight: below it, or where neither the robot nor a thing nor another name is.

    Of many things of one name the first alone has it. Words about the robot, how its run ended, stand beside it.
    """
    pixel = 1 / canvas.view.scale
    (height, width), (left, top) = canvas.image.shape[:2], (canvas.view.left, canvas.view.top)
    sight = Label(left, top - height * pixel, width * pixel, height * pixel)
    gap = GAP_PIXELS * canvas.pen * pixel
    (x, y, _), radius = run.body[tick], run.graph.body.radius
    each = list(each_thing(run, theme, tick))
    squares = [np.array((x, y, 2 * radius)), *(place for thing, _, place in each if not thing.kind.is_area)]
    taken = [Label(x - side / 2, y - side / 2, side, side) for x, y, side in squares]
    said = [Words(name, NAME_PIXELS, theme.ink, *place) for name, place in _named(run, each, sight)]
    for text in ([ending] if ending else []) + said:
        high, wide = text.pixels * canvas.pen * pixel, text_width(text.words, text.pixels * canvas.pen) * pixel
        middle = min(max(text.x, left + wide / 2), left + width * pixel - wide / 2)
        below = Label(middle - wide / 2, text.y - text.size / 2 - gap - high, wide, high)
        label = free(_places(below, text.x, text.y, text.size, gap), taken, sight)
        taken.append(label._replace(low=label.low - gap / 2, height=high + gap))
        canvas.text(label.left, label.low, text.words, text.pixels, text.colour, halo=theme.floor)


def _named(
    run: RecordedRun, each: Iterable[tuple[Thing, Colour, NDArray[np.float64]]], sight: Label
) -> Iterator[tuple[str, NDArray[np.float64]]]:
    """The name, place and size of each thing in sight that is named."""
    many = Counter(thing.name for thing in run.contents)
    named: set[str] = set()
    for thing, _, place in each:
        is_in_sight = Label(place[0], place[1], 0.0, 0.0).is_within(sight)
        if is_in_sight and (thing.name not in named or many[thing.name] <= MAX_NAMED_COPIES):
            named.add(thing.name)
            yield thing.name, place


def _places(below: Label, x: float, y: float, size: float, gap: float) -> Iterator[Label]:
    """Where a name can stand: below its thing, above, to the right or left of it, and then line by line farther."""
    above = below._replace(low=y + size / 2 + gap)
    yield from (below, above)
    level = below._replace(low=y - below.height / 2)
    yield from (level._replace(left=x + size / 2 + gap), level._replace(left=x - size / 2 - gap - below.width))
    for line in range(1, MAX_LINES_AWAY):
        away = line * (below.height + gap)
        yield from (below._replace(low=below.low - away), above._replace(low=above.low + away))


def free(places: Iterable[Label], taken: Iterable[Label], sight: Label) -> Label:
    """The first of the places that is in sight and free; the very first, where none is."""
    choices, occupied = list(places), list(taken)
    for label in choices:
        if label.is_within(sight) and not any(label.overlaps(other) for other in occupied):
            return label
    return choices[0]
