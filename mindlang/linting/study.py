"""What a lint rule looks at, and what it finds."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from mindrun.graph import Graph, Lesson

from mindlang.compile import Compiled
from mindlang.diagnostic import Findings, Fix, Label
from mindlang.editing.references import mentions
from mindlang.hierarchy import reached
from mindlang.lock import Lock, read_locks
from mindlang.model import Mind, Skill, Task
from mindlang.resolve.names import Names, gather
from mindlang.source import Span


@dataclass(frozen=True)
class Study:
    """A mind that compiled, and what its locks say."""

    mind: Mind
    graph: Graph
    names: Names
    lock: Lock

    @cached_property
    def skills(self) -> dict[str, Skill]:
        """The skills by name."""
        return {skill.name: skill for skill in self.mind.skills}

    @cached_property
    def tasks(self) -> dict[str, Task]:
        """The tasks by name."""
        return {task.name: task for task in self.mind.tasks}

    @cached_property
    def masters(self) -> set[str]:
        """The skills that are ever in charge: the mind's master, and those of its lessons."""
        return {self.mind.master, *(lesson.master for lesson in self.mind.lessons)}

    @cached_property
    def active(self) -> set[str]:
        """The skills that a master reaches."""
        return {name for master in self.masters for name in reached(self.skills, master)}

    @cached_property
    def used(self) -> dict[str, set[str]]:
        """The names that stand anywhere but in their own declaration, by noun."""
        found: dict[str, set[str]] = {}
        for mention in mentions(self.mind.files, self.names):
            if not mention.is_own:
                found.setdefault(mention.noun, set()).add(mention.name.text)
        return found

    def learners(self, lesson: Lesson) -> tuple[str, ...]:
        """The skills that a lesson of the graph teaches."""
        from mindrun.weights import learners

        return learners(self.graph, lesson)


@dataclass(frozen=True, slots=True)
class Finding:
    """What a rule finds: where, what is wrong in the user's words, and what to do; `fix` does it."""

    span: Span
    message: str
    hint: str
    labels: tuple[Label, ...] = ()
    fix: Fix | None = None


Found = Iterator[Finding]


def study(compiled: Compiled) -> Study:
    """The study of a mind that compiled; LockError where a lock is damaged."""
    assert compiled.mind is not None
    assert compiled.graph is not None
    lock = read_locks(source.path for source in compiled.sources)
    return Study(compiled.mind, compiled.graph, gather(compiled.mind.files, Findings()), lock)
