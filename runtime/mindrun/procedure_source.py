"""The module of a procedure where it stands beside the source: its text, if it can be all that the skill needs."""

from pathlib import Path

from mindrun.functions.procedure import module_source
from mindrun.graph import Skill
from mindrun.procedure_text import STANDS_ALONE, fault, fit, imports, texts


def source_of(skill: Skill, folder: Path) -> str:
    """The text of the module that a skill calls, in a folder; nothing is run.

    ProcedureError where the function is not there or cannot fit the skill, or the module needs another file: no bundle
    would hold that.
    """
    calls = str(skill.function.calls)
    source = module_source(calls, folder)
    fit(calls, source, len(skill.inputs), skill.outputs)
    for line, module, _ in imports(calls, source):
        top = module.partition(".")[0]
        places = f"{top}.py", f"{top}/__init__.py", f"{module.replace('.', '/')}.py"
        if not top or any(_is_file(folder / place) for place in places):
            raise fault(calls, f"imports {module}, a file that no bundle holds", line, STANDS_ALONE)
    for line, text in texts(calls, source):
        if "." in text and _is_file(folder / text):
            raise fault(calls, f"names {text}, a file that no bundle holds", line, STANDS_ALONE)
    return source


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # no name that a file could have
        return False
