"""`mindc migrate`: files of before things said what becomes of them mean afterwards what they meant."""

from io import BytesIO, TextIOWrapper
from pathlib import Path

import pytest

from mindlang.compiler.compile import compile_source
from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.migration import migrated_text
from mindlang.compiler.source import Source
from tests.calling import Call
from tests.sim.minds import DRIFTER

OLD = """
task Fetch in arena  # comments stay
  contains object is item size 3 to 1 by 0.1   # here, too
  contains home is zone size 5
  contains plug is power
  contains rock is obstacle count 2
  lasts 9 s
  rewards 10 on reach of object when slow > 0.5
  counts reach of plug
task Carry in arena
  contains object is item
  contains home is zone size 5
  lasts 9 s
  ends on delivery of object
task Neither in arena
  contains object is item
  contains home is zone size 5
  lasts 9 s
"""
NEW = (
    OLD.replace("by 0.1   #", "by 0.1 reached moves   #")
    .replace("is power\n", "is power reached moves\n")
    .replace(
        "task Neither in arena\n  contains object is item\n",
        "task Neither in arena\n  contains object is item delivered stays\n",
    )
)


def source(text: str) -> Source:
    return Source("a.mind", text, Path())


def test_things_say_what_became_of_them() -> None:
    assert migrated_text(source(DRIFTER + OLD), Findings()) == DRIFTER + NEW
    assert migrated_text(source(DRIFTER + NEW), Findings()) == DRIFTER + NEW


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "old.mind"
    path.write_text(DRIFTER + OLD)
    return path


def test_the_diff_is_shown_and_nothing_written(mindc: Call, file: Path) -> None:
    said = mindc("migrate", file)
    assert said.code == 0
    assert said.out.startswith("--- a/")
    assert "\n-  contains plug is power\n" in said.out
    assert "\n+  contains plug is power reached moves\n" in said.out
    assert file.read_text() == DRIFTER + OLD


def test_write_writes(mindc: Call, file: Path) -> None:
    said = mindc("migrate", file, "--write")
    assert (said.code, said.err) == (0, f"{file} is written\n")
    assert file.read_text() == DRIFTER + NEW
    again = mindc("migrate", file, "--write")
    assert (again.code, again.out, again.err) == (0, "", f"{file} needs nothing\n")


def test_standard_input(mindc: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", TextIOWrapper(BytesIO(OLD.encode())))
    assert mindc("migrate", "-", "--write").out == NEW


def test_what_cannot_be_read_is_left(mindc: Call, file: Path) -> None:
    file.write_text(broken := DRIFTER + OLD + "nonsense here\n")
    said = mindc("migrate", file, "--write")
    assert said.code == 1
    assert "nonsense" in said.err
    assert file.read_text() == broken
    assert mindc("migrate", file.parent / "none.mind").code == 2


def test_silence_is_pointed_at() -> None:
    """The same text means something else than before: lint says so, with the old meaning as its fix."""
    from mindlang.lint.lint import lint

    path = Path("old.mind")
    found = list(lint(compile_source(Source("old.mind", DRIFTER + OLD, Path()), path), ["unsaid-outcome"]))
    assert [(each.code, each.span.text) for each in found if each.span] == [
        ("unsaid-outcome", "object"),
        ("unsaid-outcome", "plug"),
    ]
    assert all(each.fix and not each.fix.is_safe for each in found)
    assert not list(lint(compile_source(Source("old.mind", DRIFTER + NEW, Path()), path), ["unsaid-outcome"]))
