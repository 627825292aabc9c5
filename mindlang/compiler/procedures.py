"""What the texts of a mind's procedures say of them: whether they can be what the skills need. Nothing is run."""

from collections.abc import Iterator
from pathlib import Path

from mindrun.errors import ProcedureError
from mindrun.functions.procedure import module_source
from mindrun.procedure_text import file_of, fit, imports
from mindrun.skill_sets import reachable

from mindlang.compiler.compile import Compiled
from mindlang.compiler.diagnostic import Diagnostic


def mistakes(compiled: Compiled, master: str | None = None) -> tuple[Diagnostic, ...]:
    """What is wrong with the procedures of a compiled mind: of all skills, or of those that a master reaches."""
    if compiled.graph is None or compiled.mind is None:
        return ()
    skills = compiled.graph.skills if master is None else reachable(compiled.graph, master)
    declared = {skill.name: skill.declaration.header for skill in compiled.mind.skills}
    found = []
    for skill in skills:
        if skill.function.calls is not None:
            try:
                _check(skill.function.calls, compiled.sources[0].folder, len(skill.inputs), skill.outputs)
            except ProcedureError as error:
                header, text = declared[skill.name], str(error)
                span = header.phrase.span if header.phrase else header.name.span
                found.append(Diagnostic("faulty-procedure", f"{text[0].upper()}{text[1:]}.", span, error.hint))
    return tuple(found)


def _check(calls: str, folder: Path, inputs: int, outputs: int) -> None:
    source = module_source(calls, folder)
    fit(calls, source, inputs, outputs)
    for line, module in _neighbours(source, folder):
        where = f"({file_of(calls)}, line {line})"
        message = f"procedure from {calls}: imports {module}, a file that no bundle holds {where}"
        raise ProcedureError(message, "A module stands alone: write what it needs into it.")


def _neighbours(source: str, folder: Path) -> Iterator[tuple[int, str]]:
    """The lines that import what stands beside the mind, and what that is."""
    for line, module in imports(source):
        top = module.partition(".")[0]
        if not top or (folder / f"{top}.py").is_file() or (folder / top / "__init__.py").is_file():
            yield line, module
