"""The path of the robot, coloured by the skill in control or, where there is only one, by time."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mindlang.pictures.canvas import Canvas, square
from mindlang.pictures.scene import thing_colours
from mindlang.pictures.theme import PAPER, Colour, Theme, mixed
from mindlang.run.recorded_run import RecordedRun

TIME_SHADES = 64  # shades of a path by time
NOBODY = "no skill"  # what the legend calls ticks in which no skill has influence
NOBODY_SHADE = 0.3  # from the floor to ink
CORE_SHARES = 2.0, 0.6  # of the width: a line that has another one in its middle, and that one
MIN_CONTROL_SHARE = 0.005  # of the run: a skill that was in control for less does not count
MOST_NUMBERED = 40


@dataclass(frozen=True, slots=True)
class Stroke:
    """How a line looks: a colour, and in its middle another one where there are more lines than colours."""

    colour: Colour
    core: Colour | None = None

    def draw(self, canvas: Canvas, points: ArrayLike, width: float) -> None:
        """A line through points; a wider one where it has a core."""
        outer, inner = CORE_SHARES
        canvas.line(points, self.colour, width * (outer if self.core else 1.0))
        if self.core:
            canvas.line(points, self.core, width * inner)


@dataclass(frozen=True, slots=True)
class Path:
    """The robot's places [ticks + 1, 2], and per tick which of the `strokes` the path has.

    `shares` says how much of the run each skill was in control, and none, by name; it is empty for a path by time.
    """

    places: NDArray[np.float64]
    keys: NDArray[np.int64]
    strokes: list[Stroke]
    shares: dict[str, float]

    @classmethod
    def of(cls, run: RecordedRun, theme: Theme) -> "Path":
        """By skill, where several were in control."""
        names = [*run.movers, NOBODY]
        places, keys = run.body[:, :2], run.in_control()
        shares = np.bincount(keys, minlength=len(names)) / max(1, run.ticks)
        if np.count_nonzero(shares >= MIN_CONTROL_SHARE) > 1:
            nobody = Stroke(mixed(theme.floor, theme.ink, NOBODY_SHADE))
            each = [*strokes_of(theme, len(run.movers)), nobody]
            return cls(places, keys, each, dict(zip(names, shares.tolist(), strict=True)))
        keys = np.arange(run.ticks) * TIME_SHADES // max(1, run.ticks)
        shades = [Stroke(mixed(theme.early, theme.late, i / TIME_SHADES)) for i in range(TIME_SHADES)]
        return cls(places, keys, shades, {})

    def draw(self, canvas: Canvas, first: int, last: int, width: float) -> None:
        """The path from tick `first` to tick `last`."""
        keys = self.keys[first:last]
        for begin, end in _stretches(keys):
            self.strokes[keys[begin]].draw(canvas, self.places[first + begin : first + end + 1], width)


def strokes_of(theme: Theme, count: int) -> list[Stroke]:
    """A stroke for each of so many skills: each colour alone, then each around another one."""
    cores = (None, theme.floor, theme.ink)
    many = len(theme.skills)
    return [Stroke(theme.skills[i % many], cores[i // many % len(cores)]) for i in range(count)]


def _stretches(keys: NDArray[np.int64]) -> list[tuple[int, int]]:
    """Where equal keys begin and end."""
    changes = np.flatnonzero(np.diff(keys)) + 1
    return list(pairwise([0, *(int(change) for change in changes), len(keys)])) if len(keys) else []


def draw_start(canvas: Canvas, run: RecordedRun) -> None:
    """Where the run began."""
    x, y, _ = run.body[0]
    canvas.disc(x, y, 5 * canvas.pixel, PAPER.floor)
    canvas.disc(x, y, 5 * canvas.pixel, PAPER.ink, width=1.8)


def draw_collisions(canvas: Canvas, run: RecordedRun) -> None:
    """Where the robot collided; over the robot, since a run may end there."""
    for x, y, _ in run.body[run.collisions]:
        draw_cross(canvas, x, y, 5.5 * canvas.pixel, PAPER)


def draw_cross(canvas: Canvas, x: float, y: float, size: float, theme: Theme) -> None:
    """The mark of a collision."""
    for colour, width in ((theme.floor, 4.5), (theme.crash, 2.2)):
        for up in (size, -size):
            canvas.line([(x - size, y - up), (x + size, y + up)], colour, width)


def draw_former(canvas: Canvas, run: RecordedRun) -> None:
    """Faintly, where things were before, numbered where they were several, and not too many.

    Of what walks or was pushed also the way; what can be pushed was first where it appeared.
    """
    for number, (thing, colour) in enumerate(zip(run.contents, thing_colours(run.contents, PAPER), strict=True)):
        former = run.former(number)
        if thing.kind.walks or thing.kind.is_loose:
            for stretch in run.stretches(number):
                canvas.line(stretch, colour, 1.0, 0.5)
        for order, (x, y, size) in enumerate(run.placements(number) if thing.kind.is_loose else former, 1):
            if thing.kind.is_round:
                canvas.disc(x, y, size / 2, colour, 0.16)
                canvas.disc(x, y, size / 2, colour, 0.45, width=1.0)
            else:
                canvas.polygon(square(x, y, size / 2), colour, 0.08)
                canvas.line(square(x, y, size / 2), colour, 1.0, 0.4, closed=True)
            if order <= len(former) and 1 < len(former) <= MOST_NUMBERED:
                below = 9 * canvas.pixel
                canvas.text(x + size / 2 + below / 3, y - below, str(order), 9, PAPER.faint)
