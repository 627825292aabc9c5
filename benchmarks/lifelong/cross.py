"""Twelve lessons after CRoSS's wheeled robot (Denker and Gepperth, 2026): lines to follow, boxes to push or to leave.

Lines of three shapes and colours, each crossed by one that is not meant; each piece counts once. Boxes of one colour
are pushed home in one lesson, and too heavy in another. Ground sensors and a lidar stand for CRoSS's camera.
"""

from math import copysign, cos, pi, sin

from benchmarks.lifelong.sequence import TaskSequence
from benchmarks.lifelong.written import EVENT_POINTS, WrittenLesson, sequence_of

ROBOT = "cross.mind"
COLOURS = "red", "green", "blue"
NOMINAL_COUNTS = {"Follow": 15.0, "Push": 2.0, "Leave": 15.0}  # in a run, of a skill that can
SHAPES = {"circle": (10.0, 10.0, 1.0), "oval": (14.0, 8.0, 1.0), "square": (11.0, 11.0, 0.5)}  # radii; 0: all corner
LINE_PIECES, GAP_PIECES, RUN_TICKS = 40, 3, 1000
ON_THE_JOB = frozenset({5, 11})  # the lessons in which all below learn as well


def cross(seed: int) -> TaskSequence:
    """The twelve lessons, whatever the seed: lines and boxes take turns."""
    lines = [_follow(2 * i + 1, shape, (i + i // 3) % 3) for i, shape in enumerate((*SHAPES, *SHAPES))]
    boxes = [_push(2 * i + 2, i % 3) if i % 2 == 0 else _leave(2 * i + 2, i % 3) for i in range(6)]
    lessons = [each for both in zip(lines, boxes, strict=True) for each in both]
    return sequence_of(ROBOT, lessons, NOMINAL_COUNTS, ticks=4e6, on_the_job=ON_THE_JOB)


def _line(shape: str, aside: float) -> list[str]:
    """The places of the pieces of a line, from one side of a gap to the other, so far along x."""
    wide, deep, power = SHAPES[shape]
    turns = [2 * pi * piece / LINE_PIECES for piece in range(GAP_PIECES, LINE_PIECES - GAP_PIECES + 1)]
    sides = [[copysign(abs(side) ** power, side) for side in (cos(turn), sin(turn))] for turn in turns]
    return [f"{wide * x + aside:.1f} {deep * y:.1f}" for x, y in sides]


def _follow(number: int, shape: str, colour: int) -> WrittenLesson:
    """A line to follow from its gap on, and one of another colour that crosses it."""
    meant, other = COLOURS[colour], COLOURS[(colour + 1) % 3]
    task = [
        *("in plain", f"  lasts {RUN_TICKS} ticks", f"  starts at {SHAPES[shape][0]:g} 0"),
        f"  contains {meant}_line is zone size 2 at {' to '.join(_line(shape, 0))} reached vanishes",
        f"  contains {other}_line is zone size 2 at {' to '.join(_line(shape, 9))}",
        *(f"  rewards {EVENT_POINTS} on reach of {meant}_line", f"  counts reach of {meant}_line"),
    ]
    return WrittenLesson(f"Follow{number}", [f"{meant}_line_below", f"{other}_line_below", "pulse"], task)


def _push(number: int, colour: int) -> WrittenLesson:
    """Boxes to push home."""
    box = f"{COLOURS[colour]}_box"
    task = [
        *("in arena size 36", f"  lasts {RUN_TICKS} ticks", f"  contains {box} is box count 4 size 3 density 0.2"),
        *("  contains home is zone size 16", f"  rewards 0.1 * progress toward {box} per tick"),
        *(f"  rewards {EVENT_POINTS} on delivery of {box}", f"  counts delivery of {box}"),
    ]
    return WrittenLesson(f"Push{number}", [f"{box}_bearing", "home_bearing", "lidar"], task)


def _leave(number: int, colour: int) -> WrittenLesson:
    """Boxes that are too heavy, to drive around between them."""
    box = f"{COLOURS[colour]}_box"
    counted = "visit of patch size 4"
    task = [
        *("in arena size 40", f"  lasts {RUN_TICKS} ticks", f"  contains {box} is box count 4 size 3 density 50"),
        *(f"  ends on reach of {box}", f"  rewards {EVENT_POINTS} on {counted}", f"  counts {counted}"),
    ]
    return WrittenLesson(f"Leave{number}", [f"{box}_bearing", "lidar", "pulse"], task)
