"""Files beside those of an edit that use one of them, and that it leaves behind."""

from collections.abc import Iterator

from mindlang.compile import load
from mindlang.editing.carry_out import Edited
from mindlang.lock import Entry, lock_path, read_lock

LOCKED = ("skill", "sensor", "memory", "actuator")  # nouns whose names a lock identifies weights by


def broken(edited: Edited) -> Iterator[str]:
    """A sentence for each file that would no longer compile, and for each whose lock would go on saying an old name."""
    own = {file.source.path for file in edited.project.files}
    folders = {path.parent for path in edited.texts}
    found = {file for folder in folders for file in folder.glob("*.mind")}
    for path in sorted(found - {edited.project.main.source.path}):
        if (now := load(path)).graph is None or not ({source.path for source in now.sources} & edited.texts.keys()):
            continue
        if (after := load(path, edited.texts)).graph is None:
            yield f"{path.name} would no longer compile by itself: {after.diagnostics[0].message}"
        if path in own:
            continue
        lock = read_lock(lock_path(path))
        for old in {rename.old for rename in edited.change.renamed if rename.noun in LOCKED}:
            if any(old in _names(entry) for entry in lock.values()):
                yield f"{lock_path(path).name} goes on saying {old}: make this edit of {path.name}, and it follows"


def _names(entry: Entry) -> set[str]:
    """The skills and parts that a line of a lock names."""
    signature = entry.signature
    return {entry.skill, *(read.partition(":")[0] for read in signature.reads), *signature.sends}
