"""An edit written: sources, locks and weights together or not at all, and not over what somebody else has written."""

import os
from collections.abc import Iterable
from contextlib import ExitStack
from pathlib import Path

from mindrun.files.npy import to_npy
from mindrun.files.regular_files import read_regular

from mindlang.compiler.source import MAX_SOURCE_BYTES, decode, encoded
from mindlang.editing import transaction
from mindlang.editing.apply import Edited
from mindlang.editing.lock_update import locks_of
from mindlang.editing.project import EditError
from mindlang.lock import lock_text
from mindlang.lock.blobs import FOLDER, exclusive_folder


def write(edited: Edited) -> None:
    """Write what an edit changes; MindError where that fails."""
    locks = {path: edited.followed.locks[path] for path in changed_locks(edited)}
    files: dict[Path, bytes | None] = {path: to_npy(weights) for path, weights in edited.followed.weights.items()}
    files |= {path: lock_text(lock).encode() for path, lock in locks.items()}
    files |= {path: encoded(path, text) for path, text in edited.texts.items()}
    with ExitStack() as stack:
        for weights in sorted({path.parent / FOLDER for path in locks}):
            stack.enter_context(exclusive_folder(weights))  # a training may keep what it has taught just now
        transaction.change(_folder(files), files, lambda: _refuse_changed(edited), keeps=True)


def changed_locks(edited: Edited) -> list[Path]:
    """The locks that an edit changes."""
    return [path for path, lock in edited.followed.locks.items() if lock != edited.locks[path]]


def _folder(files: Iterable[Path]) -> Path:
    """The folder in which all files lie, or below."""
    return Path(os.path.commonpath([path.parent for path in files]))


def _refuse_changed(edited: Edited) -> None:
    """EditError where something is not as it was read: another edit, a training or an editor has written it since."""
    old = edited.old_texts
    for path in old.keys() & edited.texts.keys():
        if path.is_symlink() or not path.is_file():
            raise EditError(f"There is no file {path} that could be written.", "Edit the file to which a link leads.")
    for path in (*old, *edited.texts):
        if _read(path) != old.get(path):
            raise EditError(f"{path.name} has been changed meanwhile.", "Try again: nothing has been written.")
    for path, lock in edited.locks.items():
        if locks_of([path])[path] != lock:
            raise EditError(f"{path.name} has been changed meanwhile.", "Try again: nothing has been written.")


def _read(path: Path) -> str | None:
    try:
        return decode(read_regular(path, MAX_SOURCE_BYTES + 1))
    except (FileNotFoundError, ValueError):
        return None
