"""`mindc edit split`."""

from mindlang.editing.page import newline, text_of, use_line, without_declaration
from mindlang.editing.project import Change, EditError, Project


def split(project: Project, to: str, names: tuple[str, ...]) -> Change:
    """Move declarations to a new file, and use it.

    A name that two nouns have takes its noun with it: task:Avoid.

    Example: mindc edit split wheels.mind left_wheel right_wheel collect.mind
    """
    main = project.main.source
    path = (main.folder / to).resolve()
    if not path.is_relative_to(main.folder) or path.suffix != ".mind":
        raise EditError(
            f"{to} is no .mind file in the folder of {main.name} or below it.", "Write for example skills.mind."
        )
    if path.exists():
        raise EditError(f"{to} exists already.", "Choose another name.")
    chosen = [project.declared(*reversed(name.rpartition(":")[::2])) for name in dict.fromkeys(names)]
    for declaration in chosen:
        if project.file_of(declaration) is not project.main:
            raise EditError(f"{declaration.header.name.text} stands in another file.", "", declaration.header.name.span)
    chosen.sort(key=lambda declaration: declaration.header.span.start)
    end = newline(main)
    created = (end * 2).join(text_of(declaration) for declaration in chosen) + end
    splices = (*(without_declaration(declaration) for declaration in chosen), use_line(project.main, to))
    return Change(splices, created={path: created})
