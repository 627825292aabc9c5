"""Who plays what: the task of a run, the master in charge, and the weights of all skills below it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Never

from mindrun.default_task import default_task
from mindrun.errors import MindError
from mindrun.graph import Graph, Task
from mindrun.weights import owners, reachable

from mindlang.compiler.compile import Compiled
from mindlang.compiler.diagnostic import did_you_mean, listed
from mindlang.lock.ready import ReadyMind, make_ready

if TYPE_CHECKING:
    from mindrun.sim.rollout import Rollout


class SetupError(MindError):
    """A run that cannot begin. `misuse`: the command line is what is wrong."""

    def __init__(self, message: str, hint: str = "", misuse: bool = False) -> None:
        super().__init__(message, hint)
        self.misuse = misuse


@dataclass(frozen=True, slots=True)
class RunSetup:
    """A task, the master in charge of it, and a mind that is ready to run; `note` says why it is this task."""

    task: Task
    master: str
    ready: ReadyMind
    folder: Path
    note: str = ""

    def rollout(self, interrupt: bool = True, workers: int = 1) -> Rollout:
        """The task under the master, in the simulator. Runs the text of the procedures' modules."""
        from mindrun.sim.rollouts import rollout_for

        return rollout_for(
            self.ready.policy,
            self.task.name,
            self.master,
            procedures=self.folder,
            interrupt=interrupt,
            workers=workers,
        )


def set_up(file: str, compiled: Compiled, task: str | None, master: str | None) -> RunSetup:
    """The task and the master of these names, or the default ones; SetupError where they cannot run."""
    assert compiled.graph is not None
    chosen, note = task_of(compiled.graph, task)
    leader = master_of(compiled.graph, chosen, master)
    ready = make_ready(compiled.graph, compiled.sources, leader)
    if ready.refusals:
        raise SetupError("\n".join(ready.refusals), f"mindc train {file} {' '.join(untaught_skills(ready))}")
    return RunSetup(chosen, leader, ready, compiled.sources[0].folder, note)


def task_of(graph: Graph, name: str | None) -> tuple[Task, str]:
    """The task of that name; without one, the mind's default, and why it is that one where this needs saying."""
    if not graph.tasks:
        raise SetupError("there is no task to run", "add one: task Go in plain")
    if name is None:
        return default_task(graph)
    found = next((task for task in graph.tasks if task.name == name), None)
    return found or unknown("task", name, [task.name for task in graph.tasks]), ""


def master_of(graph: Graph, task: Task | None, name: str | None) -> str:
    """Who is in charge of a task: the skill of that name; without one, the master of the task's first lesson.

    Where no lesson is on the task, or there is none, the mind's own master.
    """
    if name is None:
        return next((lesson.master for lesson in graph.lessons if task and lesson.task == task.name), graph.master)
    return skill_of(graph, name)


def skill_of(graph: Graph, name: str) -> str:
    """The name, which a skill has; SetupError where none does."""
    skills = [skill.name for skill in graph.skills]
    return name if name in skills else unknown("skill", name, skills)


def unknown(noun: str, name: str, known: Sequence[str]) -> Never:
    """SetupError for a name that is none, with one that was nearly written or those that there are."""
    hint = did_you_mean(name, known) or f"There is {listed(known, 'and')}."
    raise SetupError(f"there is no {noun} called {name}", hint, misuse=True)


def untaught_skills(ready: ReadyMind) -> list[str]:
    """The skills without weights that fit, subskills first."""
    reached = reachable(ready.policy.graph, ready.policy.graph.master)
    return [name for name in reversed(owners(reached)) if name not in ready.policy.weights]
