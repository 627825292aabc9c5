"""An edit carried out: the sources as they become, held against the compiler, and what becomes of each skill."""

from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path

from mindrun.graph import Graph
from mindrun.weights import to_npy

from mindlang import journal
from mindlang.compile import compile_source
from mindlang.editing.follow import Followed, Locks, follow, locks_of, merged
from mindlang.editing.project import Change, EditError, Project
from mindlang.lock import lock_text
from mindlang.lock.arrange import arrange
from mindlang.lock.blobs import FOLDER, alone
from mindlang.lock.status import Status, status
from mindlang.source import decode
from mindlang.splice import spliced, unified

BOM = b"\xef\xbb\xbf"


@dataclass(frozen=True, slots=True)
class Edited:
    """What an edit comes to: the new texts by path, what they compile to, the locks as they are and as they follow."""

    project: Project
    change: Change
    texts: Mapping[Path, str]
    graph: Graph
    locks: Locks
    followed: Followed

    @property
    def diff(self) -> str:
        """The unified diff of all sources."""
        old = _old_texts(self.project)
        return "".join(unified(_name(self.project, path), old.get(path, ""), text) for path, text in self.texts.items())

    def statuses_before(self) -> dict[str, Status]:
        """How each skill stood."""
        return _statuses(self.project.graph, self.locks)

    def statuses(self) -> dict[str, Status]:
        """How each skill stands afterwards."""
        return _statuses(self.graph, self.followed.locks)


def carry_out(project: Project, change: Change, keep_weights: bool) -> Edited:
    """The edit made in memory; EditError where its result would not compile, nothing is written."""
    texts = _texts(project, change)
    graph = _compiled(project, texts)
    locks = locks_of([file.source.path for file in project.files] + list(change.created))
    return Edited(project, change, texts, graph, locks, follow(locks, project.graph, graph, change, keep_weights))


def write(edited: Edited) -> None:
    """Write sources, locks and weights, together or not at all; MindError where that fails."""
    folder = edited.project.main.source.folder
    followed = edited.followed
    locks = {path: lock for path, lock in followed.locks.items() if lock != edited.locks[path]}
    files = {path: to_npy(weights) for path, weights in followed.weights.items()}
    files |= {path: lock_text(lock).encode() for path, lock in locks.items()}
    files |= {path: _encoded(path, text) for path, text in edited.texts.items()}
    with ExitStack() as stack:
        for weights in sorted({path.parent / FOLDER for path in locks}):
            stack.enter_context(alone(weights))  # a training may keep what it has taught just now
        journal.change(folder, files, lambda: _refuse_changed(edited))


def _refuse_changed(edited: Edited) -> None:
    """EditError where something is not as it was read: another edit, a training or an editor has written it since."""
    old = _old_texts(edited.project)
    for path in old.keys() & edited.texts.keys():
        if path.is_symlink() or not path.is_file():
            raise EditError(f"There is no file {path} that could be written.", "Edit the file to which a link leads.")
    for path in (*old, *edited.texts):
        if _read(path) != old.get(path):
            raise EditError(f"{path.name} has been changed meanwhile.", "Try again: nothing has been written.")
    for path, lock in locks_of(old).items():
        if lock != edited.locks[path]:
            raise EditError(f"{path.name} has been changed meanwhile.", "Try again: nothing has been written.")


def _texts(project: Project, change: Change) -> dict[Path, str]:
    """The new texts of the files that change, and of those that are new."""
    touched = {id(splice.source) for splice in change.splices}
    texts = {
        file.source.path: spliced(file.source, change.splices) for file in project.files if id(file.source) in touched
    }
    return texts | dict(change.created)


def _old_texts(project: Project) -> dict[Path, str]:
    return {file.source.path: file.source.text for file in project.files}


def _compiled(project: Project, texts: dict[Path, str]) -> Graph:
    """What the files of a project come to with these texts; EditError where they do not compile."""
    now = _old_texts(project) | texts
    main = project.main.source
    compiled = compile_source(replace(main, text=now[main.path]), main.path, now)
    if compiled.graph is None:
        worst = next(diagnostic for diagnostic in compiled.diagnostics if diagnostic.severity == "error")
        error = EditError(f"After this edit the mind would not compile. {worst.message}", worst.hint)
        error.diagnostic = replace(worst, message=str(error))
        raise error
    return compiled.graph


def _statuses(graph: Graph, locks: Locks) -> dict[str, Status]:
    lock = merged(locks)
    return status(arrange(graph, lock), lock)


def _read(path: Path) -> str | None:
    try:
        return decode(path.read_bytes())
    except (FileNotFoundError, ValueError):
        return None


def _encoded(path: Path, text: str) -> bytes:
    """The bytes of a source, which begins with a byte order mark if it did before."""
    marked = path.exists() and path.read_bytes()[: len(BOM)] == BOM
    return (BOM if marked else b"") + text.encode()


def _name(project: Project, path: Path) -> str:
    return path.relative_to(project.main.source.folder).as_posix()
