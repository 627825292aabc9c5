"""An edit of `mindc edit` made in an editor's texts, and the locks that follow it once its files are saved.

An edit is held against the compiler and told; nothing is written. A lock is about what lies on the disk, so a line of
it is only ever said by other names where these are the names that the saved files have. So an edit that is taken back
and saved again takes the lock back, too.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from mindlang.compiler.compile import Compiled, load
from mindlang.compiler.diagnostic import did_you_mean, listed
from mindlang.editing import transaction
from mindlang.editing.apply import apply_edit
from mindlang.editing.edits import Edit, edit, names
from mindlang.editing.lock_update import update_locks
from mindlang.editing.project import EditError, MindChange, Project, Renamed, Replaced, project_alone
from mindlang.editing.summary import broken_sentences, summarise
from mindlang.lock import Locks, lock_sources, lock_text, locks_of, merged
from mindlang.lock.signature import arrange
from mindlang.lock.status import Trained, status
from mindlang.server.workspace import MindView, Workspace


@dataclass(frozen=True, slots=True)
class PendingRename:
    """New names that locks have to follow: the minds that have them by their main files, and all files of these."""

    mains: tuple[Path, ...]
    files: tuple[Path, ...]
    renamed: tuple[Renamed, ...]
    replaced: Replaced | None

    @property
    def changes(self) -> tuple[MindChange, MindChange]:
        """The names as the edit gave them, and as they were."""
        back = tuple(Renamed(each.noun, each.new, each.old) for each in self.renamed)
        replaced = Replaced(self.replaced.new, self.replaced.old) if self.replaced else None
        return MindChange((), self.renamed, self.replaced), MindChange((), back, replaced)


@dataclass(frozen=True, slots=True)
class EditOutcome:
    """An edit's change of texts and files, the sentences about it, and the names that locks have to follow."""

    change: MindChange
    sentences: tuple[str, ...]
    following: PendingRename | None


def project(workspace: Workspace, view: MindView) -> Project:
    """The mind as edits know it, with the minds that share its files; EditError where it does not compile."""
    if view.compiled.graph is None:
        first = next(each for each in view.compiled.diagnostics if each.severity == "error")
        raise EditError(f"{view.main.name} has to compile first. {first.message}", first.hint, first.span)
    shared = (project_alone(other.compiled) for other in workspace.sharing(view) if other.compiled.graph)
    return replace(project_alone(view.compiled), neighbours=tuple(shared))


def proposed(project: Project, name: str, arguments: Mapping[str, Any]) -> MindChange:
    """The change that an edit would make; EditError where it is impossible."""
    if name not in names():
        raise EditError(f"There is no edit called {name}.", did_you_mean(name, names()))
    of = edit(name)
    change: MindChange = of.function(project, **_checked_arguments(of, arguments))
    return change


def perform(workspace: Workspace, path: Path, name: str, arguments: Mapping[str, Any]) -> EditOutcome:
    """An edit of the mind to which a file belongs; MindError where it is impossible or would break a mind."""
    on = project(workspace, workspace.view(path))
    change = proposed(on, name, arguments)
    edited = apply_edit(on, change, keep_weights=False, unsaved=workspace.texts)
    if broken := broken_sentences(edited):
        raise EditError(f"After this edit {broken[0]}", "mindc edit --anyway makes it nevertheless.")
    sentences = summarise(edited)
    locks = [lock.name for lock in edited.changed_locks]
    if not locks or not (change.renamed or change.replaced):
        return EditOutcome(change, tuple(sentences), None)
    sentences.append(f"{listed(locks, 'and')} will follow when the files are saved")
    files = dict.fromkeys(path for mind in on.minds for path in mind.paths)
    mains = tuple(mind.main.source.path for mind in on.minds)
    return EditOutcome(change, tuple(sentences), PendingRename(mains, tuple(files), change.renamed, change.replaced))


def _checked_arguments(of: Edit, arguments: Mapping[str, Any]) -> dict[str, Any]:
    """The arguments of an edit as its function takes them."""
    many = dict(of.arguments) | {option.name: option.many for option in of.options}
    for key in arguments:
        if key not in many:
            raise EditError(f"{of.name} has no argument called {key}.", did_you_mean(key, many))
    if missing := [key for key, _ in of.arguments if not arguments.get(key)]:
        raise EditError(f"{of.name} needs {listed(missing, 'and')}.", of.example)
    flags = {option.name for option in of.options if isinstance(option.default, bool)}
    found: dict[str, Any] = {}
    for key, value in arguments.items():
        texts = [str(each) for each in value] if isinstance(value, list | tuple) else [str(value)]
        found[key] = bool(value) if key in flags else tuple(texts) if many[key] else " ".join(texts)
    return found


def keep_up(following: PendingRename) -> list[Path]:
    """Rename in the locks what has been renamed in the files on the disk; returns the locks that changed.

    MindError where a lock is damaged or cannot be written.
    """
    minds = [mind for mind in map(load, following.mains) if mind.graph]
    if not minds:
        return []
    locks = locks_of(following.files)
    for change in following.changes:
        if now := _followed(minds, locks, change):
            _write(locks, now)
            return list(now)
    return []


def _followed(minds: Sequence[Compiled], locks: Locks, change: MindChange) -> Locks:
    """The locks that are others with these names; none where the minds do not have these names."""
    graphs = [mind.graph for mind in minds if mind.graph]
    names = minds[0].mind.names if minds[0].mind else None
    followed = update_locks(locks, graphs[0], graphs[0], change, keep_weights=False, neighbours=graphs[1:]).locks
    fit, would_fit = _fitting(minds, locks), _fitting(minds, followed)
    is_whole = all(len(followed[path]) == len(locks[path]) for path in locks)
    is_renamed = (
        names
        and change.renamed
        and all(each.new in names.of(each.noun) and each.old not in names.of(each.noun) for each in change.renamed)
    )  # it has the new names, and not the old ones
    if would_fit < fit or (would_fit == fit and not (is_whole and is_renamed)):
        return {}
    return {path: lock for path, lock in followed.items() if lock != locks[path]}


def _fitting(minds: Sequence[Compiled], locks: Locks) -> int:
    """The number of skills of the minds that have weights that fit."""
    count = 0
    for mind in minds:
        if mind.graph:
            lock = merged(locks, lock_sources(mind.sources))
            states = status(arrange(mind.graph, lock), lock).values()
            count += sum(isinstance(state, Trained) for state in states)
    return count


def _write(before: Locks, now: Locks) -> None:
    """Write locks, all or none, and not over what a training has written meanwhile."""

    def refuse_changed() -> None:
        for path in now:
            if locks_of([path])[path] != before[path]:
                raise EditError(f"{path.name} has been changed meanwhile.", "Save once more.")

    with transaction.no_training(now):
        files = {path: lock_text(lock).encode() for path, lock in now.items()}
        transaction.change(transaction.common_folder(files), files, refuse_changed)
