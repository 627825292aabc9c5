"""Checks of the modules of a mind's procedures by their text alone, against what the skills need. Nothing is run."""

import sys
from collections.abc import Iterable, Iterator
from importlib import import_module
from pathlib import Path
from warnings import catch_warnings

from mindrun.errors import ProcedureError
from mindrun.graph.graph import Skill
from mindrun.graph.procedure_source import is_installed, source_of
from mindrun.kinds.functions.procedure import used_file
from mindrun.kinds.procedure_names import imports
from mindrun.kinds.procedure_text import file_of, parsed

from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.model import Mind
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Uses, of_form

BESIDE_MINDRUN = {"mindrun", "numpy"}  # modules that are wherever a bundle runs, beside those of Python itself
BUSY = {"__main__", "antigravity", "idlelib", "test", "this", "turtledemo"}  # modules of Python that do something


def mistakes(skills: Iterable[Skill], mind: Mind, folder: Path) -> Iterator[Diagnostic]:
    """The mistakes in the procedures among these skills, whose modules are in a folder.

    That something is not installed here is a warning: it may be on the robot.
    """
    declared = {skill.name: skill.declaration for skill in mind.skills}
    for skill in skills:
        if skill.function.calls is None:
            continue
        header = declared[skill.name].header
        span = header.phrase.span if header.phrase else header.name.span
        try:
            source_of(skill, folder)
        except ProcedureError as error:
            yield _faulty(error, span)
            continue
        for fact in of_form(declared[skill.name].facts, Uses):
            try:
                used_file(skill.function.calls, fact.file.text, folder)
            except ProcedureError as error:
                yield _faulty(error, fact.file.span)
        for said, mend in _absent(skill, folder):
            message = f"Procedure from {skill.function.calls}: imports {said}."
            hint = f"Without it {skill.name} runs neither here nor on a robot: {mend}."
            yield Diagnostic("faulty-procedure", message, span, hint, severity="warning")


def _faulty(error: ProcedureError, span: Span) -> Diagnostic:
    text = str(error)
    return Diagnostic("faulty-procedure", f"{text[0].upper()}{text[1:]}.", span, error.hint)


def needed_modules(skills: Iterable[Skill], folder: Path) -> dict[str, str]:
    """The modules of others that procedures cannot do without, and where the first import of each stands."""
    found: dict[str, str] = {}
    for module, _, where in _needed(skills, folder):
        if not _is_everywhere(top := module.partition(".")[0]):
            found.setdefault(top, where)
    return found


def _absent(skill: Skill, folder: Path) -> Iterator[tuple[str, str]]:
    """The imports of a procedure that are not installed here, each once, in words, with a hint.

    Of modules of others it is asked only whether they are installed: to know what is in them they would have to run.
    """
    told = set()
    for module, what, where in _needed([skill], folder):
        top = module.partition(".")[0]
        if not is_installed(top, folder):
            name, words, mend = top, "is not installed here", "install it on both"
        else:
            name = _missing_name(module, what) if _is_everywhere(top) and top not in BUSY else ""
            words, mend = f"{top} does not have here", f"write what {top} has on both"
        if name and name not in told:
            told.add(name)
            yield f"{name}, which {words} {where}", mend


def _needed(skills: Iterable[Skill], folder: Path) -> Iterator[tuple[str, str, str]]:
    """The modules that procedures cannot do without, what of them, and where that stands."""
    for skill in skills:
        if (calls := skill.function.calls) is not None:
            for line, module, what, may_be_missing in imports(parsed(calls, source_of(skill, folder))):
                if not may_be_missing:
                    yield module, what, f"({file_of(calls)}, line {line})"


def _is_everywhere(module: str) -> bool:
    return module in sys.stdlib_module_names or module in BESIDE_MINDRUN


def _missing_name(module: str, what: str) -> str:
    """The first of a dotted name that is not there; empty where all of it is."""
    if "." not in module and not what:
        return ""
    with catch_warnings(action="ignore"):  # of names that are going to be taken away
        try:
            found = import_module(module)
        except ImportError:
            return module
        if not what or hasattr(found, what):
            return ""
        try:
            import_module(f"{module}.{what}")
        except ImportError:
            return f"{module}.{what}"
    return ""
