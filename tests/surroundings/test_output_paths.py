"""Where a user has files written to: nothing but a regular file is ever replaced, whatever stands there."""

import os
import stat
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path
from threading import Thread

import pytest
from mindrun.files.atomic_write import destination, rewrite, write, write_out
from mindrun.graph.bundle import read_bundle

from mindlang.lint import lint_file as command
from tests.calling import Call
from tests.surroundings.kinds import DEVICES, FILES, IRREGULAR, KINDS, Make, look

TAKES = ("null", "zero")  # whatever is written into them
LOG = "attempt,generation,best\n1,1,0.5\n1,2,0.7\n"


@pytest.mark.parametrize("writing", [write, write_out])
@pytest.mark.parametrize("kind", KINDS)
def test_only_files_are_replaced(tmp_path: Path, kind: str, writing: Callable[[Path, bytes], None]) -> None:
    path = tmp_path / "out"
    KINDS[kind](path)
    before, linked = look(path), look(tmp_path / "target")
    if kind in FILES or (writing is write_out and kind.split()[-1] in TAKES):
        writing(path, b"new")
        assert kind not in FILES or path.read_bytes() == b"new"
    elif writing is write or kind != "loop":  # which is a link, and may be replaced
        with pytest.raises(OSError, match=r"\w") as refused:
            writing(path, b"new")
        assert refused.value.strerror
        assert look(path) == before
    if writing is write_out and before:
        assert look(path) == before, "a link stays a link"
        assert linked in (None, look(tmp_path / "target"))
    assert not [left for left in tmp_path.iterdir() if left.suffix == ".mind-tmp"]


@pytest.mark.parametrize("kind", KINDS)
def test_a_bundle_is_built_into_whatever_takes_it(mindc: Call, rules: Path, kind: str) -> None:
    out = rules.with_name("out")
    KINDS[kind](out)
    before = look(out)
    said = mindc("build", rules, "-o", out)
    fine = kind in FILES or kind.split()[-1] in TAKES
    assert (said.code, said.out) == (0 if fine else 1, "")
    assert "failed" not in said.err
    if not fine:
        assert said.err.startswith(f"{out} cannot be written: ")
        assert said.err.count("\n") == 1
    if kind in FILES:
        assert read_bundle(out).graph.master == "Roam"
    assert before in (None, look(out))


def test_who_reads_a_pipe_gets_the_bundle(mindc: Call, rules: Path) -> None:
    pipe, got = rules.with_name("pipe"), list[bytes]()
    os.mkfifo(pipe)
    reader = Thread(target=lambda: got.append(pipe.read_bytes()))
    reader.start()
    while mindc("build", rules, "-o", pipe, "--json").code:  # until there is a reader
        assert reader.is_alive()
    reader.join()
    assert mindc("build", rules, "-o", rules.with_name("out")).code == 0
    assert sha256(got[0]).digest() == sha256(rules.with_name("out").read_bytes()).digest()


@pytest.mark.parametrize("kind", IRREGULAR)
def test_a_plot_replaces_no_device(mindc: Call, tmp_path: Path, kind: str) -> None:
    (tmp_path / "log.csv").write_text(LOG)
    out = tmp_path / "out.svg"
    IRREGULAR[kind](out)
    before = look(out)
    said = mindc("plot", tmp_path / "log.csv", "-o", out)
    assert said.code == (0 if kind.split()[-1] in TAKES else 2)
    assert look(out) == before


@pytest.mark.parametrize("name", ["/", ".", "..", "a/", "../"])
@pytest.mark.parametrize("words", ["build r.mind -o", "plot log.csv -o", "run r.mind --picture", "run r.mind --video"])
def test_no_name_is_wrong_usage(mindc: Call, words: str, name: str) -> None:
    said = mindc(*words.split(), name)
    assert said.code == 2
    assert f"{name!r} names no file." in said.err


@pytest.mark.parametrize("name", ["x" * 300, "no/such/folder", "file/out", "x" * 5000, "new/"])
def test_a_name_that_cannot_be_is_refused(tmp_path: Path, name: str) -> None:
    (tmp_path / "file").touch()
    if name != "new/":  # of which a Path knows no more
        with pytest.raises(OSError, match=r"too long|there is no folder"):
            write_out(tmp_path / name, b"new")
    assert [left.name for left in tmp_path.iterdir()] == ["file"]


@pytest.mark.skipif(os.getuid() != 0, reason="only root can give files away")
def test_a_file_that_root_replaces_stays_its_owners(mindc: Call, rules: Path) -> None:
    rules.write_text(rules.read_text().replace(" is ", "  is "))
    os.chown(rules, 12345, 23456)
    rules.chmod(0o640)
    assert mindc("fmt", rules).code == 0
    found = rules.stat()
    assert (found.st_uid, found.st_gid, stat.S_IMODE(found.st_mode)) == (12345, 23456, 0o640)


def test_other_names_of_a_file_keep_what_it_was(tmp_path: Path) -> None:
    path, other = tmp_path / "a", tmp_path / "b"
    path.write_bytes(b"old")
    other.hardlink_to(path)
    write_out(path, b"new")
    assert (path.read_bytes(), other.read_bytes()) == (b"new", b"old")


@pytest.mark.parametrize("kind", IRREGULAR)
def test_nothing_but_a_file_is_edited(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "a.mind"
    IRREGULAR[kind](path)
    with pytest.raises(OSError, match=r"it is a |symbolic links"):
        rewrite(path, b"new", b"")


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
    [(["fmt"], "mindlang.compiler.format.formatted"), (["lint", "--fix"], "mindlang.lint.lint_file.fixed")],
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


def test_a_destination_is_where_the_links_lead(tmp_path: Path) -> None:
    (tmp_path / "far").mkdir()
    (tmp_path / "link").symlink_to("far/file")
    assert destination(tmp_path / "link") == tmp_path.resolve() / "far" / "file"
    assert command  # imported before its parts are replaced


def test_the_devices_are_of_every_kind() -> None:
    makes: list[Make] = [*DEVICES.values()]
    assert len(makes) == 5
