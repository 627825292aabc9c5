"""Files of an edit are changed together or not at all: killed, out of room, or changed by somebody else meanwhile."""

import errno
import json
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
from mindlang.editing.apply import apply_edit
from mindlang.editing.edits.rename import rename
from mindlang.editing.project import EditError, open_project
from mindlang.editing.transaction import JOURNAL_NAME, TransactionError, change, recover
from mindlang.editing.writing import write
from tests.calling import Call
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


def changed_with(folder: Path, fails: Callable[[int, str], BaseException | None]) -> BaseException | None:
    """How a change ends when operations fail."""
    with pytest.MonkeyPatch.context() as patch:
        failing(patch, fails)
        try:
            change(folder, files(folder, OTHER))
        except (Crash, TransactionError, KeyboardInterrupt) as error:
            return error
    return None


def test_a_crash_between_any_two_operations_leaves_all_files_as_they_were_or_changes_all(folder: Path) -> None:
    ends = []
    for last in count():
        crashed = changed_with(folder, lambda number, _, last=last: Crash() if number >= last else None)
        interrupted = (folder / JOURNAL_NAME).exists()
        assert recover(folder) == interrupted
        now = found(folder)
        now.pop(f".{JOURNAL_NAME}.mind-tmp", None)  # nobody reads it, and it goes with the next edit
        assert now in (ONE, OTHER), f"after {last} operations"
        ends.append(now == OTHER)
        change(folder, files(folder, ONE))
        (folder / "new.mind").unlink(missing_ok=True)
        if crashed is None:
            break
    assert sorted(ends) == ends
    assert len(ends) > 15


@pytest.mark.parametrize("error", [OSError(errno.EIO, "Input/output error"), KeyboardInterrupt()])
def test_an_operation_that_fails_changes_nothing(folder: Path, error: BaseException) -> None:
    for place in count():
        failed = changed_with(folder, lambda number, _, place=place: error if number == place else None)
        if failed is None:  # whether the journal's end is on the disk makes no difference
            break
        now = found(folder)
        if now == OTHER:  # stopped when all was done already
            assert isinstance(failed, KeyboardInterrupt)
            break
        assert now == ONE, f"after {place} operations"
        assert isinstance(failed, TransactionError if isinstance(error, OSError) else KeyboardInterrupt)
    assert place > 10


def test_on_a_full_disk_all_is_put_back_as_soon_as_there_is_room(folder: Path) -> None:
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
        recover(folder)
        assert found(folder) == ONE, f"after {place} operations"
    assert ends == {
        "",
        f"the edit is half done; any mindc command takes it back as soon as {folder} can be written again",
    }


def test_whatever_moment_a_process_is_killed_at(folder: Path) -> None:
    rng = Random(1)
    interrupted = 0
    for _ in range(12):
        with subprocess.Popen([sys.executable, CHANGING, folder], stdout=subprocess.PIPE) as process:
            assert process.stdout
            process.stdout.readline()
            sleep(rng.uniform(0, 0.03))
            process.send_signal(signal.SIGKILL)
        interrupted += recover(folder)
        now = found(folder)
        now.pop(f".{JOURNAL_NAME}.mind-tmp", None)
        assert now in (ONE, OTHER, ONE | {"new.mind": OTHER["new.mind"]})
    assert interrupted


def test_what_was_changed_by_hand_since_is_not_overwritten(folder: Path) -> None:
    with pytest.MonkeyPatch.context() as patch:
        replaced = count()
        failing(patch, lambda _, name: Crash() if name == "replace" and next(replaced) > 1 else None)
        patch.setattr("mindlang.editing.transaction._undo", lambda *_: None)  # the process is gone
        with pytest.raises(Crash):
            change(folder, files(folder, OTHER))
    (folder / "a.lock").write_text("by hand")
    before = found(folder)
    with pytest.raises(TransactionError, match=r"a\.lock has been changed since an edit of a\.mind") as refused:
        recover(folder)
    assert str(folder / JOURNAL_NAME) in refused.value.hint
    with pytest.raises(TransactionError):
        change(folder, files(folder, OTHER))
    assert found(folder) == before
    (folder / JOURNAL_NAME).unlink()
    assert not recover(folder)


@pytest.mark.parametrize(
    "name", ["../out.mind", "/tmp/out.mind", "x.py", "weights/../../out.mind", "link/out.mind", "link.mind"]
)
def test_a_journal_from_somewhere_else_changes_nothing_outside(folder: Path, tmp_path_factory: Any, name: str) -> None:
    outside = tmp_path_factory.mktemp("outside")
    (folder / "link").symlink_to(outside)
    (folder / "link.mind").symlink_to(outside / "out.mind")
    (folder / JOURNAL_NAME).write_text(json.dumps({name: {"was": "eA==", "becomes": ""}}))
    with pytest.raises(TransactionError, match="is not what mindc wrote"):
        recover(folder)
    assert list(outside.iterdir()) == []
    assert not (folder.parent / "out.mind").exists()


@pytest.mark.parametrize(
    "text", ["", "{", "[]", '{"a.mind": 1}', '{"a.mind": {"was": "?", "becomes": 1}}', "{1}", "\udcff"]
)
def test_a_damaged_journal_is_told(mindc: Call, rules: Path, text: str) -> None:
    (rules.parent / JOURNAL_NAME).write_bytes(text.encode("utf-8", "surrogateescape"))
    said = mindc("check", rules)
    assert said.code == 2
    assert f"{JOURNAL_NAME} is not what mindc wrote" in said.err


def test_any_command_puts_back_what_an_edit_left(mindc: Call, rules: Path) -> None:
    old = rules.read_text()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("mindlang.editing.transaction._done", lambda *_: Path("/nowhere").stat())
        patch.setattr("mindlang.editing.transaction._undo", lambda *_: None)
        assert mindc("edit", "rename", "Turn", "Spin", rules, "--write").code == 1
    assert rules.read_text() != old
    assert mindc("check", rules).code == 0
    assert rules.read_text() == old
    assert sorted(path.name for path in rules.parent.iterdir()) == [rules.name]


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


def test_what_is_taken_back_is_said(mindc: Call, rules: Path) -> None:
    text = rules.read_text()
    project = open_project(load(rules))
    edited = apply_edit(project, rename(project, "Turn", "Spin"), keep_weights=False)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("mindlang.editing.transaction._done", lambda *_: (_ for _ in ()).throw(Crash()))
        patch.setattr("mindlang.editing.transaction._undo", lambda *_: None)
        with pytest.raises(Crash):
            write(edited)
    assert rules.read_text() != text
    said = mindc("show", rules)
    assert (said.code, rules.read_text()) == (0, text)
    assert "An edit was interrupted, and has been taken back." in said.err


def test_edits_of_several_processes_lose_nothing(rules: Path) -> None:
    names = [("Turn", "Spin"), ("Chase", "Hunt"), ("left_wheel", "port"), ("feeler", "whisker")]
    commands = [
        [
            sys.executable,
            "-c",
            "from mindlang.cli import main; main()",
            "edit",
            "rename",
            old,
            new,
            str(rules),
            "--write",
        ]
        + ["--noun", "skill"] * old[0].isupper()
        for old, new in names
    ]
    processes = [subprocess.Popen(command, stderr=subprocess.PIPE, text=True) for command in commands]
    said = [process.communicate()[1] for process in processes]
    text = rules.read_text()
    for (old, new), process, err in zip(names, processes, said, strict=True):
        assert process.returncode == (0 if f" {new} " in text else 1), err
        assert process.returncode == 0 or "rules.mind has been changed meanwhile." in err
        assert (f" {old} " in text) == bool(process.returncode) or old == "Chase", "the task of that name stays"
    assert load(rules).graph is not None
    assert any(process.returncode == 0 for process in processes)
