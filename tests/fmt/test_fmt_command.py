"""`mindc fmt`, as its users call it."""

from io import BytesIO, TextIOWrapper
from pathlib import Path

import pytest

from tests.calling import RULES, Call

UNTIDY = RULES.replace(" is ", "   is ")
TIDY = RULES


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "rules.mind"
    path.write_text(UNTIDY)
    return path


def test_it_tidies_in_place(mindc: Call, file: Path) -> None:
    said = mindc("fmt", file)
    assert (said.code, said.out, said.err) == (0, "", f"{file} is tidy now\n")
    assert file.read_text() == TIDY
    assert mindc("fmt", file) == (0, "", "")


def test_check_writes_nothing(mindc: Call, file: Path) -> None:
    said = mindc("fmt", file, "--check")
    assert (said.code, said.out, said.err) == (1, "", f"{file} is not tidy\n")
    assert file.read_text() == UNTIDY
    file.write_text(TIDY)
    assert mindc("fmt", file, "--check") == (0, "", "")


def test_diff_writes_nothing(mindc: Call, file: Path) -> None:
    said = mindc("fmt", file, "--diff")
    assert said.code == 1
    assert said.out.startswith("--- a/")
    assert "\n-body Robot   is disc\n" in said.out
    assert "\n+body Robot is disc\n" in said.out
    assert file.read_text() == UNTIDY


def test_standard_input_goes_to_standard_output(mindc: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", TextIOWrapper(BytesIO(UNTIDY.replace("\n", "\r\n").encode())))
    said = mindc("fmt", "-")
    assert (said.code, said.out, said.err) == (0, TIDY.replace("\n", "\r\n"), "")


def test_a_byte_order_mark_and_the_mode_stay(mindc: Call, file: Path) -> None:
    file.write_bytes(b"\xef\xbb\xbf" + UNTIDY.encode())
    file.chmod(0o600)
    assert mindc("fmt", file).code == 0
    assert file.read_bytes() == b"\xef\xbb\xbf" + TIDY.encode()
    assert file.stat().st_mode & 0o777 == 0o600


def test_a_file_with_bad_lines_is_left_as_it_is(mindc: Call, file: Path) -> None:
    text = UNTIDY.replace("drives", "drive", 1)
    file.write_text(text)
    said = mindc("fmt", file)
    assert (said.code, file.read_text()) == (1, text)
    assert "drive" in said.err


def test_files_that_cannot_be_read(mindc: Call, file: Path, tmp_path: Path) -> None:
    (tmp_path / "binary.mind").write_bytes(b"\0")
    said = mindc("fmt", tmp_path / "none.mind", tmp_path / "binary.mind", file)
    assert said.code == 2
    assert "none.mind cannot be read" in said.err
    assert "is a binary file" in said.err
    assert file.read_text() == TIDY, "the others are tidied"


def test_a_link_is_followed(mindc: Call, file: Path, tmp_path: Path) -> None:
    link = tmp_path / "link.mind"
    link.symlink_to(file)
    assert mindc("fmt", link).code == 0
    assert link.is_symlink()
    assert file.read_text() == TIDY


def test_breakpoints_are_known_by_their_name(mindc: Call, file: Path) -> None:
    breaks = file.with_suffix(".break")
    breaks.write_text("stop  on 2 reach of ball#both\n")
    assert mindc("fmt", breaks, file).err == f"{breaks} is tidy now\n{file} is tidy now\n"
    assert breaks.read_text() == "stop on 2 reach of ball  #both\n"
    assert mindc("fmt", breaks, "--check") == (0, "", "")
    breaks.write_text("stop  at collision\n")
    said = mindc("fmt", breaks)
    assert (said.code, breaks.read_text()) == (1, "stop  at collision\n")
    assert "[missing-on]" in said.err
