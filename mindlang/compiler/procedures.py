"""What the texts of a mind's procedures say of them: whether they can be what the skills need. Nothing is run."""

import sys
from collections.abc import Iterable, Iterator
from importlib.util import find_spec
from pathlib import Path

from mindrun.errors import ProcedureError
from mindrun.graph import Skill
from mindrun.procedure_source import source_of
from mindrun.procedure_text import file_of, imports

from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.model import Mind

BESIDE_MINDRUN = {"mindrun", "numpy"}  # modules that are wherever a bundle runs, beside those of Python itself


def mistakes(skills: Iterable[Skill], mind: Mind, folder: Path) -> Iterator[Diagnostic]:
    """What is wrong with the procedures among these skills, whose modules are in a folder.

    That a module of others is not installed here is a warning: it may be on the robot.
    """
    declared = {skill.name: skill.declaration.header for skill in mind.skills}
    for skill in skills:
        if skill.function.calls is None:
            continue
        header = declared[skill.name]
        span = header.phrase.span if header.phrase else header.name.span
        try:
            source_of(skill, folder)
        except ProcedureError as error:
            text = str(error)
            yield Diagnostic("faulty-procedure", f"{text[0].upper()}{text[1:]}.", span, error.hint)
            continue
        for module, where in needed_modules([skill], folder).items():
            if not _is_installed(module):
                message = f"Procedure from {skill.function.calls}: imports {module}, which is not installed here"
                hint = f"Without it {skill.name} runs neither here nor on a robot: install it on both."
                yield Diagnostic("faulty-procedure", f"{message} {where}.", span, hint, severity="warning")


def needed_modules(skills: Iterable[Skill], folder: Path) -> dict[str, str]:
    """The modules of others that procedures cannot do without, and where the first import of each stands."""
    found: dict[str, str] = {}
    for skill in skills:
        if (calls := skill.function.calls) is not None:
            for line, module, may_be_missing in imports(calls, source_of(skill, folder)):
                top = module.partition(".")[0]
                if not may_be_missing and top not in sys.stdlib_module_names and top not in BESIDE_MINDRUN:
                    found.setdefault(top, f"({file_of(calls)}, line {line})")
    return found


def _is_installed(module: str) -> bool:
    try:
        return find_spec(module) is not None
    except ValueError:  # what is imported already, and from no file
        return True
