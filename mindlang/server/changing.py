"""An edit of `mindc edit` made in an editor's texts: held against the compiler, and told; nothing is written."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from mindlang.compiler.diagnostic import did_you_mean, listed
from mindlang.compiler.splice import Splice
from mindlang.editing.apply import apply_edit
from mindlang.editing.edits import Edit, edit, names
from mindlang.editing.project import EditError, MindChange, Project
from mindlang.editing.summary import broken_sentences, summarise
from mindlang.editing.writing import changed_locks
from mindlang.server.navigating import sharing
from mindlang.server.pending_renames import PendingRename
from mindlang.server.view import MindView
from mindlang.server.workspace import Workspace


@dataclass(frozen=True, slots=True)
class EditOutcome:
    """What an edit does to texts, which files it makes, what there is to say, and which names locks have to follow."""

    change: MindChange
    sentences: tuple[str, ...]
    following: PendingRename | None


def project(workspace: Workspace, view: MindView) -> Project:
    """The mind as edits know it, with the minds that share its files; EditError where it does not compile."""
    if view.compiled.graph is None:
        first = next(each for each in view.compiled.diagnostics if each.severity == "error")
        raise EditError(f"{view.main.name} has to compile first. {first.message}", first.hint, first.span)
    shared = (_project(other) for other in sharing(workspace, view) if other.compiled.graph)
    return replace(_project(view), neighbours=tuple(shared))


def proposed(project: Project, name: str, arguments: Mapping[str, Any]) -> MindChange:
    """What an edit would splice; EditError where it is impossible."""
    if name not in names():
        raise EditError(f"There is no edit called {name}.", did_you_mean(name, names()))
    of = edit(name)
    change: MindChange = of.function(project, **_checked_arguments(of, arguments))
    return change


def perform(workspace: Workspace, path: Path, name: str, arguments: Mapping[str, Any]) -> EditOutcome:
    """An edit of the mind to which a file belongs; MindError where it is impossible or would break a mind."""
    on = project(workspace, workspace.view(path))
    change = proposed(on, name, arguments)
    edited = apply_edit(on, _as_open(on, change, workspace), keep_weights=False)
    if broken := broken_sentences(edited):
        raise EditError(f"After this edit {broken[0]}", "mindc edit --anyway makes it nevertheless.")
    sentences = summarise(edited)
    locks = [lock.name for lock in changed_locks(edited)]
    if not locks or not (change.renamed or change.replaced):
        return EditOutcome(change, tuple(sentences), None)
    sentences.append(f"{listed(locks, 'and')} will follow when the files are saved")
    minds = (on, *on.neighbours)
    files = dict.fromkeys(path for mind in minds for path in mind.paths)
    mains = tuple(mind.main.source.path for mind in minds)
    return EditOutcome(change, tuple(sentences), PendingRename(mains, tuple(files), change.renamed, change.replaced))


def _project(view: MindView) -> Project:
    assert view.compiled.mind is not None
    assert view.compiled.graph is not None
    return Project(view.compiled.mind, view.compiled.graph)


def _checked_arguments(of: Edit, arguments: Mapping[str, Any]) -> dict[str, Any]:
    """The arguments of an edit as its function takes them."""
    many = dict(of.arguments) | {option.name: option.many for option in of.options}
    for key in arguments:
        if key not in many:
            raise EditError(f"{of.name} has no argument called {key}.", did_you_mean(key, many))
    if missing := [key for key, _ in of.arguments if not arguments.get(key)]:
        raise EditError(f"{of.name} needs {listed(missing, 'and')}.", of.example)
    flags = {option.name for option in of.options if isinstance(option.default, bool)}
    return {key: _value(value, many[key], key in flags) for key, value in arguments.items()}


def _value(value: Any, is_many: bool, is_flag: bool) -> Any:
    if is_flag:
        return bool(value)
    texts = [str(each) for each in value] if isinstance(value, list | tuple) else [str(value)]
    return tuple(texts) if is_many else " ".join(texts)


def _as_open(project: Project, change: MindChange, workspace: Workspace) -> MindChange:
    """The change with an empty splice for each open file that it leaves alone, so that this is held against, too."""
    touched = {splice.source.path for splice in change.splices}
    minds = (*project.neighbours, project)
    open_ = {path: file.source for mind in minds for path, file in mind.paths.items() if path in workspace.texts}
    idle = (Splice(source, 0, 0, "") for path, source in open_.items() if path not in touched)
    return replace(change, splices=(*change.splices, *idle))
