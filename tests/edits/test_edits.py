"""Every edit does what its cases say, in sources of every shape.

After a change of words: UPDATE=1 pytest tests/edits/test_edits.py, and read the difference.
"""

import os
import re
import shlex
import shutil
import subprocess
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from mindlang.editing.edits import edit, names
from tests.calling import Call
from tests.edits.cases import HERE, SHARED, Case, Files, archived, cases
from tests.language.examples import COLLECT

FILES = sorted(HERE.glob("*.txt"))
CASES = [case for path in FILES for case in cases(path)]

NUMBER = "  #n([0-9]+)"  # a comment by which a line is known

Edited = Callable[[Case], Files]


def each(found: list[Case]) -> pytest.MarkDecorator:
    """A test for each case."""
    return pytest.mark.parametrize("case", found, ids=lambda case: f"{case.edit}: {case.title}")


@pytest.fixture
def prepared(mindc: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[Case], list[str]]:
    """The last command of a case, in a folder in which the others have been carried out."""

    def prepared(case: Case) -> list[str]:
        folder = tmp_path / f"{len(list(tmp_path.iterdir()))}"
        case.lay_out(folder)
        monkeypatch.chdir(folder)
        *earlier, last = (["edit", *case.words(command)] for command in case.commands)
        for words in earlier:
            assert mindc(*words, "--write").code == 0
        return last

    return prepared


@pytest.fixture
def edited(mindc: Call, prepared: Callable[[Case], list[str]]) -> Edited:
    """The files that are others after a case."""

    def edited(case: Case) -> Files:
        words = prepared(case)
        before = texts()
        assert mindc(*words, "--write").code == 0
        return changed(before)

    return edited


def texts() -> Files:
    """The sources in this folder and below it."""
    return {path.as_posix(): path.read_bytes().decode() for path in Path().rglob("*.mind")}


def changed(before: Files) -> Files:
    """The sources that are others than before."""
    return {name: text for name, text in texts().items() if before.get(name) != text}


@each([case for case in CASES if not case.refused])
def test_a_case(case: Case, mindc: Call, prepared: Callable[[Case], list[str]]) -> None:
    words = prepared(case)
    before = texts()
    said = mindc(*words)
    assert said.code == 0, said.err
    assert texts() == before, "something was written without --write"
    assert mindc(*words, "--write").out == ""
    after = changed(before)
    hold(case, archived(after) if case.before else said.out)
    if git := shutil.which("git"):
        for name, text in before.items():
            Path(name).write_bytes(text.encode())
        for name in after.keys() - before.keys():
            Path(name).unlink()
        subprocess.run([git, "apply", "--whitespace=nowarn", "-"], input=said.out.encode(), check=True)
        assert texts() == before | after, "the diff says something else"


@each([case for case in CASES if case.refused])
def test_a_case_that_is_refused(case: Case, mindc: Call, prepared: Callable[[Case], list[str]]) -> None:
    words = prepared(case)
    before = texts()
    said = mindc(*words, "--write")
    assert (said.code, said.out, texts()) == (1, "", before), said.err
    assert "mindc failed" not in said.err
    hold(case, said.err.removesuffix("\n"))


def hold(case: Case, after: str) -> None:
    """Compare what comes out with the case, or write it there."""
    if not os.environ.get("UPDATE"):
        assert after == case.after
        return
    path = HERE / f"{case.edit}.txt"
    head, title, rest = path.read_text(encoding="utf-8").partition(f"==== {case.title}\n")
    old, new = (f"{case.commands[-1]}\n{text}" for text in (case.after, after))
    assert old in rest
    path.write_text(head + title + rest.replace(old, new, 1), encoding="utf-8")


def reshaped() -> list[object]:
    """The cases that are tried in sources of every shape: one of each edit, or in the slow suite all."""
    found, seen = list[object](), Counter[str]()
    for case in CASES:
        if not case.refused and case.edit not in ("scenario3", "fold"):  # no comment is lost
            seen[case.edit] += 1
            marks = [pytest.mark.slow] if seen[case.edit] > 1 else []
            found.append(pytest.param(case, marks=marks, id=f"{case.edit}: {case.title}"))
    return found


@pytest.mark.parametrize("case", reshaped())
def test_a_case_in_sources_of_every_shape(case: Case, edited: Edited) -> None:
    plain = edited(case)
    own = case.before or {SHARED}
    for shape, new in ((windows, crlf), (unfinished, str)):  # a file that is new is like the main one, but ends
        after = edited(case.with_texts(shape))
        assert after == {name: (shape if name in own else new)(text) for name, text in plain.items()}
    numbered = case.with_texts(Numbered())
    after = edited(numbered)
    assert {name: re.sub(NUMBER, "", text) for name, text in after.items()} == plain
    old, new = (numbers("".join(files.values())) for files in (numbered.before, after))
    assert len(dict(new)) == len(new) or case.edit == "inline", "a comment stands there twice"
    assert [(number, verb) for number, verb in new if dict(old)[number] != verb] == []


def windows(text: str) -> str:
    """A text as Windows has it, with its line ends and a byte order mark."""
    return f"\ufeff{crlf(text)}"


def crlf(text: str) -> str:
    """A text with the line ends of Windows."""
    return text.replace("\n", "\r\n")


def unfinished(text: str) -> str:
    """A text whose last line does not end."""
    return text.removesuffix("\n")


@dataclass
class Numbered:
    """Puts a number behind each line on which something stands, over all texts."""

    last: int = 0

    def __call__(self, text: str) -> str:
        """The text with its numbers."""
        return "".join(f"{line}{self._next()}\n" if line else "\n" for line in text.splitlines())

    def _next(self) -> str:
        self.last += 1
        return f"  #n{self.last}"


def numbers(text: str) -> list[tuple[str, str]]:
    """The number of each line that has one, and the word with which it begins."""
    return [(found[1], line.split()[0]) for line in text.splitlines() if (found := re.search(NUMBER, line))]


def test_every_edit_has_its_cases() -> None:
    told = {case.edit for case in CASES}
    assert set(names()) <= told
    assert {case.edit for case in CASES if case.refused} >= set(names())


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_the_cases_of_an_edit_are_about_it(path: Path) -> None:
    found = cases(path)
    assert "".join(f"{case}\n" for case in found).removesuffix("\n") == path.read_text(encoding="utf-8")
    assert len({case.title for case in found}) == len(found)
    if path.stem in names():
        assert {case.commands[-1].split()[0] for case in found} == {path.stem}


@pytest.mark.parametrize("name", names())
def test_the_first_sentence_about_an_edit_fits_the_list_of_commands(name: str) -> None:
    sentence, *_ = edit(name).text.splitlines()
    assert sentence.endswith(".")
    assert len(sentence) <= 62


BEFORE = {"inline": "extract", "unfreeze": "freeze", "unfold": "fold"}  # what undoes an edit needs one


@pytest.mark.parametrize("name", sorted({*names()} - {"prune"}))  # of what was taught: test_growing.py
def test_the_example_of_an_edit_works_on_the_shipped_files(
    name: str, mindc: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for path in (COLLECT, COLLECT.with_name("power.mind"), COLLECT.with_name("like.mind")):
        shutil.copy(path, tmp_path)
    for other in ("legs.mind", "goals.mind"):
        shutil.copy(HERE / "minds" / other, tmp_path)
    monkeypatch.chdir(tmp_path)
    for each in filter(None, (BEFORE.get(name), name)):
        line = edit(each).example.removeprefix("Example: ").replace("\\\n", "")  # as a shell joins them
        command, *words = shlex.split(line)
        assert (command, *words[:2]) == ("mindc", "edit", each)
        said = mindc(*words, *["--write"] * (each != name))
        assert said.code == 0, said.err
    assert said.out.startswith("--- a/")
