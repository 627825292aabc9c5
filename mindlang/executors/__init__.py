"""Where jobs are done, by what --on says: one file a kind, `begin(argument, assignment)` opens it."""

from dataclasses import dataclass
from importlib import import_module
from pkgutil import iter_modules

from mindrun.errors import MindError
from mindrun.work.assignment import Assignment
from mindrun.work.executor import Executor

THREADS = "threads"  # of this process: no executor, and no argument


@dataclass(frozen=True, slots=True)
class Where:
    """A kind of executor, and what is said of it behind the colon."""

    kind: str
    argument: str

    def begin(self, assignment: Assignment) -> Executor:
        """Workers for the jobs of an assignment; MindError where there can be none."""
        executor: Executor = import_module(f"{__name__}.{self.kind}").begin(self.argument, assignment)
        return executor


def kinds() -> list[str]:
    """The kinds of executors, but for threads."""
    return sorted(module.name for module in iter_modules(__path__))


def where(text: str) -> Where | None:
    """What --on says, None for the threads of this process; MindError where it says nothing that is known."""
    kind, _, argument = text.partition(":")
    if text == THREADS:
        return None
    if kind not in kinds():
        raise MindError(f"nobody knows where {text!r:.60} is", f"--on says {THREADS}, or {usages()}")
    module = import_module(f"{__name__}.{kind}")
    if flaw := module.flaw(argument):
        raise MindError(f"{text!r:.60} says no {kind}: {flaw}", f"--on says it so: {module.USAGE}")
    return Where(kind, argument)


def usages() -> str:
    """How each kind is said."""
    return ", ".join(import_module(f"{__name__}.{kind}").USAGE for kind in kinds())
