"""Work grows as files do: counted in calls of functions, which are the same on any machine."""

import pytest

from benchmarks.doubling import COMMANDS, LINEAR_RATIO, calls, growth
from benchmarks.shapes import SHAPES

LINES, WORDS = 40, 160  # a line of a few words is explained otherwise than a long one
FEW_CALLS = 1000
FEW = ("skills that nobody reaches", "things not there")
ALL = [pytest.param(shape, marks=() if shape in FEW else pytest.mark.slow) for shape in SHAPES]
ALLOWED = {
    ("layers", "show"),  # a tree is as wide as it is deep
}


@pytest.mark.parametrize("shape", ALL)
def test_twice_the_lines_are_twice_the_work(shape: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        "mindlang.compiler.diagnostic.MAX_DIAGNOSTICS", 4
    )  # what is done for the first few lines only is done here, too
    monkeypatch.setattr("mindlang.editing.unified_diff.MAX_COMPARED_LINES", 10)
    monkeypatch.setattr("mindlang.lint.lint.MAX_FIX_ROUNDS", 2)
    first = WORDS if shape.startswith("one long") else LINES
    slow = {}
    for command in COMMANDS:
        figures = [calls(command, shape, factor * first) for factor in (1, 2, 4)]
        if growth(figures) > LINEAR_RATIO and figures[2] > FEW_CALLS and (shape, command) not in ALLOWED:
            slow[command] = figures
    assert not slow
