"""A .break file as it should be written: idempotent, with the same meaning and comments."""

import re

from hypothesis import given
from hypothesis import strategies as st

from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.format import formatted as formatted_file
from mindlang.compiler.parse import parse_stops
from mindlang.compiler.source import Source
from tests.fmt.test_format import comments, plain

TEXT = """
stop when on in tick least of greatest and or Avoid influences left_wheel above below 50 50% % 812 1/2 0.5
( ) + - * / < >= holding collision delivery red stopped fault eye # ## " wenn
"""
WORDS = re.findall(r"\S+", TEXT)
BLANKS = st.sampled_from(["", " ", "  ", "\t", " \t "])
LINES = st.sampled_from([
    "stop when Avoid influences left_wheel above 70% and holding > 0.5",
    "stop when -(a - b) * -c < least of a 1 (1 - c) or walls.A+B influences Go below limit",
    "stop on 3 delivery of red to home",
    "stop on fault of eye",
    "stop in tick 812",
    "",
])  # fmt: skip


def formatted(text: str) -> str:
    return formatted_file(text, "stop")


@st.composite
def texts(draw: st.DrawFn) -> str:
    """Lines with odd blanks, some of which say nothing, and comments."""

    def line() -> str:
        words = draw(LINES.map(str.split) | st.lists(st.sampled_from(WORDS), max_size=6))
        comment = draw(st.sampled_from(["", "#", "# why", "#  two  #"]))
        return draw(BLANKS) + "".join(word + draw(BLANKS.filter(bool)) for word in words) + comment

    end = draw(st.sampled_from(["\n", "\r\n"]))
    return end.join(line() for _ in range(draw(st.integers(0, 4))))


def meaning(text: str) -> object:
    """What the lines say, without their places, and what those say that cannot be read."""
    findings = Findings()
    lines = plain(tuple(parse_stops(Source("text", text), findings)))
    return lines, [each.code for each in findings.diagnostics]


@given(texts())
def test_it_is_idempotent_and_keeps_meaning_and_comments(text: str) -> None:
    tidy = formatted(text)
    assert formatted(tidy) == tidy
    assert meaning(tidy) == meaning(text)
    assert comments(tidy) == comments(text)
    assert not tidy or tidy.strip()
    assert "\n\n\n" not in tidy.replace("\r", "")


@given(st.lists(LINES, max_size=3), st.data())
def test_blanks_are_restored(lines: list[str], data: st.DataObject) -> None:
    untidy = [
        "".join(data.draw(BLANKS) * (number == 0) + word + data.draw(BLANKS.filter(bool)) for number, word in words)
        for words in (enumerate(line.split()) for line in lines)
    ]
    assert formatted("\n".join(untidy)) == formatted("\n".join(lines))


def test_words_are_one_space_apart_and_comments_two_behind() -> None:
    text = (
        "\n\n # why\n stop  when  (a -b)*  -c<20 %and Avoid\tinfluences left above 50 %#x\n \n\t\nstop on 3  fault\n\n"
    )
    assert formatted(text) == (
        "# why\nstop when (a - b) * -c < 20% and Avoid influences left above 50%  #x\n\nstop on 3 fault\n"
    )
    assert formatted("") == formatted("\n\n") == formatted(" \r\n") == ""
