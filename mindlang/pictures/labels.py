"""The names of things, each beside its thing and none over another."""

from collections import Counter
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
from mindrun.graph.graph import Thing

from mindlang.pictures.canvas import Canvas, Rectangle, text_width
from mindlang.pictures.scene import Floats, each_thing
from mindlang.pictures.theme import Colour, Theme
from mindlang.run.recorded_run import RecordedRun

MAX_NAMED_COPIES = 6  # things of one name that each have it beside them
NAME_PIXELS = 10.0  # the capitals of a thing's name
GAP_PIXELS = 4.0  # between a thing and its name
MAX_LINES_AWAY = 8  # how far a name gives way to others


class Label(NamedTuple):
    """Words with capitals of so many `pixels`, and the place and size of what they are about."""

    words: str
    pixels: float
    colour: Colour
    x: float
    y: float
    size: float


def draw_names(canvas: Canvas, run: RecordedRun, theme: Theme, tick: int, ending: Label | None = None) -> None:
    """The name of each thing in sight: below it, or where neither the robot nor a thing nor another name is.

    Of many things of one name the first alone has it. Words about the robot, how its run ended, stand beside it.
    """
    pixel = 1 / canvas.view.scale
    (height, width), (left, top) = canvas.image.shape[:2], (canvas.view.left, canvas.view.top)
    sight = Rectangle(left, top - height * pixel, width * pixel, height * pixel)
    gap = GAP_PIXELS * canvas.pixel
    (x, y, _), radius = run.body[tick], run.graph.body.radius
    each = list(each_thing(run, theme, tick))
    squares = [np.array((x, y, 2 * radius)), *(place for thing, _, place in each if not thing.kind.is_area)]
    taken = [Rectangle(x - side / 2, y - side / 2, side, side) for x, y, side in squares]
    said = [Label(name, NAME_PIXELS, theme.ink, *place) for name, place in _named(run, each, sight)]
    for text in ([ending] if ending else []) + said:
        high, wide = text.pixels * canvas.pixel, text_width(text.words, text.pixels * canvas.pen) * pixel
        middle = min(max(text.x, left + wide / 2), left + width * pixel - wide / 2)
        below = Rectangle(middle - wide / 2, text.y - text.size / 2 - gap - high, wide, high)
        place = free(_places(below, text, gap), taken, sight)
        taken.append(place._replace(low=place.low - gap / 2, height=high + gap))
        canvas.text(place.left, place.low, text.words, text.pixels, text.colour, halo=theme.floor)


def _named(
    run: RecordedRun, each: Iterable[tuple[Thing, Colour, Floats]], sight: Rectangle
) -> Iterator[tuple[str, Floats]]:
    """The name, place and size of each thing in sight that is named."""
    many = Counter(thing.name for thing in run.contents)
    named: set[str] = set()
    for thing, _, place in each:
        is_in_sight = Rectangle(place[0], place[1], 0.0, 0.0).is_within(sight)
        if is_in_sight and (thing.name not in named or many[thing.name] <= MAX_NAMED_COPIES):
            named.add(thing.name)
            yield thing.name, place


def _places(below: Rectangle, text: Label, gap: float) -> Iterator[Rectangle]:
    """Where a name can stand: below its thing, above, to the right or left of it, and then line by line farther."""
    above = below._replace(low=text.y + text.size / 2 + gap)
    yield from (below, above)
    level = below._replace(low=text.y - below.height / 2)
    aside = text.size / 2 + gap
    yield from (level._replace(left=text.x + aside), level._replace(left=text.x - aside - below.width))
    for line in range(1, MAX_LINES_AWAY):
        away = line * (below.height + gap)
        yield from (below._replace(low=below.low - away), above._replace(low=above.low + away))


def free(places: Iterable[Rectangle], taken: Iterable[Rectangle], sight: Rectangle) -> Rectangle:
    """The first of the places that is in sight and free; the very first, where none is."""
    choices, occupied = list(places), list(taken)
    for place in choices:
        if place.is_within(sight) and not any(place.overlaps(other) for other in occupied):
            return place
    return choices[0]
