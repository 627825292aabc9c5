"""Commands in messages can be pasted, whatever a file is called."""

import ast
import re
import shlex
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.terminal.command_line import command_line

from tests.calling import Call
from tests.edits.taught import MIND, teach
from tests.project.sources import COMPILER, ROOT, RUNTIME, modules, nodes

# What stands behind `mindc` there is no file: a noun, an edit, a project's name, a seed, a command, an error.
NO_FILES = {
    "mindlang/attribution/ends.py", "mindlang/cli/new.py", "mindlang/explaining/collection.py",
    "mindlang/explaining/kinds.py", "mindlang/run/summary.py", "mindlang/server/serve.py",
    "mindlang/server/server.py", "mindlang/diagnosis.py",
    "runtime/mindrun/graph/bundle.py", "runtime/mindrun/robot/live_view.py",
}  # fmt: skip
REFUSED = (
    "run FILE", "bench FILE", "build FILE -o x.bundle", "train FILE Drive", "train FILE Avoid",
    "weights export FILE Go w.safetensors",
)  # fmt: skip
ODD_NAMES = ("a mind.mind", "-x.mind", "it's.mind", "$HOME.mind", "a;b.mind", "*.mind", "ü.mind")


@given(st.text(st.characters(exclude_characters="\0/", exclude_categories=["Cs"]), min_size=1).filter(str.strip))
def test_a_file_stays_a_file(file: str) -> None:
    *words, last = shlex.split(command_line("mindc", "check", Path(file)))
    assert words == ["mindc", "check"]
    assert Path(last) == Path(file)
    assert not last.startswith("-")


def put_together(path: Path) -> Iterator[str]:
    """The texts before each value of an f-string in which the words of a command stand."""
    for node in nodes(path):
        before = ""
        for part in node.values if isinstance(node, ast.JoinedStr) else ():
            if isinstance(part, ast.Constant):
                before += str(part.value)
            elif re.search(r"\bmind(c|run) [a-z][\w -]* $", before) and "command_line(" not in ast.unparse(part):
                yield before


def test_no_command_is_put_together_by_hand() -> None:
    found = {path for path in modules(COMPILER, RUNTIME) if any(put_together(path))}
    assert {path.relative_to(ROOT).as_posix() for path in found} == NO_FILES


@pytest.mark.parametrize("file", ODD_NAMES)
def test_hints_can_be_pasted(mindc: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, file: str) -> None:
    """Each command that is refused names one that finds the same file, and is refused or made by itself."""
    monkeypatch.chdir(tmp_path)
    path = tmp_path / file
    path.write_text(MIND.replace("  drives mood\n", "  drives mood\n  stays frozen\n"))
    for asked in REFUSED:
        said = mindc(*(f"./{file}" if word == "FILE" else word for word in asked.split()))
        hint = said.err.splitlines()[-1].removeprefix("  ").removeprefix("first: ")
        found = [word for word in shlex.split(hint) if word.endswith(".mind")]
        assert [Path(word) for word in found] == [Path(file)], said.err
        assert not found[0].startswith("-")
    teach(path)
    path.write_text(path.read_text().replace("60 ticks", "61 ticks"))
    hints = re.findall(r"mindc status (.*?) --accept", mindc("lint", f"./{file}").err + mindc("lint", f"./{file}").out)
    assert hints
    assert {Path(*shlex.split(hint)) for hint in hints} == {Path(file)}
