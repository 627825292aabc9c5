"""The text of a procedure's module beside the source of a mind, if it can be all that the skill needs."""

from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

from mindrun.graph.graph import Skill
from mindrun.kinds.functions.procedure import module_source
from mindrun.kinds.procedure_names import imports, opened, texts
from mindrun.kinds.procedure_text import NOT_USED, STANDS_ALONE, fault, fit, parsed


def source_of(skill: Skill, folder: Path) -> str:
    """The text of the module that a skill calls, in a folder; nothing is run.

    ProcedureError where the function is not there or cannot fit the skill, or the module needs another file: no bundle
    would hold that.
    """
    calls = str(skill.function.calls)
    source = module_source(calls, folder)
    fit(calls, source, len(skill.inputs), skill.outputs, bool(skill.files))
    names = parsed(calls, source)
    for line, module, _, _ in imports(names):
        top = module.partition(".")[0]
        places = f"{top}.py", f"{top}/__init__.py", f"{module.replace('.', '/')}.py"
        if not top or any(_is(Path.is_file, folder / place) for place in places):
            raise fault(calls, f"imports {module}, a file that no bundle holds", line, STANDS_ALONE)
        if _is(Path.is_dir, folder / top) and not is_installed(top, folder):  # a package without an __init__.py
            raise fault(calls, f"imports {module}, a folder that no bundle holds", line, STANDS_ALONE)
    if skill.files and all(by != "__file__" for _, by in opened(names)):
        hint = f'Open them wherever it runs: Path(__file__).parent / "{skill.files[0]}"'
        raise fault(calls, "never says __file__, beside which the files are that the skill uses", hint=hint)
    for line, text in texts(names):
        if "." in text and text not in skill.files and _is(Path.is_file, folder / text):
            raise fault(calls, f"names {text}, a file that no bundle holds", line, NOT_USED)
    return source


def is_installed(module: str, folder: Path) -> bool:
    """True if a module, its name without a dot, is there wherever Python is begun; `folder`'s own does not count."""
    try:
        spec = find_spec(module)
    except ValueError:  # what is imported already, and from no file
        return True
    if spec is None or spec.origin is not None or spec.submodule_search_locations is None:
        return spec is not None
    own = (folder / module).resolve()
    return any(Path(place).resolve() != own for place in spec.submodule_search_locations)


def _is(kind: Callable[[Path], bool], path: Path) -> bool:
    try:
        return kind(path)
    except (OSError, ValueError):  # no name that a file could have
        return False
