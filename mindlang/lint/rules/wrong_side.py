"""A part whose name says left, and which is on the right, or the other way round.

A wheel is on the `side` that it says, and angles turn counterclockwise: a range finder at 40 deg looks to the left, a
bumper at -40 deg is on the right. A robot with two such parts exchanged turns toward what it should avoid.
"""

from collections.abc import Iterator
from math import sin

from mindlang.compiler.source import Span
from mindlang.lint.study import Finding, Found, Study, name_words

OPPOSITE_SIDES = {"left": "right", "right": "left"}
GOOD = ("sensor left_eye is range_finder at 30 60 deg\n", "sensor left_eye is range_finder at 0 deg\n")
BAD = (
    "sensor left_eye is range_finder at -40 deg\n",
    "sensor left_bumper is bumper at -40 deg\n",
    """
actuator left_wheel is wheel side right neutral 0.5
actuator right_wheel is wheel side left neutral 0.5
""",
)


def check(study: Study) -> Found:
    for name, side, span in _sided(study):
        said = {*name_words(name)}
        if OPPOSITE_SIDES[side] in said and side not in said:
            hint = f"Put it on the {OPPOSITE_SIDES[side]}, or rename it: {study.main.edit('rename', name, 'NAME')}"
            yield Finding(span, f"{name} is on the {side}.", hint)


def _sided(study: Study) -> Iterator[tuple[str, str, Span]]:
    """The parts that are on a side, on which, and where they are declared."""
    for actuator in study.mind.actuators:
        if side := actuator.kind.mounted:
            yield actuator.name, side, actuator.span
    for sensor in study.mind.sensors:
        sides = {_side(angle) for angle in sensor.kind.directions}
        if len(sides) == 1 and (only := sides.pop()):
            yield sensor.name, only, sensor.span


def _side(angle: float) -> str:
    aside = sin(angle)
    return "" if abs(aside) < 1e-9 else "left" if aside > 0 else "right"
