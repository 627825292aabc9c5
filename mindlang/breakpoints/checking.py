"""A .break file held against a mind before anything runs, or where there is none, read line by line."""

from collections.abc import Mapping
from pathlib import Path

from mindrun.named_readings import physical

from mindlang.breakpoints.file import BreakpointFile, breakpoints_of, load_breakpoints
from mindlang.breakpoints.subject import Subject
from mindlang.compiler.compile import Compiled, load
from mindlang.compiler.source import Source
from mindlang.run.setup import master_of, task_of


def check_breakpoints(path: str, mind: Compiled | None, task: str | None) -> BreakpointFile:
    """What is wrong with the lines of the file at `path`, of which no more than their words are known without a mind.

    The task is that of a run by default; SetupError where the mind has none of that name. Events of the task and of a
    robot count both: a file may be for both.
    """
    return load_breakpoints(path, _subject(mind, task) if mind else None)


def check_text(source: Source, mind: Compiled | None) -> BreakpointFile:
    """The same of a text, and the task of a run by default."""
    return breakpoints_of(source, _subject(mind, None) if mind else None)


def mind_of(path: str, given: Mapping[str, Compiled]) -> Compiled | None:
    """The mind that a .break file is about: the only one of those that are given, else that of its name beside it.

    None where there is none, or where it does not compile.
    """
    minds = [compiled for compiled in given.values() if compiled.graph]
    beside = Path(path).with_suffix(".mind")
    found = minds[0] if len(minds) == 1 else load(beside) if beside.exists() else None
    return found if found and found.graph else None


def _subject(compiled: Compiled, name: str | None) -> Subject:
    assert compiled.mind
    assert compiled.graph
    graph, sensors = compiled.graph, tuple(physical(compiled.graph))
    if not graph.tasks and name is None:
        return Subject(compiled.mind.names, graph, graph.master, None, sensors)
    task, _ = task_of(graph, name)
    return Subject(compiled.mind.names, graph, master_of(graph, task, None), task, sensors)
