"""The run that the breakpoints of tests are about: tests/language/right.mind on its task."""

from functools import cache
from pathlib import Path

from mindrun.graph.named_readings import physical

from mindlang.breakpoints.subject import BreakpointSubject
from mindlang.breakpoints.watch import RowBlock, Rows
from mindlang.compiler.compile import load

RIGHT = Path(__file__).parents[1] / "language" / "right.mind"


@cache
def subject(master: str = "Go", has_task: bool = True) -> BreakpointSubject:
    """The run under a master; without a task it is what a robot has recorded."""
    compiled = load(RIGHT)
    assert compiled.mind
    assert compiled.graph
    if not has_task:
        return BreakpointSubject.of_recording(compiled.graph, master, tuple(physical(compiled.graph)))
    return BreakpointSubject(compiled.mind.names, compiled.graph, master, compiled.graph.tasks[0])


def part(rows: Rows, first: int, end: int) -> RowBlock:
    """The rows from `first` up to `end`, counted from 0."""
    here = slice(first, end)
    return RowBlock(rows.readings[here], rows.influence[here], rows.commands[here], rows.events[here])
