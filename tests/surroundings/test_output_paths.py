"""Where a user has files written to: nothing but a regular file is ever replaced, whatever stands there."""

import stat
from pathlib import Path

import pytest
from mindrun.files.atomic_write import destination, rewrite, write_out

from tests.calling import Call
from tests.surroundings.kinds import FILES, KINDS, look


@pytest.mark.parametrize("kind", KINDS)
def test_only_files_are_replaced(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "out"
    KINDS[kind](path)
    before, linked = look(path), look(tmp_path / "target")
    if kind in FILES:
        write_out(path, b"new")
        assert path.read_bytes() == b"new"
    else:
        for writing in (write_out, lambda path, data: rewrite(path, data, b"")):
            with pytest.raises(OSError, match=r"it is a |symbolic links"):
                writing(path, b"new")
    assert before in (None, look(path)), "a link stays a link"
    assert linked in (None, look(tmp_path / "target"))
    assert not [left for left in tmp_path.iterdir() if left.suffix == ".mind-tmp"]


@pytest.mark.parametrize("kind", ["file", "pipe"])
def test_a_bundle_goes_into_a_file_alone(mindc: Call, rules: Path, kind: str) -> None:
    out = rules.with_name("out")
    KINDS[kind](out)
    said = mindc("build", rules, "-o", out)
    assert (said.code, said.out) == (0 if kind == "file" else 1, "")
    assert kind == "file" or said.err.startswith(f"{out} cannot be written: it is a {kind}")


def test_no_name_is_wrong_usage(mindc: Call) -> None:
    for name in ("/", ".", "..", "a/"):
        said = mindc("build", "r.mind", "-o", name)
        assert (said.code, f"{name!r} names no file." in said.err) == (2, True)


def test_a_name_that_cannot_be_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    for name in ("x" * 300, "no/such/folder", "file/out"):
        with pytest.raises(OSError, match=r"too long|there is no folder"):
            write_out(tmp_path / name, b"new")
    assert [left.name for left in tmp_path.iterdir()] == ["file"]


def test_a_file_that_is_replaced_keeps_its_mode(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.touch(0o640)
    path.chmod(0o640)
    write_out(path, b"new")
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


def test_a_destination_is_where_the_links_lead(tmp_path: Path) -> None:
    (tmp_path / "far").mkdir()
    (tmp_path / "link").symlink_to("far/file")
    assert destination(tmp_path / "link") == tmp_path.resolve() / "far" / "file"


def test_other_names_of_a_file_keep_what_it_was(tmp_path: Path) -> None:
    path, other = tmp_path / "a", tmp_path / "b"
    path.write_bytes(b"old")
    other.hardlink_to(path)
    write_out(path, b"new")
    assert (path.read_bytes(), other.read_bytes()) == (b"new", b"old")


@pytest.mark.parametrize("meanwhile", [b"saved by an editor", b"", None])
def test_what_an_editor_saves_meanwhile_is_not_lost(tmp_path: Path, meanwhile: bytes | None) -> None:
    path = tmp_path / "a.mind"
    if meanwhile is not None:
        path.write_bytes(meanwhile)
    with pytest.raises(OSError, match=r"it has been changed meanwhile"):
        rewrite(path, b"tidy", b"as it was read")
    assert (path.read_bytes() if path.exists() else None) == meanwhile
    assert len(list(tmp_path.iterdir())) == (meanwhile is not None)


@pytest.mark.parametrize(
    ("words", "last"),
    [(["fmt"], "mindlang.compiler.format.formatted"), (["lint", "--fix"], "mindlang.lint.lint.apply_safe_fixes")],
)
def test_tools_that_edit_refuse_what_has_changed(
    mindc: Call, rules: Path, monkeypatch: pytest.MonkeyPatch, words: list[str], last: str
) -> None:
    rules.write_text(rules.read_text().replace("sensor feeler", "memory old is cell decay 0.9\nsensor  feeler"))
    saved = b"# saved by an editor\n"
    module, _, name = last.rpartition(".")
    real = getattr(__import__(module, fromlist=[name]), name)

    def slow(*given: object) -> object:
        made = real(*given)
        rules.write_bytes(saved)
        return made

    monkeypatch.setattr(last, slow)
    said = mindc(*words, rules)
    assert rules.read_bytes() == saved
    assert said.code == 1
    assert "changed meanwhile" in said.err
    assert [*rules.parent.iterdir()] == [rules]
