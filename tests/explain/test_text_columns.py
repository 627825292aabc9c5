"""Texts side by side: whole names on any terminal, and nothing beyond its edge that could be wrapped."""

from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console
from rich.text import Text

from mindlang.cli._terminal import text_columns

WORDS = st.text("abcdefGH+_", min_size=1, max_size=18)
ROWS = st.lists(st.tuples(WORDS, WORDS, st.lists(WORDS | st.just("\n"), max_size=12)), max_size=5)


@given(ROWS, st.integers(30, 120))
def test_whole_and_within_the_edge(rows: list[tuple[str, str, list[str]]], width: int) -> None:
    found = text_columns(
        Console(width=width), [((Text(name), Text(word)), Text(" ".join(body))) for name, word, body in rows]
    ).plain
    words = [word for name, word, body in rows for word in (name, word, *" ".join(body).split())]
    assert found.split() == words
    short = max((len(name) for name, _, _ in rows), default=0) + 2 + max((len(word) for _, word, _ in rows), default=0)
    for line in found.splitlines():
        assert line == line.rstrip()
        assert len(line) <= max(width, short)
