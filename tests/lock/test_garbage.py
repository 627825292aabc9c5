"""`mindc gc` removes the weights that no lock names, and nothing else."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from mindlang.lock import LockError, lock_path
from mindlang.lock.blobs import blob, remove, unnamed
from tests.calling import Call
from tests.edits.taught import recorded, teach


def test_gc_removes_what_no_lock_names(mindc: Call, drive: Path) -> None:
    teach(drive)
    old = recorded(drive)
    teach(drive, seed=2)
    stray = drive.parent / "weights" / "notes.npy"
    np.save(stray, np.zeros(3))
    (drive.parent / "poetry.lock").write_text("no lock of ours")
    listed = mindc("gc", drive.parent, "--json")
    found = json.loads(listed.out)
    assert str(blob(drive.parent, old)) in found["files"]
    assert (len(found["files"]), found["removed"]) == (2, False)
    assert blob(drive.parent, old).exists()
    assert mindc("gc", drive.parent, "--write").code == 0
    assert not blob(drive.parent, old).exists()
    assert blob(drive.parent, recorded(drive)).exists()
    assert stray.exists()
    assert mindc("gc", drive.parent).err.startswith("nothing to remove")


def test_gc_removes_nothing_where_a_lock_is_damaged_or_missing(mindc: Call, drive: Path) -> None:
    teach(drive)
    kept = blob(drive.parent, recorded(drive))
    lock_path(drive).write_text("?")
    said = mindc("gc", drive.parent, "--write")
    assert (said.code, kept.exists()) == (1, True)
    assert "drive.lock is damaged" in said.err
    lock_path(drive).unlink()
    assert mindc("gc", drive.parent, "--write").code == 0
    assert kept.exists()


def test_below_too_but_neither_hidden_nor_behind_links(drive: Path, tmp_path: Path) -> None:
    teach(drive)
    teach(drive, seed=2)
    old = {path.name for path in unnamed(drive.parent)}
    project, elsewhere = tmp_path / "project", tmp_path / "elsewhere"
    for folder in (project / "b", project / "a" / "deep", project / ".git" / "copy", elsewhere):
        folder.mkdir(parents=True)
        for each in (drive, lock_path(drive)):
            shutil.copy2(each, folder)
        shutil.copytree(drive.parent / "weights", folder / "weights")
    (project / "link").symlink_to(elsewhere)
    half = project / "half"  # its weights lie elsewhere: they are not this project's
    half.mkdir()
    for each in (drive, lock_path(drive)):
        shutil.copy2(each, half)
    (half / "weights").symlink_to(elsewhere / "weights")
    (project / "b" / "weights" / f"{'0' * 64}.npy").symlink_to(elsewhere / drive.name)
    found = unnamed(project)
    assert {path.parent.parent for path in found} == {project / "a" / "deep", project / "b"}
    assert {path.name for path in found} == old


def test_what_a_lock_names_by_now_stays(drive: Path) -> None:
    teach(drive)
    old = lock_path(drive).read_bytes()
    teach(drive, seed=2)
    found = unnamed(drive.parent)
    assert found
    lock_path(drive).write_bytes(old)  # somebody has gone back to it in the meantime
    remove(found)
    assert all(path.exists() for path in found)


def test_a_file_that_cannot_be_removed_is_named(drive: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    teach(drive)
    teach(drive, seed=2)
    found = unnamed(drive.parent)

    def refuse(path: Path) -> None:
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(Path, "unlink", refuse)
    with pytest.raises(LockError, match=rf"{found[0].name} cannot be removed: Permission denied"):
        remove(found)
