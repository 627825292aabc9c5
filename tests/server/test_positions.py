"""Columns in UTF-16 and back, against the bytes that they count."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mindlang.server.lsp_types import Ruler
from tests.server.client import offset, position

TEXTS = st.text(st.sampled_from("ab é😀\u2028\x85\x0b#\n\r"), max_size=40)


@given(TEXTS, st.data())
def test_utf_16_there_and_back(text, data):
    at = data.draw(st.integers(0, len(text)))
    if text[at - 1 : at + 1] == "\r\n":  # between the two there is no place
        at -= 1
    line, column = Ruler(text).place(at)
    assert {"line": line, "character": column} == position(text, at)
    assert Ruler(text).offset(line, column) == at == offset(text, {"line": line, "character": column})


@given(TEXTS, st.integers(-2, 50), st.integers(-2, 50), st.sampled_from(["utf-8", "utf-16", "utf-32"]))
def test_any_place_has_an_offset(text, line, column, encoding):
    assert 0 <= Ruler(text, encoding).offset(line, column) <= len(text)


@pytest.mark.parametrize(("encoding", "column"), [("utf-8", 7), ("utf-16", 4), ("utf-32", 3)])
def test_what_a_column_counts(encoding, column):
    text = "# a\r\né😀 x"
    assert Ruler(text, encoding).place(8) == (1, column)
    assert Ruler(text, encoding).offset(1, column) == 8


def test_behind_the_end_of_a_line_is_its_end():
    assert Ruler("ab\r\ncd").offset(0, 99) == 2
    assert Ruler("ab\r\ncd").offset(9, 0) == 6
    assert Ruler("ab\r\ncd").offset(-1, 5) == 0


def test_half_a_character_is_where_the_next_one_begins():
    assert Ruler("😀x").offset(0, 1) == 1
