"""`mindc edit split`."""

from pathlib import Path

from mindlang.editing.insertion import text_of, use_line, without_declarations
from mindlang.editing.project import EditError, MindChange, Project


def split(project: Project, to: str, names: tuple[str, ...]) -> MindChange:
    """Move declarations to a new file, and use it.

    A name that two nouns have takes its noun with it: task:Avoid.

    Example: mindc edit split collect.mind wheels.mind left_wheel right_wheel
    """
    main = project.main.source
    path = (main.folder / to).resolve()
    if not path.is_relative_to(main.folder) or path.suffix != ".mind" or '"' in to or Path(to).is_absolute():
        message = f"{to} is no .mind file in the folder of {main.name} or below it."
        raise EditError(message, "Write for example skills.mind.")
    used = (file.source.path.resolve() for file in project.files)  # an editor may not have saved them
    if path.exists() or path in used:
        raise EditError(f"{to} exists already.", "Choose another name.")
    chosen = []
    for noun, _, own in (name.rpartition(":") for name in dict.fromkeys(names)):
        declaration = project.declared(own, noun, f"{{}}:{own}")
        if declaration.header.span.source is not main:
            raise EditError(f"{own} stands in another file.", "", declaration.header.name.span)
        chosen.append(declaration)
    splices = (*without_declarations(chosen), use_line(project.main, Path(to).as_posix()))
    return MindChange(splices, created={path: text_of(chosen)})
