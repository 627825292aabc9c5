"""The run that the breakpoints of tests are about: tests/language/right.mind on its task."""

from functools import cache
from pathlib import Path

from mindlang.breakpoints.resolve import Subject
from mindlang.compiler.compile import load

RIGHT = Path(__file__).parents[1] / "language" / "right.mind"


@cache
def subject(master: str = "Go", has_task: bool = True) -> Subject:
    """The run under a master; without a task it is that of a robot."""
    compiled = load(RIGHT)
    assert compiled.mind
    assert compiled.graph
    return Subject(compiled.mind, compiled.graph, master, compiled.graph.tasks[0] if has_task else None)
