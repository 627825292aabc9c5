"""Locks that follow an edit made in an editor: once its files are saved, as the lock is about what lies on the disk.

A line of a lock is only ever said by other names, and only where these are the names that the saved files have. So an
edit that is taken back and saved again takes the lock back, too.
"""

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

from mindrun.graph.graph import Graph

from mindlang.compiler.compile import Compiled, load
from mindlang.editing import transaction
from mindlang.editing.lock_update import Locks, locks_of, merged, update_locks
from mindlang.editing.project import EditError, MindChange, Renamed, Replaced
from mindlang.lock import Lock, lock_sources, lock_text
from mindlang.lock.arrange import arrange
from mindlang.lock.blobs import FOLDER, exclusive_folder
from mindlang.lock.status import Trained, status


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


def keep_up(following: PendingRename) -> list[Path]:
    """Rename in the locks what has been renamed in the files on the disk; returns the locks that changed.

    MindError where a lock is damaged or cannot be written.
    """
    minds = [mind for mind in map(load, following.mains) if mind.mind]
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
    first = minds[0].graph
    assert first is not None
    graphs = [mind.graph for mind in minds if mind.graph]
    followed = update_locks(locks, first, first, change, keep_weights=False, neighbours=graphs[1:]).locks
    fit, would_fit = _fitting(minds, locks), _fitting(minds, followed)
    is_whole = all(len(followed[path]) == len(locks[path]) for path in locks)
    if would_fit < fit or (would_fit == fit and not (is_whole and _is_renamed(minds[0], change))):
        return {}
    return {path: lock for path, lock in followed.items() if lock != locks[path]}


def _is_renamed(mind: Compiled, change: MindChange) -> bool:
    """Whether a mind has the new names and not the old ones."""
    assert mind.mind is not None
    names = mind.mind.names
    return bool(change.renamed) and all(
        each.new in names.of(each.noun) and each.old not in names.of(each.noun) for each in change.renamed
    )


def _fitting(minds: Sequence[Compiled], locks: Locks) -> int:
    """How many skills of the minds have weights that fit."""
    return sum(_trained(mind.graph, merged(locks, lock_sources(mind.sources))) for mind in minds if mind.graph)


def _trained(graph: Graph, lock: Lock) -> int:
    states = status(arrange(graph, lock), lock)
    return sum(isinstance(state, Trained) for state in states.values())


def _write(before: Locks, now: Locks) -> None:
    """Write locks, all or none, and not over what a training has written meanwhile."""

    def refuse_changed() -> None:
        for path in now:
            if locks_of([path])[path] != before[path]:
                raise EditError(f"{path.name} has been changed meanwhile.", "Save once more.")

    with ExitStack() as stack:
        for folder in sorted({path.parent / FOLDER for path in now}):
            stack.enter_context(exclusive_folder(folder))
        for folder in sorted({path.parent for path in now}):
            files = {path: lock_text(lock).encode() for path, lock in now.items() if path.parent == folder}
            transaction.change(folder, files, refuse_changed)
