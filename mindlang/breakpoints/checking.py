"""A .break file held against a mind or a bundle before anything runs, or where there is none, read line by line."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from mindrun.graph.named_readings import physical

from mindlang.breakpoints.subject import Subject
from mindlang.compiler.compile import Compiled, load
from mindlang.run.chosen_task import master_of, task_of

if TYPE_CHECKING:
    from mindrun.graph.bundle import Bundle


def mind_of(path: str, given: Mapping[str, Compiled]) -> Compiled | None:
    """The mind that a .break file is about: the only one of those that are given, else that of its name beside it.

    None where there is none, or where it does not compile.
    """
    minds = [compiled for compiled in given.values() if compiled.graph]
    beside = Path(path).with_suffix(".mind")
    found = minds[0] if len(minds) == 1 else load(beside) if beside.exists() else None
    return found if found and found.graph else None


def subject_of_mind(compiled: Compiled, task: str | None = None, master: str | None = None) -> Subject:
    """A run of a mind, with the task and the master of these names or those of a run by default.

    Events of the task and of a robot count both: a file may be for both. SetupError where there is none of that name.
    """
    assert compiled.mind
    assert compiled.graph
    graph, sensors = compiled.graph, tuple(physical(compiled.graph))
    chosen = task_of(graph, task)[0] if graph.tasks or task else None
    return Subject(compiled.mind.names, graph, master_of(graph, chosen, master), chosen, sensors)


def subject_of_bundle(bundle: Bundle, task: str | None = None, master: str | None = None) -> Subject:
    """What a robot with this bundle will record; with a task, what a dry run of it will. SetupError as above."""
    graph = bundle.graph
    wired = [wire.sensor for wire in bundle.wiring.sensors] if bundle.wiring and not task else physical(graph)
    chosen = task_of(graph, task)[0] if task else None
    return Subject.of_recording(graph, master_of(graph, None, master), tuple(wired), chosen)
