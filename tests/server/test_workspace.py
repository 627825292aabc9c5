"""Whatever lies about in a workspace: nothing is waited for, nothing is read that is too large, and all is answered."""

import os
from pathlib import Path
from resource import RUSAGE_SELF, getrusage

import pytest

from mindlang import files
from tests.language.examples import RIGHT
from tests.server.client import editing, uri

PARTS = "sensor eye is battery\n"
MAIN = 'tick 1/60 s\nmaster Go\nuse "parts.mind"\nbody Robot is disc\nactuator left is wheel side left neutral 0.5\n'
GO = "skill Go is rule\n  reads eye\n  drives left at eye\n"


@pytest.fixture
def odd(tmp_path: Path) -> Path:
    """A folder with everything that is no source, whatever its name says."""
    folder = tmp_path.resolve()
    os.mkfifo(folder / "pipe.mind")
    os.mkfifo(folder / "module.py")
    with (folder / "huge.mind").open("wb") as huge:
        huge.truncate(3 << 30)
    (folder / "loop.mind").symlink_to("loop.mind")
    (folder / "zero.mind").symlink_to("/dev/zero")
    (folder / "lost.mind").symlink_to("nowhere")
    (folder / "folder.mind").mkdir()
    (folder / "up").symlink_to("..")
    (folder / "bytes.mind").write_bytes(b"\xff\xfe\0")
    (folder / "parts.mind").write_text(PARTS)
    (folder / "main.mind").write_text(MAIN + GO)
    return folder


def memory() -> int:
    """The most memory that this process, with the server in it, has had, in KiB."""
    return getrusage(RUSAGE_SELF).ru_maxrss


def test_what_lies_about_is_passed_over(odd: Path) -> None:
    with editing(odd) as editor:
        editor.open(odd / "parts.mind")
        assert editor.settle(odd / "parts.mind") == []
        before = memory()
        place = editor.at(odd / "parts.mind", "eye")
        assert "read by Go" in editor.ask("textDocument/hover", place)["contents"]["value"]
        found = editor.ask("textDocument/references", {**place, "context": {"includeDeclaration": True}})
        assert {each["uri"] for each in found} == {uri(odd / "main.mind"), uri(odd / "parts.mind")}
        assert [each["name"] for each in editor.ask("workspace/symbol", {"query": "eye"})] == ["eye"]
        assert memory() - before < 200_000


def test_what_is_no_file_is_said_when_it_is_used(odd: Path) -> None:
    with editing(odd) as editor:
        for name in ("pipe", "huge", "loop", "zero", "lost", "folder", "bytes"):
            text = f'use "{name}.mind"\n{MAIN}{GO}'
            path = odd / f"uses_{name}.mind"
            editor.open(path, text)
            assert [each["code"] for each in editor.settle(path)] in (["unreadable-use"], ["outside-project"]), name
            editor.ask("textDocument/definition", editor.at(path, f"{name}.mind"))
        path = odd / "says.mind"
        editor.open(path, "skill Go is procedure from module.function\nskill Do is procedure from \n")
        editor.ask("textDocument/definition", editor.at(path, "module.function", 9))
        editor.ask("textDocument/completion", editor.at(path, "procedure from \n", 15))


def test_no_more_is_looked_through_than_one_can_wait_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "MAX_FOLDER_ENTRIES", 10)
    for number in range(30):
        (tmp_path / f"f{number:02}.mind").write_text("x")
        (tmp_path / f"d{number:02}").mkdir()
        (tmp_path / f"d{number:02}" / "g.mind").write_text("x")
    assert len(files.files_beside(tmp_path)) <= 10
    assert 0 < len([*files.files_below(tmp_path)]) <= 10
    assert len([*files.within_read_limits((Path(str(n)), "x" * (1 << 20)) for n in range(99))]) == 8
    assert len([*files.within_read_limits((Path(str(n)), "") for n in range(9999))]) == files.MAX_READ_FILES


def test_many_findings_are_told_once(tmp_path: Path) -> None:
    path = tmp_path.resolve() / "many.mind"
    with editing(tmp_path) as editor:
        editor.open(path, RIGHT.read_text(encoding="utf-8") + "sensor eyes is battery\n" * 5000)
        found = editor.settle(path)
        assert len(found) == 1001
        assert "4000 more findings" in found[-1]["message"]


def test_settings_count_and_what_is_wrong_in_them_is_said_in_the_first_line(tmp_path: Path) -> None:
    folder = tmp_path.resolve()
    (folder / "main.mind").write_text(
        (MAIN + GO).replace('use "parts.mind"', "sensor eye is battery\nsensor odd is battery")
    )
    settings = folder / "mind.toml"
    settings.write_text('[lint]\nignore = ["unread-sensor", "no-rule"]\n')
    with editing(folder) as editor:
        editor.open(folder / "main.mind")
        found = editor.settle(folder / "main.mind")
        assert "unread-sensor" not in {each["code"] for each in found}
        wrong = next(each for each in found if each["code"] == "unknown-rule")
        assert "mind.toml:2: There is no rule called no-rule." in wrong["message"]
        assert wrong["range"]["start"] == {"line": 0, "character": 0}
