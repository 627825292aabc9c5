"""Splices and lines: what is put in and taken out of a text, whatever its line ends, comments and blank lines are."""

from io import StringIO

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.parse import parse
from mindlang.compiler.source import Source, Span, Splice, spliced
from mindlang.editing.insertion import declare, first_line, insert_below, remove_lines, text_of, without_declarations
from mindlang.editing.project import EditError, refuse_misnamed
from mindlang.editing.unified_diff import unified

lines = st.lists(
    st.sampled_from(["", " ", "# a", "  # b", "skill A is rule", "  reads x", "\u2028", "\f", "ä"]), max_size=9
)


@st.composite
def sources(draw: st.DrawFn) -> Source:
    """Any lines with either line end, the last one with or without."""
    end = draw(st.sampled_from(["\n", "\r\n"]))
    return Source("any", end.join(draw(lines)) + draw(st.sampled_from(["", end])))


def made(source: Source, *splices: Splice) -> str:
    """The text of a source with splices made."""
    return spliced(source, splices)


def test_splices_at_one_place_stand_in_their_order() -> None:
    source = Source("text", "ab")
    assert made(source, Splice(source, 1, 1, "x"), Splice(source, 1, 2, "y"), Splice(source, 1, 1, "z")) == "axzy"


def test_splices_that_overlap_are_refused() -> None:
    source = Source("text", "abc")
    with pytest.raises(ValueError, match="overlap at offset 1 of text"):
        spliced(source, [Splice(source, 0, 2, ""), Splice(source, 1, 3, "")])


def test_splices_of_other_sources_are_left_to_them() -> None:
    source, other = Source("text", "a"), Source("text", "a")
    assert spliced(source, [Splice(other, 0, 1, "b")]) == "a"


@given(sources(), st.data())
def test_a_line_that_is_put_in_and_taken_out_leaves_no_trace(source: Source, data: st.DataObject) -> None:
    line = first_line(Span(source, data.draw(st.integers(0, len(source.text))), 0))
    longer = Source("longer", made(source, insert_below(line, ["here"])))
    put_in = first_line(Span(longer, line.end + 2, 0))
    assert put_in.text == "here"
    assert longer.text.count("\n") == source.text.count("\n") + 1
    assert made(longer, remove_lines(put_in, put_in)) == source.text


@given(sources(), st.data())
def test_lines_are_those_of_the_text(source: Source, data: st.DataObject) -> None:
    line = first_line(Span(source, data.draw(st.integers(0, len(source.text))), 0))
    known = [*reversed([above.text for above in line.above()]), line.text, *(below.text for below in line.below())]
    there = source.text.replace("\r\n", "\n").split("\n")
    assert known in (there, there[:-1])


@pytest.mark.parametrize("short", [0, 3, 400])
@given(sources(), sources())
def test_a_diff_makes_the_new_text_of_the_old_one(short: int, old: Source, new: Source) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("mindlang.editing.unified_diff.MAX_COMPARED_LINES", short)
        diff = unified("any", old.text, new.text)
    assert (diff == "") == (old.text == new.text)
    assert patched(old.text, diff) == new.text


def patched(old: str, diff: str) -> str:
    """What a program makes of a text that patches it."""
    there, made = StringIO(old).readlines(), []
    done, mark = 0, ""  # lines of the old text; what the line before begins with
    for line in StringIO(diff).readlines()[2:]:
        if line[0] == "@":
            start, _, length = line.split()[1][1:].partition(",")
            begin = int(start) - (length != "0")
            made += there[done:begin]
            done = begin
        elif line[0] in "- ":
            made += [there[done]] if line[0] == " " else []
            done += 1
        elif line[0] == "+":
            made.append(line[1:])
        elif mark == "+":
            made[-1] = made[-1].removesuffix("\n")
        mark = line[0]
    return "".join([*made, *there[done:]])


def test_a_diff_counts_from_the_first_line_of_a_long_file() -> None:
    old = "".join(f"{number}\n" for number in range(1, 1001))
    new = old.replace("\n500\n", "\n500\nnew\n").replace("\n999\n", "\n")
    assert unified("long.mind", old, new) == (
        "--- a/long.mind\n+++ b/long.mind\n"
        "@@ -498,6 +498,7 @@\n 498\n 499\n 500\n+new\n 501\n 502\n 503\n"
        "@@ -996,5 +997,4 @@\n 996\n 997\n 998\n-999\n 1000\n"
    )


def test_a_long_diff_is_of_the_lines_that_differ() -> None:
    old = "".join(f"{number}\n" for number in range(2000))
    new = old.replace("7\n", "seven\n")
    diff = unified("long.mind", old, new).splitlines()[2:]
    assert sum(line.startswith("-") for line in diff) == sum(line.startswith("+") for line in diff) == 200


def test_a_line_ends_only_where_the_compiler_says() -> None:
    assert unified("a", "x  # \u2028 \f\ny", "x  # \u2028 \f\nz").endswith(
        " x  # \u2028 \f\n-y\n\\ No newline at end of file\n+z\n\\ No newline at end of file\n"
    )


def test_a_name_with_blanks_ends_with_a_tab() -> None:
    assert unified("my own.mind", "x\n", "y\n").startswith("--- a/my own.mind\t\n+++ b/my own.mind\t\n@@")


def test_a_new_file_is_one() -> None:
    assert unified("new.mind", "", "x\n") == "--- /dev/null\n+++ b/new.mind\n@@ -0,0 +1 @@\n+x\n"


EXTENTS = {
    "the comments right above": ("# a\n\n# b\n# c\nskill A is rule\n", "# b\n# c\nskill A is rule\n"),
    "a comment below": ("skill A is rule\n# a\n\n# b\n", "skill A is rule\n# a\n"),
    "a comment farther in": ("skill A is rule\n  # a\nskill B is rule\n", "skill A is rule\n  # a\n"),
    "one farther in below blank lines": ("skill A is rule\n\n\n  # a\n\n# b\n", "skill A is rule\n\n\n  # a\n"),
    "none that leads what follows": ("skill A is rule\n  # a\n# b\nskill B is rule\n", "skill A is rule\n  # a\n"),
    "none that leads a setting": ("skill A is rule\n# b\ntick 1 s\n", "skill A is rule\n"),
    "none of a block that leads what follows": (
        "skill A is rule\n\n# a\n  # b\nskill B is rule\n",
        "skill A is rule\n",
    ),
    "what is between its facts": ("skill A is rule\n# a\n\nreads x\n\n# b\n", "skill A is rule\n# a\n\nreads x\n"),
    "an indented one": (" # a\n skill A is rule\n  # b\n # c\n skill B is rule\n", " # a\n skill A is rule\n  # b\n"),
    "an unfinished one": ("# a\nskill A is rule\n  # b", "# a\nskill A is rule\n  # b\n"),
}


@pytest.mark.parametrize(("text", "extent"), EXTENTS.values(), ids=EXTENTS)
def test_a_declaration_has(text: str, extent: str) -> None:
    for shaped in (text, f"tick 1 s\n\n{text}", f"skill Z is rule\n  reads z\n\n{text}"):
        declarations = parse(Source("text", shaped), Findings()).declarations
        assert text_of([next(known for known in declarations if known.header.name.text == "A")]) == extent


TAKEN_OUT = {
    "A": ("", "skill B is rule\n\n\nskill C is rule\nskill D is rule\n"),
    "B": ("skill A is rule\n", "\n\nskill C is rule\nskill D is rule\n"),
    "C": ("skill A is rule\n\nskill B is rule\n\n\n", "skill D is rule\n"),
    "D": ("skill A is rule\n\nskill B is rule\n\n\n", "skill C is rule\n"),
    "AB": ("", "skill C is rule\nskill D is rule\n"),
    "BC": ("skill A is rule\n\n", "skill D is rule\n"),
    "CD": ("skill A is rule\n\nskill B is rule\n", ""),
    "AC": ("", "skill B is rule\n\n\nskill D is rule\n"),
    "BD": ("skill A is rule\n", "\n\nskill C is rule\n"),
    "ABCD": ("", ""),
}


@pytest.mark.parametrize("names", TAKEN_OUT)
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_declarations_are_taken_out(names: str, end: str) -> None:
    text = "skill A is rule\n\nskill B is rule\n\n\nskill C is rule\nskill D is rule\n".replace("\n", end)
    source = Source("text", text)
    chosen = [known for known in parse(source, Findings()).declarations if known.header.name.text in names]
    assert made(source, *without_declarations(chosen)) == "".join(TAKEN_OUT[names]).replace("\n", end)


def test_several_are_declared_together() -> None:
    file = parse(Source("text", "tick 1 s  # short\n# The end."), Findings())
    both = made(file.source, declare(file, "skill", ["skill A is rule"], ["skill B is rule", "  reads x"]))
    assert both == "tick 1 s  # short\n\nskill A is rule\n\nskill B is rule\n  reads x\n# The end."


@pytest.mark.parametrize("noun", ["skill", "task", "sensor", "thing"])
@pytest.mark.parametrize("name", ["", " ", "9", "a b", "A b", "A\nskill B is rule", "a is b #", "A is b #", "A#", "ä-"])
def test_what_is_no_name_is_refused(noun: str, name: str) -> None:
    with pytest.raises(EditError, match="cannot be the name of"):
        refuse_misnamed(noun, name)
