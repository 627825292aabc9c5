"""Work grows as files do: counted in calls of functions, which are the same on any machine."""

import pytest

from benchmarks.doubling import COMMANDS, LINEAR, calls, growth
from benchmarks.shapes import SHAPES

LINES = 40
FEW = ("skills that nobody reaches", "one sensor again", "misspelt readings", "things not there", "comments and facts")
ALL = [pytest.param(shape, marks=() if shape in FEW else pytest.mark.slow) for shape in SHAPES]
ALLOWED = {
    ("actuators", "prove"),  # bounds are proved of each actuator through each skill
}


@pytest.mark.parametrize("shape", ALL)
def test_twice_the_lines_are_twice_the_work(shape: str) -> None:
    slow = {}
    for command in COMMANDS:
        figures = [calls(command, shape, factor * LINES) for factor in (1, 2, 4)]
        if growth(figures) > LINEAR and (shape, command) not in ALLOWED:
            slow[command] = figures
    assert not slow
