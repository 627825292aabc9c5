"""Two versions of a lock made one: the lines of both branches, and their worlds whole."""

from collections.abc import Mapping
from dataclasses import dataclass

from mindlang.lock import Entry, Lock, lock_of

CONFLICT_PARTS = ("<<<<<<< ours", "=======", ">>>>>>> theirs")


@dataclass(frozen=True, slots=True)
class MergedLock:
    """What two branches agree on, and by skill what each of them says where both have changed it; None: nothing."""

    entries: Lock
    conflicts: Mapping[str, tuple[Entry | None, Entry | None]]

    def text(self) -> str:
        """The lock; of a skill that both have changed both lines, between the marks of git."""
        lines = {skill: str(entry) for skill, entry in self.entries.items()}
        lines |= {skill: _conflict(*sides) for skill, sides in self.conflicts.items()}
        both = (side for sides in self.conflicts.values() for side in sides if side)
        return lock_of(lines, [*self.entries.values(), *both])


def merge(base: Lock, ours: Lock, theirs: Lock) -> MergedLock:
    """The lines that one of two branches has changed, added or taken out since `base`, and those that none has."""
    entries: dict[str, Entry] = {}
    conflicts: dict[str, tuple[Entry | None, Entry | None]] = {}
    for skill in sorted({*ours, *theirs}):
        before, own, other = (lock.get(skill) for lock in (base, ours, theirs))
        if own != other and before not in (own, other):
            conflicts[skill] = own, other
        elif now := other if own == before else own:
            entries[skill] = now
    return MergedLock(entries, conflicts)


def _conflict(ours: Entry | None, theirs: Entry | None) -> str:
    first, between, last = CONFLICT_PARTS
    return "\n".join([first, *([str(ours)] if ours else []), between, *([str(theirs)] if theirs else []), last])
