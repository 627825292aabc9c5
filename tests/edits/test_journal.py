"""Files of an edit are changed together or not at all: killed, out of room, or changed by somebody else meanwhile."""

import errno
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path
from random import Random
from time import sleep
from typing import Any

import pytest

from mindlang.compiler.compile import load
from mindlang.editing.apply import apply_edit, write
from mindlang.editing.edits.rename import rename
from mindlang.editing.project import EditError, open_project
from mindlang.editing.transaction import UNDO_NAME, TransactionError, change, undo
from tests.edits.changing import ONE, OTHER, files

CHANGING = Path(__file__).parent / "changing.py"
OPERATIONS = ((os, "fsync"), (Path, "open"), (Path, "replace"), (Path, "unlink"), (Path, "mkdir"))


class Crash(BaseException):
    """The end of a process."""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "weights").mkdir()
    for path, data in files(tmp_path, ONE).items():
        path.write_bytes(data)
    return tmp_path


def found(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def failing(patch: pytest.MonkeyPatch, fails: Callable[[int, str], BaseException | None]) -> Iterator[int]:
    """Let file operations fail: which of them, by their number and name."""
    numbers = count()
    for owner, name in OPERATIONS:
        works: Any = getattr(owner, name)

        def attempt(*arguments: Any, works: Any = works, name: str = name, **options: Any) -> Any:
            reads = name == "open" and "w" not in str((*arguments[1:], options))
            if not reads and (error := fails(next(numbers), name)):
                raise error
            return works(*arguments, **options)

        patch.setattr(owner, name, attempt)
    return numbers


def changed_with(
    folder: Path, fails: Callable[[int, str], BaseException | None], killed: bool = False
) -> BaseException | None:
    """How a change ends when operations fail; where the process is `killed`, nothing is put back."""
    with pytest.MonkeyPatch.context() as patch:
        failing(patch, fails)
        if killed:
            patch.setattr("mindlang.editing.transaction._put_back", lambda *_: None)
        try:
            change(folder, files(folder, OTHER), keeps=True)
        except (Crash, TransactionError, KeyboardInterrupt) as error:
            return error
    return None


@pytest.mark.parametrize("error", [OSError(errno.EIO, "Input/output error"), KeyboardInterrupt()])
def test_an_operation_that_fails_changes_nothing(folder: Path, error: BaseException) -> None:
    for place in count():
        failed = changed_with(folder, lambda number, _, place=place: error if number == place else None)
        if failed is None:  # whether the journal's end is on the disk makes no difference
            break
        now = {name: data for name, data in found(folder).items() if name != UNDO_NAME}
        if now == OTHER:  # stopped when all was done already
            assert isinstance(failed, KeyboardInterrupt)
            break
        assert now == ONE, f"after {place} operations"
        assert isinstance(failed, TransactionError if isinstance(error, OSError) else KeyboardInterrupt)
    assert place > 10


def test_what_is_killed_while_it_writes_can_be_taken_back(folder: Path) -> None:
    ends = []
    for last in count():
        crashed = changed_with(folder, lambda number, _, last=last: Crash() if number >= last else None, killed=True)
        if (folder / UNDO_NAME).exists():
            undo(folder)
        now = {name: data for name, data in found(folder).items() if not name.endswith(".mind-tmp")}
        assert now == ONE, f"after {last} operations"
        ends.append(crashed)
        if crashed is None:
            break
    assert len(ends) > 10


def test_whatever_moment_a_process_is_killed_at(folder: Path) -> None:
    rng = Random(1)
    for _ in range(3):
        with subprocess.Popen([sys.executable, CHANGING, folder], stdout=subprocess.PIPE) as process:
            assert process.stdout
            process.stdout.readline()
            sleep(rng.uniform(0, 0.03))
            process.send_signal(signal.SIGKILL)
        if (folder / UNDO_NAME).exists():
            undo(folder)
        now = {name: data for name, data in found(folder).items() if not name.endswith(".mind-tmp")}
        assert now in (ONE, OTHER, ONE | {"new.mind": OTHER["new.mind"]})


def test_on_a_full_disk_what_could_not_be_put_back_can_be_taken_back(folder: Path) -> None:
    full = OSError(errno.ENOSPC, "No space left on device")
    ends = set()
    for place in count():
        failed = changed_with(
            folder, lambda number, name, place=place: full if number >= place and name in ("open", "fsync") else None
        )
        if failed is None:
            break
        assert "No space left on device" in str(failed)
        assert isinstance(failed, TransactionError)
        ends.add(failed.hint)
        if (folder / UNDO_NAME).exists():
            undo(folder)
        assert found(folder) == ONE, f"after {place} operations"
    assert ends == {"", "the edit is half done: mindc edit undo takes it back"}


def test_what_was_written_since_the_file_was_read_is_not_lost(rules: Path) -> None:
    def edited(old: str, new: str) -> Any:
        project = open_project(load(rules))
        return apply_edit(project, rename(project, old, new, noun="skill"), keep_weights=False)

    first, second = edited("Turn", "Spin"), edited("Chase", "Hunt")
    write(first)
    now = rules.read_text()
    with pytest.raises(EditError, match=r"rules\.mind has been changed meanwhile") as refused:
        write(second)
    assert refused.value.hint == "Try again: nothing has been written."
    assert rules.read_text() == now
    write(edited("Chase", "Hunt"))
    assert "Spin" in rules.read_text()
    rules.unlink()
    with pytest.raises(EditError, match="There is no file"):
        write(second)


@pytest.mark.parametrize("name", ["b.txt", "link.mind"])
def test_what_could_not_be_put_back_is_not_changed(folder: Path, name: str) -> None:
    (folder / "link.mind").symlink_to(folder / "a.mind")
    before = found(folder)
    with pytest.raises(TransactionError, match=rf"{name} cannot be changed together with others"):
        change(folder, {folder / "a.mind": b"other", folder / name: b"other"})
    assert found(folder) == before


def test_who_may_read_a_file_still_may(rules: Path) -> None:
    rules.chmod(0o640)
    rules.with_name("rules.mind.tmp").write_text("mine")
    project = open_project(load(rules))
    write(apply_edit(project, rename(project, "Turn", "Spin"), keep_weights=False))
    assert "Spin" in rules.read_text()
    assert rules.stat().st_mode & 0o777 == 0o640
    assert rules.with_name("rules.mind.tmp").read_text() == "mine"


def test_edits_of_several_processes_lose_nothing(rules: Path) -> None:
    names = [("Turn", "Spin"), ("Chase", "Hunt")]
    program = [sys.executable, "-c", "from mindlang.cli import main; main()"]
    commands = [[*program, "edit", "rename", rules, old, new, "--write", "--noun", "skill"] for old, new in names]
    processes = [subprocess.Popen(command, stderr=subprocess.PIPE, text=True) for command in commands]
    said = [process.communicate()[1] for process in processes]
    text = rules.read_text()
    for (old, new), process, err in zip(names, processes, said, strict=True):
        assert process.returncode == (0 if f" {new} " in text else 1), err
        assert process.returncode == 0 or "rules.mind has been changed meanwhile." in err
        assert (f" {old} " in text) == bool(process.returncode) or old == "Chase", "the task of that name stays"
    assert load(rules).graph is not None
    assert any(process.returncode == 0 for process in processes)
