"""What mindc can be asked about a line: an editor shows these words above it, and runs them in a terminal."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Declaration, Master, Teaches
from mindlang.server.view import MindView

DUE_TITLE = "Train what is due"
LOOKING_COMMANDS = {"Run": "run", "Bench": "bench", "View": "view"}  # a word above the line, and the command of mindc


@dataclass(frozen=True, slots=True)
class Lens:
    """A word above a line, and the arguments of mindc that it stands for."""

    span: Span
    title: str
    words: tuple[str, ...]


def lenses(view: MindView, path: Path) -> list[Lens]:
    """The words above the lines `master`, `task` and `curriculum` of a file, in the order of its text.

    All of them are about the mind to which the file belongs. A task has the skills that are taught on it.
    """
    file = view.file(path)
    if file is None or not view.main.is_file():
        return []
    found = [lens for setting in file.settings if isinstance(setting, Master) for lens in _of_master(view, setting)]
    for declaration in file.declarations:
        match declaration.header.noun.text:
            case "task":
                found += _of_task(view, declaration)
            case "curriculum":
                found.append(_of_curriculum(view, declaration))
    return sorted(found, key=lambda lens: lens.span.start)


def _of_master(view: MindView, master: Master) -> Iterator[Lens]:
    """Nothing in a mind that only thinks, for there is no world in which it could be run."""
    if master.span.source.path == view.main and view.names.of("task"):
        if view.names.of("curriculum"):
            yield Lens(master.span, DUE_TITLE, ("train", view.main.name))
        yield from _looks(view, master.span)


def _of_task(view: MindView, task: Declaration) -> Iterator[Lens]:
    header, name = task.header, task.header.name.text
    lessons = (fact for file in view.files for each in file.declarations for fact in each.facts)
    skills = dict.fromkeys(fact.skill.text for fact in lessons if isinstance(fact, Teaches) and fact.task.text == name)
    for skill in skills:
        yield Lens(header.span, f"Train {skill}", ("train", view.main.name, skill))
    yield from _looks(view, header.span, "--task", name)


def _of_curriculum(view: MindView, curriculum: Declaration) -> Lens:
    header = curriculum.header
    return Lens(header.span, DUE_TITLE, ("train", view.main.name, "--curriculum", header.name.text))


def _looks(view: MindView, span: Span, *more: str) -> Iterator[Lens]:
    return (Lens(span, title, (command, view.main.name, *more)) for title, command in LOOKING_COMMANDS.items())
