"""The last edit that was written, taken back: sources, locks and weights together or not at all."""

from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path

from mindlang.editing import transaction
from mindlang.editing.transaction import TransactionError
from mindlang.lock.blobs import FOLDER, exclusive_folder

Files = Mapping[Path, bytes | None]


def kept_in(folder: Path) -> Path | None:
    """The folder, or the nearest above it, in which an edit was written last; None where none was."""
    return next((each for each in (folder, *folder.parents) if (each / transaction.UNDO_NAME).is_file()), None)


def undo(folder: Path) -> tuple[Files, Files]:
    """Take back the last edit that was written in a folder; its files as they were until now, and as they are.

    What was done before that edit is not kept. TransactionError where a file has been changed since.
    """
    files = transaction.last_change(folder)
    now = {path: path.read_bytes() if path.exists() else None for path in files}
    locked = {path.parent / FOLDER for path in files if path.suffix == ".lock"}
    with ExitStack() as stack:
        for weights in sorted(locked):
            stack.enter_context(exclusive_folder(weights))  # a training may keep what it has taught just now
        transaction.change(folder, files, lambda: _refuse_changed(folder, files))
    (folder / transaction.UNDO_NAME).unlink(missing_ok=True)
    return now, files


def _refuse_changed(folder: Path, files: Files) -> None:
    """TransactionError where another edit was written meanwhile, or one of the files."""
    if transaction.last_change(folder) != files:
        raise TransactionError("another edit has been written meanwhile", "nothing has been taken back")
