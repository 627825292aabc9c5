"""What counts as the same print, what does not, and what a page makes of a file."""

import pytest

from tests.pages.comparing import fits
from tests.pages.programs import MARK, printed_by, with_marks
from tests.pages.transcript import Command, Write, changed, steps

SAME = {
    "the same": ("nothing wrong\n", "nothing wrong\n"),
    "another time and rate": ("9 s at 826 k ticks/s; w\n", "14 s at 1.3 M ticks/s; w\n"),
    "another folder of the run": ("in runs/A/20261123T223636Z-1\n", "in runs/A/20270101T000000Z-1\n"),
    "another number of cores": ("on 2 cores\n", "on 16 cores\n"),
    "what is said meanwhile": ("A has learnt\n", "A: attempt 1 of 2, generation 3 of 30, best 1.00, …\nA has learnt\n"),
    "anything in a line": ("a … c\n", "a b b c\n"),
    "any lines": ("a\n…\nd\n", "a\nb\nc\nd\n"),
    "no line": ("a\n…\nd\n", "a\nd\n"),
    "any lines at the beginning": ("…\nd\n", "a\nd\n"),
    "any lines at the end": ("a\n…\n", "a\nb\n"),
}
OTHER = {
    "another figure": ("score 5.40\n", "score 5.41\n"),
    "another count of things": ("5 lamps\n", "6 lamps\n"),
    "another folder of another seed": ("in runs/A/20261123T223636Z-1\n", "in runs/A/20261123T223636Z-2\n"),
    "a line more": ("a\n", "a\nb\n"),
    "a line less": ("a\nb\n", "a\n"),
    "nothing at all": ("a\n", ""),
    "something where nothing is shown": ("", "a\n"),
    "another line after any": ("a\n…\nd\n", "a\nb\ne\n"),
    "any in a line, in two": ("a … c\n", "a b\nc\n"),
}


@pytest.mark.parametrize(("shown", "printed"), SAME.values(), ids=SAME)
def test_it_fits(shown: str, printed: str) -> None:
    assert fits(shown, printed)


@pytest.mark.parametrize(("shown", "printed"), OTHER.values(), ids=OTHER)
def test_it_does_not_fit(shown: str, printed: str) -> None:
    assert not fits(shown, printed)


PAGE = """# Page

```mind a.mind
one
two
```

```diff a.mind
-two
+2
```

    make this            # not run

    $ cat a.mind
    one

    2
    $ true

```mind a.mind add
three
```
"""


def test_a_page_is_files_and_commands_in_order() -> None:
    assert list(steps(PAGE)) == [
        Write("a.mind", "one\ntwo\n", adds=False, changes=False),
        Write("a.mind", "-two\n+2\n", adds=False, changes=True),
        Command("cat a.mind", "one\n\n2\n", 15, 18),
        Command("true", "", 19, 19),
        Write("a.mind", "three\n", adds=True, changes=False),
    ]


def test_files_grow() -> None:
    text = ""
    for step in steps(PAGE):
        text = step.onto(text) if isinstance(step, Write) else text
    assert text == "one\n2\n\nthree\n"


@pytest.mark.parametrize("before", ["", "zwei\n", "two\ntwo\n", "not two\n"])
def test_a_line_that_is_changed_is_there_once(before: str) -> None:
    with pytest.raises(AssertionError, match="not there once"):
        changed(before, "-two\n+2\n")


PROGRAM = """print(1 + 1)  # 2
for word in ("ä", "b"):
    print(word)
    print(f"{word}!")  # ä!
print(print)  # its SHA-256
print("x", end="")
"""


def test_what_a_program_shows_of_its_output_is_found(capsys: pytest.CaptureFixture[str]) -> None:
    program, comments = with_marks(PROGRAM)
    assert comments == ["2", "ä!"]
    exec(compile(program, "program", "exec"), {})
    printed = capsys.readouterr().out
    assert [printed_by(printed, number) for number in (0, 1, 2)] == ["2\n", "ä!\nb!\n", ""]
    assert MARK not in printed_by(printed, 1)
    assert not fits(comments[1], printed_by(printed, 1))
