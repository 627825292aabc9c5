"""An edit carried out: the sources as they become, held against the compiler, and what becomes of each skill."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from mindrun.weights import to_npy

from mindlang import journal
from mindlang.compile import Compiled, compile_source
from mindlang.editing.follow import Followed, follow, locks_of, merged
from mindlang.editing.project import Change, EditError, Project
from mindlang.lock import lock_text
from mindlang.lock.arrange import arrange
from mindlang.lock.blobs import FOLDER, alone
from mindlang.lock.status import Status, status
from mindlang.splice import spliced, unified

BOM = b"\xef\xbb\xbf"


@dataclass(frozen=True, slots=True)
class Edited:
    """What an edit comes to: the new texts by path, what they compile to, and the locks as they follow."""

    project: Project
    change: Change
    texts: Mapping[Path, str]
    compiled: Compiled
    followed: Followed

    @property
    def diff(self) -> str:
        """The unified diff of all sources."""
        old = {file.source.path: file.source for file in self.project.files}
        return "".join(
            unified(_name(self.project, path), old[path].text if path in old else "", text)
            for path, text in self.texts.items()
        )

    def statuses(self) -> dict[str, Status]:
        """How each skill stands afterwards."""
        assert self.compiled.graph is not None
        lock = merged(self.followed.locks)
        return status(arrange(self.compiled.graph, lock), lock)


def carry_out(project: Project, change: Change, keep_weights: bool) -> Edited:
    """The edit made in memory; EditError where its result would not compile, nothing is written."""
    texts = _texts(project, change)
    compiled = _compiled(project, texts)
    if compiled.graph is None:
        worst = compiled.diagnostics[0]
        error = EditError(f"After this edit the mind would not compile. {worst.message}", worst.hint)
        error.diagnostic = replace(worst, message=str(error))
        raise error
    locks = locks_of([file.source.path for file in project.files] + list(change.created))
    lock = merged(locks)
    before, after = arrange(project.graph, lock), compiled.graph
    return Edited(project, change, texts, compiled, follow(locks, before, after, change, keep_weights))


def write(edited: Edited) -> None:
    """Write sources, locks and weights, together or not at all; MindError where that fails."""
    folder = edited.project.main.source.folder
    files = {path: to_npy(weights) for path, weights in edited.followed.weights.items()}
    for path, text in edited.texts.items():
        files[path] = _encoded(path, text)
    for path, entries in edited.followed.locks.items():
        if path.exists() or entries:
            files[path] = lock_text(entries).encode()
    with alone(folder / FOLDER):  # a training may keep what it has taught just now
        journal.change(folder, files)


def _texts(project: Project, change: Change) -> dict[Path, str]:
    """The new texts of the files that change, and of those that are new."""
    touched = {id(splice.source) for splice in change.splices}
    texts = {
        file.source.path: spliced(file.source, change.splices) for file in project.files if id(file.source) in touched
    }
    return texts | dict(change.created)


def _compiled(project: Project, texts: Mapping[Path, str]) -> Compiled:
    main = project.main.source
    source = replace(main, text=texts.get(main.path, main.text))
    return compile_source(source, main.path, texts)


def _encoded(path: Path, text: str) -> bytes:
    """The bytes of a source, which begins with a byte order mark if it did before."""
    marked = path.exists() and path.read_bytes()[: len(BOM)] == BOM
    return (BOM if marked else b"") + text.encode()


def _name(project: Project, path: Path) -> str:
    return path.relative_to(project.main.source.folder).as_posix()
